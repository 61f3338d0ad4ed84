//! Cameras over frames: moved from place to place, or around a point.

use glam::DVec3;

use super::Keys;
use language::schema::Range;
use scene::{Camera, Lens};
use text::Span;

/// How the camera moves over the frames.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraTrack {
    /// Whether its place is given, or its angles around a point.
    pub movement: Movement,
    /// The parameters that it sets. The scene's view has the others.
    pub parameters: Vec<(Parameter, Keys)>,
    /// The place of its table in the track file.
    pub span: Span,
}

/// What gives the place of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Movement {
    /// The eye and the point looked at.
    LookAt,
    /// Angles around the point looked at, and the distance from it.
    Orbit,
}

impl Movement {
    /// The parameters that it has.
    pub const fn parameters(self) -> &'static [Parameter] {
        use Parameter as P;
        match self {
            Self::LookAt => &[P::Eye, P::Target, P::Up, P::Fov, P::Height],
            Self::Orbit => &[
                P::Azimuth,
                P::Elevation,
                P::Distance,
                P::Target,
                P::Up,
                P::Fov,
                P::Height,
            ],
        }
    }
}

/// A parameter of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// Its position.
    Eye,
    /// The point that it looks at.
    Target,
    /// The up direction.
    Up,
    /// The vertical field of view in degrees, of a perspective view.
    Fov,
    /// The height of the visible area, of an orthographic view.
    Height,
    /// The angle in degrees about the axis through the target in the up direction, from where the
    /// scene's view looks; counter-clockwise as seen from above.
    Azimuth,
    /// The angle in degrees above the plane through the target across the up direction.
    Elevation,
    /// The distance from the target.
    Distance,
}

impl Parameter {
    /// The name in a track file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Eye => "eye",
            Self::Target => "target",
            Self::Up => "up",
            Self::Fov => "fov",
            Self::Height => "height",
            Self::Azimuth => "azimuth",
            Self::Elevation => "elevation",
            Self::Distance => "distance",
        }
    }

    /// The number of components.
    pub const fn components(self) -> usize {
        match self {
            Self::Eye | Self::Target | Self::Up => 3,
            Self::Fov | Self::Height | Self::Azimuth | Self::Elevation | Self::Distance => 1,
        }
    }

    /// What a value is, as a noun phrase.
    pub fn expected(self) -> String {
        match self {
            Self::Up => "three numbers that are not all 0, such as [0, 1, 0]".to_owned(),
            Self::Eye | Self::Target => "three numbers, such as [0, 1, 5]".to_owned(),
            _ => self.range().words(),
        }
    }

    /// Whether finite numbers are a value.
    pub fn allows(self, numbers: &[f64]) -> bool {
        let allowed = numbers.iter().all(|&number| self.range().contains(number));
        allowed && (self != Self::Up || numbers.iter().any(|&number| number != 0.0))
    }

    /// Its value in a camera, `base` being that of the scene; `None` if the camera has another kind of
    /// lens. The inverse of [`CameraTrack::at`].
    pub(super) fn of(self, camera: &Camera, base: &Camera) -> Option<Vec<f64>> {
        let axis = camera.up.normalize_or(DVec3::Y);
        let parts = |camera: &Camera| {
            let from = camera.eye - camera.target;
            let rise = from.dot(axis);
            (from, rise, from - rise * axis)
        };
        let (from, rise, across) = parts(camera);
        let number = match (self, camera.lens) {
            (Self::Eye, _) => return Some(camera.eye.to_array().to_vec()),
            (Self::Target, _) => return Some(camera.target.to_array().to_vec()),
            (Self::Up, _) => return Some(camera.up.to_array().to_vec()),
            (Self::Fov, Lens::Perspective(fov)) => fov,
            (Self::Height, Lens::Orthographic(height)) => height,
            (Self::Fov | Self::Height, _) => return None,
            (Self::Distance, _) => from.length(),
            (Self::Elevation, _) => libm::atan2(rise, across.length()).to_degrees(),
            (Self::Azimuth, _) => {
                let (.., start) = parts(base);
                let turned = axis.dot(start.cross(across));
                libm::atan2(turned, start.dot(across)).to_degrees()
            }
        };
        Some(vec![number])
    }

    const fn range(self) -> Range {
        match self {
            Self::Eye | Self::Target | Self::Up | Self::Azimuth => Range::Any,
            Self::Fov => Range::Between(0.0, 180.0),
            Self::Elevation => Range::Between(-90.0, 90.0),
            Self::Height | Self::Distance => Range::Positive,
        }
    }
}

