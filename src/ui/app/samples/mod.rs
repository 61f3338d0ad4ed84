//! The page of the sample scenes that the program carries: a picture and a line of each, and opening a
//! copy of one.

mod keys;
mod page;
mod tracing;

pub(crate) use keys::KEYS;
pub(crate) use page::{list_samples, shown_samples};
pub use tracing::Gallery;
pub(crate) use tracing::{derived, is_ticket};
