//! Spheres. They stay in world space, where every ray has unit speed; see [`ball`] for the
//! formula.

use glam::DVec3;

use super::line::{approach, ball};
use super::transform::normalise;
use super::{Aabb, Chart, Crossings, Hit, Ray, Surface};

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub centre: DVec3,
    /// Its radius, above 0.
    pub radius: f64,
}

impl Sphere {
    /// The tight axis-aligned box.
    pub fn bounds(&self) -> Aabb {
        Aabb {
            min: self.centre - self.radius,
            max: self.centre + self.radius,
        }
    }

    /// Where the ray's line crosses the sphere. Its only part is 0.
    #[inline]
    pub fn crossings(&self, ray: &Ray) -> Option<Crossings> {
        let (place, start) = approach(ray.origin - self.centre, ray.direction, self.radius);
        let [enter, exit] = ball(place, ray.direction, self.radius)?;
        Crossings {
            enter: Hit { t: enter, part: 0 },
            exit: Hit { t: exit, part: 0 },
        }
        .after(start)
    }

    /// The surface at a hit.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        let normal = normalise(ray.at(hit.t) - self.centre).unwrap_or(DVec3::Z);
        Surface {
            point: self.centre + self.radius * normal,
            normal,
            shading: normal,
            scale: self.centre.abs().max_element().max(self.radius),
        }
    }

    /// The texture coordinates at a hit.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        Chart::of_ball((ray.at(hit.t) - self.centre) / self.radius)
            .with_gradients(|gradient| gradient / self.radius)
    }
}
