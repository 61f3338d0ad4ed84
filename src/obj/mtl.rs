//! Material libraries.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::findings::{File, Findings};
use super::lines::{Fault, Statement, Word, statements};
use super::maps::{self, Map, Problem};

/// A material as a library defines it.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The library as named by the mesh; paths are relative to it.
    pub library: Arc<str>,
    /// Kd; white by default.
    pub diffuse: [f64; 3],
    /// Ks; black by default.
    pub specular: [f64; 3],
    /// Ke; black by default.
    pub emission: [f64; 3],
    /// Ns; 0 by default.
    pub exponent: f64,
    /// Ni; 1 by default.
    pub index: f64,
    /// illum, 0 to 7; 2 by default.
    pub illumination: u32,
    /// Tf; black by default.
    pub filter: [f64; 3],
    /// `map_Kd`.
    pub diffuse_map: Option<Map>,
    /// `map_Ks`.
    pub specular_map: Option<Map>,
}

impl Material {
    fn new(library: Arc<str>) -> Self {
        Self {
            library,
            diffuse: [1.0; 3],
            specular: [0.0; 3],
            emission: [0.0; 3],
            exponent: 0.0,
            index: 1.0,
            illumination: 2,
            filter: [0.0; 3],
            diffuse_map: None,
            specular_map: None,
        }
    }
}

/// Keywords of which everything is ignored, though it would change the picture.
const IGNORED: [&str; 10] = [
    "bump", "map_bump", "disp", "map_disp", "norm", "decal", "refl", "map_d", "map_ke", "map_ns",
];

/// What an unusable statement costs.
const COST: &str = "the line is ignored";

/// What `illum` may be to count: other models of the format are ignored.
const MODEL: &str = "a whole number from 0 to 7";

/// A library being read.
struct Library<'t, 'f> {
    file: File<'t>,
    findings: &'f mut Findings,
    /// The words that have been said to be ignored.
    told: HashSet<&'static str>,
}

/// Reads the materials of a library by name, of those that are used. Of two with the same name the last
/// counts; what follows a `newmtl` without a name belongs to none.
pub(super) fn read(
    bytes: &[u8],
    library: &str,
    is_used: impl Fn(&str) -> bool,
    findings: &mut Findings,
) -> HashMap<String, Material> {
    let mut materials = HashMap::new();
    let mut current: Option<(String, Material)> = None;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut reader = Library {
        file: File {
            library: Some(library),
            ..File::text(bytes)
        },
        findings,
        told: HashSet::new(),
    };
    let library: Arc<str> = library.into();
    for statement in statements(bytes, 0..bytes.len(), 1) {
        let keyword = statement.keyword();
        if keyword.text.eq_ignore_ascii_case(b"newmtl") {
            materials.extend(current.take().filter(|(name, _)| is_used(name)));
            let name = statement.rest();
            if name.text.is_empty() {
                let message = "newmtl: the name is missing";
                let fault = Fault::new(statement.end(), message, "the name of the material");
                let cost = "what follows is ignored up to the next newmtl";
                reader.findings.warn(reader.file, fault.costing(cost));
            }
            current = Some((name.name(), Material::new(Arc::clone(&library))));
            continue;
        }
        let set = match &mut current {
            Some((_, material)) => reader
                .set(material, &statement)
                .map_err(|fault| fault.in_statement(&statement)),
            None => before_materials(keyword),
        };
        if let Err(fault) = set {
            reader.findings.warn(reader.file, fault);
        }
    }
    materials.extend(current.filter(|(name, _)| is_used(name)));
    materials
}

/// Warns of a statement that belongs to no material, unless it would be ignored anyway.
fn before_materials(keyword: Word<'_>) -> Result<(), Fault> {
    match &keyword.text.to_ascii_lowercase()[..] {
        b"kd" | b"ks" | b"ke" | b"ns" | b"ni" | b"illum" | b"tf" | b"map_kd" | b"map_ks" => {
            let message = format!("{} stands before the first newmtl", keyword.shown());
            Err(Fault::new(keyword, message, "newmtl").costing(COST))
        }
        _ => Ok(()),
    }
}

