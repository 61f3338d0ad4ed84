//! A line through a solid made of solids.

use glam::DVec3;
use smallvec::SmallVec;

use super::{Boundaries, Csg, Kind, Operation};
use crate::geometry::{Aabb, Hit, Ray, Spans};

/// What is left to do.
#[derive(Clone, Copy)]
enum Task {
    /// Put the boundaries of a step on the stack.
    Step(u32),
    /// The first operand of a step is on the stack: see whether the second matters.
    Second(u32),
    /// Both operands of a step are on the stack.
    Merge(u32),
    /// Remember what is on top of the stack, for the next user of a step.
    Remember(u32),
}

/// Lists of boundaries, one on top of the other.
#[derive(Default)]
struct Stack {
    hits: Boundaries,
    /// Where each list starts.
    starts: SmallVec<[u32; 16]>,
}

impl Stack {
    fn open(&mut self) {
        self.starts.push(self.hits.len() as u32);
    }

    fn top(&self) -> &[Hit] {
        let start = self.starts.last().copied().unwrap_or(0);
        &self.hits[start as usize..]
    }
}

impl Csg {
    /// Where the ray's line crosses the boundary at distances in `reach`; beyond, boundaries may be
    /// missing, in pairs.
    ///
    /// Steps are done from the last, by a list of tasks and not by recursion: a chain of operations
    /// may be as long as memory. An operand that the line misses is not looked into.
    pub(super) fn boundaries(&self, ray: &Ray, reach: [f64; 2]) -> Boundaries {
        let mut stack = Stack::default();
        let mut spans = Spans::new();
        let mut merged = Boundaries::new();
        let mut known: Vec<Option<Vec<Hit>>> = vec![None; self.shared as usize];
        let slowness = ray.direction.recip();
        let mut tasks: SmallVec<[Task; 32]> = SmallVec::new();
        tasks.push(Task::Step(self.steps.len() as u32 - 1));
        while let Some(task) = tasks.pop() {
            match task {
                Task::Step(index) => {
                    let step = &self.steps[index as usize];
                    stack.open();
                    if !meets(step.bounds, ray.origin, slowness, reach) {
                        continue;
                    }
                    if let Some(shared) = step.shared {
                        if let Some(hits) = &known[shared as usize] {
                            stack.hits.extend_from_slice(hits);
                            continue;
                        }
                        tasks.push(Task::Remember(shared));
                    }
                    match step.kind {
                        Kind::Leaf(leaf) => {
                            let leaf = &self.leaves[leaf as usize];
                            spans.clear();
                            leaf.shape.spans(ray, &mut spans);
                            let ends = spans.iter().flat_map(|span| [span.enter, span.exit]);
                            stack.hits.extend(ends.map(|end| Hit {
                                part: 2 * (leaf.first_part + end.part),
                                ..end
                            }));
                        }
                        Kind::Operation(_, [first, _]) => {
                            stack.starts.pop();
                            tasks.push(Task::Second(index));
                            tasks.push(Task::Step(first));
                        }
                    }
                }
                Task::Second(index) => {
                    if let Kind::Operation(operation, [_, second]) = self.steps[index as usize].kind
                        && (operation == Operation::Union || !stack.top().is_empty())
                    {
                        tasks.push(Task::Merge(index));
                        tasks.push(Task::Step(second));
                    }
                }
                Task::Merge(index) => {
                    let Kind::Operation(operation, _) = self.steps[index as usize].kind else {
                        continue;
                    };
                    let middle = stack.starts.pop().unwrap_or(0) as usize;
                    let start = stack.starts.last().copied().unwrap_or(0) as usize;
                    let (first, second) = stack.hits[start..].split_at(middle - start);
                    merged.clear();
                    self.merge(ray, operation, [first, second], &mut merged);
                    stack.hits.truncate(start);
                    stack.hits.extend_from_slice(&merged);
                }
                Task::Remember(shared) => {
                    known[shared as usize] = Some(stack.top().to_vec());
                }
            }
        }
        stack.hits
    }
}

/// Whether a line may meet a box at distances in `reach`. Errs on the side of meeting: three
/// roundings of a distance are within two units in its last place. `slowness` is the reciprocal of
/// the direction.
fn meets(bounds: Aabb, origin: DVec3, slowness: DVec3, reach: [f64; 2]) -> bool {
    let [mut low, mut high] = reach;
    for axis in 0..3 {
        let (origin, slowness) = (origin[axis], slowness[axis]);
        let (min, max) = (bounds.min[axis], bounds.max[axis]);
        if slowness.is_infinite() {
            if origin < min || max < origin {
                return false;
            }
            continue;
        }
        let (a, b) = ((min - origin) * slowness, (max - origin) * slowness);
        let (near, far) = if 0.0 < slowness { (a, b) } else { (b, a) };
        low = low.max(near - 2.0 * f64::EPSILON * near.abs());
        high = high.min(far + 2.0 * f64::EPSILON * far.abs());
    }
    low <= high
}
