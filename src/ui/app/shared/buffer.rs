//! The buffer that an editor has of the scene.

use std::sync::Arc;

use link::Abilities;

/// A buffer that is open in an editor.
#[derive(Debug)]
pub struct Buffer {
    /// The short name of the editor.
    pub editor: String,
    /// What the editor can be asked for.
    pub(crate) can: Abilities,
    /// Whether its text is the outside text.
    pub(crate) is_followed: bool,
    /// Whether it has changed since it was opened or saved.
    pub is_changed: bool,
    /// The version whose text is the saved text of the document; `None` until one is.
    pub(crate) version: Option<u64>,
    /// The version that is to be merged, while that waits for a decision.
    pub(crate) offered: Option<u64>,
    /// Edits that were sent and are not in the buffer yet.
    pub(crate) sent: Option<Sent>,
    /// How many times the same edits were sent without success.
    pub(crate) failures: u32,
    /// The revision of the text whose edits are about to be sent.
    pub(crate) due: Option<u64>,
}

/// Edits that were sent.
#[derive(Debug)]
pub(crate) struct Sent {
    /// The version that they change.
    pub(crate) base: u64,
    /// The text with them.
    pub(crate) text: Arc<String>,
    /// Whether the editor says that it made them.
    pub(crate) is_made: bool,
}

impl Buffer {
    /// A buffer that was just opened.
    pub(crate) fn new(editor: String, can: Abilities, is_followed: bool) -> Self {
        Self {
            editor,
            can,
            is_followed,
            is_changed: false,
            version: None,
            offered: None,
            sent: None,
            failures: 0,
            due: None,
        }
    }

    /// The editor, if its buffer is the outside text.
    pub fn followed(&self) -> Option<&str> {
        self.is_followed.then_some(&*self.editor)
    }

    /// The editor, if undoing and saving are done there.
    pub(crate) fn owner(&self) -> Option<&str> {
        self.takes_edits().then_some(&*self.editor)
    }

    /// Whether the editor has edits of the interface made in its buffer.
    pub(crate) fn takes_edits(&self) -> bool {
        self.is_followed && self.can.edits
    }
}
