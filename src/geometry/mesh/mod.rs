//! Triangle meshes and their instances.
//!
//! A [`Mesh`] is shared: each [`Instance`] places it in the world by an affine frame. Rays are
//! transformed to the space of the mesh once per instance. The caller finds the candidate
//! triangles, usually by a BVH over [`Mesh::triangle_bounds`], and tests them in runs ([`TriangleRuns`]),
//! with a single [`MeshLine`] or the [`MeshLines`] of a packet.

mod instance;
mod packet;
mod runs;
mod surface;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::Aabb;

pub use instance::{Instance, MeshLine, Triangle};
pub use packet::{MeshLines, NearestOnLines};
pub use runs::{RoughLine, TriangleRun, TriangleRuns};
pub(super) use surface::gathered;

/// The margin of a triangle's box, in the unit space of the mesh: a crossing is computed from
/// vertices at most 6 away from the line's start, and is off the line by less than half of this.
const MARGIN: f64 = 32.0 * f64::EPSILON;

/// Marks a vertex without a value.
pub const ABSENT: u32 = u32::MAX;

/// Triangles with shared vertices.
///
/// Positions are stored in unit space: relative to the centre of their box, in units of the least
/// power of two not below half its longest edge. The tests are therefore independent of size and
/// location, and a mesh scaled by a power of two gives the same bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    centre: DVec3,
    size: f64,
    /// The half extent along each axis, in unit space.
    half: DVec3,
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    normals: Attribute<DVec3>,
    uvs: Attribute<DVec2>,
    slots: Vec<SlotRun>,
}

/// The input of [`Mesh::new`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshParts {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Indices into `positions`; counter-clockwise triangles are front-facing.
    pub triangles: Vec<[u32; 3]>,
    /// Vertex normals, of any length above 0. A triangle that lacks one of its three is flat.
    pub normals: Attribute<DVec3>,
    /// Texture coordinates of vertices; 0, 0 if missing.
    pub uvs: Attribute<DVec2>,
    /// Runs of triangles with the same material slot, in ascending order; triangles before the
    /// first run have slot 0.
    pub slots: Vec<SlotRun>,
}

/// Values at the vertices of triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute<T> {
    /// The values, indexed by `corners`.
    pub values: Vec<T>,
    /// For each triangle the indices into `values`, or [`ABSENT`]; empty if there are no values or
    /// the indices equal those of the positions.
    pub corners: Vec<[u32; 3]>,
}

/// A run of triangles with the same material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotRun {
    /// The first triangle; the run ends where the next one begins.
    pub first: u32,
    /// The slot of its material.
    pub slot: u32,
}

/// Why a mesh could not be created.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// There are no triangles.
    #[error("the mesh has no triangles")]
    Empty,
    /// 2³² − 1 or more triangles or positions.
    #[error("the mesh has too many triangles or positions")]
    TooMany,
    /// An index out of range, or a different number of indices than triangles.
    #[error("a triangle refers to a missing vertex")]
    Index,
    /// Runs of material slots that are not in ascending order.
    #[error("the material runs are not in ascending order")]
    Order,
    /// A number or the size of the mesh is not finite.
    #[error("a coordinate is not finite or too large")]
    Range,
}

impl<T> Default for Attribute<T> {
    fn default() -> Self {
        Self {
            values: Vec::new(),
            corners: Vec::new(),
        }
    }
}

impl<T: Copy> Attribute<T> {
    /// The values at the vertices of a triangle with these position indices.
    fn at(&self, triangle: u32, positions: [u32; 3]) -> [Option<T>; 3] {
        let corners = self.corners.get(triangle as usize);
        let corners = corners.copied().unwrap_or(positions);
        corners.map(|corner| self.values.get(corner as usize).copied())
    }

    /// Validates the indices and drops redundant ones.
    fn checked(mut self, triangles: &[[u32; 3]]) -> Result<Self, MeshError> {
        if self.values.is_empty() {
            return Ok(Self::default());
        }
        if self.corners == triangles {
            self.corners = Vec::new();
        }
        let count = self.values.len();
        let exists = |&corner: &u32| corner == ABSENT || (corner as usize) < count;
        let shared = self.corners.is_empty();
        let corners = if shared { triangles } else { &self.corners };
        if corners.len() != triangles.len() || !corners.as_flattened().par_iter().all(exists) {
            return Err(MeshError::Index);
        }
        self.values.shrink_to_fit();
        self.corners.shrink_to_fit();
        Ok(self)
    }
}

