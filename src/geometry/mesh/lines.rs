//! Packets of rays against a mesh.

use std::ops::Range;

use super::{Instance, Mesh, MeshLine, Pretest};
use crate::geometry::Rays;
use crate::geometry::lanes::{Eight, Simd, SimdBase, WIDTH, bits};
use crate::geometry::triangle::{Roughly, Shears};

/// The lines of eight rays in the unit space of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct MeshLines<'m, S: Simd> {
    mesh: &'m Mesh,
    rays: Rays<Eight<S>>,
    shears: Shears<Eight<S>>,
    /// The distances of the lines' starts along the rays.
    start: Eight<S>,
    roughly: Option<Roughly<S>>,
    /// A mask of the rays that the mesh is not behind, lowest bit first.
    pub lanes: u32,
}

impl Instance {
    /// Transforms the rays whose bit in `lanes` is 1 to the space of the mesh; `None` if the mesh
    /// is behind all of them.
    #[inline(always)]
    pub fn lines<S: Simd>(&self, rays: &Rays<Eight<S>>, lanes: u32) -> Option<MeshLines<'_, S>> {
        let (line, is_ahead) = self.approach(rays);
        let lanes = bits::<S>(is_ahead) & lanes;
        if lanes == 0 {
            return None;
        }
        let rays = Rays {
            origin: line.origin,
            direction: line.direction,
        };
        let shears = Shears::new(rays.direction);
        Some(MeshLines {
            mesh: self.mesh(),
            roughly: Roughly::each(&rays.origin, &shears, lanes),
            rays,
            shears,
            start: line.start,
            lanes,
        })
    }
}

impl<'m, S: Simd> MeshLines<'m, S> {
    /// The lines as rays in the space of [`Mesh::triangle_bounds`], their directions of any length.
    #[inline(always)]
    pub fn rays(&self) -> &Rays<Eight<S>> {
        &self.rays
    }

    /// The line of a ray whose bit is set in [`MeshLines::lanes`].
    #[inline(always)]
    pub fn line(&self, lane: usize) -> MeshLine<'m> {
        let lane = lane % WIDTH;
        let line = self.rays.ray(lane);
        let sheared = self.shears.lane(line.origin, lane);
        MeshLine::from_parts(self.mesh, line, sheared, self.start[lane])
    }

    /// The maximum distances along [`Self::rays`] of hits nearer than the world rays' limits.
    #[inline(always)]
    pub fn limits(&self, limits: &Eight<S>) -> Eight<S> {
        let mut on_lines = *(*limits - self.start);
        for limit in &mut on_lines {
            *limit = limit.next_up();
        }
        Eight::load_array(limits.simd, on_lines)
    }

    /// Whether [`Self::may_meet`] tests all lines together.
    #[inline(always)]
    pub fn are_aligned(&self) -> bool {
        self.roughly.is_some()
    }

    /// The given lanes without those whose line surely misses the triangle at a place of a run by
    /// [`MeshLine::meet`].
    #[inline(always)]
    pub fn may_meet(&self, pretest: &Pretest, run: &Range<usize>, place: usize, lanes: u32) -> u32 {
        match &self.roughly {
            Some(lines) => pretest.of_triangle(lines, run, place) & lanes,
            None => lanes,
        }
    }
}
