//! The page of the undo history: a picture of the text after each step.

mod thumbnails;
mod tracing;

pub use thumbnails::{Rank, Thumbnail, Thumbnails};
pub(super) use tracing::derived;