impl CameraTrack {
    /// The camera at a frame; what the track does not set is as in `base`, the camera of the scene.
    pub fn at(&self, frame: u32, base: &Camera) -> Camera {
        let vector = |parameter, otherwise| match self.numbers(parameter, frame)[..] {
            [x, y, z] => DVec3::new(x, y, z),
            _ => otherwise,
        };
        let number = |parameter| self.numbers(parameter, frame).first().copied();
        let target = vector(Parameter::Target, base.target);
        let up = vector(Parameter::Up, base.up);
        let camera = Camera {
            eye: vector(Parameter::Eye, base.eye),
            target,
            up,
            lens: match base.lens {
                Lens::Perspective(fov) => Lens::Perspective(number(Parameter::Fov).unwrap_or(fov)),
                Lens::Orthographic(height) => {
                    Lens::Orthographic(number(Parameter::Height).unwrap_or(height))
                }
            },
            ..*base
        };
        match self.movement {
            Movement::LookAt => camera,
            Movement::Orbit => {
                let distance = number(Parameter::Distance);
                let elevation = number(Parameter::Elevation);
                let from = offset(base, up, distance, elevation);
                let azimuth = number(Parameter::Azimuth).unwrap_or_default();
                let eye = target + from;
                Camera { eye, ..camera }.about_target(azimuth.to_radians())
            }
        }
    }

    /// The camera `base` with numbers that differ from all others where the track sets them.
    pub(super) fn unset(&self, base: &Camera) -> Camera {
        let sets = |wanted: &[Parameter]| {
            let mut own = self.parameters.iter();
            own.any(|(parameter, _)| wanted.contains(parameter))
        };
        let unknown = |is_set, value| if is_set { DVec3::NAN } else { value };
        let moves_eye = self.movement == Movement::Orbit || sets(&[Parameter::Eye]);
        Camera {
            eye: unknown(moves_eye, base.eye),
            target: unknown(sets(&[Parameter::Target]), base.target),
            up: unknown(sets(&[Parameter::Up]), base.up),
            lens: match base.lens {
                Lens::Perspective(_) if sets(&[Parameter::Fov]) => Lens::Perspective(f64::NAN),
                Lens::Orthographic(_) if sets(&[Parameter::Height]) => Lens::Orthographic(f64::NAN),
                lens => lens,
            },
            ..*base
        }
    }

    /// The numbers of a parameter at a frame; none if the track does not set it.
    fn numbers(&self, wanted: Parameter, frame: u32) -> Vec<f64> {
        let mut parameters = self.parameters.iter();
        let set = parameters.find(|(parameter, _)| *parameter == wanted);
        set.map(|(_, keys)| keys.numbers_at(frame))
            .unwrap_or_default()
    }
}

/// Where an orbiting camera begins, from its target: as in `base` unless its distance or elevation,
/// in degrees, is given.
fn offset(base: &Camera, up: DVec3, distance: Option<f64>, elevation: Option<f64>) -> DVec3 {
    let from = base.eye - base.target;
    if distance.is_none() && elevation.is_none() {
        return from;
    }
    let axis = up.normalize_or(DVec3::Y);
    let rise = from.dot(axis);
    let across = from - rise * axis;
    let elevation = elevation.map_or_else(|| libm::atan2(rise, across.length()), f64::to_radians);
    let forward = across.normalize_or(axis.any_orthonormal_vector());
    let direction = libm::cos(elevation) * forward + libm::sin(elevation) * axis;
    distance.unwrap_or_else(|| from.length()) * direction
}
