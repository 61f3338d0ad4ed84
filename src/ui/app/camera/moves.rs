//! Moves of the camera, each of which returns the new camera.

use glam::DVec3;

use scene::{Camera, Lens};

/// Angle of one orbit step, in degrees.
const ORBIT: f64 = 5.0;
/// Length of one pan step, relative to the distance to the target.
const PAN: f64 = 0.05;
/// Factor of the distance for one dolly step forward.
const DOLLY: f64 = 0.9;
/// Length of one step forward, relative to the distance to the target.
const ADVANCE: f64 = 0.1;
/// Angle of one turn in place or one roll, in degrees.
const TURN: f64 = 5.0;
/// Change of the field of view per step, in degrees.
const WIDEN: f64 = 2.0;
/// The smallest angle between the view direction and `up`, in degrees.
const POLE: f64 = 1.0;
/// Limits of the field of view for keys, in degrees.
const ANGLES: (f64, f64) = (1.0, 170.0);

/// Orbits around the target by steps to the left and up.
pub(super) fn stepped(camera: Camera, left: i8, up: i8) -> Camera {
    orbited(camera, f64::from(left) * ORBIT, f64::from(up) * ORBIT)
}

/// Moves the camera and its target by steps to the left and up.
pub(super) fn panned(camera: Camera, left: i8, up: i8) -> Camera {
    let offset = camera.eye - camera.target;
    let axes = Axes::of(&camera);
    let shift = offset.length() * PAN * (f64::from(up) * axes.up - f64::from(left) * axes.right);
    shifted(camera, shift)
}

/// Moves the camera and its target by a vector.
pub(crate) fn shifted(camera: Camera, by: DVec3) -> Camera {
    Camera {
        eye: camera.eye + by,
        target: camera.target + by,
        ..camera
    }
}

/// Moves the camera nearer to its target by steps.
pub(crate) fn dollied(camera: Camera, steps: i8) -> Camera {
    let share = libm::pow(DOLLY, f64::from(steps));
    Camera {
        eye: camera.target + share * (camera.eye - camera.target),
        lens: match camera.lens {
            // Parallel rays see the same at any distance: the picture is enlarged instead.
            Lens::Orthographic(height) => Lens::Orthographic(share * height),
            lens @ Lens::Perspective(_) => lens,
        },
        ..camera
    }
}

/// Turns the camera in place by steps to the left and up.
pub(super) fn faced(camera: Camera, left: i8, up: i8) -> Camera {
    turned(camera, f64::from(left) * TURN, f64::from(up) * TURN)
}

/// Moves the camera and its target by steps forward.
pub(crate) fn advanced(camera: Camera, steps: i8) -> Camera {
    let by = ADVANCE * f64::from(steps) * (camera.target - camera.eye);
    shifted(camera, by)
}

/// Rolls the camera around the view direction by steps to the left.
pub(super) fn rolled(camera: Camera, left: i8) -> Camera {
    let back = (camera.eye - camera.target).normalize_or(DVec3::Z);
    let along = camera.up.dot(back) * back;
    let across = camera.up - along;
    let (sin, cos) = libm::sincos((f64::from(left) * TURN).to_radians());
    Camera {
        // The part along the view direction stays: rolling back restores the axis of orbits.
        up: along + cos * across + sin * back.cross(across),
        ..camera
    }
}

/// Widens the field of view by steps.
pub(super) fn widened(camera: Camera, steps: i8) -> Camera {
    let steps = f64::from(steps);
    let lens = match camera.lens {
        Lens::Perspective(angle) => {
            let wider = angle + steps * WIDEN;
            // An angle from the text beyond the limits is not forced back by a step.
            let (low, high) = (ANGLES.0.min(angle), ANGLES.1.max(angle));
            Lens::Perspective(wider.clamp(low, high))
        }
        Lens::Orthographic(height) => Lens::Orthographic(height * libm::pow(DOLLY, -steps)),
    };
    Camera { lens, ..camera }
}

/// Rounds a camera that was moved; `None` if it would see nothing.
pub(super) fn settled(moved: Camera, before: &Camera) -> Option<Camera> {
    let moved = rounded(moved, before);
    let finite = moved.eye.is_finite() && moved.target.is_finite();
    let distance = (moved.eye - moved.target).length();
    (finite && distance.is_finite() && 0.0 < distance).then_some(moved)
}

/// The picture's axes in world space.
struct Axes {
    right: DVec3,
    up: DVec3,
}

