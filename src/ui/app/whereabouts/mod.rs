//! "Where is it?": a panel that tells of the selected row whether it is in the picture, what hides it, what
//! lights it and what it changes. It follows the selection until it is closed.

mod asking;
mod keys;
mod places;
mod screen;
mod words;

pub use asking::Whereabouts;
pub(crate) use asking::located;
pub(crate) use keys::KEYS;
pub(crate) use places::{Arrow, arrow};
pub(crate) use screen::locates;
pub(crate) use words::lines;
