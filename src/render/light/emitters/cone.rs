//! Where emitters shine to: cones of directions.

use std::f64::consts::PI;

use glam::DVec3;

use crate::sampling::warp;
use geometry::Aabb;

/// Where an emitter is, where it shines to and how much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    pub(crate) bounds: Aabb,
    pub(crate) cone: Cone,
    /// Radiant intensity at its brightest, as a weight.
    pub(crate) strength: f64,
}

/// A cone that contains the normals of emitters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cone {
    /// Its axis, of unit length.
    pub(crate) axis: DVec3,
    /// The cosine of its half angle; −1 contains all directions.
    pub(crate) cosine: f64,
    /// Whether the emitters shine to the opposite side as well.
    pub(crate) is_two_sided: bool,
}

impl Cone {
    /// All directions.
    pub(crate) const ALL: Self = Self {
        axis: DVec3::Z,
        cosine: -1.0,
        is_two_sided: false,
    };

    /// A single direction.
    pub(crate) fn around(axis: DVec3) -> Self {
        Self {
            axis,
            cosine: 1.0,
            is_two_sided: false,
        }
    }

    /// The same with the opposite directions.
    pub(crate) fn two_sided(self) -> Self {
        Self {
            is_two_sided: true,
            ..self
        }
    }

    /// A cone that contains both, the smallest unless one shines to both sides.
    pub(crate) fn union(&self, other: &Self) -> Self {
        let is_two_sided = self.is_two_sided || other.is_two_sided;
        let mut axis = other.axis;
        // Which of two opposite normals counts is open.
        if other.is_two_sided && self.axis.dot(axis) < 0.0 {
            axis = -axis;
        }
        let angles = [self.cosine, other.cosine].map(half_angle);
        let [own, its] = angles;
        let cosine = self.axis.dot(axis);
        let between = half_angle(cosine);
        if between + its <= own {
            return Self {
                is_two_sided,
                ..*self
            };
        }
        if between + own <= its {
            return Self {
                axis,
                cosine: other.cosine,
                is_two_sided,
            };
        }
        let angle = 0.5 * (own + between + its);
        if PI <= angle {
            return Self {
                is_two_sided,
                ..Self::ALL
            };
        }
        let aside = axis - cosine * self.axis;
        let aside = aside
            .try_normalize()
            .unwrap_or_else(|| warp::basis(self.axis)[0]);
        let (sine, cosine) = libm::sincos(angle - own);
        let turned = (cosine * self.axis + sine * aside).normalize();
        // Rounding must not leave a normal outside.
        let (_, cosine) = libm::sincos((angle + 1e-7).min(PI));
        Self {
            axis: turned,
            cosine,
            is_two_sided,
        }
    }
}

fn half_angle(cosine: f64) -> f64 {
    libm::acos(cosine.clamp(-1.0, 1.0))
}
