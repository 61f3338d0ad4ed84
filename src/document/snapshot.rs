//! A text from outside and unsaved edits, brought together beside the document that is edited on.

use std::sync::Arc;

use super::{Document, Merge};
use crate::format::Format;
use crate::text::{self, Edit, Span, smallest_edit};

/// A document at one moment, as far as a text from outside is compared with it.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Its language.
    pub format: Format,
    /// The text last saved or loaded.
    pub saved: Arc<String>,
    /// The text under edit.
    pub text: Arc<String>,
    /// Whether the two differ.
    pub is_dirty: bool,
}

/// What a text from outside and unsaved edits make together: [`Document::take`].
#[derive(Debug)]
pub struct Merged {
    /// The text with both, and its tree; what is saved is the text from outside.
    pub document: Document,
    /// What the unsaved edits replaced in the text from outside, and where it stands now; `None` if
    /// they are all in it.
    pub mine: Option<[Span; 2]>,
    /// The edits that lead back to the text under edit.
    pub(super) back: Vec<Edit>,
}

impl Snapshot {
    /// Whether a document still is as it was.
    pub fn is_of(&self, document: &Document) -> bool {
        Arc::ptr_eq(&self.saved, &document.saved) && Arc::ptr_eq(&self.text, &document.text)
    }

    /// Merges a text from outside with the unsaved edits; or what is to be decided first.
    pub fn merge(&self, theirs: Document) -> Result<Merged, Merge> {
        let merge = Merge::new(self.format, &self.saved, &self.text, &theirs.text);
        if !merge.conflicts.is_empty() {
            return Err(merge);
        }
        let mut text = String::clone(&self.text);
        let back = text::apply(&mut text, &merge.edits());
        let mut document = theirs;
        let mine = smallest_edit(&document.text, &text).map(|edit| {
            let spans = [edit.span, edit.placed()];
            document.change(&[edit]);
            spans
        });
        Ok(Merged {
            document,
            mine,
            back,
        })
    }
}
