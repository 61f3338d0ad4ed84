//! The texts of a history, present or not.

use std::sync::Arc;

use super::Document;
use super::history::Step;
use super::steps::{State, StateId, StepName};
use language::Language;

/// All texts of a history, at one moment, to be derived on another thread. Copies no text.
#[derive(Clone, Debug)]
pub struct Timeline {
    /// The language of the texts.
    pub language: Language,
    present: Arc<String>,
    undo: Vec<Arc<Step>>,
    redo: Vec<Arc<Step>>,
}

impl Timeline {
    /// The text after this many steps, as [`Document::states`] counts them; the nearest one if there
    /// are not as many. Takes time in proportion to the text for each step between it and the
    /// present.
    pub fn text(&self, at: usize) -> Arc<String> {
        let present = self.undo.len();
        let steps: Vec<_> = if at < present {
            self.undo[at..].iter().rev().collect()
        } else {
            self.redo.iter().rev().take(at - present).collect()
        };
        let mut text = Arc::clone(&self.present);
        for step in steps {
            text::apply(Arc::make_mut(&mut text), &step.edits);
        }
        text
    }
}

impl Document {
    /// Names the step made by the last change; does nothing if that made none. A change merged into
    /// a step extends its name.
    pub fn name_step(&mut self, name: StepName) {
        self.history.name(name);
    }

    /// The texts of the history, the first one first, each with the step that led to it: those to
    /// return to by undo, the present one, and those to return to by redo.
    pub fn states(&self) -> impl Iterator<Item = State<'_>> {
        self.history.states()
    }

    /// Identifies the present text.
    pub fn state(&self) -> StateId {
        self.history.state()
    }

    /// The number of steps that can be undone, which is the index of the present text among
    /// [`Document::states`].
    pub fn present(&self) -> usize {
        self.history.undoable()
    }

    /// The texts of the history, to be derived on another thread.
    pub fn timeline(&self) -> Timeline {
        let (undo, redo) = self.history.steps();
        Timeline {
            language: self.language(),
            present: self.shared_text(),
            undo: undo.to_vec(),
            redo: redo.to_vec(),
        }
    }
}
