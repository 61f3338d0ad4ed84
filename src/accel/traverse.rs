//! The walk of a ray through the tree, near children first.

use std::ops::Range;

use arrayvec::ArrayVec;

use crate::geometry::lanes::Simd;
use crate::geometry::{Ray, Rays};

use super::build::LEVELS;
use super::node::{Child, WIDTH};
use super::slab::{Approach, SlabRay, is_open};
use super::{Bvh, RUN};

/// The most children that can wait: a node takes one off and leaves at most [`WIDTH`], once a level.
pub(super) const STACK: usize = 1 + LEVELS * (WIDTH - 1);

/// A child whose turn has not come.
#[derive(Clone, Copy)]
pub(super) struct Waiting<L> {
    /// Where the first of its rays enters its box.
    pub(super) entry: f32,
    pub(super) child: Child,
    /// The rays that meet it; nothing where there is but one.
    pub(super) lanes: L,
}

impl Bvh {
    /// The places of boxes without finite planes.
    #[inline]
    pub(super) fn unbounded(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let end = self.order.len();
        let starts = (self.bounded..end).step_by(RUN);
        starts.map(move |start| start..end.min(start + RUN))
    }
}

/// See [`Bvh::traverse`].
#[expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take this with it"
)]
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
    let slopes = slopes.map(
        #[inline(always)]
        |[inverse, above, below]| [inverse as f32, above as f32, below as f32],
    );
    let ray = SlabRay::of(simd, approach.start() as f32, slopes);
    let root = Waiting {
        entry: ray.start,
        child: Child::Inner(0),
        lanes: (),
    };
    // A walk takes less time than filling an array of this size.
    let mut stack = ArrayVec::<_, STACK>::new();
    stack.push(root);
    while let Some(Waiting { entry, child, .. }) = stack.pop() {
        let reach = approach.limits(limit) as f32;
        if !is_open(entry, reach) {
            continue;
        }
        match child {
            Child::Inner(number) => {
                let node = &bvh.nodes[number as usize];
                let (entries, mut met) = node.entries(&ray, reach);
                let base = stack.len();
                while met != 0 {
                    let lane = met.trailing_zeros() as usize % WIDTH;
                    met &= met - 1;
                    let waiting = Waiting {
                        entry: entries[lane],
                        child: node.child(lane),
                        lanes: (),
                    };
                    insert(&mut stack, base, waiting);
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

/// Puts a child among those from `base` on, which stay sorted with the nearest on top.
#[expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take this with it"
)]
#[inline(always)]
pub(super) fn insert<L: Copy>(
    stack: &mut ArrayVec<Waiting<L>, STACK>,
    base: usize,
    waiting: Waiting<L>,
) {
    let mut place = stack.len();
    stack.push(waiting);
    while base < place && stack[place - 1].entry < waiting.entry {
        stack[place] = stack[place - 1];
        place -= 1;
    }
    stack[place] = waiting;
}
