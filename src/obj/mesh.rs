//! Meshes: vertices, faces and the assignment of materials.

use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::findings::{File, Findings};
use super::libraries::Libraries;
use super::lines::{Fault, Place, Spot, Statement, statements};
use super::plain::{self, Chunk, Plain};
use super::polygons::Polygons;
use super::{Finding, Model};
use geometry::{Mesh, MeshParts};
use text::counted;

/// The maximum number of vertices, and of others, that cannot be used. They take more memory than
/// their lines.
const MAX_WRONG: usize = 1 << 24;

/// What an unusable value of each kind costs: positions, texture coordinates, normals.
const COSTS: [&str; 3] = [
    "faces that use it are left out",
    "it reads as 0 0",
    "faces that use it are flat",
];

/// A mesh being read.
pub(super) struct MeshBuilder<'t> {
    pub(super) file: File<'t>,
    /// The maximum number of triangles.
    pub(super) most: usize,
    /// What corners may refer to, if the file has been read once; until then all may follow later.
    pub(super) known: Option<Known>,
    pub(super) parts: MeshParts,
    pub(super) polygons: Polygons,
    pub(super) findings: Findings,
    /// The greatest index of each kind plus 1.
    pub(super) greatest: [u32; 3],
    /// The indices of values that cannot be used, ascending.
    wrong: [Vec<u32>; 3],
    pub(super) libraries: Libraries,
    /// The corners of the current face: position, texture coordinates, normal.
    pub(super) corners: Vec<[u32; 3]>,
    /// The last line with a statement.
    last: usize,
}

/// The values in a file that the corners of its faces may refer to.
#[derive(Debug)]
pub(super) struct Known {
    /// The number of values of each kind.
    pub(super) counts: [usize; 3],
    /// The indices of those that cannot be used, ascending.
    wrong: [Vec<u32>; 3],
}

impl Known {
    /// Whether there is a usable value of a kind at an index below its count.
    pub(super) fn is_usable(&self, kind: usize, index: u32) -> bool {
        self.wrong[kind].binary_search(&index).is_err()
    }

    /// Whether all corners of plain lines refer to usable values.
    fn suffices(&self, plain: &Plain) -> bool {
        let [v, vt, vn] = [&plain.triangles, &plain.uv_corners, &plain.normal_corners];
        [v, vt, vn].into_iter().enumerate().all(|(kind, corners)| {
            let is_usable = |&index: &u32| self.is_usable(kind, index);
            plain.greatest[kind] as usize <= self.counts[kind]
                && (self.wrong[kind].is_empty() || corners.as_flattened().iter().all(is_usable))
        })
    }
}

/// See [`super::read`]. `most` is the maximum number of triangles.
pub(super) fn read<B: AsRef<[u8]>>(
    bytes: &[u8],
    most: usize,
    library: impl FnMut(&str) -> Result<B, String>,
) -> Result<Model, Vec<Finding>> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    read_parts(bytes, || plain::parts(bytes, plain::PART), most, library)
}

/// Reads a text that `parts` cuts into parts. If corners refer to values that are not there, it is
/// read once more: only then are all values known, which may follow the faces.
pub(super) fn read_parts<B: AsRef<[u8]>>(
    bytes: &[u8],
    parts: impl Fn() -> Vec<Chunk>,
    most: usize,
    library: impl FnMut(&str) -> Result<B, String>,
) -> Result<Model, Vec<Finding>> {
    let mut builder = MeshBuilder::new(bytes, most, None).read(parts())?;
    if let Some(known) = builder.lacking() {
        drop(builder);
        builder = MeshBuilder::new(bytes, most, Some(known)).read(parts())?;
    }
    builder.model(library)
}

impl<'t> MeshBuilder<'t> {
    fn new(bytes: &'t [u8], most: usize, known: Option<Known>) -> Self {
        Self {
            file: File::text(bytes),
            most,
            known,
            parts: MeshParts::default(),
            polygons: Polygons::default(),
            findings: Findings::default(),
            greatest: [0; 3],
            wrong: <[_; 3]>::default(),
            libraries: Libraries::default(),
            corners: Vec::new(),
            last: 1,
        }
    }

    /// Reads the whole text. Fails if it has too many triangles.
    fn read(mut self, mut parts: Vec<Chunk>) -> Result<Self, Vec<Finding>> {
        if let Some(known) = &self.known {
            for part in &mut parts {
                part.plain = part.plain.take().filter(|plain| known.suffices(plain));
            }
        }
        let mut line = 1;
        self.reserve(&parts);
        for run in parts.chunk_by_mut(|a, b| a.plain.is_some() && b.plain.is_some()) {
            let (fitting, others) = run.split_at_mut(self.fitting(run));
            let mut content = Vec::with_capacity(fitting.len());
            for part in fitting {
                self.last = part.last.map_or(self.last, |last| line + last);
                if let Some(plain) = part.plain.take() {
                    for (greatest, own) in self.greatest.iter_mut().zip(plain.greatest) {
                        *greatest = own.max(*greatest);
                    }
                    content.push(plain);
                }
                line += part.lines;
            }
            plain::append(content, &mut self.parts, &mut self.polygons);
            for part in others {
                for statement in statements(self.file.bytes, part.range.clone(), line) {
                    self.last = statement.last_line();
                    if let Err(fault) = self.take(&statement) {
                        return Err(self.findings.fail(self.file, fault));
                    }
                }
                line += part.lines;
            }
        }
        Ok(self)
    }

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

    /// The number of values of each kind so far.
    pub(super) fn counts(&self) -> [usize; 3] {
        let MeshParts {
            positions,
            uvs,
            normals,
            ..
        } = &self.parts;
        [positions.len(), uvs.values.len(), normals.values.len()]
    }

