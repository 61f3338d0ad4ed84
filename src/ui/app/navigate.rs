//! Moving the camera: all of it changes the working view, none of it the text.

use glam::DVec3;

use super::App;
use crate::language::Node;
use crate::scene::{Camera, Lens};

/// How far one step orbits, in degrees.
const ORBIT: f64 = 5.0;
/// How far one step pans, as a share of the distance to the target.
const PAN: f64 = 0.05;
/// How much of the distance one step nearer leaves.
const DOLLY: f64 = 0.9;
/// How much one step widens the angle of view, in degrees.
const WIDEN: f64 = 2.0;
/// The least angle between the view's direction and `up`, in degrees.
const POLE: f64 = 1.0;
/// Bounds of the angle of view, in degrees, that keys keep to.
const ANGLES: (f64, f64) = (1.0, 170.0);

impl App {
    /// Makes a camera the working view, or drops it where it is the text's own.
    pub(super) fn set_view(&mut self, camera: Camera) {
        let own = self.scene.as_ref().map(|scene| scene.camera);
        let camera = Some(camera).filter(|camera| Some(*camera) != own);
        if camera != self.view {
            self.view = camera;
            self.pending.scene = true;
        }
    }

    /// Applies a move, unless it leads to a camera that sees nothing.
    fn move_camera(&mut self, change: impl FnOnce(Camera) -> Camera) {
        let Some(camera) = self.camera() else {
            return;
        };
        let moved = rounded(change(camera), &camera);
        let finite = moved.eye.is_finite() && moved.target.is_finite();
        let distance = (moved.eye - moved.target).length();
        if finite && distance.is_finite() && 0.0 < distance {
            self.set_view(moved);
        } else {
            self.fail("the camera can go no further");
        }
    }

    pub(super) fn orbit_steps(&mut self, left: i8, up: i8) {
        self.orbit(f64::from(left) * ORBIT, f64::from(up) * ORBIT);
    }

    /// Turns the camera around its target, in degrees: to the left and up.
    pub(super) fn orbit(&mut self, left: f64, up: f64) {
        self.move_camera(|camera| orbited(camera, left, up));
    }

    pub(super) fn pan(&mut self, left: i8, up: i8) {
        self.move_camera(|camera| {
            let offset = camera.eye - camera.target;
            let axes = Axes::of(&camera);
            let shift =
                offset.length() * PAN * (f64::from(up) * axes.up - f64::from(left) * axes.right);
            Camera {
                eye: camera.eye + shift,
                target: camera.target + shift,
                ..camera
            }
        });
    }

    pub(super) fn dolly(&mut self, steps: i8) {
        let share = libm::pow(DOLLY, f64::from(steps));
        self.move_camera(|camera| Camera {
            eye: camera.target + share * (camera.eye - camera.target),
            lens: match camera.lens {
                // Side by side, rays see the same from anywhere: the picture itself is enlarged.
                Lens::Orthographic(height) => Lens::Orthographic(share * height),
                lens @ Lens::Perspective(_) => lens,
            },
            ..camera
        });
    }

    pub(super) fn widen(&mut self, steps: i8) {
        self.move_camera(|camera| {
            let lens = match camera.lens {
                Lens::Perspective(angle) => {
                    let wider = angle + f64::from(steps) * WIDEN;
                    // An angle beyond the bounds that the text says is not forced back by a step.
                    let (low, high) = (ANGLES.0.min(angle), ANGLES.1.max(angle));
                    Lens::Perspective(wider.clamp(low, high))
                }
                Lens::Orthographic(height) => {
                    Lens::Orthographic(height * libm::pow(DOLLY, -f64::from(steps)))
                }
            };
            Camera { lens, ..camera }
        });
    }

    pub(super) fn reset_view(&mut self) {
        if self.view.take().is_some() {
            self.pending.scene = true;
        }
    }

    /// Looks at the selected object, or at everything, from the same side.
    pub(super) fn frame_selected(&mut self) {
        let Some(scene) = self.scene.clone() else {
            return;
        };
        let bounds = match self.selected {
            Node::Object(index) => {
                let drawn = self.source().drawn(index);
                let object = drawn.and_then(|at| scene.objects.get(at as usize));
                let bounds = object.map(|object| object.shape.bounds());
                bounds.filter(|bounds| bounds.is_bounded() && !bounds.is_empty())
            }
            _ => None,
        };
        let bounds = bounds.unwrap_or_else(|| scene.bounds());
        if bounds.is_empty() {
            self.say("there is nothing to look at");
            return;
        }
        let (centre, radius) = (bounds.centre(), bounds.half_diagonal());
        self.move_camera(|camera| framed(camera, centre, radius));
    }

