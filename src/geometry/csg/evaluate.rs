//! Evaluation of the steps of a CSG solid, for single lines and packets.

use smallvec::SmallVec;

use super::{Csg, Leaf, Operation, PreparedKind};
use crate::geometry::lanes::{Lanes, Vector};
use crate::geometry::{Aabb, Rays};

/// A stack of lists of boundaries, on one line or several.
pub(super) trait Lists {
    /// A subset of the lines.
    type Lines: Copy;

    /// The given lines that may hit a box; `None` if all miss it.
    fn may_hit(&self, bounds: &Aabb, lines: Self::Lines) -> Option<Self::Lines>;
    /// The total number of boundaries.
    fn len(&self) -> usize;
    /// Pushes the boundaries of a leaf.
    fn push(&mut self, leaf: &Leaf, lines: Self::Lines);
    /// Merges the lists `start..middle` and `middle..` by an operation.
    fn merge(&mut self, operation: Operation, start: usize, middle: usize);
    /// Saves the list `start..` for the next user of a shared step.
    fn remember(&mut self, shared: u32, start: usize);
    /// Pushes the list of a shared step if it was saved.
    fn recall(&mut self, shared: u32) -> bool;
}

/// A pending task.
#[derive(Clone, Copy)]
enum Task<L> {
    /// Push the boundaries of a step.
    Step(u32, L),
    /// Evaluate the second operand of a step if it matters; the list of the first starts here.
    Second(u32, L, usize),
    /// Merge the lists of both operands, which start here and there.
    Merge(Operation, usize, usize),
    /// Save the list of a shared step, which starts here.
    Remember(u32, usize),
}

impl Csg {
    /// Evaluates the last step, whose list is left on the stack.
    ///
    /// Tasks are kept on an explicit stack instead of recursion: a chain of operations may be
    /// arbitrarily long. An operand that all lines miss is skipped.
    #[inline(always)]
    pub(super) fn evaluate<L: Lists>(&self, lists: &mut L, lines: L::Lines) {
        let mut tasks: SmallVec<[Task<L::Lines>; 16]> = SmallVec::new();
        tasks.push(Task::Step(self.steps.len() as u32 - 1, lines));
        while let Some(task) = tasks.pop() {
            match task {
                Task::Step(index, lines) => {
                    let step = &self.steps[index as usize];
                    let lines = match &step.bounds {
                        Some(bounds) => lists.may_hit(bounds, lines),
                        None => Some(lines),
                    };
                    let Some(lines) = lines else { continue };
                    if let Some(shared) = step.shared {
                        if lists.recall(shared) {
                            continue;
                        }
                        tasks.push(Task::Remember(shared, lists.len()));
                    }
                    match step.kind {
                        PreparedKind::Leaf(leaf) => lists.push(&self.leaves[leaf as usize], lines),
                        PreparedKind::Operation(_, [first, _]) => {
                            tasks.push(Task::Second(index, lines, lists.len()));
                            tasks.push(Task::Step(first, lines));
                        }
                    }
                }
                Task::Second(index, lines, start) => {
                    let middle = lists.len();
                    if let PreparedKind::Operation(operation, [_, second]) =
                        self.steps[index as usize].kind
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

/// Lines prepared for tests against boxes.
#[derive(Clone, Copy)]
pub(super) struct Slopes<N> {
    origin: Vector<N>,
    /// The reciprocal of the direction.
    reciprocal: Vector<N>,
    /// The interval of distances that count.
    reach: [N; 2],
}

impl<N: Lanes> Slopes<N> {
    #[inline(always)]
    pub(super) fn new(rays: &Rays<N>, reach: [N; 2]) -> Self {
        let one = reach[0].all(1.0);
        let direction = rays.direction;
        Self {
            origin: rays.origin,
            reciprocal: Vector {
                x: one / direction.x,
                y: one / direction.y,
                z: one / direction.z,
            },
            reach,
        }
    }

    /// Whether lines may hit a box within reach. Conservative: three roundings of a distance are
    /// within two ulps.
    #[inline(always)]
    pub(super) fn may_hit(&self, Aabb { min, max }: &Aabb) -> N::Mask {
        let (origin, reciprocal) = (self.origin, self.reciprocal);
        let (reach, x) = narrowed(self.reach, [min.x, max.x], origin.x, reciprocal.x);
        let (reach, y) = narrowed(reach, [min.y, max.y], origin.y, reciprocal.y);
        let ([low, high], z) = narrowed(reach, [min.z, max.z], origin.z, reciprocal.z);
        low.up_to(high) & x & y & z
    }
}

/// The part of `reach` where a coordinate may be in bounds, and whether a constant coordinate is.
#[inline(always)]
fn narrowed<N: Lanes>(
    [low, high]: [N; 2],
    [min, max]: [f64; 2],
    origin: N,
    reciprocal: N,
) -> ([N; 2], N::Mask) {
    let (min, max) = (origin.all(min), origin.all(max));
    let (a, b) = ((min - origin) * reciprocal, (max - origin) * reciprocal);
    let rises = origin.all(0.0).below(reciprocal);
    let (near, far) = (N::select(rises, a, b), N::select(rises, b, a));
    let rounding = origin.all(2.0 * f64::EPSILON);
    let near = near - rounding * near.abs();
    let far = far + rounding * far.abs();
    let stays = reciprocal.abs().equals(origin.all(f64::INFINITY));
    let outside = origin.below(min) | max.below(origin);
    // NaN narrows nothing.
    let low = N::select(low.below(near) & !stays, near, low);
    let high = N::select(far.below(high) & !stays, far, high);
    ([low, high], !(stays & outside))
}
