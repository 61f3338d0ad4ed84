//! Affine images of a square, a surface that bounds no solid.

use glam::DVec3;

use super::line::Ends;
use super::{Aabb, Affine, Chart, Hit, Ray, Surface};

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

    /// The hit with 0 < t < `limit`. The square's only part is 0.
    #[inline]
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        let line = self.0.line(&ray.into());
        let t = -line.origin.z / line.direction.z;
        let position = DVec3::from(line.origin) + t * DVec3::from(line.direction);
        let inside = position.x.abs() <= 1.0 && position.y.abs() <= 1.0;
        let found = Ends::between(t, t, 0, inside).shifted(line.start)?;
        let found = self.0.clipped(found, &ray.into(), || self.bounds())?;
        let (end, hit) = found.nearest(limit);
        hit.then_some(end.into())
    }

    /// The surface at a hit.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        let position = self.0.position(ray.at(hit.t)).with_z(0.0);
        self.0.surface(DVec3::Z.into(), |_| position.into()).into()
    }

    /// The texture coordinates at a hit: from 0, 0 at the corner (−1, −1) to 1, 1 at (1, 1).
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, Chart::of_disc)
    }
}
