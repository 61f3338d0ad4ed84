//! The way through the steps of a solid made of solids, for one line or for several side by side.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use smallvec::SmallVec;

use super::{Csg, Kind, Leaf, Operation};
use crate::geometry::lanes::{Lanes, Vector};
use crate::geometry::{Aabb, Rays};

/// Lists of boundaries, one on top of the other: on one line, or on several.
pub(super) trait Lists {
    /// Some of the lines.
    type Lines: Copy;

    /// Of some lines, those that may meet a box; `None` if none does.
    fn meet(&self, bounds: &Aabb, lines: Self::Lines) -> Option<Self::Lines>;
    /// How many boundaries all lists have.
    fn len(&self) -> usize;
    /// Puts those of a leaf on top.
    fn push(&mut self, leaf: &Leaf, lines: Self::Lines);
    /// Makes one list of two: one up to a place, the other from there, and both from `start`.
    fn merge(&mut self, operation: Operation, start: usize, middle: usize);
    /// Keeps the list from `start` for the next user of a shared step.
    fn remember(&mut self, shared: u32, start: usize);
    /// Puts the list of a shared step on top, if it is known.
    fn recall(&mut self, shared: u32) -> bool;
}

/// What is left to do.
#[derive(Clone, Copy)]
enum Task<L> {
    /// Put the boundaries of a step on top.
    Step(u32, L),
    /// The list of the first operand of a step starts here: see whether the second matters.
    Second(u32, L, usize),
    /// The lists of both operands start here and there.
    Merge(Operation, usize, usize),
    /// Remember the list of a shared step, which starts here.
    Remember(u32, usize),
}

impl Csg {
    /// Leaves the list of the last step.
    ///
    /// Steps are done by a list of tasks and not by recursion: a chain of operations may be as long
    /// as memory. An operand that all lines miss is not looked into.
    #[inline(always)]
    pub(super) fn evaluate<L: Lists>(&self, lists: &mut L, lines: L::Lines) {
        let mut tasks: SmallVec<[Task<L::Lines>; 16]> = SmallVec::new();
        tasks.push(Task::Step(self.steps.len() as u32 - 1, lines));
        while let Some(task) = tasks.pop() {
            match task {
                Task::Step(index, lines) => {
                    let step = &self.steps[index as usize];
                    let met = match &step.bounds {
                        Some(bounds) => lists.meet(bounds, lines),
                        None => Some(lines),
                    };
                    let Some(lines) = met else { continue };
                    if let Some(shared) = step.shared {
                        if lists.recall(shared) {
                            continue;
                        }
                        tasks.push(Task::Remember(shared, lists.len()));
                    }
                    match step.kind {
                        Kind::Leaf(leaf) => lists.push(&self.leaves[leaf as usize], lines),
                        Kind::Operation(_, [first, _]) => {
                            tasks.push(Task::Second(index, lines, lists.len()));
                            tasks.push(Task::Step(first, lines));
                        }
                    }
                }
                Task::Second(index, lines, start) => {
                    let middle = lists.len();
                    if let Kind::Operation(operation, [_, second]) = self.steps[index as usize].kind
                        && (operation == Operation::Union || start < middle)
                    {
                        tasks.push(Task::Merge(operation, start, middle));
                        tasks.push(Task::Step(second, lines));
                    }
                }
                Task::Merge(operation, start, middle) => lists.merge(operation, start, middle),
                Task::Remember(shared, start) => lists.remember(shared, start),
            }
        }
    }
}

/// Lines as boxes see them.
#[derive(Clone, Copy)]
pub(super) struct Slopes<N> {
    origin: Vector<N>,
    /// The reciprocal of the direction.
    slowness: Vector<N>,
    /// Only distances between these count.
    reach: [N; 2],
}

impl<N: Lanes> Slopes<N> {
    #[inline(always)]
    pub(super) fn new(rays: &Rays<N>, reach: [N; 2]) -> Self {
        let one = reach[0].all(1.0);
        let direction = rays.direction;
        Self {
            origin: rays.origin,
            slowness: Vector {
                x: one / direction.x,
                y: one / direction.y,
                z: one / direction.z,
            },
            reach,
        }
    }

    /// Whether lines may meet a box within reach. Errs on the side of meeting: three roundings of a
    /// distance are within two units in its last place.
    #[inline(always)]
    pub(super) fn meet(&self, Aabb { min, max }: &Aabb) -> N::Mask {
        let (origin, slowness) = (self.origin, self.slowness);
        let (reach, x) = narrowed(self.reach, [min.x, max.x], origin.x, slowness.x);
        let (reach, y) = narrowed(reach, [min.y, max.y], origin.y, slowness.y);
        let ([low, high], z) = narrowed(reach, [min.z, max.z], origin.z, slowness.z);
        low.up_to(high) & x & y & z
    }
}

/// The part of `reach` where a coordinate may be between two bounds; and whether it is so anywhere,
/// if it stays the same.
#[inline(always)]
fn narrowed<N: Lanes>(
    [low, high]: [N; 2],
    [min, max]: [f64; 2],
    origin: N,
    slowness: N,
) -> ([N; 2], N::Mask) {
    let (min, max) = (origin.all(min), origin.all(max));
    let (a, b) = ((min - origin) * slowness, (max - origin) * slowness);
    let rises = origin.all(0.0).below(slowness);
    let (near, far) = (N::select(rises, a, b), N::select(rises, b, a));
    let rounding = origin.all(2.0 * f64::EPSILON);
    let near = near - rounding * near.abs();
    let far = far + rounding * far.abs();
    let stays = slowness.abs().equals(origin.all(f64::INFINITY));
    let outside = origin.below(min) | max.below(origin);
    // What is not a number narrows nothing.
    let low = N::select(low.below(near) & !stays, near, low);
    let high = N::select(far.below(high) & !stays, far, high);
    ([low, high], !(stays & outside))
}
