//! A text from outside and unsaved edits, brought together beside the document that is edited on.

use std::sync::Arc;

use super::{Document, Merge};
use crate::language::Language;
use crate::text;
use crate::text::{Edit, smallest_edit};

/// A document at one moment, as far as a text from outside is compared with it.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Its language.
    pub language: Language,
    /// The text last saved or loaded.
    pub saved: Arc<String>,
    /// The text under edit, if it is another one.
    pub edited: Option<Arc<String>>,
}

/// What a text from outside and unsaved edits make together: [`Document::take`].
#[derive(Debug)]
pub struct Merged {
    /// The text with both, and its tree; what is saved is the text from outside.
    pub document: Document,
    /// The edits that lead back to the text under edit.
    pub(super) back: Vec<Edit>,
}

impl Snapshot {
    /// Whether a document still is as it was.
    pub fn is_of(&self, document: &Document) -> bool {
        let is_text = match &self.edited {
            Some(edited) => Arc::ptr_eq(edited, document.source.text()),
            None => !document.is_dirty,
        };
        is_text && Arc::ptr_eq(&self.saved, &document.saved)
    }

    /// The text under edit.
    pub fn text(&self) -> &Arc<String> {
        self.edited.as_ref().unwrap_or(&self.saved)
    }

    /// Merges a text from outside with the unsaved edits; or what is to be decided first.
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
        let back = text::apply(&mut text, &merge.edits());
        let mut document = theirs;
        if let Some(edit) = smallest_edit(document.text(), &text) {
            document.change(&[edit]);
        }
        Ok(Merged { document, back })
    }
}
