//! The steps of a CSG solid in the order in which they are evaluated, for lines side by side.

use super::{Operation, Prepared, PreparedKind};
use crate::Aabb;

/// A tree of operations as a flat list of instructions, which leave one list of boundaries.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Program(pub(super) Vec<Instruction>);

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Instruction {
    /// Continues with the lines that may hit a box; if none does, jumps to `end` and lists nothing.
    Enter { bounds: Aabb, end: u32 },
    /// Restores the lines from before the matching [`Instruction::Enter`].
    Leave,
    /// Lists the boundaries of a leaf; `inverted` if its inside is subtracted.
    Leaf { leaf: u32, inverted: bool },
    /// Begins the list of a first operand.
    First,
    /// Begins the list of a second operand; unless it is one of a union, jumps to `end` if that of
    /// the first is empty.
    Second { is_union: bool, end: u32 },
    /// Merges the lists of both operands.
    Merge(Operation),
}

/// What is left to translate.
enum Task {
    Step { index: u32, inverted: bool },
    Leave { enter: usize },
    Second(Operation),
    Merge(Operation),
}

impl Program {
    /// Translates a tree, whose root is the last step.
    pub(super) fn new(steps: &[Prepared]) -> Self {
        let mut code = Vec::new();
        // The instructions whose `end` is not known yet, innermost last.
        let mut seconds = Vec::new();
        let mut tasks = vec![Task::Step {
            index: steps.len() as u32 - 1,
            inverted: false,
        }];
        while let Some(task) = tasks.pop() {
            match task {
                Task::Step { index, inverted } => {
                    let step = &steps[index as usize];
                    if let Some(bounds) = step.bounds {
                        tasks.push(Task::Leave { enter: code.len() });
                        code.push(Instruction::Enter { bounds, end: 0 });
                    }
                    match step.kind {
                        PreparedKind::Leaf(leaf) => code.push(Instruction::Leaf { leaf, inverted }),
                        PreparedKind::Operation(operation, [first, second]) => {
                            code.push(Instruction::First);
                            tasks.push(Task::Merge(operation));
                            tasks.push(Task::Step {
                                index: second,
                                inverted: inverted ^ (operation == Operation::Difference),
                            });
                            tasks.push(Task::Second(operation));
                            tasks.push(Task::Step {
                                index: first,
                                inverted,
                            });
                        }
                    }
                }
                Task::Leave { enter } => {
                    code.push(Instruction::Leave);
                    let after = code.len() as u32;
                    if let Instruction::Enter { end, .. } = &mut code[enter] {
                        *end = after;
                    }
                }
                Task::Second(operation) => {
                    seconds.push(code.len());
                    let is_union = operation == Operation::Union;
                    code.push(Instruction::Second { is_union, end: 0 });
                }
                Task::Merge(operation) => {
                    code.push(Instruction::Merge(operation));
                    let after = code.len() as u32;
                    let second = seconds.pop().map(|second: usize| &mut code[second]);
                    if let Some(Instruction::Second { end, .. }) = second {
                        *end = after;
                    }
                }
            }
        }
        code.shrink_to_fit();
        Self(code)
    }
}
