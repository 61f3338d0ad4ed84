//! Conversion between cameras and the `camera` and `size` commands.

use super::schema::{self, CAMERA};
use crate::schema::position::At;
use crate::view::Numbers;
use scene::{Camera, Focus, Lens, Size};

/// The numbers without any of the commands.
pub(super) const DEFAULT: [f64; COUNT] = [
    0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 45.0, 640.0, 480.0,
];

const COUNT: usize = CAMERA.numbers() + schema::SIZE.numbers();

pub(super) const FROM: At<3> = CAMERA.at("from");
pub(super) const AT: At<3> = CAMERA.at("at");
pub(super) const UP: At<3> = CAMERA.at("up");
const FOV: At<1> = CAMERA.at("fov");
const SIZE: At<2> = schema::SIZE.at("size").later(CAMERA.numbers());

/// The numbers of a camera.
pub(super) fn numbers(camera: &Camera) -> Numbers {
    let mut numbers = DEFAULT.to_vec();
    FROM.put(&mut numbers, camera.eye.into());
    AT.put(&mut numbers, camera.target.into());
    UP.put(&mut numbers, camera.up.into());
    let (Lens::Perspective(fov) | Lens::Orthographic(fov)) = camera.lens;
    FOV.put(&mut numbers, [fov]);
    let Size { width, height } = camera.size;
    SIZE.put(&mut numbers, [width.into(), height.into()]);
    numbers
}

/// The camera described by these numbers.
pub(super) fn camera(numbers: &[f64]) -> Camera {
    let [width, height] = SIZE.get(numbers).map(|side| side as u32);
    Camera {
        eye: FROM.vector(numbers),
        target: AT.vector(numbers),
        up: UP.vector(numbers),
        lens: Lens::Perspective(FOV.number(numbers)),
        pixel_aspect: 1.0,
        depths: Camera::ALL_DEPTHS,
        focus: Focus::PINHOLE,
        size: Size { width, height },
    }
}