impl Mesh {
    /// Creates a mesh; fails if an index or a number is out of range.
    pub fn new(parts: MeshParts) -> Result<Self, MeshError> {
        let MeshParts {
            mut positions,
            triangles,
            normals,
            uvs,
            slots,
        } = parts;
        let count = positions.len();
        let indices = triangles.as_flattened();
        if triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        if u32::MAX as usize <= triangles.len().max(count) {
            return Err(MeshError::TooMany);
        }
        if indices.par_iter().any(|&index| count <= index as usize) {
            return Err(MeshError::Index);
        }
        if !slots.is_sorted_by_key(|run| run.first) {
            return Err(MeshError::Order);
        }
        let finite = positions.par_iter().all(|position| position.is_finite())
            && normals.values.par_iter().all(|normal| normal.is_finite())
            && uvs.values.par_iter().all(|uv| uv.is_finite());
        if !finite {
            return Err(MeshError::Range);
        }
        // Positions that no triangle uses do not count.
        let used = indices.par_iter().map(|&index| positions[index as usize]);
        let ends = used.map(|position| (position, position)).reduce(
            || (DVec3::INFINITY, DVec3::NEG_INFINITY),
            |a, b| (a.0.min(b.0), a.1.max(b.1)),
        );
        // The order of reduction decides between 0 and −0: make both 0.
        let (min, max) = (ends.0 + 0.0, ends.1 + 0.0);
        let centre = 0.5 * min + 0.5 * max;
        let reach = (max - centre).max(centre - min).max_element();
        let size = next_power_of_two(reach);
        if !size.is_finite() {
            return Err(MeshError::Range);
        }
        positions
            .par_iter_mut()
            .for_each(|position| *position = (*position - centre) / size);
        positions.shrink_to_fit();
        let mut mesh = Self {
            centre,
            size,
            half: ((max - centre) / size).max((centre - min) / size),
            normals: normals.checked(&triangles)?,
            uvs: uvs.checked(&triangles)?,
            positions,
            triangles,
            slots,
        };
        mesh.triangles.shrink_to_fit();
        mesh.slots.shrink_to_fit();
        Ok(mesh)
    }

    /// The number of triangles.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether the mesh has no triangles: always false.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The tight axis-aligned box in the mesh's own coordinates.
    pub fn bounds(&self) -> Aabb {
        Aabb {
            min: self.centre - self.size * self.half,
            max: self.centre + self.size * self.half,
        }
    }

    /// The box of a triangle in the space of [`MeshLine::ray`]; a line that crosses the triangle
    /// crosses the box too.
    pub fn triangle_bounds(&self, triangle: u32) -> Aabb {
        let [a, b, c] = self.corners(self.triangles[triangle as usize]);
        Aabb {
            min: a.min(b).min(c) - MARGIN,
            max: a.max(b).max(c) + MARGIN,
        }
    }

    /// The material slots of the triangles, unordered and possibly repeated.
    fn slots(&self) -> impl Iterator<Item = u32> {
        let first = self.slots.first().is_none_or(|run| 0 < run.first);
        let named = self.slots.iter().map(|run| run.slot);
        first.then_some(0).into_iter().chain(named)
    }

    /// The material slot of a triangle.
    fn slot(&self, triangle: u32) -> u32 {
        let after = self.slots.partition_point(|run| run.first <= triangle);
        after.checked_sub(1).map_or(0, |run| self.slots[run].slot)
    }

    /// The vertices of a triangle by its number, in unit space.
    #[inline]
    pub(crate) fn vertices(&self, triangle: u32) -> [DVec3; 3] {
        self.corners(self.triangles[triangle as usize])
    }

    /// The vertices of a triangle, in unit space.
    #[inline]
    fn corners(&self, [a, b, c]: [u32; 3]) -> [DVec3; 3] {
        let corner = |number: u32| self.positions[number as usize];
        [corner(a), corner(b), corner(c)]
    }
}

/// The least power of two not below `x` ≥ 0, at least the least normal number.
fn next_power_of_two(x: f64) -> f64 {
    let below = super::transform::power_of_two(x);
    if below < x { 2.0 * below } else { below }
}
