//! Undoing and redoing, and the page of the undo history: a picture of the text after each step.

mod keys;
mod thumbnails;
mod timeline;
mod tracing;
mod undoing;

pub(crate) use keys::KEYS;
pub use thumbnails::{Rank, Thumbnail, Thumbnails};
#[cfg(test)]
pub(crate) use timeline::go_to_state;
pub(crate) use timeline::{history_layout, list_steps, step_rows, when};
pub(crate) use tracing::derived;
pub(crate) use undoing::{redo, undo};
