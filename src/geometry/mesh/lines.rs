//! Packets of rays against a mesh.

use super::{Instance, Mesh, MeshLine};
use crate::geometry::lanes::{Eight, Simd, SimdBase, WIDTH};
use crate::geometry::triangle::ShearedLines;
use crate::geometry::{Ray, Rays};

/// The lines of eight rays in the unit space of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct MeshLines<'m, S: Simd> {
    mesh: &'m Mesh,
    lines: [MeshLine<'m>; WIDTH],
    rays: Rays<Eight<S>>,
    sheared: Option<ShearedLines<S>>,
    /// A mask of the rays that the mesh is not behind, lowest bit first.
    pub lanes: u32,
}

impl Instance {
    /// Transforms the rays whose bit in `lanes` is 1 to the space of the mesh; `None` if the mesh
    /// is behind all of them.
    #[inline(always)]
    pub fn lines<S: Simd>(&self, rays: &Rays<Eight<S>>, lanes: u32) -> Option<MeshLines<'_, S>> {
        let simd = rays.origin.x.simd;
        let mut hit_lanes = 0;
        let mut lines = [None; WIDTH];
        for (lane, line) in lines.iter_mut().enumerate() {
            if lanes >> lane & 1 == 1 {
                *line = self.line(&rays.ray(lane));
                hit_lanes |= u32::from(line.is_some()) << lane;
            }
        }
        // Unused lanes repeat one of the lines.
        let any = lines.into_iter().flatten().next()?;
        let lines = lines.map(|line| line.unwrap_or(any));
        let rays: [Ray; WIDTH] = lines.map(|line| *line.ray());
        Some(MeshLines {
            mesh: self.mesh(),
            rays: Rays::gather(simd, &rays),
            sheared: ShearedLines::new(simd, lines.each_ref().map(MeshLine::sheared)),
            lines,
            lanes: hit_lanes,
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
    pub fn line(&self, lane: usize) -> &MeshLine<'m> {
        &self.lines[lane % WIDTH]
    }

    /// The maximum distances along [`Self::rays`] of hits nearer than the world rays' limits.
    #[inline(always)]
    pub fn limits(&self, limits: &Eight<S>) -> Eight<S> {
        let mut on_lines = [0.0; WIDTH];
        for lane in 0..WIDTH {
            on_lines[lane] = self.lines[lane].limit(limits[lane]);
        }
        Eight::load_array(limits.simd, on_lines)
    }

    /// The given lanes without those whose line surely misses a triangle by [`MeshLine::meet`].
    #[inline(always)]
    pub fn may_meet(&self, triangle: u32, lanes: u32) -> u32 {
        match &self.sheared {
            Some(sheared) => {
                let corners = self.mesh.triangles[triangle as usize];
                sheared.may_cross(self.mesh.corners(corners)) & lanes
            }
            None => lanes,
        }
    }
}
