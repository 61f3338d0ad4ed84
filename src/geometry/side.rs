//! The two sides of a surface.

use glam::DVec3;

/// The side of a surface that a ray hits, by the geometric normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The side that the outward normal points to.
    Front,
    /// The inside of a solid.
    Back,
}

impl Side {
    /// The side of a surface with outward `normal` that a ray in `direction` hits.
    #[inline]
    pub fn hit(direction: DVec3, normal: DVec3) -> Self {
        if direction.dot(normal) < 0.0 {
            Self::Front
        } else {
            Self::Back
        }
    }

    /// Turns an outward normal to this side.
    #[inline]
    pub fn turn(self, normal: DVec3) -> DVec3 {
        match self {
            Self::Front => normal,
            Self::Back => -normal,
        }
    }
}
