//! Axis-aligned boxes.

use glam::DVec3;

/// A closed axis-aligned box, empty if a minimum exceeds its maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Minimum corner.
    pub min: DVec3,
    /// Maximum corner.
    pub max: DVec3,
}

impl Aabb {
    /// The empty box, neutral under union.
    pub const EMPTY: Self = Self {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    /// The smallest box that contains both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// The overlap of both, or [`Self::EMPTY`].
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        let overlap = Self {
            min: self.min.max(other.min),
            max: self.max.min(other.max),
        };
        // An inverted box would grow a union.
        if overlap.is_empty() {
            Self::EMPTY
        } else {
            overlap
        }
    }

    /// The centre; 0 along an axis that is unbounded on both sides.
    pub fn centre(self) -> DVec3 {
        let centre = 0.5 * self.min + 0.5 * self.max;
        DVec3::select(centre.is_nan_mask(), DVec3::ZERO, centre)
    }

    /// The lengths of the edges.
    pub fn size(self) -> DVec3 {
        self.max - self.min
    }

    /// The radius of the sphere through the corners; infinite if an edge is.
    pub fn half_diagonal(self) -> f64 {
        let size = self.size();
        let longest = size.max_element();
        if longest <= 0.0 || longest == f64::INFINITY {
            return longest;
        }
        // Scaled if a square might overflow or underflow.
        let scale = if (1e-100..1e100).contains(&longest) {
            1.0
        } else {
            longest
        };
        0.5 * scale * (size / scale).length()
    }

    /// The largest magnitude of a finite coordinate; 0 if no coordinate is finite.
    pub fn magnitude(self) -> f64 {
        let sizes = [self.min, self.max].map(|corner| corner.abs().to_array());
        let finite = sizes.into_iter().flatten().filter(|size| size.is_finite());
        finite.fold(0.0, f64::max)
    }

    /// Whether the box contains no point.
    pub fn is_empty(self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Whether all sides are finite; false for [`Self::EMPTY`].
    pub fn is_bounded(self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }
}
