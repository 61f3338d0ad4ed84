//! The render settings suggested for a picture.

use crate::language::RenderKey;

/// A render setting and its value.
pub(super) type Cure = (RenderKey, String);

/// The suggested cures.
#[derive(Debug, Default)]
pub struct Cures {
    /// For what the text shows.
    pub(super) of_text: Vec<Cure>,
    /// For what the preview shows.
    pub(super) of_picture: Vec<Cure>,
    /// Whether the preview was said to be black or too bright, and is so still.
    pub(super) is_said: bool,
}
