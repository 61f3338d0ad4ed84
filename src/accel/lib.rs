//! A bounding volume hierarchy over boxes. It depends on boxes and rays only; the contents of boxes
//! are left to the caller's closure.
//!
//! `build` sorts boxes into a tree of [`node::WIDTH`]-wide nodes by the surface area heuristic.
//! `node` is such a node, `slab` a ray prepared for tests against all its children's boxes at once.
//! `refit` adapts the tree to moved boxes, `splice` to removed and inserted ones, and `traverse` and
//! `packet` traverse it, near children first; `packet`, for any hits, large ones first. `overlap` finds the
//! boxes that overlap another.
//!
//! # Why no box is missed
//!
//! - Nodes store `f32` planes relative to a reference point, rounded outward. The reference is the
//!   median of the boxes' centres, so scenes far from the origin keep their resolution, and so do
//!   small objects beside a few huge ones.
//! - Rays are converted to `f32` too. An origin becomes an interval, and each plane is tested
//!   against the end that enlarges the box.
//! - Distances are extended by the bound of their rounding error: Ize, "Robust BVH Ray Traversal"
//!   (JCGT 2013); see `slab`.
//!
//! All bounds are relative: a scene scaled by a power of two gives the same tree and the same
//! visits, unless it comes near the limits of `f32`.

mod bins;
mod build;
mod node;
mod overlap;
mod packet;
mod refit;
mod slab;
mod splice;
mod split;
mod traverse;

#[cfg(test)]
mod tests;

use std::ops::Range;

use glam::DVec3;

use geometry::lanes::{Eight, Simd};
use geometry::{Aabb, IsCancelled, Ray, Rays};
use node::{Child, Node, WIDTH};

/// A bounding volume hierarchy.
#[derive(Debug)]
pub struct Bvh {
    /// The origin of the planes of the nodes.
    reference: DVec3,
    /// The median Chebyshev distance of the boxes' centres from `reference`.
    spread: f64,
    /// The largest distance of a plane from `reference`.
    farthest: f64,
    /// The nodes, root first; empty if no box is in the tree.
    nodes: Vec<Node>,
    /// Indices of boxes; a leaf is a run of them. Boxes without finite planes, which every ray
    /// visits, come last.
    order: Vec<u32>,
    /// The number of boxes with finite planes.
    bounded: usize,
    /// The number of boxes moved since the tree was built.
    moved: usize,
}

/// The order in which the children of a node are visited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Those entered first come first: for nearest hits.
    NearFirst,
    /// Those with the largest boxes come first: for any hits.
    LargeFirst,
}

/// The maximum number of boxes in a leaf, and in any run visited at once.
pub const RUN: usize = 8;

/// Whether cancellation is polled at this step of a loop: every few milliseconds.
fn polls_at(step: usize) -> bool {
    step.is_multiple_of(1 << 14)
}

impl Bvh {
    /// Builds the tree in parallel on the current rayon pool; the result depends on the boxes only.
    /// Returns `None` if `cancelled` returns true; it is called at least every few milliseconds.
    ///
    /// An empty box is never visited. A box that is infinite or NaN, or too far from most others
    /// for `f32`, is visited by every ray. Boxes beyond the first 2³¹ are ignored.
    pub fn build(boxes: &[Aabb], cancelled: IsCancelled<'_>) -> Option<Self> {
        Self::over(boxes.len(), |index| boxes[index as usize], cancelled)
    }

    /// Like [`Bvh::build`] over `count` boxes, each computed on demand: a million would take 48 MB.
    pub fn over(
        count: usize,
        aabb: impl Fn(u32) -> Aabb + Sync,
        cancelled: IsCancelled<'_>,
    ) -> Option<Self> {
        build::build(count, &aabb, cancelled).ok()
    }

    /// Adapts the tree to a few changed boxes. Returns `None` if a new one is better: after many
    /// changes, for few boxes, or if a box becomes or ceases to be empty or unbounded; or once `cancelled`,
    /// polled every few milliseconds, returns true.
    pub fn refitted(
        &self,
        changed: &[u32],
        aabb: impl Fn(u32) -> Aabb,
        cancelled: IsCancelled<'_>,
    ) -> Option<Self> {
        refit::refit(self, changed, aabb, cancelled)
    }

