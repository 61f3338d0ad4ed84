//! Undoing and redoing, and the page of the undo history: a picture of the text after each step.

mod thumbnails;
mod timeline;
mod tracing;
mod undoing;

pub use thumbnails::{Rank, Thumbnail, Thumbnails};
pub(crate) use timeline::{go_to_state, history_layout, list_steps, open_steps, step_rows};
pub(crate) use tracing::derived;
pub(crate) use undoing::{redo, undo};
