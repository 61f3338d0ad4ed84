//! Texture coordinates of hits.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

/// Texture coordinates at a point, and their gradients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chart {
    /// The coordinates u and v.
    pub uv: DVec2,
    /// The world gradients of u and v as functions of space; only their tangential parts are
    /// meaningful. At a pole, where u is undefined, its gradient is 0.
    pub gradients: [DVec3; 2],
}

impl Chart {
    /// Longitude and latitude around the origin: u = atan2(y, x) / 2π + ½, v = asin(z / r) / π + ½
    /// at distance r.
    pub(super) fn of_ball(position: DVec3) -> Self {
        let DVec3 { x, y, z } = position;
        let radius = DVec2::new(x, y).length();
        let square = position.length_squared();
        let meridian = if radius == 0.0 {
            DVec2::X
        } else {
            DVec2::new(x, y) / radius
        };
        let rise = DVec3::new(-z * meridian.x, -z * meridian.y, radius) / (PI * square);
        let (u, around) = longitude(position);
        Self {
            uv: DVec2::new(u, libm::atan2(z, radius) / PI + 0.5),
            gradients: [around, if square == 0.0 { DVec3::ZERO } else { rise }],
        }
    }

    /// u is the longitude around the z axis, v = z.
    pub(super) fn of_side(position: DVec3) -> Self {
        let (u, around) = longitude(position);
        Self {
            uv: DVec2::new(u, position.z),
            gradients: [around, DVec3::Z],
        }
    }

    /// The bounding square of the unit disc, mapped to [0, 1]².
    pub(super) fn of_disc(position: DVec3) -> Self {
        Self {
            uv: 0.5 * (DVec2::new(position.x, position.y) + 1.0),
            gradients: [0.5 * DVec3::X, 0.5 * DVec3::Y],
        }
    }

    /// The two coordinates other than `axis`, in order.
    pub(super) fn of_face(position: DVec3, axis: usize) -> Self {
        let (u, v) = match axis {
            0 => (1, 2),
            1 => (0, 2),
            _ => (0, 1),
        };
        Self {
            uv: DVec2::new(position[u], position[v]),
            gradients: [DVec3::AXES[u], DVec3::AXES[v]],
        }
    }

    /// Transforms the gradients to another space.
    pub(super) fn with_gradients(self, to: impl Fn(DVec3) -> DVec3) -> Self {
        Self {
            gradients: self.gradients.map(to),
            ..self
        }
    }
}

/// Returns atan2(y, x) / 2π + ½ and its gradient.
fn longitude(position: DVec3) -> (f64, DVec3) {
    let DVec3 { x, y, .. } = position;
    let square = x * x + y * y;
    let around = if square == 0.0 {
        DVec3::ZERO
    } else {
        DVec3::new(-y, x, 0.0) / (TAU * square)
    };
    (libm::atan2(y, x) / TAU + 0.5, around)
}
