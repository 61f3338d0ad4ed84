//! Spheres. They stay in world space, where every ray has unit speed; see [`ball`] for the
//! formula.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lanes::{Eight, Lanes, Simd, Vector};
use super::line::{End, Ends, approach, ball};
use super::transform::normalised;
use super::{Aabb, Chart, Hit, Hits, Ray, Rays, Surfaces};

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

    /// Where the lines cross the sphere, in each lane. Its only part is 0.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let like = rays.origin.x;
        ends(Vector::all(like, self.centre), like.all(self.radius), rays)
    }

    /// The surfaces at hits, in each lane.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(&self, rays: &Rays<N>, at: End<N>) -> Surfaces<N> {
        let centre = Vector::all(at.t, self.centre);
        sphere_surfaces(centre, at.t.all(self.radius), rays, at.t)
    }

    /// The texture coordinates at a hit.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        Chart::of_ball((ray.at(hit.t) - self.centre) / self.radius)
            .with_gradients(|gradient| gradient / self.radius)
    }
}

/// Where rays meet spheres, side by side, at 0 < t < limit; in lanes whose bit is 0 none do. `None`
/// if none does in any.
#[inline(always)]
pub fn sphere_hits<S: Simd>(
    centre: Vector<Eight<S>>,
    radius: Eight<S>,
    rays: &Rays<Eight<S>>,
    limits: Eight<S>,
    lanes: u32,
) -> Option<Hits> {
    ends(centre, radius, rays)?.hits(limits, lanes)
}

/// The surfaces of spheres where rays meet them at distances `t`, in each lane.
#[inline(always)]
pub fn sphere_surfaces<N: Lanes>(
    centre: Vector<N>,
    radius: N,
    rays: &Rays<N>,
    t: N,
) -> Surfaces<N> {
    let normal = normalised(rays.at(t) - centre, DVec3::Z);
    Surfaces {
        point: centre + normal.scaled(radius),
        normal,
        scale: centre.abs().largest().larger(radius),
    }
}

/// Where lines cross spheres, in each lane.
#[inline(always)]
pub(super) fn ends<N: Lanes>(centre: Vector<N>, radius: N, rays: &Rays<N>) -> Option<Ends<N>> {
    let (place, start) = approach(rays.origin - centre, rays.direction, radius);
    ball(place, rays.direction, radius)?.after(start)
}
