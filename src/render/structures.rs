//! Acceleration structures of meshes: one tree over the triangles of each, shared by all instances.

use std::sync::Arc;

use rayon::prelude::*;

use crate::accel::Bvh;
use crate::geometry::lanes::{Eight, Lanes, Simd, WIDTH, mask};
use crate::geometry::{Hit, Hits, Instance, Mesh, Ray, Rays, Shape};
use crate::scene::Objects;

/// Which hit of a mesh is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Search {
    /// The nearest hit.
    Nearest,
    /// Any hit, to find out whether light is blocked.
    Blocker,
}

/// The trees of a scene's meshes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Structures {
    /// Each mesh once, with its tree.
    trees: Vec<(Arc<Mesh>, Arc<Bvh>)>,
    /// Index of each object's tree, 0 for other shapes; empty without meshes.
    numbers: Vec<u32>,
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
                    let bounds = |triangle: u32| mesh.triangle_bounds(triangle);
                    Arc::new(Bvh::over(mesh.len(), bounds, cancelled)?)
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
        let mut nearest = None;
        tree.traverse(
            simd,
            line.ray(),
            limit_on_line,
            #[inline(always)]
            |places| {
                let mut farthest = limit_on_line;
                for &triangle in &tree.order()[places] {
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
        let mut nearest = [None; WIDTH];
        tree.traverse_packet(
            lines.rays(),
            lines.lanes,
            limits_on_lines,
            #[inline(always)]
            |places, lanes, mut farthest| {
                for &triangle in &tree.order()[places] {
                    let mut candidates = lines.may_meet(triangle, lanes);
                    while candidates != 0 {
                        let lane = candidates.trailing_zeros() as usize % WIDTH;
                        candidates &= candidates - 1;
                        let (line, nearest) = (lines.line(lane), &mut nearest[lane]);
                        farthest[lane] = line.meet(triangle, limits_on_lines[lane], nearest);
                        let met = nearest.is_some_and(|hit| line.hit(hit, limits[lane]).is_some());
                        if met && search == Search::Blocker {
                            farthest[lane] = -1.0;
                        }
                    }
                }
                farthest
            },
        );
        Hits::one_by_one(lines.lanes, |lane| {
            lines.line(lane).hit(nearest[lane]?, limits[lane])
        })
    }

    /// The trees, ordered by the first object of their meshes.
    #[cfg(test)]
    pub(crate) fn trees(&self) -> impl Iterator<Item = &Arc<Bvh>> {
        self.trees.iter().map(|(_, tree)| tree)
    }

    fn number(&self, mesh: &Arc<Mesh>) -> Option<usize> {
        self.trees
            .iter()
            .position(|(known, _)| Arc::ptr_eq(known, mesh))
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
