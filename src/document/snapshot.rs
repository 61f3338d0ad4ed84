//! Merges a text from outside with unsaved edits, while the document can be edited.

use std::sync::Arc;

use super::{Document, Merge};
use crate::language::Language;
use crate::text;
use crate::text::{Edit, smallest_edit};

/// What a merge with a text from outside needs of a document, at one moment.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// The language of the text.
    pub language: Language,
    /// The text last saved or loaded.
    pub saved: Arc<String>,
    /// The text being edited, if it differs.
    pub edited: Option<Arc<String>>,
}

/// A text from outside merged with unsaved edits, for [`Document::take`].
#[derive(Debug)]
pub struct Merged {
    /// The merged text and its tree; its saved text is the one from outside.
    pub document: Document,
    /// The edits that lead back to the text that was edited.
    pub(super) back: Vec<Edit>,
}

impl Snapshot {
    /// Whether a document is unchanged since the snapshot.
    pub fn is_of(&self, document: &Document) -> bool {
        let is_text = match &self.edited {
            Some(edited) => Arc::ptr_eq(edited, document.source.text()),
            None => !document.is_dirty,
        };
        is_text && Arc::ptr_eq(&self.saved, &document.saved)
    }

    /// The text being edited.
    pub fn text(&self) -> &Arc<String> {
        self.edited.as_ref().unwrap_or(&self.saved)
    }

    /// Merges a text from outside with the unsaved edits; the error is a merge with conflicts.
    pub fn merge(&self, theirs: Document) -> Result<Merged, Merge> {
        let merge = Merge::new(
            self.language,
            &self.saved,
            self.text(),
            theirs.source.text(),
        );
        if !merge.conflicts.is_empty() {
            return Err(merge);
        }
        let mut text = String::clone(self.text());
        let mut back = text::apply(&mut text, &merge.edits());
        let mut document = theirs;
        if let Some(edit) = smallest_edit(document.text(), &text) {
            document.change(&[edit]);
        }
        // Both may have added or deleted something, and then state the same count.
        let counts = document.source.recount();
        if !counts.is_empty() {
            document.change(&counts);
            back = smallest_edit(document.text(), self.text())
                .into_iter()
                .collect();
        }
        Ok(Merged { document, back })
    }
}
