//! Acceleration structures of meshes: one tree over the triangles of each, shared by all instances.

use std::sync::Arc;

use rayon::prelude::*;

use crate::accel::Bvh;
use crate::geometry::lanes::{Eight, Lanes, Simd, WIDTH, each_bit, mask};
use crate::geometry::{Hit, Hits, Instance, Mesh, MeshLines, Pretest, Ray, Rays, Shape};
use crate::scene::Objects;

/// Which hit of a mesh is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Search {
    /// The nearest hit.
    Nearest,
    /// Any hit, to find out whether light is blocked.
    Blocker,
}

/// The tree over a mesh's triangles, and their vertices for quick tests of the runs it visits.
#[derive(Debug)]
pub(crate) struct MeshTree {
    bvh: Bvh,
    pretest: Pretest,
}

/// The trees of a scene's meshes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Structures {
    /// Each mesh once, with its tree.
    trees: Vec<(Arc<Mesh>, Arc<MeshTree>)>,
    /// Index of each object's tree, 0 for other shapes; empty without meshes.
    numbers: Vec<u32>,
}

/// Up to this many lines of a packet are tested one by one, each against all triangles of a run.
const FEW_LINES: u32 = 2;

impl MeshTree {
    /// `None` once `cancelled` returns true.
    fn build(mesh: &Mesh, cancelled: &(dyn Fn() -> bool + Sync)) -> Option<Self> {
        let bounds = |triangle: u32| mesh.triangle_bounds(triangle);
        let bvh = Bvh::over(mesh.len(), bounds, cancelled)?;
        let pretest = Pretest::new(mesh, bvh.order(), &bvh.runs(), cancelled)?;
        Some(Self { bvh, pretest })
    }
}

impl Structures {
    /// Builds a tree for each mesh, reusing those in `known` for meshes at the same address. `None`
    /// once `cancelled` returns true.
    pub(crate) fn build(
        objects: &Objects,
        known: Option<&Self>,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let mut structures = Self::default();
        for (object, instance) in instances(objects) {
            let mesh = instance.mesh();
            let number = structures.number(mesh);
            let number = number.unwrap_or(structures.trees.len());
            if number == structures.trees.len() {
                let known = known.and_then(|known| Some((known, known.number(mesh)?)));
                let tree = if let Some((known, number)) = known {
                    Arc::clone(&known.trees[number].1)
                } else {
                    Arc::new(MeshTree::build(mesh, cancelled)?)
                };
                structures.trees.push((Arc::clone(mesh), tree));
            }
            structures.numbers.resize(objects.len(), 0);
            structures.numbers[object] = number as u32;
        }
        Some(structures)
    }

    /// Returns a hit of an object, which is this instance, with `0 < t < limit`.
    #[inline(always)]
    pub(crate) fn hit<S: Simd>(
        &self,
        simd: S,
        object: u32,
        instance: &Instance,
        ray: &Ray,
        limit: f64,
        search: Search,
    ) -> Option<Hit> {
        let (_, tree) = &self.trees[self.numbers[object as usize] as usize];
        let line = instance.line(ray)?;
        let limit_on_line = line.limit(limit);
        let rough = line.roughly(simd);
        let mut nearest = None;
        let mut farthest = limit_on_line;
        tree.bvh.traverse(
            simd,
            line.ray(),
            limit_on_line,
            #[inline(always)]
            |run| {
                let candidates = tree.pretest.of_line(&rough, &run);
                for place in each_bit(candidates) {
                    let triangle = tree.bvh.order()[run.start + place];
                    farthest = line.meet(triangle, limit_on_line, &mut nearest);
                    let met = nearest.is_some_and(|nearest| line.hit(nearest, limit).is_some());
                    if met && search == Search::Blocker {
                        return -1.0;
                    }
                }
                farthest
            },
        );
        line.hit(nearest?, limit)
    }

    /// Returns hits of a packet's rays whose bit in `lanes` is 1.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(
        &self,
        object: u32,
        instance: &Instance,
        rays: &Rays<Eight<S>>,
        lanes: u32,
        limits: &Eight<S>,
        search: Search,
    ) -> Option<Hits> {
        let (_, tree) = &self.trees[self.numbers[object as usize] as usize];
        let lines = instance.lines(rays, lanes)?;
        let chosen = mask(limits.simd, lines.lanes);
        let limits_on_lines = Lanes::select(chosen, lines.limits(limits), limits.all(-1.0));
        let mut met = MetTogether {
            lines: &lines,
            limits,
            limits_on_lines,
            search,
            nearest: [None; WIDTH],
        };
        tree.bvh.traverse_packet(
            lines.rays(),
            lines.lanes,
            limits_on_lines,
            #[inline(always)]
            |run, lanes, mut farthest| {
                let order = tree.bvh.order();
                if FEW_LINES < lanes.count_ones() && lines.are_aligned() {
                    for place in run.clone() {
                        let candidates = lines.may_meet(&tree.pretest, &run, place, lanes);
                        for lane in each_bit(candidates) {
                            farthest[lane % WIDTH] = met.meet(lane, order[place]);
                        }
                    }
                } else {
                    for lane in each_bit(lanes) {
                        let rough = lines.line(lane).roughly(limits.simd);
                        for place in each_bit(tree.pretest.of_line(&rough, &run)) {
                            farthest[lane % WIDTH] = met.meet(lane, order[run.start + place]);
                        }
                    }
                }
                farthest
            },
        );
        let nearest = met.nearest;
        Hits::one_by_one(lines.lanes, |lane| {
            lines.line(lane).hit(nearest[lane]?, limits[lane])
        })
    }

    /// The trees, ordered by the first object of their meshes.
    #[cfg(test)]
    pub(crate) fn trees(&self) -> impl Iterator<Item = &Arc<MeshTree>> {
        self.trees.iter().map(|(_, tree)| tree)
    }

    fn number(&self, mesh: &Arc<Mesh>) -> Option<usize> {
        self.trees
            .iter()
            .position(|(known, _)| Arc::ptr_eq(known, mesh))
    }
}

/// The nearest hits of a packet's lines so far.
struct MetTogether<'a, S: Simd> {
    lines: &'a MeshLines<'a, S>,
    limits: &'a Eight<S>,
    limits_on_lines: Eight<S>,
    search: Search,
    nearest: [Option<Hit>; WIDTH],
}

impl<S: Simd> MetTogether<'_, S> {
    /// Tests the line in a lane against a triangle; returns the limit for nearer crossings, below 0
    /// if none is needed.
    #[inline(always)]
    fn meet(&mut self, lane: usize, triangle: u32) -> f64 {
        let lane = lane % WIDTH;
        let (line, nearest) = (self.lines.line(lane), &mut self.nearest[lane]);
        let farthest = line.meet(triangle, self.limits_on_lines[lane], nearest);
        let limit = self.limits[lane];
        let is_met = nearest.is_some_and(|hit| line.hit(hit, limit).is_some());
        if is_met && self.search == Search::Blocker {
            -1.0
        } else {
            farthest
        }
    }
}

/// The mesh instances among objects with their object numbers, in order.
pub(super) fn instances(objects: &Objects) -> Vec<(usize, &Instance)> {
    let meshes = objects
        .par_numbered()
        .filter_map(|(number, object)| match &object.shape {
            Shape::Mesh(instance) => Some((number, &**instance)),
            _ => None,
        });
    meshes.collect()
}
