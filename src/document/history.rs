//! Undo and redo steps as inverse edits. Holds no text: the document applies the edits.

use crate::text::{Edit, Span};

/// The edits that undo one step; their spans refer to the text after it.
type Step = Vec<Edit>;

/// The undo and redo steps, and what is needed to revert the last call.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    undo: Vec<Step>,
    redo: Vec<Step>,
    /// Whether the top of `undo` is a run of replacements of one leaf that can still grow.
    open: bool,
    last: Option<Call>,
}

/// What the last call did to the history and the text, so that both can be reverted.
#[derive(Clone, Debug)]
struct Call {
    /// The edits that revert the text; unlike the top step, they cover only this call.
    inverse: Step,
    /// Whether it pushed a step.
    pushed: bool,
    /// The step that was replaced by its own.
    replaced: Option<Step>,
    redo: Vec<Step>,
    open: bool,
}

impl History {
    /// Records a replacement of one leaf by `literal`, merging it into the open step if that ended
    /// with the same leaf. A run that returns to its initial text is not a step.
    pub(super) fn record_literal(&mut self, inverse: Edit, literal: &str) {
        let start = inverse.span.start();
        let before = Span::new(start, start + inverse.text.len());
        let joins = |step: &mut Step| matches!(step.as_slice(), [edit] if edit.span == before);
        let open = self.open;
        let replaced = if open { self.undo.pop_if(joins) } else { None };
        let original = replaced
            .as_ref()
            .and_then(|step| step.first())
            .map_or(&inverse.text, |edit| &edit.text);
        let pushed = original != literal;
        if pushed {
            self.undo.push(vec![Edit {
                span: inverse.span,
                text: original.clone(),
            }]);
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

    /// Records a separate step.
    pub(super) fn record(&mut self, inverse: Step) {
        self.undo.push(inverse.clone());
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
    pub(super) fn revert(&mut self) -> Option<Step> {
        let call = self.last.take()?;
        if call.pushed {
            self.undo.pop();
        }
        self.undo.extend(call.replaced);
        self.redo = call.redo;
        self.open = call.open;
        Some(call.inverse)
    }

    /// The step that would be undone.
    pub(super) fn peek_undo(&self) -> Option<&Step> {
        self.undo.last()
    }

    /// The step that would be redone.
    pub(super) fn peek_redo(&self) -> Option<&Step> {
        self.redo.last()
    }

    /// The edits that revert the last call.
    pub(super) fn last_inverse(&self) -> Option<&[Edit]> {
        self.last.as_ref().map(|call| &*call.inverse)
    }

    /// Takes the step to undo; its inverse is to be passed to [`History::undone`].
    pub(super) fn next_undo(&mut self) -> Option<Step> {
        self.commit();
        self.undo.pop()
    }

    /// Takes the step to redo; its inverse is to be passed to [`History::redone`].
    pub(super) fn next_redo(&mut self) -> Option<Step> {
        self.commit();
        self.redo.pop()
    }

    /// Stores the edits that redo a step just undone.
    pub(super) fn undone(&mut self, inverse: Step) {
        self.redo.push(inverse);
    }

    /// Stores the edits that undo a step just redone.
    pub(super) fn redone(&mut self, inverse: Step) {
        self.undo.push(inverse);
    }
}
