//! Acceleration structures of meshes: one tree over the triangles of each, shared by all instances.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use accel::{Bvh, Order};
use geometry::lanes::{Eight, Lanes, Simd, WIDTH, mask};
use geometry::{
    Hit, Hits, Instance, IsCancelled, Mesh, MeshLine, Ray, Rays, Shape, TriangleRun, TriangleRuns,
};
use scene::Objects;

/// Which hit of a mesh is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Search {
    /// The nearest hit.
    Nearest,
    /// Any hit, to find out whether light is blocked.
    Blocker,
}

/// The tree over a mesh's triangles, and the runs of them that it visits.
#[derive(Debug)]
pub(crate) struct MeshTree {
    bvh: Bvh,
    runs: TriangleRuns,
}

/// The trees of a scene's meshes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Structures {
    /// Each mesh once, with its tree.
    trees: Vec<(Arc<Mesh>, Arc<MeshTree>)>,
    /// Index of each object's tree, 0 for other shapes; empty without meshes.
    numbers: Vec<u32>,
}

impl MeshTree {
    /// `None` once `cancelled` returns true.
    fn build(mesh: &Mesh, cancelled: IsCancelled<'_>) -> Option<Self> {
        let bounds = |triangle: u32| mesh.triangle_bounds(triangle);
        let bvh = Bvh::over(mesh.len(), bounds, cancelled)?;
        let runs = TriangleRuns::new(mesh, bvh.order(), &bvh.runs(cancelled)?, cancelled)?;
        Some(Self { bvh, runs })
    }

    /// Returns a hit of a line's ray with `0 < t < limit`.
    #[inline(always)]
    fn hit<S: Simd>(
        &self,
        simd: S,
        line: &MeshLine<'_>,
        limit: f64,
        search: Search,
    ) -> Option<Hit> {
        simd.vectorize(
            #[inline(always)]
            || {
                let limit_on_line = line.limit(limit);
                let roughly = line.roughly(simd);
                let mut nearest = None;
                self.bvh.traverse(
                    simd,
                    line.ray(),
                    limit_on_line,
                    #[inline(always)]
                    |places| {
                        let run = self.run(places);
                        let farthest = line.meet_run(&roughly, &run, limit_on_line, &mut nearest);
                        let is_met = || nearest.is_some_and(|hit| line.hit(hit, limit).is_some());
                        if search == Search::Blocker && is_met() {
                            return -1.0;
                        }
                        farthest
                    },
                );
                line.hit(nearest?, limit)
            },
        )
    }

    /// The triangles at some places visited at once.
    #[inline(always)]
    fn run(&self, places: Range<usize>) -> TriangleRun<'_> {
        self.runs.run(self.bvh.order(), places)
    }
}

impl Structures {
    /// Builds a tree for each mesh, reusing those in `known` for meshes at the same address. `None`
    /// once `cancelled` returns true.
    pub(crate) fn build(
        objects: &Objects,
        known: Option<&Self>,
        cancelled: IsCancelled<'_>,
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
        tree.hit(simd, &line, limit, search)
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
        let closed = limits.all(-1.0);
        let limits_on_lines = Lanes::select(chosen, lines.limits(limits), closed);
        if !tree.bvh.takes_together(lines.rays()) {
            return Hits::one_by_one(
                lines.lanes,
                #[inline(always)]
                |lane| {
                    let limit = limits[lane % WIDTH];
                    tree.hit(limits.simd, &lines.line(lane), limit, search)
                },
            );
        }
        let mut nearest = lines.none_before(limits_on_lines);
        tree.bvh.traverse_packet(
            lines.rays(),
            lines.lanes,
            limits_on_lines,
            match search {
                Search::Nearest => Order::NearFirst,
                Search::Blocker => Order::LargeFirst,
            },
            #[inline(always)]
            |places, lanes, _| {
                lines.meet_run(&tree.run(places), lanes, &mut nearest);
                if search == Search::Blocker
                    && let Some(hits) = lines.hits(&nearest, *limits)
                {
                    return Lanes::select(mask(limits.simd, hits.lanes), closed, nearest.t);
                }
                nearest.t
            },
        );
        lines.hits(&nearest, *limits)
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

/// The mesh instances among objects with their object numbers, in order.
pub(crate) fn instances(objects: &Objects) -> Vec<(usize, &Instance)> {
    let meshes = objects
        .par_numbered()
        .filter_map(|(number, object)| match &object.shape {
            Shape::Mesh(instance) => Some((number, &**instance)),
            _ => None,
        });
    meshes.collect()
}
