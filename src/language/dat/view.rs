//! Conversion between cameras and the `camera`, `resolution` and `viewport` records.

use glam::DVec3;

use super::Film;
use super::schema::{self, CAMERA, PROJECTIONS};
use crate::schema::position::At;
use crate::spelling::rounded_off;
use crate::view::Numbers;
use scene::{Camera, Focus, Lens, Size};

/// The far distance written for an unlimited view: `.dat` cannot express infinity.
pub(super) const FARTHEST: f64 = 1e30;

/// The default size of the picture.
pub(super) const DEFAULT_SIZE: Size = Size {
    width: 800,
    height: 600,
};

/// Number of numbers in the records of the view.
const COUNT: usize = CAMERA.numbers() + schema::RESOLUTION.numbers() + schema::VIEWPORT.numbers();

const PROJECTION: At<1> = CAMERA.at("projection");
pub(super) const EYE: At<3> = CAMERA.at("eye");
pub(super) const LOOK: At<3> = CAMERA.at("look");
pub(super) const UP: At<3> = CAMERA.at("up");
const FOCAL: At<1> = CAMERA.at("focal");
const NEAR: At<1> = CAMERA.at("near");
pub(super) const FAR: At<1> = CAMERA.at("far");
const RESOLUTION: At<2> = schema::RESOLUTION.at("resolution").later(CAMERA.numbers());
const VIEWPORT: At<2> = schema::VIEWPORT.at("viewport").later(COUNT - 2);

/// The content of the records of the view.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) is_perspective: bool,
    pub(super) eye: DVec3,
    pub(super) look: DVec3,
    pub(super) up: DVec3,
    /// The distance from the eye to the image plane.
    pub(super) focal: f64,
    /// The range of depths in the picture.
    pub(super) depths: [f64; 2],
    /// World units per pixel, across and up.
    pub(super) resolution: [f64; 2],
    pub(super) size: Size,
}

impl View {
    /// The camera it describes.
    pub(super) fn camera(&self) -> Camera {
        let [across, up] = self.resolution;
        let height = up * f64::from(self.size.height);
        let [near, far] = self.depths;
        Camera {
            eye: self.eye,
            target: self.look,
            up: self.up,
            lens: if self.is_perspective {
                Lens::Perspective(2.0 * libm::atan(0.5 * height / self.focal).to_degrees())
            } else {
                Lens::Orthographic(height)
            },
            pixel_aspect: across / up,
            depths: [near.max(0.0), far],
            focus: Focus::PINHOLE,
            size: self.size,
        }
    }

    /// The view that describes a camera. An angle of view is expressed by the focal length, with
    /// the resolution unchanged; the height of an orthographic view by the resolution.
    fn of(camera: &Camera, film: &Film) -> Self {
        let rows = f64::from(camera.size.height);
        let (focal, up) = match camera.lens {
            Lens::Perspective(angle) => {
                let up = film.resolution[1];
                let focal = 0.5 * rows * up / libm::tan(0.5 * angle.to_radians());
                (rounded_off(focal), up)
            }
            Lens::Orthographic(height) => (film.focal, rounded_off(height / rows)),
        };
        let across = if camera.pixel_aspect == 1.0 {
            up
        } else {
            rounded_off(up * camera.pixel_aspect)
        };
        let [near, far] = camera.depths;
        Self {
            is_perspective: matches!(camera.lens, Lens::Perspective(_)),
            eye: camera.eye,
            look: camera.target,
            up: camera.up,
            focal,
            depths: [near, far.min(FARTHEST)],
            resolution: [across, up],
            size: camera.size,
        }
    }

    /// The view with these numbers in its `camera` record.
    pub(super) fn from_camera_record(numbers: &[f64]) -> Self {
        Self {
            is_perspective: PROJECTION.choice(numbers, &PROJECTIONS),
            eye: EYE.vector(numbers),
            look: LOOK.vector(numbers),
            up: UP.vector(numbers),
            focal: FOCAL.number(numbers),
            depths: [NEAR, FAR].map(|at| at.number(numbers)),
            resolution: [1.0; 2],
            size: DEFAULT_SIZE,
        }
    }

    /// The view with these numbers in its three records, in the order of the table.
    fn from_numbers(numbers: &[f64]) -> Self {
        Self {
            resolution: RESOLUTION.get(numbers),
            size: size(VIEWPORT.get(numbers)),
            ..Self::from_camera_record(numbers)
        }
    }

    /// The numbers of the view, in the order of the table.
    fn numbers(&self) -> Numbers {
        let mut numbers = vec![0.0; COUNT];
        PROJECTION.choose(&mut numbers, &PROJECTIONS, self.is_perspective);
        EYE.put(&mut numbers, self.eye.into());
        LOOK.put(&mut numbers, self.look.into());
        UP.put(&mut numbers, self.up.into());
        FOCAL.put(&mut numbers, [self.focal]);
        let [near, far] = self.depths;
        NEAR.put(&mut numbers, [near]);
        FAR.put(&mut numbers, [far]);
        RESOLUTION.put(&mut numbers, self.resolution);
        let Size { width, height } = self.size;
        VIEWPORT.put(&mut numbers, [width.into(), height.into()]);
        numbers
    }
}

/// A picture size from integers.
pub(super) fn size([width, height]: [f64; 2]) -> Size {
    Size {
        width: width as u32,
        height: height as u32,
    }
}

/// The numbers of a camera, in the order of the table.
pub(super) fn numbers(camera: &Camera, film: &Film) -> Numbers {
    View::of(camera, film).numbers()
}

/// The camera described by these numbers; `base` is a camera of the same text. Parts whose numbers
/// agree with `base` are kept bit for bit.
pub(super) fn camera(numbers: &Numbers, base: &Camera, film: &Film) -> Camera {
    let before = View::from_numbers(&self::numbers(base, film));
    let view = View::from_numbers(numbers);
    let camera = view.camera();
    let lens = match base.lens {
        // The picture keeps its size at the target.
        Lens::Orthographic(height) if view.is_perspective => {
            let distance = (base.eye - base.target).length();
            Lens::Perspective(2.0 * libm::atan(0.5 * height / distance).to_degrees())
        }
        Lens::Perspective(angle) if !view.is_perspective => {
            let distance = (base.eye - base.target).length();
            Lens::Orthographic(2.0 * distance * libm::tan(0.5 * angle.to_radians()))
        }
        lens if before.focal == view.focal
            && before.resolution == view.resolution
            && before.size == view.size =>
        {
            lens
        }
        _ => camera.lens,
    };
    Camera {
        lens,
        pixel_aspect: if before.resolution == view.resolution {
            base.pixel_aspect
        } else {
            camera.pixel_aspect
        },
        depths: if before.depths == view.depths {
            base.depths
        } else {
            camera.depths
        },
        focus: base.focus,
        ..camera
    }
}
