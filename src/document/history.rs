//! Undo and redo steps as edits that lead back. Holds no text: the document applies what it hands
//! out.

use crate::text::{Edit, Span};

/// The edits that take one step back, in positions of the text after the step.
type Step = Vec<Edit>;

/// The steps done and undone, and what is needed to forget the last call.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    undo: Vec<Step>,
    redo: Vec<Step>,
    /// Whether the top of `undo` is a run of replacements of one leaf that may still grow.
    open: bool,
    last: Option<Call>,
}

/// What the last call did to the history and the text, so that both can be taken back.
#[derive(Clone, Debug)]
struct Call {
    /// The edits that take the text back; unlike the top step, they span this one call.
    inverse: Step,
    /// Whether it left a step on top.
    pushed: bool,
    /// The step that its own took the place of.
    replaced: Option<Step>,
    redo: Vec<Step>,
    open: bool,
}

impl History {
    /// Notes a replacement of one leaf by `literal`; joins the open step if that ended with the
    /// same leaf. A run that comes back to where it began is not a step.
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

    /// Notes a step of its own.
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

    /// Notes a call that changed nothing, so that taking it back changes nothing either.
    pub(super) fn record_nothing(&mut self) {
        self.last = None;
    }

    /// Ends the open step and lets the last call stand for good.
    pub(super) fn settle(&mut self) {
        self.close();
        self.last = None;
    }

    /// Ends the open step; the last call can still be taken back.
    pub(super) fn close(&mut self) {
        self.open = false;
        if let Some(call) = &mut self.last {
            call.open = false;
        }
    }

    /// Forgets the last call; the edits that take the text back.
    pub(super) fn take_back(&mut self) -> Option<Step> {
        let call = self.last.take()?;
        if call.pushed {
            self.undo.pop();
        }
        self.undo.extend(call.replaced);
        self.redo = call.redo;
        self.open = call.open;
        Some(call.inverse)
    }

    /// Takes the step to undo; what leads forward again goes to [`History::undone`].
    pub(super) fn next_undo(&mut self) -> Option<Step> {
        self.settle();
        self.undo.pop()
    }

    /// Takes the step to redo; what leads back again goes to [`History::redone`].
    pub(super) fn next_redo(&mut self) -> Option<Step> {
        self.settle();
        self.redo.pop()
    }

    /// Keeps what redoes a step just undone.
    pub(super) fn undone(&mut self, inverse: Step) {
        self.redo.push(inverse);
    }

    /// Keeps what undoes a step just redone.
    pub(super) fn redone(&mut self, inverse: Step) {
        self.undo.push(inverse);
    }
}
