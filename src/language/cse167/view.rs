//! The numbers of the `camera` and `size` commands.

use super::schema::{CAMERA, SIZE};
use crate::camera::Pinhole;

/// The numbers without any of the commands.
pub(super) const DEFAULT: [f64; CAMERA.numbers() + SIZE.numbers()] = [
    0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 45.0, 640.0, 480.0,
];

/// Their positions.
pub(super) const VIEW: Pinhole = Pinhole {
    eye: CAMERA.at("from"),
    target: CAMERA.at("at"),
    up: CAMERA.at("up"),
    fov: CAMERA.at("fov"),
    size: SIZE.at("size").later(CAMERA.numbers()),
};
