//! MOVE: moves, rotates and scales things in the picture.

mod keys;
mod room;
mod state;
mod transforming;

pub(crate) use keys::{ENTRIES, KEYS};
pub use state::{Moving, Tool, Transform};
pub(crate) use state::{decimals_of, round_up};
pub(crate) use transforming::{confirm, pose_for, start, type_amount};
