//! Points that rays hit.

use glam::DVec3;

use geometry::{Ray, Side, Surface};

/// A point hit by a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) surface: Surface,
    /// Shading normal including bumps, flipped on back faces.
    pub(crate) normal: DVec3,
    pub(crate) side: Side,
    /// Unit vector toward the origin of the ray.
    pub(crate) view: DVec3,
}

impl Point {
    /// Starts a ray from this point.
    pub(crate) fn leave(&self, direction: DVec3) -> Ray {
        Ray {
            origin: self.surface.leave(direction),
            direction,
        }
    }
}
