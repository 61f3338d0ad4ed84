//! Points on surfaces, alone and side by side.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lanes::{Eight, Lanes, Row, Simd, Vector};

/// A point on a surface, as exact as `f64` holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// The point, re-projected onto the surface.
    pub point: DVec3,
    /// The outward geometric normal, of unit length.
    pub normal: DVec3,
    /// The normal that light is computed with, of unit length: the geometric one, but on a mesh
    /// with normals of its own.
    pub shading: DVec3,
    /// The largest magnitude that entered the computation of the point (coordinates of the shape's
    /// origin, its size), times the cancellation of a skewed frame: a few [`ulp`] of it bound how
    /// far from the surface the point is.
    pub scale: f64,
}

/// How many [`ulp`] of its scale a ray starts off the surface it leaves.
///
/// Rounding the point costs one, taking it into the shape's frame again a few more. Of the five
/// million rays of the tests thousands come back from 1 and none from 2; 16 has a factor of eight
/// in hand for frames that those do not meet, and is still far below any distance that shows.
pub(super) const CLEARANCE: f64 = 16.0;

impl Surface {
    /// The start of a ray that leaves the surface toward `direction`: moved off it by a few units
    /// in the last place of `scale`, to the side the direction points to.
    #[inline(always)]
    pub fn leave(&self, direction: DVec3) -> DVec3 {
        Surfaces::from(*self).leave(direction.into()).into()
    }
}

/// The unit in the last place of a finite number: see [`Lanes::ulp`].
#[inline(always)]
pub fn ulp(x: f64) -> f64 {
    Lanes::ulp(x)
}

/// A point on a surface in each lane: see [`Surface`]. Light is computed with the geometric normal.
#[derive(Clone, Copy, Debug)]
pub struct Surfaces<N> {
    /// The points.
    pub point: Vector<N>,
    /// The outward normals.
    pub normal: Vector<N>,
    /// The largest magnitudes that entered the computation.
    pub scale: N,
}

impl<N: Lanes> Surfaces<N> {
    /// The starts of rays: see [`Surface::leave`].
    #[inline(always)]
    pub fn leave(&self, direction: Vector<N>) -> Vector<N> {
        let clearance = self.scale.all(CLEARANCE) * self.scale.ulp();
        let step = self.normal.scaled(clearance);
        let inward = direction.dot(self.normal).below(self.scale.all(0.0));
        Vector::select(inward, self.point - step, self.point + step)
    }
}

impl<S: Simd> Surfaces<Eight<S>> {
    /// The one where the mask is true, the other where it is not.
    #[must_use]
    #[inline(always)]
    pub fn select(mask: <Eight<S> as Lanes>::Mask, yes: Self, no: Self) -> Self {
        Self {
            point: Vector::select(mask, yes.point, no.point),
            normal: Vector::select(mask, yes.normal, no.normal),
            scale: Lanes::select(mask, yes.scale, no.scale),
        }
    }

    /// Those, as they lie in memory.
    #[inline(always)]
    pub fn store(self) -> Surfaces<Row> {
        Surfaces {
            point: self.point.store(),
            normal: self.normal.store(),
            scale: self.scale.into(),
        }
    }
}

impl Surfaces<Row> {
    /// Those, in vectors.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S) -> Surfaces<Eight<S>> {
        Surfaces {
            point: self.point.load(simd),
            normal: self.normal.load(simd),
            scale: self.scale.load(simd),
        }
    }
}

impl From<Surface> for Surfaces<f64> {
    #[inline(always)]
    fn from(surface: Surface) -> Self {
        Self {
            point: surface.point.into(),
            normal: surface.normal.into(),
            scale: surface.scale,
        }
    }
}

impl From<Surfaces<f64>> for Surface {
    #[inline(always)]
    fn from(surface: Surfaces<f64>) -> Self {
        let normal = surface.normal.into();
        Self {
            point: surface.point.into(),
            normal,
            shading: normal,
            scale: surface.scale,
        }
    }
}
