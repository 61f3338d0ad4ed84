//! Camera checks and defaults shared by all languages.

use glam::DVec3;

use super::schema::Range;
use geometry::{Aabb, normalise};
use scene::Camera;
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
