//! Texture coordinates: where on its own surface a solid was hit.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

/// Texture coordinates at a point, and how they change around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chart {
    /// u and v.
    pub uv: DVec2,
    /// The gradients of u and v in the world, as functions of space; only what is tangential to the
    /// surface means something. At a pole, where u has every value, its gradient is 0.
    pub gradients: [DVec3; 2],
}

impl Chart {
    /// Longitude and latitude of a place as seen from the centre of a sphere:
    /// u = atan2(y, x) / 2π + ½, v = asin(z) / π + ½ at distance 1, and the same along a radius.
    pub(super) fn of_ball(place: DVec3) -> Self {
        let DVec3 { x, y, z } = place;
        let radius = DVec2::new(x, y).length();
        let square = place.length_squared();
        let meridian = if radius == 0.0 {
            DVec2::X
        } else {
            DVec2::new(x, y) / radius
        };
        let rise = DVec3::new(-z * meridian.x, -z * meridian.y, radius) / (PI * square);
        let (u, around) = longitude(place);
        Self {
            uv: DVec2::new(u, libm::atan2(z, radius) / PI + 0.5),
            gradients: [around, if square == 0.0 { DVec3::ZERO } else { rise }],
        }
    }

    /// Around the z axis and along it, from z = 0 to z = 1.
    pub(super) fn of_side(place: DVec3) -> Self {
        let (u, around) = longitude(place);
        Self {
            uv: DVec2::new(u, place.z),
            gradients: [around, DVec3::Z],
        }
    }

    /// The unit disc's bounding square.
    pub(super) fn of_disc(place: DVec3) -> Self {
        Self {
            uv: 0.5 * (DVec2::new(place.x, place.y) + 1.0),
            gradients: [0.5 * DVec3::X, 0.5 * DVec3::Y],
        }
    }

    /// The two coordinates other than this axis, in their order.
    pub(super) fn of_face(place: DVec3, axis: usize) -> Self {
        let (u, v) = match axis {
            0 => (1, 2),
            1 => (0, 2),
            _ => (0, 1),
        };
        Self {
            uv: DVec2::new(place[u], place[v]),
            gradients: [DVec3::AXES[u], DVec3::AXES[v]],
        }
    }

    /// The same with gradients taken to another space.
    pub(super) fn with_gradients(self, to: impl Fn(DVec3) -> DVec3) -> Self {
        Self {
            gradients: self.gradients.map(to),
            ..self
        }
    }
}

/// atan2(y, x) / 2π + ½ and its gradient.
fn longitude(place: DVec3) -> (f64, DVec3) {
    let DVec3 { x, y, .. } = place;
    let square = x * x + y * y;
    let around = if square == 0.0 {
        DVec3::ZERO
    } else {
        DVec3::new(-y, x, 0.0) / (TAU * square)
    };
    (libm::atan2(y, x) / TAU + 0.5, around)
}
