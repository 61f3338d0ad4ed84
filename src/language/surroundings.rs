//! What of a camera, its surroundings and the lights other languages cannot hold.

use glam::DVec3;

use super::losses::{Loss, Losses, Of};
use geometry::{Aabb, normalise};
use scene::{Camera, Falloff, Lens, Light, Rgb, Scene, Setting};

const PARALLEL: Loss = Loss {
    keys: &["projection"],
    lost: "an orthographic camera",
    instead: "written as a perspective one that shows as much at its target",
};

const PIXELS: Loss = Loss {
    keys: &["resolution"],
    lost: "pixels that are not square",
    instead: "written with square ones: the picture is stretched",
};

const NEAR: Loss = Loss {
    keys: &["near"],
    lost: "a near limit",
    instead: "written without it: what is nearer is seen, and rays that begin at the eye are rounded \
              differently",
};

const FAR: Loss = Loss {
    keys: &["far"],
    lost: "a far limit that hides something",
    instead: "written without it: what is farther is seen",
};

const FOCUS: Loss = Loss {
    keys: &["dof"],
    lost: "depth of field",
    instead: "written without it: everything is in focus",
};

const BACKGROUND: Loss = Loss {
    keys: &["background"],
    lost: "a background that is not black",
    instead: "written without it",
};

const ENVIRONMENT: Loss = Loss {
    keys: &["environment"],
    lost: "an environment that is not black",
    instead: "written without it",
};

/// A light with a size.
pub(super) const SIZE: Loss = Loss {
    keys: &["size"],
    lost: "a light with a size",
    instead: "written as a point: its shadows are hard",
};

/// A light that fades with distance.
pub(super) const FADING: Loss = Loss {
    keys: &["attenuation", "a0", "a1", "a2"],
    lost: "light that fades with distance",
    instead: "written as bright everywhere as it is in the middle of the scene",
};

/// A spot light.
pub(super) const SPOT: Loss = Loss {
    keys: &["aa", "direction"],
    lost: "a spot light",
    instead: "written as a light that shines as bright in all directions",
};

/// A light that casts no shadows.
pub(super) const SHADOWLESS: Loss = Loss {
    keys: &["shadow"],
    lost: "light without shadows",
    instead: "written with shadows",
};

/// A light infinitely far away.
pub(super) const DISTANT: Loss = Loss {
    keys: &["direction", "position"],
    lost: "a light infinitely far away",
    instead: "written as a point far away",
};

/// The vertical angle of view, in degrees, of a perspective camera with square pixels and without
/// depth limits that shows nearly the same.
pub(super) fn angle(scene: &Scene, losses: &mut Losses<'_>) -> f64 {
    let camera = &scene.camera;
    if camera.pixel_aspect != 1.0 {
        losses.add(Of::View, &PIXELS);
    }
    let [near, far] = camera.depths;
    if near != 0.0 {
        losses.add(Of::View, &NEAR);
    }
    if !is_all_before(scene, far) {
        losses.add(Of::View, &FAR);
    }
    match camera.lens {
        Lens::Perspective(angle) => angle,
        Lens::Orthographic(height) => {
            losses.add(Of::View, &PARALLEL);
            let distance = camera.eye.distance(camera.target);
            let angle = 2.0 * libm::atan2(0.5 * height, distance).to_degrees();
            angle.clamp(f64::MIN_POSITIVE, 180.0_f64.next_down())
        }
    }
}

/// Whether nothing in the scene reaches farther than this along the view.
pub(super) fn is_all_before(scene: &Scene, far: f64) -> bool {
    let Camera { eye, target, .. } = scene.camera;
    let forward = normalise(0.5 * target - 0.5 * eye);
    let Some(forward) = forward.filter(|_| far != f64::INFINITY) else {
        return true;
    };
    let is_before = |bounds: Aabb| {
        let depth = (bounds.centre() - eye).dot(forward);
        let half = 0.5 * bounds.size().dot(forward.abs());
        // More than the rounding of a depth.
        let margin = 1e-9 * (depth.abs() + half + eye.abs().max_element());
        bounds.is_empty() || depth + half + margin < far
    };
    scene
        .objects
        .iter()
        .all(|object| is_before(object.shape.bounds()))
}

/// Reports depth of field, and surroundings other than black.
pub(super) fn report_plain(scene: &Scene, losses: &mut Losses<'_>) {
    if scene.camera.focus.lens_radius != 0.0 {
        losses.add(Of::View, &FOCUS);
    }
    let Setting {
        background,
        environment,
        ..
    } = scene.setting;
    if background.colour != Rgb::ZERO {
        losses.add(Of::Background, &BACKGROUND);
    }
    if environment.colour != Rgb::ZERO {
        losses.add(Of::Environment, &ENVIRONMENT);
    }
}

/// The colour of a point light at `position` in the middle of a scene with these bounds.
pub(super) fn faded(light: &Light, position: DVec3, falloff: &Falloff, bounds: Aabb) -> Rgb {
    let middle = if bounds.is_empty() {
        DVec3::ZERO
    } else {
        bounds.centre()
    };
    let distance = position.distance(middle);
    let [a0, a1, a2] = falloff.radial;
    let spread = a0 + a1 * distance + a2 * distance * distance;
    let colour = light.colour / spread;
    if 0.0 < spread && colour.is_finite() {
        colour
    } else {
        light.colour
    }
}
