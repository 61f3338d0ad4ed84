//! Axis-aligned boxes.

use glam::DVec3;

/// An axis-aligned box, closed. Empty when a minimum exceeds its maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The least coordinates.
    pub min: DVec3,
    /// The greatest coordinates.
    pub max: DVec3,
}

impl Aabb {
    /// The box that holds nothing and changes no union.
    pub const EMPTY: Self = Self {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    /// The smallest box around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// The centre.
    pub fn centre(self) -> DVec3 {
        0.5 * self.min + 0.5 * self.max
    }

    /// Edge lengths.
    pub fn size(self) -> DVec3 {
        self.max - self.min
    }

    /// Whether it holds no point.
    pub fn is_empty(self) -> bool {
        !self.min.cmple(self.max).all()
    }
}
