//! Affine images of a square, a surface that bounds no solid.

use glam::DVec3;

use super::lanes::{Lanes, Vector};
use super::line::{End, Ends};
use super::{Aabb, Affine, Chart, Hit, Ray, Rays, Surfaces};

/// An affine image of the square −1 ≤ x, y ≤ 1 at z = 0, with the normal of +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane(pub Affine);

impl Plane {
    /// The tight axis-aligned box.
    pub fn bounds(&self) -> Aabb {
        let [x, y, _] = self.0.axes();
        let half = x.abs() + y.abs();
        Aabb {
            min: self.0.origin() - half,
            max: self.0.origin() + half,
        }
    }

    /// Intersects lines with the square, in each lane; they enter where they leave. Its only part is 0.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let line = self.0.line(rays);
        let t = -line.origin.z / line.direction.z;
        let position = line.origin + line.direction.scaled(t);
        let one = t.all(1.0);
        let inside = position.x.abs().up_to(one) & position.y.abs().up_to(one);
        let found = Ends::between(t, t, 0, inside).shifted(line.start)?;
        self.0.clipped(found, rays, || self.bounds())
    }

    /// The surface at a hit, in each lane.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(&self, rays: &Rays<N>, at: End<N>) -> Surfaces<N> {
        let position = self.0.positions(rays, at.t).flat();
        self.0.surface(
            Vector::all(at.t, DVec3::Z),
            #[inline(always)]
            |_| position,
        )
    }

    /// The texture coordinates at a hit: from 0, 0 at the corner (−1, −1) to 1, 1 at (1, 1).
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, Chart::of_disc)
    }
}
