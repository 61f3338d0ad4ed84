//! The camera's records.

use std::fmt::Write;

use crate::dat::view::FARTHEST;
use crate::losses::Losses;
use crate::spelling::{numbers, vector};
use scene::{Camera, Lens, Scene, Size};

/// Focal lengths to try, until one gives the angle of view to the last bit.
const FOCAL: [f64; 8] = [1.0, 2.0, 0.5, 3.0, 0.1, 5.0, 7.0, 0.3];

pub(super) fn write(text: &mut String, scene: &Scene, _: &Losses<'_>) {
    let camera = &scene.camera;
    let plane = ImagePlane::of(camera);
    text.push_str(match camera.lens {
        Lens::Perspective(_) => "camera perspective",
        Lens::Orthographic(_) => "camera orthographic",
    });
    for point in [camera.eye, camera.target, camera.up] {
        vector(text, point);
    }
    let [near, far] = camera.depths;
    text.push(' ');
    numbers(text, [plane.focal, near, far.min(FARTHEST)]);
    text.push_str("\nresolution");
    numbers(text, plane.resolution);
    let Size { width, height } = camera.size;
    // Writing to a string cannot fail.
    let _ = writeln!(text, "\nviewport {width} {height}");
}

/// The distance of the image plane, and the world units of a pixel on it, across and up.
struct ImagePlane {
    focal: f64,
    resolution: [f64; 2],
}

impl ImagePlane {
    /// The plane that gives the camera's lens and pixels, to the last bit if one is found.
    fn of(camera: &Camera) -> Self {
        let rows = f64::from(camera.size.height);
        let (focal, up) = match camera.lens {
            Lens::Orthographic(height) => {
                let up = near(height / rows).find(|up| up * rows == height);
                (1.0, up.unwrap_or(height / rows))
            }
            Lens::Perspective(angle) => {
                let up_at = |focal: f64| 2.0 * focal * libm::tan(0.5 * angle.to_radians()) / rows;
                let exact = |focal: f64| {
                    let is_same = |up: &f64| {
                        let height = up * rows;
                        2.0 * libm::atan(0.5 * height / focal).to_degrees() == angle
                    };
                    Some((focal, near(up_at(focal)).find(is_same)?))
                };
                let found = FOCAL.into_iter().find_map(exact);
                found.unwrap_or_else(|| (1.0, up_at(1.0)))
            }
        };
        let aspect = camera.pixel_aspect;
        let across = near(up * aspect).find(|across| across / up == aspect);
        Self {
            focal,
            resolution: [across.unwrap_or(up * aspect), up],
        }
    }
}

/// Numbers within a few rounding errors of one, that of fifteen digits first.
pub(super) fn near(number: f64) -> impl Iterator<Item = f64> {
    /// The number of steps up and down.
    const STEPS: usize = 8;
    let short = format!("{number:.14e}").parse().unwrap_or(number);
    let up = std::iter::successors(Some(number), |number| Some(number.next_up()));
    let down = std::iter::successors(Some(number), |number| Some(number.next_down()));
    [short]
        .into_iter()
        .chain(up.take(STEPS))
        .chain(down.skip(1).take(STEPS))
}
