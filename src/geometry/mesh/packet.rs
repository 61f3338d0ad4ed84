//! Intersection of packets of eight rays with a mesh.

use super::{Instance, Mesh, MeshLine, TriangleRun};
use crate::lanes::{Eight, Lanes, Simd, SimdBase, WIDTH, bits, each_bit, mask};
use crate::line::End;
use crate::triangle::{Roughly, Sheared, Shears};
use crate::{Hit, Hits, Rays};

/// Up to this many lines of a packet are tested one by one, each against all triangles of a run.
const MOST_SINGLE_LINES: u32 = 2;

/// The lines of eight rays in the unit space of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct MeshLines<'m, S: Simd> {
    mesh: &'m Mesh,
    rays: Rays<Eight<S>>,
    shears: Shears<Eight<S>>,
    /// The distances of the lines' starts along the rays.
    start: Eight<S>,
    /// Those lines together, if their largest components are on the same axis.
    together: Option<(Sheared<Eight<S>>, Roughly<S>)>,
    /// A mask of the rays that the mesh is not behind, lowest bit first.
    pub lanes: u32,
}

/// The nearest triangles met so far, in each lane.
#[derive(Clone, Copy, Debug)]
pub struct NearestOnLines<S: Simd> {
    /// The distance along the line, or the limit if none is met.
    pub t: Eight<S>,
    /// The triangle's number, or [`NONE`].
    part: Eight<S>,
}

/// Above the number of each triangle.
const NONE: f64 = u32::MAX as f64;

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
            together: shears
                .sheared_together(rays.origin, lanes)
                .map(|lines| (lines, Roughly::each(&lines))),
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

    /// No triangle met up to limits along [`Self::rays`].
    #[inline(always)]
    pub fn none_before(&self, limits: Eight<S>) -> NearestOnLines<S> {
        let part = Eight::splat(limits.simd, NONE);
        NearestOnLines { t: limits, part }
    }

    /// Runs [`MeshLine::meet`] for the lines in the given lanes and the triangles of a run.
    #[inline(always)]
    pub fn meet_run(&self, run: &TriangleRun<'_>, lanes: u32, nearest: &mut NearestOnLines<S>) {
        let simd = nearest.t.simd;
        match &self.together {
            Some((lines, roughly)) if MOST_SINGLE_LINES < lanes.count_ones() => {
                let zero = Eight::splat(simd, 0.0);
                for (at, &triangle) in run.triangles.iter().enumerate() {
                    let lanes = run.may_cross_at(roughly, at) & lanes;
                    if lanes == 0 {
                        continue;
                    }
                    let corners = lines.splat(self.mesh.vertices(triangle));
                    let Some((crossing, crosses)) = lines.crossing(corners) else {
                        continue;
                    };
                    let (t, part) = (crossing.t, Eight::splat(simd, triangle.into()));
                    let is_nearer =
                        t.below(nearest.t) | t.equals(nearest.t) & part.below(nearest.part);
                    let is_ahead = zero.below(self.start + t);
                    let counts = crosses & is_nearer & is_ahead & mask(simd, lanes);
                    nearest.t = Lanes::select(counts, t, nearest.t);
                    nearest.part = Lanes::select(counts, part, nearest.part);
                }
            }
            _ => {
                for lane in each_bit(lanes) {
                    let lane = lane % WIDTH;
                    let mut alone = nearest.hit(lane);
                    let limit = nearest.t[lane];
                    let line = self.line(lane);
                    let roughly = line.roughly(simd);
                    nearest.t[lane] = line.meet_run(&roughly, run, limit, &mut alone);
                    nearest.part[lane] = alone.map_or(NONE, |hit| hit.part.into());
                }
            }
        }
    }

    /// The nearest triangles as hits of the world's rays, where t is less than their limits.
    #[inline(always)]
    pub fn hits(&self, nearest: &NearestOnLines<S>, limits: Eight<S>) -> Option<Hits> {
        let end = End {
            t: self.start + nearest.t,
            part: nearest.part,
        };
        let is_met = end.part.below(limits.all(NONE)) & end.t.below(limits);
        let lanes = bits::<S>(is_met) & self.lanes;
        (lanes != 0).then(|| end.hits(lanes))
    }
}

impl<S: Simd> NearestOnLines<S> {
    /// The nearest triangle in a lane, with its distance along the line.
    #[inline(always)]
    fn hit(&self, lane: usize) -> Option<Hit> {
        let (t, part) = (self.t[lane], self.part[lane]);
        (part < NONE).then_some(Hit {
            t,
            part: part as u32,
        })
    }
}
