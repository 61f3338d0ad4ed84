//! The steps of the undo history as they are listed.

use crate::document::{Document, StateId};
use crate::text::counted;

/// The steps of the history, as listed at one revision of the text.
#[derive(Debug)]
pub struct Steps {
    /// The texts, the first one first, each named by the step that led to it.
    pub rows: Vec<(StateId, String)>,
    /// The index of the present one.
    pub present: usize,
    pub(crate) revision: u64,
}

impl Steps {
    /// The steps of a document.
    pub(crate) fn of(document: &Document) -> Self {
        let rows = document.states().map(|state| {
            let name = state.name.map(ToString::to_string);
            (state.id, name.unwrap_or_else(|| "as opened".to_owned()))
        });
        Self {
            rows: rows.collect(),
            present: document.present(),
            revision: document.revision(),
        }
    }

    /// The place of a text relative to the present one: `2 steps back`.
    pub fn when(&self, at: usize) -> String {
        match self.present.checked_sub(at) {
            Some(0) => "now".to_owned(),
            Some(back) => format!("{} back", counted(back, "step")),
            None => format!("{} ahead", counted(at - self.present, "step")),
        }
    }
}