impl Axes {
    fn of(camera: &Camera) -> Self {
        let back = (camera.eye - camera.target).normalize_or(DVec3::Z);
        let right = camera.up.cross(back).try_normalize();
        let right = right.unwrap_or_else(|| back.any_orthonormal_vector());
        Self {
            right,
            up: back.cross(right),
        }
    }
}

/// Orbits around the target, in degrees to the left and up.
pub(crate) fn orbited(camera: Camera, left: f64, up: f64) -> Camera {
    let offset = camera.eye - camera.target;
    let distance = offset.length();
    let axis = camera.up.normalize_or(DVec3::Y);
    let height = offset.dot(axis);
    let across = offset - height * axis;
    let level = across
        .try_normalize()
        .unwrap_or_else(|| axis.cross(Axes::of(&camera).right).normalize_or(axis));
    // Rodrigues' rotation of a vector perpendicular to the axis.
    let (sin, cos) = libm::sincos(-left.to_radians());
    let level = cos * level + sin * axis.cross(level);
    let polar = libm::atan2(across.length(), height).to_degrees();
    // A camera that the text places nearer to the pole may stay there.
    let (low, high) = (POLE.min(polar), (180.0 - POLE).max(polar));
    let (sin, cos) = libm::sincos((polar - up).clamp(low, high).to_radians());
    Camera {
        eye: camera.target + distance * (sin * level + cos * axis),
        ..camera
    }
}

/// Turns the camera in place, in degrees to the left and up.
pub(crate) fn turned(camera: Camera, left: f64, up: f64) -> Camera {
    // The target orbits the eye.
    let swapped = |camera: Camera| Camera {
        eye: camera.target,
        target: camera.eye,
        ..camera
    };
    swapped(orbited(swapped(camera), -left, up))
}

/// Moves the camera so that a sphere fills the smaller of the two view angles.
pub(super) fn framed(camera: Camera, centre: DVec3, radius: f64) -> Camera {
    let aspect = f64::from(camera.size.width) / f64::from(camera.size.height) * camera.pixel_aspect;
    let (distance, lens) = match camera.lens {
        Lens::Perspective(angle) => {
            let half = 0.5 * angle.to_radians();
            let half_across = libm::atan(libm::tan(half) * aspect);
            (radius / libm::sin(half.min(half_across)), camera.lens)
        }
        Lens::Orthographic(_) => {
            let height = 2.0 * radius / aspect.min(1.0);
            // Far enough for the whole sphere to be in front of the eye.
            (2.0 * radius, Lens::Orthographic(height))
        }
    };
    let side = (camera.eye - camera.target).normalize_or(DVec3::Z);
    Camera {
        eye: centre + distance * side,
        target: centre,
        lens,
        ..camera
    }
}

/// Rounds changed values to about six digits of the distance to the target, so that a saved view is
/// short and renders exactly the picture that was on screen.
fn rounded(camera: Camera, before: &Camera) -> Camera {
    let distance = (camera.eye - camera.target).length();
    if !distance.is_normal() {
        return camera;
    }
    let places_for = |length: f64| 5 - libm::floor(libm::log10(length)) as i32;
    let round = |point: DVec3, before: DVec3, length: f64| {
        if point == before {
            return before;
        }
        point.map(|number| to_places(number, places_for(length)))
    };
    Camera {
        eye: round(camera.eye, before.eye, distance),
        target: round(camera.target, before.target, distance),
        up: round(camera.up, before.up, camera.up.length()),
        lens: match camera.lens {
            // The text may give it in another form, which rounding would not reproduce.
            lens if lens == before.lens => lens,
            Lens::Perspective(angle) => Lens::Perspective(to_places(angle, 4)),
            Lens::Orthographic(height) => Lens::Orthographic(to_places(height, places_for(height))),
        },
        ..camera
    }
}

/// Rounds to a number of decimal places; negative ones round to tens, hundreds and so on.
fn to_places(number: f64, places: i32) -> f64 {
    let digits = if let Ok(places) = usize::try_from(places) {
        format!("{number:.places$}")
    } else {
        // In exponential form, because a power of ten would itself be rounded.
        let shortest = format!("{number:e}");
        let exponent = shortest.split_once('e').map(|(_, exponent)| exponent);
        let exponent: i32 = exponent.and_then(|e| e.parse().ok()).unwrap_or(0);
        let kept = usize::try_from(exponent + places).unwrap_or(0);
        format!("{number:.kept$e}")
    };
    // Adding 0 turns −0 into 0 and changes nothing else.
    digits.parse().map_or(number, |rounded: f64| rounded + 0.0)
}
