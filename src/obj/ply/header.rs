//! Reads the header of a `.ply` file.

use super::super::findings::{File, Findings};
use super::super::lines::{Fault, Place, Spot, Word};
use super::elements::{Column, Element, Encoding, Kind, NAMES, Scalar};
use super::header_lines::{Line, Lines};

/// The maximum number of elements and of properties in all, which take more memory than their lines.
const MOST: usize = 1000;

/// The keywords of a header.
const KEYWORDS: &str = "format, comment, obj_info, element, property or end_header";

/// A header.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the last line begins.
    pub(super) end: Place,
    /// Where the values begin.
    pub(super) body: Place,
}

/// Reads the header of a file. Fails with what is wrong with it.
pub(super) fn read(file: File<'_>, findings: &mut Findings) -> Result<Header, Fault> {
    let mut lines = Lines::of(file.bytes);
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let (mut properties, mut has_colours) = (0, false);
    let (start, first) = lines.next().unwrap_or((lines.next, b""));
    if first != b"ply" {
        let word = Line::new(start, first).word(0);
        let message = format!("`{}` begins no .ply file", word.shown());
        return Err(Fault::new(word, message, "a first line of ply"));
    }
    loop {
        let Some((start, text)) = lines.next() else {
            let message = "the header has no end";
            return Err(Fault::new(end_of(file, &lines), message, "end_header"));
        };
        let line = Line::new(start, text);
        match line.word(0).text {
            b"comment" | b"obj_info" | b"" => {}
            b"format" => encoding = Some(format(&line)?),
            b"element" => {
                if elements.len() == MOST {
                    return Err(too_many(&line, "elements"));
                }
                let element = element(&line, &elements)?;
                elements.push(element);
            }
            b"property" => {
                properties += 1;
                if properties == MOST {
                    return Err(too_many(&line, "properties"));
                }
                let Some(element) = elements.last_mut() else {
                    let message = "property: there is no element yet";
                    return Err(Fault::new(line.word(0), message, "an element before it"));
                };
                let column = property(&line, element.kind)?;
                element.columns.push(column);
                let name = line.word(2);
                if matches!(name.text, b"red" | b"diffuse_red") && !has_colours {
                    has_colours = true;
                    let fault =
                        Fault::new(name, "the colours of the mesh are not drawn", "no colours");
                    let fault = fault.costing("the material of the object gives its colour");
                    findings.warn(file, fault);
                }
            }
            b"end_header" => {
                let encoding = encoding.ok_or_else(|| {
                    let message = "the header does not say its format";
                    Fault::new(line.word(0), message, "a line such as format ascii 1.0")
                })?;
                return Ok(Header {
                    encoding,
                    elements,
                    end: start,
                    body: lines.next,
                });
            }
            _ => {
                let word = line.word(0);
                let message = format!("`{}` is ignored", word.shown());
                findings.warn(file, Fault::new(word, message, KEYWORDS));
            }
        }
    }
}

fn format(line: &Line<'_>) -> Result<Encoding, Fault> {
    Ok(match line.word(1).text {
        b"ascii" => Encoding::Text,
        b"binary_little_endian" => Encoding::LittleEndian,
        b"binary_big_endian" => Encoding::BigEndian,
        _ => {
            let word = line.word(1);
            let message = format!("format: `{}` is not a format", word.shown());
            let expected = "ascii, binary_little_endian or binary_big_endian";
            return Err(Fault::new(word, message, expected));
        }
    })
}

/// Reads an element; of several vertices or faces the first counts.
fn element(line: &Line<'_>, others: &[Element]) -> Result<Element, Fault> {
    let (name, word) = (line.word(1), line.word(2));
    let count = std::str::from_utf8(word.text).ok();
    let Some(count) = count.and_then(|count| count.parse().ok()) else {
        let message = format!("element: `{}` is not a count", word.shown());
        return Err(Fault::new(word, message, "a whole number of 0 or more"));
    };
    let kind = match name.text {
        b"vertex" => Kind::Vertex,
        b"face" => Kind::Face,
        _ => Kind::Other,
    };
    let is_first = others.iter().all(|other| other.kind != kind);
    Ok(Element {
        kind: if is_first { kind } else { Kind::Other },
        count,
        columns: Vec::new(),
    })
}

fn property(line: &Line<'_>, of: Kind) -> Result<Column, Fault> {
    let scalar = |at: usize| {
        let word = line.word(at);
        Scalar::named(word.text).ok_or_else(|| {
            let message = format!("property: `{}` is not a type", word.shown());
            let expected = "list, char, uchar, short, ushort, int, uint, float or double";
            Fault::new(word, message, expected)
        })
    };
    if line.word(1).text != b"list" {
        let scalar = scalar(1)?;
        let name = line.word(2).text;
        let is = |names: &&[&str]| names.iter().any(|known| known.as_bytes() == name);
        let role = NAMES.iter().position(is);
        return Ok(Column::One(scalar, role.filter(|_| of == Kind::Vertex)));
    }
    let (count, item) = (scalar(2)?, scalar(3)?);
    if !count.is_integer() {
        let message = "property: the length of a list is no whole number";
        return Err(Fault::new(line.word(2), message, "an integer type"));
    }
    let name = line.word(4).text;
    Ok(Column::List {
        count,
        item,
        is_face: of == Kind::Face && matches!(name, b"vertex_indices" | b"vertex_index"),
    })
}

fn too_many(line: &Line<'_>, what: &str) -> Fault {
    let message = format!("more than {MOST} {what}");
    Fault::new(line.word(0), message, format!("at most {MOST}"))
}

/// The place behind the last line.
fn end_of<'t>(file: File<'t>, lines: &Lines<'t>) -> Word<'t> {
    let at = file.bytes.trim_ascii_end().len();
    Word {
        text: b"",
        place: Spot::from(Place {
            line: lines.line_of(at),
            at,
        }),
    }
}
