//! Affine images of the unit sphere.

use glam::DVec3;

use super::lanes::{Lanes, Vector};
use super::line::{End, Ends, ball};
use super::transform::normalised;
use super::{Aabb, Affine, Chart, Hit, Ray, Rays, Surfaces};

/// An affine image of the unit sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid(pub Affine);

impl Ellipsoid {
    /// The tight axis-aligned box: its half extents are the lengths of the rows of the
    /// unit-to-world matrix.
    pub fn bounds(&self) -> Aabb {
        let half = self.0.reach_of_disc([0, 1, 2]);
        Aabb {
            min: self.0.origin() - half,
            max: self.0.origin() + half,
        }
    }

    /// Intersects lines with the ellipsoid, in each lane. Its only part is 0.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let line = self.0.line(rays);
        let found = ball(line.origin, line.direction, line.start.all(1.0))?.shifted(line.start)?;
        self.0.clipped(found, rays, || self.bounds())
    }

    /// The surface at a hit, in each lane.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(&self, rays: &Rays<N>, at: End<N>) -> Surfaces<N> {
        let position = normalised(self.0.positions(rays, at.t), Vector::all(at.t, DVec3::Z));
        self.0.surface(
            position,
            #[inline(always)]
            |_| position,
        )
    }

    /// The texture coordinates at a hit: those of the unit sphere.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, Chart::of_ball)
    }
}
