//! SEQUENCE: plays a track over the scene, frame by frame, keys values in it, and exports all frames.
//!
//! Each frame is tried in the text of the scene as a [transient edit][edit], so that it is a scene like any
//! other.
//!
//! [edit]: crate::app::shared::live_edit::TransientEdit

mod dope_sheet;
mod exporting;
mod keying;
mod keys;
mod playing;
mod room;
mod state;

pub(crate) use dope_sheet::DopeSheet;
pub(crate) use exporting::{export, filmed};
pub(crate) use keying::written;
pub(crate) use keys::{ENTRIES, KEYS};
pub(crate) use playing::{open_track, play_on, reread, track_read};
pub use state::{OpenTrack, Sequence};
