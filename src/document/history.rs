//! Undo and redo steps as inverse edits. Holds no text: the document applies the edits.

use std::sync::Arc;

use super::rebase::rebased;
use super::steps::{State, StateId, StepName};
use text::{Edit, Span};

/// A step that can be undone or redone.
#[derive(Clone, Debug)]
pub(super) struct Step {
    /// The edits that undo or redo it; their spans refer to the text before that.
    pub(super) edits: Vec<Edit>,
    pub(super) name: StepName,
    /// The text after the step.
    state: StateId,
}

/// The undo and redo steps, and what is needed to revert the last call.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    undo: Vec<Arc<Step>>,
    redo: Vec<Arc<Step>>,
    /// The text before all steps.
    first: StateId,
    /// The text that was numbered last.
    newest: StateId,
    /// Whether the top of `undo` is a run of replacements of one leaf that can still grow.
    open: bool,
    /// Whether the last change made the top of `undo`, or a part of it.
    made: Option<Made>,
    last: Option<Call>,
}

/// What the last change made.
#[derive(Clone, Debug)]
enum Made {
    /// A step of its own.
    Step,
    /// A part of a step, which had this name before.
    Part(StepName),
}

/// What the last call did to the history and the text, so that both can be reverted.
#[derive(Clone, Debug)]
struct Call {
    /// The edits that revert the text; unlike the top step, they cover only this call.
    inverse: Vec<Edit>,
    /// Whether it pushed a step.
    pushed: bool,
    /// The step that was replaced by its own.
    replaced: Option<Arc<Step>>,
    redo: Vec<Arc<Step>>,
    open: bool,
}

impl History {
    /// An empty history whose texts are numbered after those of another one.
    pub(super) fn after(other: &Self) -> Self {
        let first = StateId(other.newest.0 + 1);
        Self {
            first,
            newest: first,
            ..Self::default()
        }
    }

    /// Whether there are no steps.
    pub(super) fn is_empty(&self) -> bool {
        self.undo.is_empty() && self.redo.is_empty()
    }

    /// The history after edits from outside of the present text: the steps up to the first that they touch,
    /// with texts of new numbers. Without edits, the same history.
    pub(super) fn rebased(&self, outside: &[Edit]) -> Self {
        let mut history = Self::after(self);
        if outside.is_empty() {
            history.clone_from(self);
            history.commit();
            history.record_nothing();
            return history;
        }
        let newest = &mut history.newest.0;
        let [undo, redo] = [&self.undo, &self.redo].map(|steps| {
            let edits = steps.iter().rev().map(|step| &*step.edits);
            let moved = rebased(edits, outside).into_iter();
            let moved = moved.zip(steps.iter().rev()).map(|(edits, step)| {
                *newest += 1;
                Arc::new(Step {
                    edits,
                    name: step.name.clone(),
                    state: StateId(*newest),
                })
            });
            let mut moved: Vec<_> = moved.collect();
            moved.reverse();
            moved
        });
        Self {
            undo,
            redo,
            ..history
        }
    }

    /// Records a replacement of one leaf by `literal`, merging it into the open step if that ended
    /// with the same leaf. A run that returns to its initial text is not a step.
    pub(super) fn record_literal(&mut self, inverse: Edit, literal: &str) {
        let start = inverse.span.start();
        let before = Span::new(start, start + inverse.text.len());
        let joins =
            |step: &mut Arc<Step>| matches!(step.edits.as_slice(), [edit] if edit.span == before);
        let open = self.open;
        let replaced = if open { self.undo.pop_if(joins) } else { None };
        let original = replaced
            .as_ref()
            .and_then(|step| step.edits.first())
            .map_or(&inverse.text, |edit| &edit.text);
        let pushed = original != literal;
        self.made = None;
        if pushed {
            let edit = Edit {
                span: inverse.span,
                text: original.clone(),
            };
            let name = replaced.as_ref().map(|step| step.name.clone());
            self.push(vec![edit], name.clone().unwrap_or_default());
            self.made = Some(name.map_or(Made::Step, Made::Part));
        }
        self.open = pushed;
        self.last = Some(Call {
            inverse: vec![inverse],
            pushed,
            replaced,
            redo: std::mem::take(&mut self.redo),
            open,
        });
    }

    /// The text that the open run had at first where it now has this span.
    pub(super) fn at_first(&self, span: Span) -> Option<&str> {
        let step = self.undo.last().filter(|_| self.open)?;
        match step.edits.as_slice() {
            [edit] if edit.span == span => Some(&edit.text),
            _ => None,
        }
    }

