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

    /// The largest box in both.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        let overlap = Self {
            min: self.min.max(other.min),
            max: self.max.min(other.max),
        };
        // An inside-out box would grow a union.
        if overlap.is_empty() {
            Self::EMPTY
        } else {
            overlap
        }
    }

    /// The centre; 0 along an axis without ends.
    pub fn centre(self) -> DVec3 {
        let centre = 0.5 * self.min + 0.5 * self.max;
        DVec3::select(centre.is_nan_mask(), DVec3::ZERO, centre)
    }

    /// Edge lengths.
    pub fn size(self) -> DVec3 {
        self.max - self.min
    }

    /// The radius of the sphere through its corners: infinite where a length is.
    pub fn half_diagonal(self) -> f64 {
        let size = self.size();
        let longest = size.max_element();
        if longest <= 0.0 || longest == f64::INFINITY {
            return longest;
        }
        // Scaled where a square might overflow or vanish.
        let scale = if (1e-100..1e100).contains(&longest) {
            1.0
        } else {
            longest
        };
        0.5 * scale * (size / scale).length()
    }

    /// The largest magnitude of a finite coordinate; 0 if there is none.
    pub fn magnitude(self) -> f64 {
        let sizes = [self.min, self.max].map(|corner| corner.abs().to_array());
        let finite = sizes.into_iter().flatten().filter(|size| size.is_finite());
        finite.fold(0.0, f64::max)
    }

    /// Whether it holds no point.
    pub fn is_empty(self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Whether it ends on every side; an empty box does not.
    pub fn is_bounded(self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }
}