    /// All values of the file, if corners refer to others or some cannot be used.
    fn lacking(&mut self) -> Option<Known> {
        let counts = self.counts();
        let exceeds = |(greatest, count): (u32, usize)| count < greatest as usize;
        let has_wrong = self.wrong.iter().any(|wrong| !wrong.is_empty());
        let exceeds = self.greatest.into_iter().zip(counts).any(exceeds);
        (exceeds || has_wrong).then(|| Known {
            counts,
            wrong: std::mem::take(&mut self.wrong),
        })
    }

    /// Reads a statement. Fails only if there are too many triangles.
    fn take(&mut self, statement: &Statement<'_>) -> Result<(), Fault> {
        let keyword = statement.keyword();
        match keyword.text {
            // A weight or a colour may follow.
            b"v" => {
                let position = self.value(0, statement, 3..=7)?;
                self.parts.positions.push(DVec3::from_array(position));
            }
            b"vt" => {
                let uv = self.value(1, statement, 1..=3)?;
                self.parts.uvs.values.push(DVec2::from_array(uv));
            }
            b"vn" => {
                let normal = self.value(2, statement, 3..=3)?;
                self.parts.normals.values.push(DVec3::from_array(normal));
            }
            b"f" | b"fo" => return self.face(statement),
            b"usemtl" => {
                let first = self.parts.triangles.len() as u32;
                let slots = &mut self.parts.slots;
                if let Err(fault) = self.libraries.use_material(statement, first, slots) {
                    self.findings.warn(self.file, fault);
                }
            }
            b"mtllib" => {
                if let Err(fault) = self.libraries.add(statement) {
                    self.findings.warn(self.file, fault);
                }
            }
            // Groups and smoothing do not affect triangles; points and lines have no surface.
            b"" | b"g" | b"o" | b"s" | b"mg" | b"p" | b"l" => {}
            _ => {
                let message = format!("`{}` is ignored", keyword.shown());
                let expected = "v, vt, vn, f, usemtl or mtllib";
                let fault = Fault::new(keyword, message, expected);
                self.findings.warn(self.file, fault);
            }
        }
        Ok(())
    }

    /// Reads a value of a kind. One that cannot be used is 0 and noted as wrong, so that the following
    /// indices keep their meaning. Fails if there are too many of these.
    fn value<const N: usize>(
        &mut self,
        kind: usize,
        statement: &Statement<'_>,
        allowed: RangeInclusive<usize>,
    ) -> Result<[f64; N], Fault> {
        let value = self.numbers(statement, allowed, COSTS[kind]);
        if value.is_none() {
            if self.wrong[kind].len() == MAX_WRONG {
                let message = format!("more than {MAX_WRONG} lines cannot be used");
                return Err(Fault::new(statement.keyword(), message, "fewer bad lines"));
            }
            let index = self.counts()[kind] as u32;
            self.wrong[kind].push(index);
        }
        Ok(value.unwrap_or([0.0; N]))
    }

    /// Reads the first N numbers of a statement, 0 if missing; `None` if they cannot be used. Warns
    /// unless these are numbers and the number of words is in `allowed`. `cost` says what unusable
    /// numbers mean.
    fn numbers<const N: usize>(
        &mut self,
        statement: &Statement<'_>,
        allowed: RangeInclusive<usize>,
        cost: &'static str,
    ) -> Option<[f64; N]> {
        let mut warn = |fault: Fault| self.findings.warn(self.file, fault.in_statement(statement));
        let mut numbers = [0.0; N];
        let mut count = 0;
        let (least, most) = (*allowed.start(), *allowed.end());
        for word in statement.words().skip(1) {
            if word.begins_foreign_comment() {
                warn(Fault::foreign_comment(word));
                break;
            }
            if let Some(number) = numbers.get_mut(count) {
                match word.coordinate() {
                    Ok(value) => *number = value,
                    Err(wrong) => {
                        warn(wrong.costing(cost));
                        return None;
                    }
                }
            }
            count += 1;
            if most < count {
                let expected = format!("at most {}", counted(most, "number"));
                let message = format!("expected {expected}");
                warn(Fault::new(word, message, expected).costing("the rest is ignored"));
                break;
            }
        }
        if count < least {
            let expected = counted(least, "number");
            let message = format!("expected {expected}, found {count}");
            warn(Fault::new(statement.end(), message, expected).costing(cost));
            return None;
        }
        Some(numbers)
    }

    /// The mesh and its materials. Fails if there are no faces.
    fn model<B: AsRef<[u8]>>(
        mut self,
        library: impl FnMut(&str) -> Result<B, String>,
    ) -> Result<Model, Vec<Finding>> {
        self.polygons.reshape(&mut self.parts);
        let mut parts = self.parts;
        // Values that no corner refers to are dropped.
        if parts.normals.corners.is_empty() {
            parts.normals.values.clear();
        }
        if parts.uvs.corners.is_empty() {
            parts.uvs.values.clear();
        }
        let mesh = if parts.triangles.is_empty() {
            Err("the file has no faces that can be used".to_owned())
        } else {
            Mesh::new(parts).map_err(|error| error.to_string())
        };
        match mesh {
            Ok(mesh) => {
                let (materials, library_warnings) = self.libraries.read(self.file, library);
                Ok(Model {
                    mesh: Arc::new(mesh),
                    materials,
                    warnings: self.findings.finish(),
                    library_warnings,
                })
            }
            Err(message) => {
                let fault = Fault {
                    place: Spot::from(Place {
                        line: self.last,
                        at: self.file.bytes.trim_ascii_end().len(),
                    }),
                    length: 0,
                    message,
                    expected: "a line such as f 1 2 3".to_owned(),
                    cost: "",
                };
                Err(self.findings.fail(self.file, fault))
            }
        }
    }
}
