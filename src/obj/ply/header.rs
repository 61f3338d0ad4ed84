//! The header of a `.ply` file: what its elements are, and how they are written.

use super::super::findings::{File, Findings};
use super::super::lines::{Fault, Place, Spot, Word};

/// The maximum number of elements and of properties in all, which take more memory than their lines.
const MOST: usize = 1000;

/// The keywords of a header.
const KEYWORDS: &str = "format, comment, obj_info, element, property or end_header";

/// How the values behind the header are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// What each row of an element consists of, in this order.
#[derive(Clone, Copy, Debug)]
pub(super) enum Column {
    /// A value with what it is for: [`X`] and so on; `None` if it is not used.
    One(Scalar, Option<usize>),
    /// The number of items, and so many.
    List {
        count: Scalar,
        item: Scalar,
        /// Whether the items are the vertices of a face.
        is_face: bool,
    },
}

/// What a value of a vertex is for. Coordinates are followed by those of the normal and of the texture.
pub(super) const X: usize = 0;
pub(super) const NORMAL: usize = 3;
pub(super) const UV: usize = 6;
/// The number of these.
pub(super) const USES: usize = 8;

/// The names of what is used of a vertex.
const NAMES: [&[&str]; USES] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["s", "u", "texture_u", "texture_s"],
    &["t", "v", "texture_v", "texture_t"],
];

/// What is called so in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Vertex,
    Face,
    /// It is skipped.
    Other,
}

impl Kind {
    /// The word for a row of it.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Vertex => "vertex",
            Self::Face => "face",
            Self::Other => "element",
        }
    }
}

/// A kind of rows.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) kind: Kind,
    /// How many rows the file claims to have.
    pub(super) count: u64,
    pub(super) columns: Vec<Column>,
}

impl Element {
    /// Whether its rows have all of these values.
    pub(super) fn has(&self, uses: std::ops::Range<usize>) -> bool {
        let has = |wanted| {
            let is =
                |column: &Column| matches!(column, Column::One(_, Some(own)) if *own == wanted);
            self.columns.iter().any(is)
        };
        uses.into_iter().all(has)
    }

    /// Whether its rows have the vertices of a face.
    pub(super) fn lists_corners(&self) -> bool {
        let lists = |column: &Column| matches!(column, Column::List { is_face: true, .. });
        self.columns.iter().any(lists)
    }

    /// The least bytes of a row.
    pub(super) fn least(&self, encoding: Encoding) -> usize {
        let column = |column: &Column| match (encoding, column) {
            // A digit and a blank.
            (Encoding::Text, _) => 2,
            (_, Column::One(scalar, _)) => scalar.size(),
            (_, Column::List { count, .. }) => count.size(),
        };
        self.columns.iter().map(column).sum()
    }
}

impl Scalar {
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Its bytes where it is not text.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    const fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

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
                    let fault = Fault::new(name, "the colours of the mesh are not drawn", "");
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
        let role = NAMES.iter().position(|names| is(&names));
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
            line: lines.next.line.saturating_sub(1).max(1),
            at,
        }),
    }
}

/// The lines of a header. All end as the first does: the values behind the last one may begin with any
/// bytes.
struct Lines<'t> {
    bytes: &'t [u8],
    end: u8,
    next: Place,
}

impl<'t> Lines<'t> {
    fn of(bytes: &'t [u8]) -> Self {
        let is_end = |byte: &&u8| matches!(**byte, b'\n' | b'\r');
        let first = bytes.iter().position(|byte| is_end(&byte));
        let end = first.map_or(b'\n', |at| match bytes[at..] {
            [b'\r', b'\n', ..] => b'\n',
            [end, ..] => end,
            [] => b'\n',
        });
        Self {
            bytes,
            end,
            next: Place { line: 1, at: 0 },
        }
    }
}

impl<'t> Iterator for Lines<'t> {
    type Item = (Place, &'t [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let start = self.next;
        let rest = self.bytes.get(start.at..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|&byte| byte == self.end);
        let length = length.unwrap_or(rest.len());
        self.next = Place {
            line: start.line + 1,
            at: self.bytes.len().min(start.at + length + 1),
        };
        Some((start, rest[..length].trim_ascii_end()))
    }
}

/// A line of a header.
struct Line<'t> {
    start: Place,
    text: &'t [u8],
}

impl<'t> Line<'t> {
    fn new(start: Place, text: &'t [u8]) -> Self {
        Self { start, text }
    }

    /// A word by its number; the empty place behind the line if there are fewer.
    fn word(&self, number: usize) -> Word<'t> {
        let words = self.text.split(u8::is_ascii_whitespace);
        let mut words = words.filter(|word| !word.is_empty());
        let text = words.nth(number);
        let text = text.unwrap_or(&self.text[self.text.len()..]);
        let offset = text.as_ptr() as usize - self.text.as_ptr() as usize;
        Word {
            text,
            place: Spot::from(Place {
                at: self.start.at + offset,
                ..self.start
            }),
        }
    }
}
