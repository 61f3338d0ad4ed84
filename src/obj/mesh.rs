//! Meshes: vertices, faces and the assignment of materials.

use std::collections::HashMap;
use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::lines::{Fault, Findings, Statement, Word, statements};
use super::plain::{self, Chunk, Plain, push_corners};
use super::{Finding, MAX_FINDINGS, MAX_LIBRARIES, Model, mtl};
use crate::geometry::{ABSENT, Mesh, MeshError, MeshParts, SlotRun};
use crate::text::{counted, visible};

/// The kinds of values that a corner of a face refers to, in this order.
const KINDS: [&str; 3] = ["v", "vt", "vn"];

/// A mesh being read.
#[derive(Default)]
struct MeshBuilder {
    /// The maximum number of triangles.
    most: usize,
    parts: MeshParts,
    findings: Findings,
    /// The greatest index of each kind plus 1, with its line and column; checked at the end because
    /// the value may follow later.
    greatest: [(u32, usize, usize); 3],
    /// The slots of materials by name; slot 0 means no material.
    slots: HashMap<String, u32>,
    /// The names of slots from 1 on, with line and column of their first use.
    named: Vec<(String, usize, usize)>,
    /// The names of libraries with line and column.
    libraries: Vec<(String, usize, usize)>,
    /// The corners of the current face: position, texture coordinates, normal.
    corners: Vec<[u32; 3]>,
}

/// See [`super::read`]. `most` is the maximum number of triangles.
pub(super) fn read<B: AsRef<[u8]>>(
    bytes: &[u8],
    most: usize,
    library: impl FnMut(&str) -> Result<B, String>,
) -> Result<Model, Vec<Finding>> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    read_parts(bytes, plain::parts(bytes, plain::PART), most, library)
}

/// Reads a text that has been cut into parts.
pub(super) fn read_parts<B: AsRef<[u8]>>(
    bytes: &[u8],
    mut parts: Vec<Chunk>,
    most: usize,
    library: impl FnMut(&str) -> Result<B, String>,
) -> Result<Model, Vec<Finding>> {
    let mut builder = MeshBuilder {
        most,
        ..MeshBuilder::default()
    };
    let mut last = 1;
    let mut line = 1;
    builder.reserve(&parts);
    for run in parts.chunk_by_mut(|a, b| a.plain.is_some() && b.plain.is_some()) {
        let (fitting, others) = run.split_at_mut(builder.fitting(run));
        let mut content = Vec::with_capacity(fitting.len());
        for part in fitting {
            last = part.last.map_or(last, |last| line + last);
            if let Some(plain) = part.plain.take() {
                builder.note(&plain, line);
                content.push(plain);
            }
            line += part.lines;
        }
        plain::append(content, &mut builder.parts);
        for part in others {
            for statement in statements(&bytes[part.range.clone()], line) {
                last = statement.line;
                if let Err(Fault { column, message }) = builder.take(&statement) {
                    builder.findings.error(statement.line, column, message);
                }
                if builder.findings.is_full() {
                    return Err(builder.findings.errors);
                }
            }
            line += part.lines;
        }
    }
    builder.check_indices();
    let (materials, library_warnings) = builder.materials(library);
    let MeshBuilder {
        mut parts,
        mut findings,
        ..
    } = builder;
    if !findings.errors.is_empty() {
        return Err(findings.errors);
    }
    // Values that no corner refers to are dropped.
    if parts.normals.corners.is_empty() {
        parts.normals.values.clear();
    }
    if parts.uvs.corners.is_empty() {
        parts.uvs.values.clear();
    }
    match Mesh::new(parts) {
        Ok(mesh) => Ok(Model {
            mesh: Arc::new(mesh),
            materials,
            warnings: findings.warnings,
            library_warnings,
        }),
        Err(error) => {
            let message = match error {
                MeshError::Empty => "the file has no faces".to_owned(),
                other => other.to_string(),
            };
            findings.error(last, 1, message);
            Err(findings.errors)
        }
    }
}

impl MeshBuilder {
    /// Reserves memory for the content of plain parts, so that several runs of them do not regrow the lists.
    fn reserve(&mut self, parts: &[Chunk]) {
        let plain = || parts.iter().filter_map(|part| part.plain.as_ref());
        let sum = |of: fn(&Plain) -> usize| plain().map(of).sum();
        let own = &mut self.parts;
        own.positions.reserve(sum(|plain| plain.positions.len()));
        own.triangles.reserve(sum(|plain| plain.triangles.len()));
        own.uvs.values.reserve(sum(|plain| plain.uvs.len()));
        own.uvs.corners.reserve(sum(|plain| plain.uv_corners.len()));
        own.normals.values.reserve(sum(|plain| plain.normals.len()));
        let corners = sum(|plain| plain.normal_corners.len());
        own.normals.corners.reserve(corners);
    }

