//! Traversal of the tree by a single ray, near children first.

use std::ops::Range;

use arrayvec::ArrayVec;

use crate::geometry::lanes::Simd;
use crate::geometry::{Ray, Rays};

use super::build::LEVELS;
use super::node::{Child, WIDTH};
use super::slab::{Approach, SlabRay, is_open};
use super::{Bvh, RUN};

/// The capacity of the stack: a node pops one entry and pushes at most [`WIDTH`], once per level.
pub(super) const STACK: usize = 1 + LEVELS * (WIDTH - 1);

/// A child on the stack.
#[derive(Clone, Copy)]
pub(super) struct Pending<L> {
    /// The distance at which the first of its rays enters its box.
    pub(super) entry: f32,
    pub(super) child: Child,
    /// The rays that hit it; `()` for a single ray.
    pub(super) lanes: L,
}

impl Bvh {
    /// Ranges of [`Bvh::order`] with the boxes without finite planes.
    #[inline]
    pub(super) fn unbounded(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let end = self.order.len();
        let starts = (self.bounded..end).step_by(RUN);
        starts.map(move |start| start..end.min(start + RUN))
    }
}

/// See [`Bvh::traverse`].
#[inline(always)]
pub(super) fn traverse<S: Simd>(
    bvh: &Bvh,
    simd: S,
    ray: &Ray,
    mut limit: f64,
    mut visit: impl FnMut(Range<usize>) -> f64,
) {
    for run in bvh.unbounded() {
        if limit < 0.0 {
            return;
        }
        limit = visit(run);
    }
    if bvh.nodes.is_empty() {
        return;
    }
    let rays = Rays::from(ray);
    let approach = Approach::new(&rays, bvh);
    let slopes = approach.slopes(rays.direction, bvh.farthest);
    let ray = SlabRay::rounded(simd, approach.start(), slopes);
    let root = Pending {
        entry: ray.start,
        child: Child::Inner(0),
        lanes: (),
    };
    // A traversal takes less time than filling an array of this size.
    let mut stack = ArrayVec::<_, STACK>::new();
    stack.push(root);
    while let Some(Pending { entry, child, .. }) = stack.pop() {
        let reach = approach.limits(limit) as f32;
        if !is_open(entry, reach) {
            continue;
        }
        match child {
            Child::Inner(number) => {
                let node = &bvh.nodes[number as usize];
                let (entries, mut hits) = node.entries(&ray, reach);
                let base = stack.len();
                while hits != 0 {
                    let lane = hits.trailing_zeros() as usize % WIDTH;
                    hits &= hits - 1;
                    let pending = Pending {
                        entry: entries[lane],
                        child: node.child(lane),
                        lanes: (),
                    };
                    insert(&mut stack, base, pending);
                }
            }
            Child::Leaf { first, count } => {
                let first = first as usize;
                limit = visit(first..first + usize::from(count));
                if limit < 0.0 {
                    return;
                }
            }
        }
    }
}

/// Inserts a child among those from `base` on, which stay sorted with the nearest on top.
#[inline(always)]
pub(super) fn insert<L: Copy>(
    stack: &mut ArrayVec<Pending<L>, STACK>,
    base: usize,
    pending: Pending<L>,
) {
    let mut position = stack.len();
    stack.push(pending);
    while base < position && stack[position - 1].entry < pending.entry {
        stack[position] = stack[position - 1];
        position -= 1;
    }
    stack[position] = pending;
}