    /// Writes the working view into the text, as an edit like any other.
    pub(super) fn save_view(&mut self) {
        let (Some(view), Some(scene)) = (self.view, self.scene.clone()) else {
            self.say("the view is the scene's own");
            return;
        };
        if 0 < self.error_count() {
            self.fail("the view can't be written while the scene has errors");
            return;
        }
        self.document.end_step();
        match self.write_camera(&view, &scene.camera) {
            Ok(()) => {
                self.view = None;
                self.say("the view is in the scene's text now");
            }
            Err(refused) => self.fail(refused.message),
        }
        self.document.end_step();
    }
}

/// The picture's directions in the world.
struct Axes {
    right: DVec3,
    up: DVec3,
}

impl Axes {
    fn of(camera: &Camera) -> Self {
        let back = (camera.eye - camera.target).normalize_or(DVec3::Z);
        let right = camera.up.cross(back);
        let right = right.try_normalize();
        let right = right.unwrap_or_else(|| back.any_orthonormal_vector());
        Self {
            right,
            up: back.cross(right),
        }
    }
}

fn orbited(camera: Camera, left: f64, up: f64) -> Camera {
    let offset = camera.eye - camera.target;
    let distance = offset.length();
    let axis = camera.up.normalize_or(DVec3::Y);
    let height = offset.dot(axis);
    let across = offset - height * axis;
    let level = across
        .try_normalize()
        .unwrap_or_else(|| axis.cross(Axes::of(&camera).right).normalize_or(axis));
    // Rodrigues' rotation of a vector across the axis.
    let (sin, cos) = libm::sincos(-left.to_radians());
    let level = cos * level + sin * axis.cross(level);
    let polar = libm::atan2(across.length(), height).to_degrees();
    // A camera that the text has put nearer to the pole may stay there.
    let (low, high) = (POLE.min(polar), (180.0 - POLE).max(polar));
    let (sin, cos) = libm::sincos((polar - up).clamp(low, high).to_radians());
    Camera {
        eye: camera.target + distance * (sin * level + cos * axis),
        ..camera
    }
}

/// The camera from which a sphere fills the smaller angle of view.
fn framed(camera: Camera, centre: DVec3, radius: f64) -> Camera {
    let aspect = f64::from(camera.size.width) / f64::from(camera.size.height) * camera.pixel_aspect;
    let (distance, lens) = match camera.lens {
        Lens::Perspective(angle) => {
            let half = 0.5 * angle.to_radians();
            let half_across = libm::atan(libm::tan(half) * aspect);
            (radius / libm::sin(half.min(half_across)), camera.lens)
        }
        Lens::Orthographic(_) => {
            let height = 2.0 * radius / aspect.min(1.0);
            // Far enough for all of it to be before the eye.
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

/// Rounds what is not as before to about six digits of the distance to the target: a saved view is
/// short to read, and the picture of it the very one that was on screen.
fn rounded(camera: Camera, before: &Camera) -> Camera {
    let distance = (camera.eye - camera.target).length();
    if !distance.is_normal() {
        return camera;
    }
    let places = 5 - libm::floor(libm::log10(distance)) as i32;
    let round = |point: DVec3, before: DVec3| {
        if point == before {
            return before;
        }
        DVec3::from_array(point.to_array().map(|n| to_places(n, places)))
    };
    Camera {
        eye: round(camera.eye, before.eye),
        target: round(camera.target, before.target),
        lens: match camera.lens {
            // The text may say it by other numbers, of which these are not the rounded ones.
            lens if lens == before.lens => lens,
            Lens::Perspective(angle) => Lens::Perspective(to_places(angle, 4)),
            Lens::Orthographic(height) => {
                let places = 5 - libm::floor(libm::log10(height)) as i32;
                Lens::Orthographic(to_places(height, places))
            }
        },
        ..camera
    }
}

/// Rounds to decimal places; a negative number of them to tens, hundreds and so on.
fn to_places(number: f64, places: i32) -> f64 {
    let digits = if let Ok(places) = usize::try_from(places) {
        format!("{number:.places$}")
    } else {
        // From its shortest form: a power of ten would be rounded itself.
        let shortest = format!("{number:e}");
        let exponent = shortest.split_once('e').map(|(_, exponent)| exponent);
        let exponent: i32 = exponent.and_then(|e| e.parse().ok()).unwrap_or(0);
        let kept = usize::try_from(exponent + places).unwrap_or(0);
        format!("{number:.kept$e}")
    };
    // The sum with 0 is the same number, and 0 for −0.
    digits.parse().map_or(number, |rounded: f64| rounded + 0.0)
}
