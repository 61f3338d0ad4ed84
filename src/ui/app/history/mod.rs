//! Undoing and redoing, and the page of the undo history: a picture of the text after each step.

mod keys;
mod page;
mod thumbnails;
mod tracing;
mod undoing;

pub(crate) use keys::KEYS;
#[cfg(test)]
pub(crate) use page::go_to_state;
pub(crate) use page::{body, history_layout, list_steps, step_rows, when};
pub(crate) use thumbnails::Slot;
pub use thumbnails::{Rank, Thumbnail, Thumbnails};
pub(crate) use tracing::derived;
pub(crate) use undoing::{redo, undo};
