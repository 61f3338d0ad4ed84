//! Meshes of triangles, and their images in the world.
//!
//! A [`Mesh`] is shared: each [`Instance`] of it stands in the world by its own affine frame. Rays go
//! to the space of the mesh, once for each instance. Which triangles a ray may meet there is not
//! for this room to know: a caller with a structure over [`Mesh::triangle_bounds`] asks a [`MeshLine`] about
//! the candidates.

mod instance;
mod lines;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::Aabb;

pub use instance::{Instance, MeshLine};
pub use lines::MeshLines;

/// How much larger than its triangle a box is, in the unit space of the mesh: a line's crossing is
/// computed from corners seen from at most 6 away, and is off the line by less than half of this.
const MARGIN: f64 = 32.0 * f64::EPSILON;

/// Marks a corner that has no value.
pub const ABSENT: u32 = u32::MAX;

/// Triangles with shared corners.
///
/// Positions are kept in unit space: relative to the centre of their box, in units of the power of
/// two at or above half its longest edge. So sizes and places do no harm to the tests, and a mesh
/// scaled by a power of two is the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    centre: DVec3,
    size: f64,
    /// How far it reaches along each axis, in unit space.
    half: DVec3,
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    normals: Attribute<DVec3>,
    uvs: Attribute<DVec2>,
    slots: Vec<SlotRun>,
}

/// What a mesh is made from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshParts {
    /// Places of corners.
    pub positions: Vec<DVec3>,
    /// Indices in `positions`; a triangle's front is where they turn counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
    /// Normals of corners, of any length above 0. A triangle that lacks one of its three is flat.
    pub normals: Attribute<DVec3>,
    /// Texture coordinates of corners. A corner that lacks its own has 0, 0.
    pub uvs: Attribute<DVec2>,
    /// Runs of triangles with the same material slot, in ascending order; slot 0 before the first.
    pub slots: Vec<SlotRun>,
}

/// Values at the corners of triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute<T> {
    /// The values.
    pub values: Vec<T>,
    /// For each triangle the indices in `values`, or [`ABSENT`]; none at all if there are no
    /// values, or if the indices are those of the positions.
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

/// Why there is no mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// It has no triangles.
    #[error("there are no triangles")]
    Empty,
    /// More than 2³² − 1 of something.
    #[error("there are too many triangles")]
    TooMany,
    /// An index beyond what it is an index of, or not as many indices as triangles.
    #[error("a triangle names a corner that does not exist")]
    Index,
    /// Runs of material slots that do not ascend.
    #[error("the runs of materials are out of order")]
    Order,
    /// A number that is not finite, or a size that is not.
    #[error("a coordinate is out of range")]
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
    /// The values at the corners of a triangle with these positions.
    fn at(&self, triangle: u32, positions: [u32; 3]) -> [Option<T>; 3] {
        let corners = self.corners.get(triangle as usize);
        let corners = corners.copied().unwrap_or(positions);
        corners.map(|corner| self.values.get(corner as usize).copied())
    }

    /// Drops what says nothing, and checks the rest.
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
        if corners.len() != triangles.len() || !corners.as_flattened().iter().all(exists) {
            return Err(MeshError::Index);
        }
        self.values.shrink_to_fit();
        self.corners.shrink_to_fit();
        Ok(self)
    }
}

impl Mesh {
    /// Makes a mesh.
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
            && normals.values.iter().all(|normal| normal.is_finite())
            && uvs.values.iter().all(|uv| uv.is_finite());
        if !finite {
            return Err(MeshError::Range);
        }
        // Positions that no triangle has do not count.
        let used = indices.par_iter().map(|&index| positions[index as usize]);
        let ends = used.map(|position| (position, position)).reduce(
            || (DVec3::INFINITY, DVec3::NEG_INFINITY),
            |a, b| (a.0.min(b.0), a.1.max(b.1)),
        );
        // Of zeros with either sign any may be the least: none keeps its sign.
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

    /// How many triangles there are.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether there are none: no mesh is empty.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The tight axis-aligned box, where it was made.
    pub fn bounds(&self) -> Aabb {
        Aabb {
            min: self.centre - self.size * self.half,
            max: self.centre + self.size * self.half,
        }
    }

    /// The box of a triangle, in the space of [`MeshLine::ray`]: a line that meets the one meets the
    /// other.
    pub fn triangle_bounds(&self, triangle: u32) -> Aabb {
        let [a, b, c] = self.corners(self.triangles[triangle as usize]);
        Aabb {
            min: a.min(b).min(c) - MARGIN,
            max: a.max(b).max(c) + MARGIN,
        }
    }

    /// The material slots that triangles have, in no order and perhaps several times.
    fn slots(&self) -> impl Iterator<Item = u32> {
        let first = self.slots.first().is_none_or(|run| 0 < run.first);
        let named = self.slots.iter().map(|run| run.slot);
        first.then_some(0).into_iter().chain(named)
    }

    /// The slot of a triangle's material.
    fn slot(&self, triangle: u32) -> u32 {
        let after = self.slots.partition_point(|run| run.first <= triangle);
        after.checked_sub(1).map_or(0, |run| self.slots[run].slot)
    }

    /// The corners of a triangle, in unit space.
    #[inline]
    fn corners(&self, triangle: [u32; 3]) -> [DVec3; 3] {
        triangle.map(|corner| self.positions[corner as usize])
    }
}

/// The least power of two that is not below `x` ≥ 0, or the least normal number.
fn next_power_of_two(x: f64) -> f64 {
    let below = super::transform::power_of_two(x);
    if below < x { 2.0 * below } else { below }
}
