//! Traversal of the tree by a single ray, near children first.
//!
//! Rejected: preparing the ray along its three axes at once in lanes (no less time).

use std::ops::Range;

use arrayvec::ArrayVec;

use geometry::lanes::Simd;
use geometry::{Ray, Rays};

use super::build::LEVELS;
use super::node::{Child, Link, Node, WIDTH};
use super::slab::{Approach, SlabRay, last_entry};
use super::{Bvh, RUN};

/// The capacity of the stack: a node pops one entry and pushes at most [`WIDTH`], once per level.
pub(super) const STACK: usize = 1 + LEVELS * (WIDTH - 1);

/// A child to be visited, in one word so that children are sorted without branches: the distance at
/// which the ray enters its box, and below it the node's number and the child's lane.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Waiting(u64);

impl Waiting {
    #[inline(always)]
    fn new(entry: f32, node: u32, lane: usize) -> Self {
        Self(u64::from(ordered(entry)) << 32 | u64::from(node << 3 | lane as u32))
    }

    /// The distance as by [`ordered`].
    #[inline(always)]
    fn entry(self) -> u32 {
        (self.0 >> 32) as u32
    }

    /// The node and the child's lane.
    #[inline(always)]
    fn place(self, bvh: &Bvh) -> (&Node, usize) {
        let place = self.0 as u32;
        (&bvh.nodes[(place >> 3) as usize], place as usize % WIDTH)
    }

    /// The child.
    #[inline(always)]
    fn link(self, bvh: &Bvh) -> Link {
        let (node, lane) = self.place(bvh);
        node.link(lane)
    }
}

/// An integer for each number, in the same order, −0 before 0.
#[inline(always)]
fn ordered(number: f32) -> u32 {
    let bits = number.to_bits();
    bits ^ ((bits.cast_signed() >> 31).cast_unsigned() | 1 << 31)
}

impl Bvh {
    /// Whether there are boxes without finite planes.
    #[inline]
    pub(super) fn has_unbounded(&self) -> bool {
        self.bounded < self.order.len()
    }

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
    if bvh.has_unbounded() {
        // Outlined, because the rest inlines `visit` as well.
        limit = simd.vectorize(
            #[inline(always)]
            || {
                let mut limit = limit;
                for run in bvh.unbounded() {
                    if limit < 0.0 {
                        return limit;
                    }
                    limit = visit(run);
                }
                limit
            },
        );
    }
    if bvh.nodes.is_empty() {
        return;
    }
    let rays = Rays::from(ray);
    let approach = Approach::new(&rays, bvh);
    let slopes = approach.slopes(rays.direction, bvh.farthest);
    let ray = SlabRay::rounded(simd, approach.start(), slopes);
    let mut reach = approach.limits(limit) as f32;
    // A traversal takes less time than filling an array of this size.
    let mut stack = ArrayVec::<Waiting, STACK>::new();
    let mut next = Link::ROOT;
    loop {
        match next.into() {
            Child::Inner(number) => {
                let node = &bvh.nodes[number as usize];
                let (entries, mut hits) = node.entries(&ray, reach);
                if hits != 0 {
                    let base = stack.len();
                    let lane = hits.trailing_zeros() as usize % WIDTH;
                    hits &= hits - 1;
                    if hits == 0 {
                        next = node.link(lane);
                        continue;
                    }
                    // The nearest child is next; the others wait on the stack.
                    let mut nearest = Waiting::new(entries[lane], number, lane);
                    while hits != 0 {
                        let lane = hits.trailing_zeros() as usize % WIDTH;
                        hits &= hits - 1;
                        let other = Waiting::new(entries[lane], number, lane);
                        insert(
                            &mut stack,
                            base,
                            nearest.max(other),
                            #[inline(always)]
                            |child| child,
                        );
                        nearest = nearest.min(other);
                    }
                    next = nearest.link(bvh);
                    continue;
                }
            }
            Child::Leaf { first, count } => {
                let first = first as usize;
                limit = visit(first..first + usize::from(count));
                if limit < 0.0 {
                    return;
                }
                reach = approach.limits(limit) as f32;
            }
        }
        let last = ordered(last_entry(reach));
        next = loop {
            match stack.pop() {
                Some(waiting) if waiting.entry() <= last => break waiting.link(bvh),
                Some(_) => {}
                None => return,
            }
        };
    }
}

/// Inserts a child among those from `base` on, which stay sorted by a key, the least on top.
#[inline(always)]
pub(super) fn insert<T: Copy, K: PartialOrd>(
    stack: &mut ArrayVec<T, STACK>,
    base: usize,
    child: T,
    key: impl Fn(T) -> K,
) {
    let mut position = stack.len();
    stack.push(child);
    while base < position && key(stack[position - 1]) < key(child) {
        stack[position] = stack[position - 1];
        position -= 1;
    }
    stack[position] = child;
}
