//! SEQUENCE: plays a track over the scene, frame by frame, keys values in it, and exports all frames.
//!
//! Each frame is tried in the text of the scene as a [transient edit](super::live_edit::TransientEdit), so
//! that it is a scene like any other.

mod dope_sheet;
mod exporting;
mod keying;
mod keys;
mod playing;
mod room;
mod state;

pub(in crate::ui) use dope_sheet::DopeSheet;
pub(super) use exporting::{export, filmed};
pub(super) use keying::written;
pub(super) use keys::{ENTRIES, KEYS};
pub(super) use playing::{open_track, play_on, reread, track_read};
pub use state::{OpenTrack, Sequence};
