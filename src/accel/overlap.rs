//! Search for the boxes of a tree that overlap another.

use std::ops::{ControlFlow, Range};

use arrayvec::ArrayVec;

use super::Bvh;
use super::node::{Bounds, Child, WIDTH};
use super::traverse::STACK;
use geometry::Aabb;

impl Bvh {
    /// Calls `visit` with ranges of [`Bvh::order`], at most [`RUN`](super::RUN) long, that include every
    /// box that overlaps another, until it breaks. Conservative: others may be visited.
    pub fn overlapping<B>(
        &self,
        aabb: Aabb,
        mut visit: impl FnMut(Range<usize>) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        for run in self.unbounded() {
            visit(run)?;
        }
        let asked = Bounds::around(aabb, self.reference);
        let mut waiting = ArrayVec::<u32, STACK>::new();
        waiting.extend((!self.nodes.is_empty()).then_some(0));
        while let Some(number) = waiting.pop() {
            let node = &self.nodes[number as usize];
            let overlaps = |lane: &usize| {
                (0..3).all(|axis| {
                    let [low, high] = node.box_planes(*lane, axis);
                    low <= asked.high[axis] && asked.low[axis] <= high
                })
            };
            for lane in (0..WIDTH).filter(overlaps) {
                match node.child(lane) {
                    Child::Inner(number) => waiting.push(number),
                    Child::Leaf { first, count } => {
                        let first = first as usize;
                        visit(first..first + usize::from(count))?;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }
}