    /// Adapts the tree to `inserted` boxes in place of those in `removed`, which shifts the indices of later
    /// boxes. `aabb` takes new indices. Returns `None` if a new tree is better: after many changes, for few
    /// boxes, or if a new box is empty, unbounded or near a full leaf; or once `cancelled`, polled every few
    /// milliseconds, returns true.
    pub fn spliced(
        &self,
        removed: Range<u32>,
        inserted: u32,
        aabb: impl Fn(u32) -> Aabb,
        cancelled: IsCancelled<'_>,
    ) -> Option<Self> {
        splice::splice(self, removed, inserted, aabb, cancelled)
    }

    /// Whether a packet is traced faster together than ray by ray.
    ///
    /// Rays into different octants soon diverge. In a small tree, which stays in the cache, a packet is
    /// still faster: diffuse rays take a tenth less time among 7,000 spheres, but half as much again among a
    /// million spheres, and a fifth more among a million triangles.
    #[inline(always)]
    pub fn takes_together<S: Simd>(&self, rays: &Rays<Eight<S>>) -> bool {
        const SMALL: usize = 1 << 16;
        self.order.len() < SMALL || rays.share_octant()
    }

    /// The indices of the boxes in the order of the tree; those of a leaf are contiguous.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The ranges of [`Bvh::order`] that are visited at once, in ascending order. `None` once
    /// `cancelled`, polled every few milliseconds, returns true.
    pub fn runs(&self, cancelled: IsCancelled<'_>) -> Option<Vec<Range<usize>>> {
        let mut children = 0;
        for (number, node) in self.nodes.iter().enumerate() {
            if polls_at(number) && cancelled() {
                return None;
            }
            children += node.filled().count_ones() as usize;
        }
        // All nodes but the root are children.
        let leaves = 1 + children - self.nodes.len();
        let mut runs = Vec::with_capacity(leaves + self.unbounded().count());
        // The children of a node are in the order of their boxes.
        let mut pending = Vec::new();
        pending.extend(self.nodes.first().map(|_| Child::Inner(0)));
        while let Some(child) = pending.pop() {
            match child {
                Child::Inner(number) => {
                    if polls_at(number as usize) && cancelled() {
                        return None;
                    }
                    let node = &self.nodes[number as usize];
                    pending.extend((0..WIDTH).rev().map(|lane| node.child(lane)));
                }
                // A missing child.
                Child::Leaf { count: 0, .. } => {}
                Child::Leaf { first, count } => {
                    let first = first as usize;
                    runs.push(first..first + usize::from(count));
                }
            }
        }
        runs.extend(self.unbounded());
        Some(runs)
    }

    /// Calls `visit` with ranges of [`Bvh::order`], at most [`RUN`] long, that include every box
    /// the ray may hit at a distance in `0..=limit`, roughly near ones first. `visit` returns the
    /// new limit: the same, or less after a nearer hit; below 0 ends the traversal. Conservative:
    /// boxes the ray misses may be visited.
    ///
    /// Inlined into the caller, to use the vectors the caller was compiled for; what is hit does not
    /// depend on them.
    ///
    /// Each index is visited at most once. The visits of a ray that is not finite are unspecified.
    #[inline(always)]
    pub fn traverse<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        limit: f64,
        visit: impl FnMut(Range<usize>) -> f64,
    ) {
        traverse::traverse(self, simd, ray, limit, visit);
    }

    /// The same for the rays of a packet whose bit in `lanes` is 1: `visit` gets the lanes that may
    /// hit the boxes, and the limits, and returns the new limits.
    #[inline(always)]
    pub fn traverse_packet<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        lanes: u32,
        limits: Eight<S>,
        order: Order,
        visit: impl FnMut(Range<usize>, u32, Eight<S>) -> Eight<S>,
    ) {
        packet::traverse(self, rays, lanes, limits, order, visit);
    }
}
