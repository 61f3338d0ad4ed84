//! Camera checks and defaults shared by all languages.

use glam::DVec3;

use super::schema::Range;
use super::schema::position::At;
use super::view::Numbers;
use geometry::{Aabb, normalise};
use scene::{Camera, Focus, Lens, Size};
use text::{Diagnostic, Findings, Span};

/// The places of a camera's parts in the text, or stand-ins for missing parts.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CameraSpans {
    pub(super) eye: Span,
    pub(super) target: Span,
    pub(super) up: Span,
    pub(super) whole: Span,
    /// How to state a camera in this language.
    pub(super) remedy: &'static str,
}

/// The positions of the numbers of a perspective camera without anything else.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pinhole {
    pub(super) eye: At<3>,
    pub(super) target: At<3>,
    pub(super) up: At<3>,
    /// The vertical angle of view in degrees.
    pub(super) fov: At<1>,
    pub(super) size: At<2>,
}

impl Pinhole {
    /// The numbers of a camera, as many as there are defaults.
    pub(super) fn numbers(&self, camera: &Camera, defaults: &[f64]) -> Numbers {
        let mut numbers = defaults.to_vec();
        self.eye.put(&mut numbers, camera.eye.into());
        self.target.put(&mut numbers, camera.target.into());
        self.up.put(&mut numbers, camera.up.into());
        let (Lens::Perspective(fov) | Lens::Orthographic(fov)) = camera.lens;
        self.fov.put(&mut numbers, [fov]);
        let Size { width, height } = camera.size;
        self.size.put(&mut numbers, [width.into(), height.into()]);
        numbers
    }

    /// The camera described by these numbers.
    pub(super) fn camera(&self, numbers: &[f64]) -> Camera {
        let [width, height] = self.size.get(numbers).map(|side| side as u32);
        Camera {
            eye: self.eye.vector(numbers),
            target: self.target.vector(numbers),
            up: self.up.vector(numbers),
            lens: Lens::Perspective(self.fov.number(numbers)),
            pixel_aspect: 1.0,
            depths: Camera::ALL_DEPTHS,
            focus: Focus::PINHOLE,
            size: Size { width, height },
        }
    }
}

/// Returns the centre of the box and an eye on the given side of it, from which its bounding sphere
/// fills the angle of view, in degrees. An empty box counts as one of size 1 around the origin.
pub(super) fn default_eye_and_target(bounds: Aabb, fov: f64, side: DVec3) -> (DVec3, DVec3) {
    let (centre, radius) = if bounds.is_empty() {
        (DVec3::ZERO, 0.5 * 3.0_f64.sqrt())
    } else {
        (bounds.centre(), bounds.half_diagonal())
    };
    let distance = radius / libm::sin((0.5 * fov).to_radians());
    (centre + distance * side.normalize(), centre)
}

/// Reports a camera whose eye is at its target, and one that looks along its `up`.
pub(super) fn check(camera: &Camera, places: &CameraSpans, report: &mut Findings) {
    if !camera.eye.is_finite() || !camera.target.is_finite() {
        report.error(|| {
            let message = "view: the scene is too large for a default view";
            Diagnostic::error(places.whole, message, Range::Any.words()).with_hint(places.remedy)
        });
        return;
    }
    // Halved, because the difference of two large numbers may overflow.
    let Some(forward) = normalise(0.5 * camera.target - 0.5 * camera.eye) else {
        report.error(|| {
            let message = "view target: coincides with the eye";
            let place = places.eye.to(places.target);
            Diagnostic::error(place, message, "a point other than the eye")
        });
        return;
    };
    let sine = normalise(camera.up).map_or(0.0, |up| forward.cross(up).length());
    if sine < Camera::LEAST_SINE {
        report.warning(|| {
            let message = "view up: is parallel to the direction of view";
            Diagnostic::warning(places.up, message, "a direction not parallel to the view")
                .with_hint("the world axis closest to perpendicular is used instead")
        });
    }
}
