//! Background work: threads that read, write, watch, compare, explain, locate, derive and film, so that no key
//! press waits for them.

mod answering;
mod assets;
pub(crate) mod buffers;
mod comparing;
mod deriving;
pub mod destination;
mod explaining;
pub mod filming;
mod locating;
pub mod remembering;
pub mod scene_loader;
mod tracks;
mod watching;
pub mod writing;

pub(crate) use answering::Answering;
pub(crate) use assets::assets;
pub(crate) use comparing::{figures, references};
pub(crate) use deriving::history_scenes;
pub(crate) use explaining::explanations;
#[cfg(test)]
pub(crate) use locating::locate;
pub(crate) use locating::whereabouts;
pub(crate) use tracks::tracks;