    /// How many parts at the start are plain and keep within the limit of triangles.
    fn fitting(&self, parts: &[Chunk]) -> usize {
        let mut triangles = self.parts.triangles.len();
        let fits = |part: &&Chunk| {
            let Some(plain) = &part.plain else {
                return false;
            };
            triangles += plain.triangles.len();
            triangles <= self.most
        };
        parts.iter().take_while(fits).count()
    }

    /// Notes the greatest indices in plain lines, the first of which has number `line`.
    fn note(&mut self, plain: &Plain, line: usize) {
        for (known, greatest) in self.greatest.iter_mut().zip(plain.greatest) {
            if known.0 < greatest.0 {
                *known = (greatest.0, line + greatest.1, greatest.2);
            }
        }
    }

    fn take(&mut self, statement: &Statement<'_>) -> Result<(), Fault> {
        let Some(keyword) = statement.words().next() else {
            return Ok(());
        };
        match keyword.text {
            b"v" => {
                // A weight or a colour may follow.
                let (position, fault) = numbers(statement, 3..=7);
                // Kept even if it is wrong, so that the following indices keep their meaning.
                self.parts.positions.push(DVec3::from_array(position));
                fault
            }
            b"vt" => {
                let (uv, fault) = numbers(statement, 1..=3);
                self.parts.uvs.values.push(DVec2::from_array(uv));
                fault
            }
            b"vn" => {
                let (normal, fault) = numbers(statement, 3..=3);
                self.parts.normals.values.push(DVec3::from_array(normal));
                fault
            }
            b"f" | b"fo" => self.face(statement),
            b"usemtl" => self.use_material(statement),
            b"mtllib" => {
                let names = statement.rest();
                if names.text.is_empty() {
                    return Err(Fault::new(statement.end(), "mtllib: the name is missing"));
                }
                if self.libraries.len() == MAX_LIBRARIES {
                    let message = format!("more than {MAX_LIBRARIES} mtllib statements");
                    return Err(Fault::new(keyword.column, message));
                }
                let library = (names.name(), statement.line, names.column);
                self.libraries.push(library);
                Ok(())
            }
            // Groups and smoothing do not affect triangles; points and lines have no surface.
            b"g" | b"o" | b"s" | b"mg" | b"p" | b"l" => Ok(()),
            _ => {
                let message = format!("`{}` is ignored", keyword.shown());
                self.findings.warn(statement.line, keyword.column, message);
                Ok(())
            }
        }
    }