impl Library<'_, '_> {
    /// Reads a statement of a material. One that cannot be used changes nothing.
    fn set(&mut self, material: &mut Material, statement: &Statement<'_>) -> Result<(), Fault> {
        let keyword = statement.keyword().text.to_ascii_lowercase();
        match &keyword[..] {
            b"kd" => self.colour(&mut material.diffuse, statement),
            b"ks" => self.colour(&mut material.specular, statement),
            b"ke" => self.colour(&mut material.emission, statement),
            b"tf" => self.colour(&mut material.filter, statement),
            b"ns" => {
                material.exponent = number(statement)?.1;
                Ok(())
            }
            b"ni" => {
                material.index = number(statement)?.1;
                Ok(())
            }
            b"illum" => self.illumination(material, statement),
            b"map_kd" => {
                material.diffuse_map = Some(self.map(statement)?);
                Ok(())
            }
            b"map_ks" => {
                material.specular_map = Some(self.map(statement)?);
                Ok(())
            }
            b"d" => {
                self.opacity("d", 1.0, statement);
                Ok(())
            }
            b"tr" => {
                self.opacity("tr", 0.0, statement);
                Ok(())
            }
            other => {
                let known = IGNORED.iter().find(|word| word.as_bytes() == other);
                if let Some(word) = known.filter(|_| !statement.rest().text.is_empty()) {
                    self.ignored(word, statement.keyword(), statement);
                }
                Ok(())
            }
        }
    }

    /// Reads a colour: one number for all channels, or three. Spectra and CIE XYZ are ignored.
    fn colour(&mut self, colour: &mut [f64; 3], statement: &Statement<'_>) -> Result<(), Fault> {
        const EXPECTED: &str = "one or three numbers";
        let wrong = |word: Word<'_>| {
            let message = format!("expected {EXPECTED}");
            Fault::new(word, message, EXPECTED).costing(COST)
        };
        let mut values = [0.0; 3];
        let mut count = 0;
        for word in statement.words().skip(1) {
            if matches!(word.text, b"spectral" | b"xyz") {
                return Ok(());
            }
            if word.begins_foreign_comment() {
                let fault = Fault::foreign_comment(word).in_statement(statement);
                self.findings.warn(self.file, fault);
                break;
            }
            let value = word.number().map_err(|fault| fault.costing(COST))?;
            *values.get_mut(count).ok_or_else(|| wrong(word))? = value;
            count += 1;
        }
        *colour = match count {
            1 => [values[0]; 3],
            3 => values,
            _ => return Err(wrong(statement.end())),
        };
        Ok(())
    }

    fn illumination(
        &mut self,
        material: &mut Material,
        statement: &Statement<'_>,
    ) -> Result<(), Fault> {
        let (word, model) = number(statement)?;
        if !(0.0..=10.0).contains(&model) || model.fract() != 0.0 {
            let message = format!("expected {MODEL}");
            return Err(Fault::new(word, message, MODEL).costing(COST));
        }
        if model <= 7.0 {
            material.illumination = model as u32;
        } else {
            material.illumination = 2;
            self.ignored("illum", word, statement);
        }
        Ok(())
    }

    /// Warns of an opacity that would be seen: surfaces are as opaque as `illum` and `Tf` say.
    fn opacity(&mut self, keyword: &'static str, usual: f64, statement: &Statement<'_>) {
        let mut values = statement.words().skip(1);
        let value = values.find(|word| word.text != b"-halo");
        let Some(value) = value.filter(|word| word.number().is_ok_and(|value| value != usual))
        else {
            return;
        };
        self.ignored(keyword, value, statement);
    }

    /// Reads a map with its options.
    fn map(&mut self, statement: &Statement<'_>) -> Result<Map, Fault> {
        let read = maps::read(statement, |problem| match problem {
            Problem::Wrong(fault) => {
                let fault = fault.in_statement(statement);
                self.findings.warn(self.file, fault);
            }
            Problem::Ignored(option, word) => self.ignored(option, word, statement),
        });
        read.map_err(|fault| fault.costing(COST))
    }

    /// Warns once that a word is ignored that would change the picture.
    fn ignored(&mut self, word: &'static str, place: Word<'_>, statement: &Statement<'_>) {
        if self.told.insert(word) {
            let message = format!("`{}` is ignored", place.shown());
            let expected = match word {
                "d" | "tr" => "illum 6 or 7 and Tf for transparency",
                "illum" => MODEL,
                _ => "a material without it",
            };
            let fault = Fault::new(place, message, expected);
            let cost = match word {
                "illum" => "illum 2 is used; reported once per library",
                _ => "it has no effect here; reported once per library",
            };
            let fault = fault.costing(cost);
            let is_all = place.text == statement.keyword().text;
            let fault = if is_all {
                fault
            } else {
                fault.in_statement(statement)
            };
            self.findings.warn(self.file, fault);
        }
    }
}

/// The number of a statement.
fn number<'s>(statement: &'s Statement<'_>) -> Result<(Word<'s>, f64), Fault> {
    let Some(word) = statement.words().nth(1) else {
        let fault = Fault::new(statement.end(), "the number is missing", "a number");
        return Err(fault.costing(COST));
    };
    let number = word.number().map_err(|fault| fault.costing(COST))?;
    Ok((word, number))
}
