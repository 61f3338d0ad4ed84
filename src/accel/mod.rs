//! Boxes against rays: a bounding volume hierarchy over boxes. Knows boxes and rays only; what a
//! box holds is the caller's closure.
//!
//! `build` sorts boxes into a tree of [`node::WIDTH`]-wide nodes by the surface area heuristic,
//! `node` holds such a node, `slab` is a ray as its children's boxes are tested against it, all at
//! once, `refit` follows boxes that move, and `traverse` and `packet` walk the tree, near children
//! first.
//!
//! # How nothing is missed
//!
//! - Nodes store `f32` planes relative to a reference point, rounded outward. The reference is the
//!   median of the boxes' centres, so a scene far from the origin keeps its resolution, and so do
//!   small things beside a few huge ones.
//! - Rays are taken to the same numbers, an origin between two of them, and each plane takes the end
//!   that makes the box larger.
//! - Distances grow by the bound on their rounding error after Ize, "Robust BVH Ray Traversal" (JCGT
//!   2013); see `slab`.
//!
//! All of it is relative: a scene scaled by a power of two gives the same tree and the same visits,
//! unless it comes near the least or the greatest numbers of `f32`.

mod build;
mod node;
mod packet;
mod refit;
mod slab;
mod split;
mod traverse;

#[cfg(test)]
mod tests;

use std::ops::Range;

use glam::DVec3;

use crate::geometry::lanes::{Eight, Simd};
use crate::geometry::{Aabb, Ray, Rays};
use node::Node;

/// A bounding volume hierarchy over the boxes it was built from.
#[derive(Debug)]
pub struct Bvh {
    /// The point the planes of the nodes are relative to.
    reference: DVec3,
    /// How far from that half of the boxes' centres are along the axis where they are farthest.
    spread: f64,
    /// The farthest plane's distance from it.
    farthest: f64,
    /// The root first; none if no box is in the tree.
    nodes: Vec<Node>,
    /// Indices of boxes; a leaf is a run of them. Last stand those without finite planes, which every
    /// ray visits.
    order: Vec<u32>,
    /// How many have finite planes.
    bounded: usize,
    /// How many boxes moved since it was built.
    moved: usize,
}

/// The most boxes of a leaf, and of any run that is visited at once.
pub const RUN: usize = 8;

impl Bvh {
    /// Builds the tree, in parallel on the current rayon pool; the same boxes give the same tree.
    /// `None` if `cancelled` said so, which is asked at least every few milliseconds.
    ///
    /// An empty box is never visited. A box that is infinite, not a number, or farther than `f32`
    /// reaches from most others is visited by every ray. Boxes beyond the first 2³² − 1 are
    /// ignored.
    pub fn build(boxes: &[Aabb], cancelled: impl Fn() -> bool + Sync) -> Option<Self> {
        Self::over(boxes.len(), |index| boxes[index as usize], cancelled)
    }

    /// As [`Bvh::build`] over so many boxes, each made when it is needed: a million of them would take
    /// 48 MB.
    pub fn over(
        count: usize,
        aabb: impl Fn(u32) -> Aabb + Sync,
        cancelled: impl Fn() -> bool + Sync,
    ) -> Option<Self> {
        build::build(count, &aabb, &cancelled).ok()
    }

    /// The same tree with a few boxes that are others now. `None` where a new one is better: of many
    /// changes, of few boxes, and where a box begins or ceases to be empty or without bounds.
    pub fn refitted(&self, changed: &[u32], aabb: impl Fn(u32) -> Aabb) -> Option<Self> {
        refit::refit(self, changed, aabb)
    }

    /// The indices of the boxes in the order of the tree: those of a leaf stand side by side.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Calls `visit` with places in [`Bvh::order`], at most [`RUN`] at once: those of every box the
    /// ray may meet at a distance in `0..=limit` are among them, roughly near ones first. `visit`
    /// returns the limit from there on: the same, or less once something nearer was found; below 0
    /// ends the walk. Never misses a box the ray meets; may visit ones it does not.
    ///
    /// Inlined into the caller, so that it uses whatever vectors the caller was compiled for; the
    /// visits are the same with any.
    ///
    /// Each place is visited at most once. A ray that is not finite visits anything or nothing.
    #[expect(
        clippy::inline_always,
        reason = "a caller compiled for wider vectors must take this with it"
    )]
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

    /// The same for rays side by side, those whose bit in `lanes` is 1: `visit` is told which of
    /// them may meet what is there, and their limits, and returns the limits from there on.
    #[expect(
        clippy::inline_always,
        reason = "a caller compiled for wider vectors must take this with it"
    )]
    #[inline(always)]
    pub fn traverse_packet<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        lanes: u32,
        limits: Eight<S>,
        visit: impl FnMut(Range<usize>, u32, Eight<S>) -> Eight<S>,
    ) {
        packet::traverse(self, rays, lanes, limits, visit);
    }
}
