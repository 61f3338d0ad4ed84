//! The steps of a history as others see them: their names, and the texts between them.

use std::fmt;
use std::sync::Arc;

use super::Document;
use super::history::Step;
use crate::language::Language;
use crate::text;

/// Identifies a text in the history of a session: no other text has the same one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StateId(pub(super) u64);

/// What a step changed, for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepName {
    /// What was done, or the place of the value that was replaced.
    what: String,
    /// The value before and after.
    values: Option<[String; 2]>,
    /// The number of changes merged into the step.
    pub(super) changes: usize,
}

impl Default for StepName {
    /// The name of a step that nobody named.
    fn default() -> Self {
        Self::done("edit")
    }
}

impl StepName {
    /// The name of a step by what was done: `deleted object 2 (box)`.
    pub fn done(what: impl Into<String>) -> Self {
        Self {
            what: what.into(),
            values: None,
            changes: 1,
        }
    }

    /// The name of a step that replaced a value: its place, and the value before and after.
    pub fn set(place: impl Into<String>, before: &str, after: &str) -> Self {
        Self {
            values: Some([before, after].map(str::to_owned)),
            ..Self::done(place)
        }
    }

    /// The name of a step that a change with this name was merged into.
    pub(super) fn continuing(mut self, before: &Self) -> Self {
        self.changes += before.changes;
        if let (Some([old, _]), Some([first, _])) = (&mut self.values, &before.values) {
            old.clone_from(first);
        }
        self
    }
}

impl fmt::Display for StepName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)?;
        if let Some([before, after]) = &self.values {
            write!(f, ": {before} → {after}")?;
        }
        if 1 < self.changes {
            write!(f, ", {} nudges", self.changes)?;
        }
        Ok(())
    }
}

/// A text of the history.
#[derive(Clone, Copy, Debug)]
pub struct State<'a> {
    /// Identifies the text.
    pub id: StateId,
    /// The step that led to it; `None` for the first text.
    pub name: Option<&'a StepName>,
}

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
