//! MOVE: moves, rotates and scales things in the picture.

mod keys;
mod transforming;

pub(crate) use keys::KEYS;
pub(crate) use transforming::{confirm, drag, is_movable, pose_for, start, type_amount};
