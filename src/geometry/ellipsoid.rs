//! Affine images of the unit sphere.

use glam::DVec3;

use super::line::ball;
use super::transform::normalise;
use super::{Aabb, Affine, Chart, Crossings, Hit, Ray, Surface};

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

    /// Where the ray's line crosses the ellipsoid. Its only part is 0.
    #[inline]
    pub fn crossings(&self, ray: &Ray) -> Option<Crossings> {
        let line = self.0.line(ray);
        let [enter, exit] = ball(line.origin, line.direction, 1.0)?;
        Crossings {
            enter: Hit { t: enter, part: 0 },
            exit: Hit { t: exit, part: 0 },
        }
        .after(line.start)
    }

    /// The surface at a hit.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        let place = normalise(self.0.place(ray.at(hit.t))).unwrap_or(DVec3::Z);
        self.0.surface(place, |_| place)
    }

    /// The texture coordinates at a hit: those of the unit sphere.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, Chart::of_ball)
    }
}
