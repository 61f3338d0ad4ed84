//! Material libraries.

use std::collections::HashMap;

use super::Finding;
use super::lines::{Fault, Findings, Statement, Word, statements};

/// A material as a library defines it.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The library as named by the mesh; paths are relative to it.
    pub library: String,
    /// Kd; white by default.
    pub diffuse: [f64; 3],
    /// Ks; black by default.
    pub specular: [f64; 3],
    /// Ns; 0 by default.
    pub exponent: f64,
    /// Ni; 1 by default.
    pub index: f64,
    /// illum; 2 by default.
    pub illumination: u32,
    /// Tf; black by default.
    pub filter: [f64; 3],
    /// The path of `map_Kd`.
    pub diffuse_map: Option<String>,
    /// The path of `map_Ks`.
    pub specular_map: Option<String>,
}

impl Material {
    fn new(library: String) -> Self {
        Self {
            library,
            diffuse: [1.0; 3],
            specular: [0.0; 3],
            exponent: 0.0,
            index: 1.0,
            illumination: 2,
            filter: [0.0; 3],
            diffuse_map: None,
            specular_map: None,
        }
    }
}

/// Reads the materials of a library by name. Of two with the same name the last counts.
pub(super) fn read(bytes: &[u8], library: &str) -> Result<HashMap<String, Material>, Vec<Finding>> {
    let mut materials = HashMap::new();
    let mut findings = Findings {
        library: Some(library.to_owned()),
        ..Findings::default()
    };
    let mut current: Option<(String, Material)> = None;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    for statement in statements(bytes, 1) {
        if findings.is_full() {
            break;
        }
        let Some(keyword) = statement.words().next() else {
            continue;
        };
        if keyword.text == b"newmtl" {
            materials.extend(current.take());
            let name = statement.rest();
            if name.text.is_empty() {
                findings.error(
                    statement.line,
                    statement.end(),
                    "newmtl: the name is missing",
                );
            }
            current = Some((name.name(), Material::new(library.to_owned())));
            continue;
        }
        let Some((_, material)) = &mut current else {
            if is_known(keyword) {
                findings.error(
                    statement.line,
                    keyword.column,
                    format!("{}: before the first newmtl", keyword.shown()),
                );
            }
            continue;
        };
        if let Err(Fault { column, message }) = set(material, keyword, &statement) {
            let message = format!("{}: {message}", keyword.shown());
            findings.error(statement.line, column, message);
        }
    }
    materials.extend(current);
    if findings.errors.is_empty() {
        Ok(materials)
    } else {
        Err(findings.errors)
    }
}

/// Whether a keyword sets a property of a material.
fn is_known(keyword: Word<'_>) -> bool {
    matches!(
        keyword.text,
        b"Kd" | b"Ks" | b"Ns" | b"Ni" | b"illum" | b"Tf" | b"map_Kd" | b"map_Ks"
    )
}

fn set(material: &mut Material, keyword: Word<'_>, statement: &Statement<'_>) -> Result<(), Fault> {
    match keyword.text {
        b"Kd" => colour(&mut material.diffuse, statement)?,
        b"Ks" => colour(&mut material.specular, statement)?,
        b"Tf" => colour(&mut material.filter, statement)?,
        b"Ns" => material.exponent = number(statement)?,
        b"Ni" => material.index = number(statement)?,
        b"illum" => {
            let model = number(statement)?;
            if !(0.0..=10.0).contains(&model) || model.fract() != 0.0 {
                let column = statement.rest().column;
                return Err(Fault::new(column, "expected a whole number from 0 to 10"));
            }
            material.illumination = model as u32;
        }
        b"map_Kd" => material.diffuse_map = Some(path(statement)?),
        b"map_Ks" => material.specular_map = Some(path(statement)?),
        _ => {}
    }
    Ok(())
}

/// Reads a colour: one number for all channels, or three. Spectra and CIE XYZ are ignored.
fn colour(colour: &mut [f64; 3], statement: &Statement<'_>) -> Result<(), Fault> {
    let mut values = Vec::with_capacity(3);
    for word in statement.words().skip(1) {
        if matches!(word.text, b"spectral" | b"xyz") {
            return Ok(());
        }
        values.push(word.number()?);
        if 3 < values.len() {
            return Err(Fault::new(word.column, "expected one or three numbers"));
        }
    }
    *colour = match values[..] {
        [grey] => [grey; 3],
        [red, green, blue] => [red, green, blue],
        _ => return Err(Fault::new(statement.end(), "expected one or three numbers")),
    };
    Ok(())
}

fn number(statement: &Statement<'_>) -> Result<f64, Fault> {
    let Some(word) = statement.words().nth(1) else {
        return Err(Fault::new(statement.end(), "the number is missing"));
    };
    word.number()
}

/// Reads the path of a map after its options, which are ignored.
fn path(statement: &Statement<'_>) -> Result<String, Fault> {
    let whole = statement.rest();
    let mut words = statement.words().skip(1).peekable();
    while let Some(option) = words.next_if(|word| word.text.starts_with(b"-")) {
        let (least, most) = match option.text {
            b"-o" | b"-s" | b"-t" => (1, 3),
            b"-mm" => (2, 2),
            _ => (1, 1),
        };
        for given in 0..most {
            let is_number = |word: &Word<'_>| word.number().is_ok();
            if words
                .next_if(|word| given < least || is_number(word))
                .is_none()
            {
                break;
            }
        }
    }
    match words.next() {
        Some(first) => {
            let from = first.column - whole.column;
            let path = Word {
                text: &whole.text[from..],
                column: first.column,
            };
            Ok(path.name())
        }
        None => Err(Fault::new(statement.end(), "the path is missing")),
    }
}
