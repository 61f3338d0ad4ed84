//! The state of VIEW and FLY: the views on their page.

use language::SavedView;

/// The state of VIEW and FLY. The camera that they move is not part of it, since every mode sees through it.
#[derive(Debug, Default)]
pub struct View {
    /// The views on the page of saved views.
    pub(super) saved: Vec<SavedView>,
    /// The revision of the text that they are from.
    pub(super) revision: Option<u64>,
}
