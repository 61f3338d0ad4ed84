//! Affine images of the unit sphere.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lanes::Lanes;
use super::line::{End, Ends, ball};
use super::transform::normalised;
use super::{Aabb, Affine, Chart, Hit, Ray, Rays, Surfaces};

/// An affine image of the unit sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid(pub Affine);

impl Ellipsoid {
    /// The tight axis-aligned box: along each world axis, the length of that row of the matrix that
    /// takes the unit sphere to the world.
    pub fn bounds(&self) -> Aabb {
        let half = self.0.reach_of_disc([0, 1, 2]);
        Aabb {
            min: self.0.origin() - half,
            max: self.0.origin() + half,
        }
    }

    /// Where the lines cross the ellipsoid, in each lane. Its only part is 0.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let line = self.0.line(rays);
        let found = ball(line.origin, line.direction, line.start.all(1.0))?.after(line.start)?;
        self.0.clipped(found, rays, || self.bounds())
    }

    /// The surfaces at hits, in each lane.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(&self, rays: &Rays<N>, at: End<N>) -> Surfaces<N> {
        let place = normalised(self.0.places(rays, at.t), DVec3::Z);
        self.0.surface(
            place,
            #[inline(always)]
            |_| place,
        )
    }

    /// The texture coordinates at a hit: those of the unit sphere.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, Chart::of_ball)
    }
}
