//! Single lines through a CSG solid, with coincident boundaries resolved.

use smallvec::SmallVec;

use super::slopes::Slopes;
use super::{Csg, Leaf, Operation, PreparedKind};
use crate::{Hit, Ray, Spans};

/// Where a line crosses the boundary of a solid, ascending, alternately entering and leaving.
pub(super) type Boundaries = SmallVec<[Hit; 32]>;

/// A pending task.
#[derive(Clone, Copy)]
enum Task {
    /// Push the boundaries of a step.
    Step(u32),
    /// Evaluate the second operand of a step if it matters; the list of the first starts here.
    Second(u32, usize),
    /// Merge the lists of both operands, which start here and there.
    Merge(Operation, usize, usize),
    /// Save the list of a shared step, which starts here.
    Remember(u32, usize),
}

/// The lists of the steps evaluated so far, one after the other.
struct Lists<'a> {
    csg: &'a Csg,
    ray: &'a Ray,
    hits: Boundaries,
    /// The saved lists of shared steps.
    known: Vec<Option<Vec<Hit>>>,
    /// Scratch buffer of `merge`.
    merged: Boundaries,
    spans: Spans,
}

impl Csg {
    /// The boundaries on the ray's line at distances in `reach`; beyond it pairs of boundaries may
    /// be missing.
    ///
    /// Tasks are kept on an explicit stack instead of recursion: a chain of operations may be
    /// arbitrarily long. An operand that the line misses is skipped.
    pub(super) fn boundaries(&self, ray: &Ray, reach: [f64; 2]) -> Boundaries {
        let slopes = Slopes::new(&ray.into(), reach);
        let mut lists = Lists {
            csg: self,
            ray,
            hits: Boundaries::new(),
            known: vec![None; self.shared as usize],
            merged: Boundaries::new(),
            spans: Spans::new(),
        };
        let mut tasks: SmallVec<[Task; 16]> = SmallVec::new();
        tasks.push(Task::Step(self.steps.len() as u32 - 1));
        while let Some(task) = tasks.pop() {
            match task {
                Task::Step(index) => {
                    let step = &self.steps[index as usize];
                    if let Some(bounds) = &step.bounds
                        && !slopes.may_hit(bounds)
                    {
                        continue;
                    }
                    if let Some(shared) = step.shared {
                        if lists.recall(shared) {
                            continue;
                        }
                        tasks.push(Task::Remember(shared, lists.hits.len()));
                    }
                    match step.kind {
                        PreparedKind::Leaf(leaf) => lists.push(&self.leaves[leaf as usize]),
                        PreparedKind::Operation(_, [first, _]) => {
                            tasks.push(Task::Second(index, lists.hits.len()));
                            tasks.push(Task::Step(first));
                        }
                    }
                }
                Task::Second(index, start) => {
                    let middle = lists.hits.len();
                    if let PreparedKind::Operation(operation, [_, second]) =
                        self.steps[index as usize].kind
                        && (operation == Operation::Union || start < middle)
                    {
                        tasks.push(Task::Merge(operation, start, middle));
                        tasks.push(Task::Step(second));
                    }
                }
                Task::Merge(operation, start, middle) => lists.merge(operation, start, middle),
                Task::Remember(shared, start) => lists.remember(shared, start),
            }
        }
        lists.hits
    }
}

impl Lists<'_> {
    /// Pushes the boundaries of a leaf.
    fn push(&mut self, leaf: &Leaf) {
        self.spans.clear();
        leaf.solid.spans(self.ray, &mut self.spans);
        let ends = self.spans.iter().flat_map(|span| [span.enter, span.exit]);
        self.hits.extend(ends.map(|end| Hit {
            part: 2 * (leaf.first_part + end.part),
            ..end
        }));
    }

    /// Merges the lists `start..middle` and `middle..` by an operation.
    fn merge(&mut self, operation: Operation, start: usize, middle: usize) {
        let (first, second) = self.hits[start..].split_at(middle - start);
        self.merged.clear();
        self.csg
            .merge(self.ray, operation, [first, second], &mut self.merged);
        self.hits.truncate(start);
        self.hits.extend_from_slice(&self.merged);
    }

    /// Saves the list `start..` for the next user of a shared step.
    fn remember(&mut self, shared: u32, start: usize) {
        self.known[shared as usize] = Some(self.hits[start..].to_vec());
    }

    /// Pushes the list of a shared step if it was saved.
    fn recall(&mut self, shared: u32) -> bool {
        let known = &self.known[shared as usize];
        if let Some(hits) = known {
            self.hits.extend_from_slice(hits);
        }
        known.is_some()
    }
}