    /// Records a separate step.
    pub(super) fn record(&mut self, inverse: Vec<Edit>) {
        self.push(inverse.clone(), StepName::default());
        self.made = Some(Made::Step);
        self.last = Some(Call {
            inverse,
            pushed: true,
            replaced: None,
            redo: std::mem::take(&mut self.redo),
            open: self.open,
        });
        self.open = false;
    }

    /// Records a call that changed nothing, so that reverting it changes nothing either.
    pub(super) fn record_nothing(&mut self) {
        self.last = None;
        self.made = None;
    }

    /// Names the step that the last change made, or made a part of.
    pub(super) fn name(&mut self, name: StepName) {
        let name = match &self.made {
            None => return,
            Some(Made::Step) => name,
            Some(Made::Part(before)) => name.continuing(before),
        };
        if let Some(step) = self.undo.last_mut() {
            Arc::make_mut(step).name = name;
        }
    }

    /// Ends the open step; the last call can no longer be reverted.
    pub(super) fn commit(&mut self) {
        self.close();
        self.last = None;
    }

    /// Ends the open step; the last call can still be reverted.
    pub(super) fn close(&mut self) {
        self.open = false;
        if let Some(call) = &mut self.last {
            call.open = false;
        }
    }

    /// Removes the last call from the history and returns the edits that revert the text.
    pub(super) fn revert(&mut self) -> Option<Vec<Edit>> {
        let call = self.last.take()?;
        if call.pushed {
            self.undo.pop();
        }
        self.undo.extend(call.replaced);
        self.redo = call.redo;
        self.open = call.open;
        self.made = None;
        Some(call.inverse)
    }

    /// The step that would be undone.
    pub(super) fn peek_undo(&self) -> Option<&Step> {
        self.undo.last().map(|step| &**step)
    }

    /// The step that would be redone.
    pub(super) fn peek_redo(&self) -> Option<&Step> {
        self.redo.last().map(|step| &**step)
    }

    /// The edits that revert the last call.
    pub(super) fn last_inverse(&self) -> Option<&[Edit]> {
        self.last.as_ref().map(|call| &*call.inverse)
    }

    /// Takes the step to undo, to be passed to [`History::undone`] with its inverse.
    pub(super) fn next_undo(&mut self) -> Option<Arc<Step>> {
        self.commit();
        self.made = None;
        self.undo.pop()
    }

    /// Takes the step to redo, to be passed to [`History::redone`] with its inverse.
    pub(super) fn next_redo(&mut self) -> Option<Arc<Step>> {
        self.commit();
        self.made = None;
        self.redo.pop()
    }

    /// Stores the edits that redo a step just undone.
    pub(super) fn undone(&mut self, step: &Step, inverse: Vec<Edit>) {
        self.redo.push(turned(step, inverse));
    }

    /// Stores the edits that undo a step just redone.
    pub(super) fn redone(&mut self, step: &Step, inverse: Vec<Edit>) {
        self.undo.push(turned(step, inverse));
    }

    /// The present text.
    pub(super) fn state(&self) -> StateId {
        self.undo.last().map_or(self.first, |step| step.state)
    }

    /// The number of steps that can be undone.
    pub(super) fn undoable(&self) -> usize {
        self.undo.len()
    }

    /// The steps to undo and to redo, each in the order in which they were pushed.
    pub(super) fn steps(&self) -> (&[Arc<Step>], &[Arc<Step>]) {
        (&self.undo, &self.redo)
    }

    /// The texts before, between and after all steps.
    pub(super) fn states(&self) -> impl Iterator<Item = State<'_>> {
        let past = self.undo.len();
        (0..=past + self.redo.len()).map(move |at| {
            let step = match at.checked_sub(1) {
                None => None,
                Some(at) if at < past => self.undo.get(at),
                Some(at) => self.redo.iter().rev().nth(at - past),
            };
            State {
                id: step.map_or(self.first, |step| step.state),
                name: step.map(|step| &step.name),
            }
        })
    }

    fn push(&mut self, edits: Vec<Edit>, name: StepName) {
        self.newest.0 += 1;
        self.undo.push(Arc::new(Step {
            edits,
            name,
            state: self.newest,
        }));
    }
}

/// A step in the other direction.
fn turned(step: &Step, inverse: Vec<Edit>) -> Arc<Step> {
    Arc::new(Step {
        edits: inverse,
        name: step.name.clone(),
        state: step.state,
    })
}
