//! Rays side by side against a mesh.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

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
    /// A bit for each ray that the mesh is not behind of.
    pub lanes: u32,
}

impl Instance {
    /// The lines of some of eight rays, those whose bit in `lanes` is 1; `None` if the mesh is
    /// behind them all.
    #[inline(always)]
    pub fn lines<S: Simd>(&self, rays: &Rays<Eight<S>>, lanes: u32) -> Option<MeshLines<'_, S>> {
        let simd = rays.origin.x.simd;
        let mut met = 0;
        let mut lines = [None; WIDTH];
        for (lane, line) in lines.iter_mut().enumerate() {
            if lanes >> lane & 1 == 1 {
                *line = self.line(&rays.ray(lane));
                met |= u32::from(line.is_some()) << lane;
            }
        }
        // One of them stands in for those that are not.
        let any = lines.into_iter().flatten().next()?;
        let lines = lines.map(|line| line.unwrap_or(any));
        let rays: [Ray; WIDTH] = lines.map(|line| *line.ray());
        Some(MeshLines {
            mesh: self.mesh(),
            rays: Rays::gather(simd, &rays),
            sheared: ShearedLines::new(simd, lines.each_ref().map(MeshLine::sheared)),
            lines,
            lanes: met,
        })
    }
}

impl<'m, S: Simd> MeshLines<'m, S> {
    /// The lines as rays, of any speed, among [`Mesh::triangle_bounds`].
    #[inline(always)]
    pub fn rays(&self) -> &Rays<Eight<S>> {
        &self.rays
    }

    /// The line of a ray that has its bit in [`MeshLines::lanes`].
    #[inline(always)]
    pub fn line(&self, lane: usize) -> &MeshLine<'m> {
        &self.lines[lane % WIDTH]
    }

    /// How far along [`Self::rays`] anything nearer than the limits along the world's rays can be.
    #[inline(always)]
    pub fn limits(&self, limits: &Eight<S>) -> Eight<S> {
        let mut on_lines = [0.0; WIDTH];
        for lane in 0..WIDTH {
            on_lines[lane] = self.lines[lane].limit(limits[lane]);
        }
        Eight::load_array(limits.simd, on_lines)
    }

    /// Of some lanes, those whose line [`MeshLine::meet`] may find to cross a triangle.
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