    fn face(&mut self, statement: &Statement<'_>) -> Result<(), Fault> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        for word in statement.words().skip(1) {
            corners.push(self.corner(statement.line, word)?);
        }
        if corners.len() < 3 {
            let count = corners.len();
            let message = format!("f: expected at least three corners, found {count}");
            return Err(Fault::new(statement.end(), message));
        }
        let parts = &mut self.parts;
        let first = parts.triangles.len();
        if self.most < first + corners.len() - 2 {
            let message = format!("f: more than {} triangles", self.most);
            return Err(Fault::new(1, message));
        }
        for pair in corners[1..].windows(2) {
            let fan = [corners[0], pair[0], pair[1]];
            parts.triangles.push(fan.map(|corner| corner[0]));
            let number = parts.triangles.len();
            push_corners(&mut parts.uvs.corners, number, fan.map(|corner| corner[1]));
            push_corners(
                &mut parts.normals.corners,
                number,
                fan.map(|corner| corner[2]),
            );
        }
        self.corners = corners;
        Ok(())
    }

    /// Parses the indices of a corner, converted to start at 0.
    fn corner(&mut self, line: usize, word: Word<'_>) -> Result<[u32; 3], Fault> {
        let counts = [
            self.parts.positions.len(),
            self.parts.uvs.values.len(),
            self.parts.normals.values.len(),
        ];
        let mut corner = [ABSENT; 3];
        let fault =
            |message: String| Fault::new(word.column, format!("f: `{}` {message}", word.shown()));
        for (place, text) in word.text.split(|&byte| byte == b'/').enumerate() {
            let Some(kind) = KINDS.get(place) else {
                return Err(fault("has more than three indices".into()));
            };
            if text.is_empty() && 0 < place {
                continue;
            }
            let number = std::str::from_utf8(text).ok();
            let number: Option<i64> = number.and_then(|text| text.parse().ok());
            let index = match number {
                None => {
                    return Err(fault(
                        "is not a corner: expected v, v/vt, v//vn or v/vt/vn".into(),
                    ));
                }
                Some(0) => return Err(fault("is not an index: indices start at 1".into())),
                Some(number) if 0 < number => number - 1,
                Some(number) => counts[place] as i64 + number,
            };
            let Some(index) = u32::try_from(index).ok().filter(|&index| index < ABSENT) else {
                let count = counts[place];
                return Err(fault(format!(
                    "is out of range: there are {count} {kind} so far"
                )));
            };
            corner[place] = index;
            let (greatest, _, _) = self.greatest[place];
            if greatest <= index {
                self.greatest[place] = (index + 1, line, word.column);
            }
        }
        Ok(corner)
    }

    fn use_material(&mut self, statement: &Statement<'_>) -> Result<(), Fault> {
        let name = statement.rest();
        if name.text.is_empty() {
            return Err(Fault::new(statement.end(), "usemtl: the name is missing"));
        }
        let next = self.slots.len() as u32 + 1;
        let slot = *self.slots.entry(name.name()).or_insert(next);
        if slot == next {
            self.named.push((name.name(), statement.line, name.column));
        }
        let first = self.parts.triangles.len() as u32;
        let runs = &mut self.parts.slots;
        match runs.last_mut() {
            Some(last) if last.first == first => last.slot = slot,
            Some(last) if last.slot == slot => {}
            _ => runs.push(SlotRun { first, slot }),
        }
        Ok(())
    }

    /// Checks that the greatest indices exist: they may refer to later lines.
    fn check_indices(&mut self) {
        let counts = [
            self.parts.positions.len(),
            self.parts.uvs.values.len(),
            self.parts.normals.values.len(),
        ];
        for ((kind, count), (greatest, line, column)) in
            KINDS.into_iter().zip(counts).zip(self.greatest)
        {
            if count < greatest as usize {
                let message = format!("f: refers to {kind} {greatest}, but there are only {count}");
                self.findings.error(line, column, message);
            }
        }
    }

    /// Reads the libraries. Returns the material of each slot and the warnings.
    fn materials<B: AsRef<[u8]>>(
        &mut self,
        mut library: impl FnMut(&str) -> Result<B, String>,
    ) -> (Vec<Option<mtl::Material>>, Vec<Finding>) {
        let mut materials = HashMap::new();
        let mut findings = Findings::default();
        let mut seen = Vec::new();
        for (names, line, column) in std::mem::take(&mut self.libraries) {
            if seen.contains(&names) {
                continue;
            }
            seen.push(names.clone());
            // A line may name one library whose name contains blanks, or several.
            let several = names.contains(|c: char| c.is_ascii_whitespace());
            let read: Vec<_> = match library(&names) {
                Err(_) if several => names
                    .split_ascii_whitespace()
                    .take(MAX_LIBRARIES)
                    .map(|name| (name.to_owned(), library(name)))
                    .collect(),
                bytes => vec![(names, bytes)],
            };
            for (name, bytes) in read {
                match bytes {
                    Ok(bytes) => match mtl::read(bytes.as_ref(), &name) {
                        Ok(defined) => materials.extend(defined),
                        Err(errors) => findings.warnings.extend(errors),
                    },
                    Err(reason) => {
                        let message = format!("cannot read `{}`: {reason}", visible(&name));
                        findings.warn(line, column, message);
                    }
                }
            }
        }
        // The definitions in an unreadable library are not known.
        let is_known = findings.warnings.is_empty();
        let mut by_slot = vec![None];
        for (name, line, column) in std::mem::take(&mut self.named) {
            let material = materials.get(&name).cloned();
            if material.is_none() && is_known {
                let message = format!("no library defines `{}`", visible(&name));
                findings.warn(line, column, message);
            }
            by_slot.push(material);
        }
        findings.warnings.truncate(MAX_FINDINGS);
        (by_slot, findings.warnings)
    }
}

/// Reads the first N numbers of a statement, 0 if missing. Also returns an error unless these are
/// numbers and the number of words is in `allowed`.
fn numbers<const N: usize>(
    statement: &Statement<'_>,
    allowed: RangeInclusive<usize>,
) -> ([f64; N], Result<(), Fault>) {
    let mut numbers = [0.0; N];
    let mut count = 0;
    let fault = |column: usize, message: &str| {
        Err(Fault::new(
            column,
            format!("{}: {message}", keyword(statement)),
        ))
    };
    for word in statement.words().skip(1) {
        if let Some(number) = numbers.get_mut(count) {
            match word.number() {
                Ok(value) => *number = value,
                Err(wrong) => return (numbers, fault(wrong.column, &wrong.message)),
            }
        }
        count += 1;
        if *allowed.end() < count {
            let message = format!("expected at most {}", counted(*allowed.end(), "number"));
            return (numbers, fault(word.column, &message));
        }
    }
    if count < *allowed.start() {
        let expected = counted(*allowed.start(), "number");
        let message = format!("expected {expected}, found {count}");
        return (numbers, fault(statement.end(), &message));
    }
    (numbers, Ok(()))
}

fn keyword(statement: &Statement<'_>) -> String {
    statement
        .words()
        .next()
        .map_or_else(String::new, |word| word.shown())
}
