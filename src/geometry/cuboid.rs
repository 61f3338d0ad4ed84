//! Affine images of the cube [0, 1]³.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lanes::Lanes;
use super::line::{Ends, slab};
use super::{Aabb, Affine, Chart, Hit, Ray, Rays, Surface};

/// An affine image of the cube [0, 1]³.
///
/// Parts 2i and 2i + 1 are the faces where coordinate i is 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid(pub Affine);

impl Cuboid {
    /// The tight axis-aligned box: a corner of it is the sum of the edges that point its way.
    pub fn bounds(&self) -> Aabb {
        let origin = self.0.origin();
        let [u, v, w] = self.0.axes();
        let zero = DVec3::ZERO;
        Aabb {
            min: origin + (u.min(zero) + v.min(zero) + w.min(zero)),
            max: origin + (u.max(zero) + v.max(zero) + w.max(zero)),
        }
    }

    /// Where the lines cross the box, in each lane: where they are between all three pairs of faces.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let line = self.0.line(rays);
        slab(line.origin.x, line.direction.x, [0, 1])?
            .overlap(slab(line.origin.y, line.direction.y, [2, 3])?)?
            .overlap(slab(line.origin.z, line.direction.z, [4, 5])?)?
            .after(line.start)
    }

    /// The surface at a hit.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        let place = self.0.place(ray.at(hit.t));
        let axis = (hit.part / 2) as usize % 3;
        let side = f64::from(hit.part % 2);
        let mut outward = DVec3::ZERO;
        outward[axis] = 2.0 * side - 1.0;
        self.0.surface(outward, |margin| {
            let mut on_face = place.max(margin).min(1.0 - margin);
            on_face[axis] = side;
            on_face
        })
    }
    /// The texture coordinates at a hit: the face's two coordinates as fractions of its edges.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, |place| {
            Chart::of_face(place, (hit.part / 2) as usize % 3)
        })
    }
}
