//! Points on surfaces, single or one per lane.

use glam::DVec3;

use super::lanes::{Eight, Lanes, Row, Simd, Vector};

/// A point on a surface, as exact as `f64` allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// The point, re-projected onto the surface.
    pub point: DVec3,
    /// The outward geometric normal, of unit length.
    pub normal: DVec3,
    /// The shading normal, of unit length: the geometric one except on a mesh with vertex normals.
    pub shading: DVec3,
    /// The largest magnitude in the computation of the point (coordinates of the shape's origin,
    /// its size), times the cancellation of a skewed frame. A few [`ulp`]s of it bound the distance
    /// of the point from the surface.
    pub scale: f64,
}

/// The distance from the surface at which a leaving ray starts, in [`ulp`]s of its scale.
///
/// Rounding the point costs one, mapping it into the shape's frame again a few more. Of the five
/// million rays of the tests, thousands hit their own surface from 1 and none from 2; 16 leaves a
/// factor of eight for frames the tests do not cover, and is still far below any visible distance.
pub(super) const CLEARANCE: f64 = 16.0;

impl Surface {
    /// The start of a ray that leaves the surface toward `direction`: the point moved off the
    /// surface by a few ulps of `scale`, to the side the direction points to.
    #[inline(always)]
    pub fn leave(&self, direction: DVec3) -> DVec3 {
        Surfaces::from(*self).leave(direction.into()).into()
    }
}

/// The ulp of a finite number: see [`Lanes::ulp`].
#[inline(always)]
pub fn ulp(x: f64) -> f64 {
    Lanes::ulp(x)
}

/// A point on a surface in each lane, without a shading normal: see [`Surface`].
#[derive(Clone, Copy, Debug)]
pub struct Surfaces<N> {
    /// The points.
    pub point: Vector<N>,
    /// The outward normals, of unit length.
    pub normal: Vector<N>,
    /// See [`Surface::scale`].
    pub scale: N,
}

/// Points on surfaces with their shading normals, in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Shaded<N> {
    /// The points.
    pub surface: Surfaces<N>,
    /// See [`Surface::shading`].
    pub shading: Vector<N>,
}

impl<N: Copy> From<Surfaces<N>> for Shaded<N> {
    #[inline(always)]
    fn from(surface: Surfaces<N>) -> Self {
        Self {
            shading: surface.normal,
            surface,
        }
    }
}

impl From<Shaded<f64>> for Surface {
    #[inline(always)]
    fn from(Shaded { surface, shading }: Shaded<f64>) -> Self {
        Self {
            shading: shading.into(),
            ..surface.into()
        }
    }
}

impl<N: Lanes> Surfaces<N> {
    /// The starts of leaving rays: see [`Surface::leave`].
    #[inline(always)]
    pub fn leave(&self, direction: Vector<N>) -> Vector<N> {
        let clearance = self.scale.all(CLEARANCE) * self.scale.ulp();
        let step = self.normal.scaled(clearance);
        let inward = direction.dot(self.normal).below(self.scale.all(0.0));
        Vector::select(inward, self.point - step, self.point + step)
    }
}

impl<S: Simd> Surfaces<Eight<S>> {
    /// Selects `yes` in the lanes where the mask is true, `no` in the others.
    #[must_use]
    #[inline(always)]
    pub fn select(mask: <Eight<S> as Lanes>::Mask, yes: Self, no: Self) -> Self {
        Self {
            point: Vector::select(mask, yes.point, no.point),
            normal: Vector::select(mask, yes.normal, no.normal),
            scale: Lanes::select(mask, yes.scale, no.scale),
        }
    }

    /// Stores the surfaces in memory.
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
    /// Loads the surfaces into SIMD vectors.
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
