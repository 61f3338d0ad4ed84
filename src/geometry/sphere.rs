//! Spheres, intersected in world space, where rays have unit speed; see [`ball`] for the formula.

use glam::DVec3;

use super::lanes::{Eight, Lanes, Simd, Vector, bits};
use super::line::{End, Ends, approach, ball};
use super::transform::normalised;
use super::{Aabb, Chart, Hit, Hits, Ray, Rays, Surfaces};

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// The centre.
    pub centre: DVec3,
    /// The radius, above 0.
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

    /// The nearest hit with `0 < t < limit`, entering or leaving.
    #[inline(always)]
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        let (end, hit) = self.ends(&ray.into())?.nearest(limit);
        hit.then_some(end.into())
    }

    /// Intersects lines with the sphere, in each lane. Its only part is 0.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let like = rays.origin.x;
        ends(Vector::all(like, self.centre), like.all(self.radius), rays)
    }

    /// The surface at a hit, in each lane.
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

/// The hits of rays with spheres, one of each per lane, with 0 < t < limit. Lanes whose bit is 0
/// have none; `None` if no lane has one.
#[inline(always)]
pub fn sphere_hits<S: Simd>(
    centre: Vector<Eight<S>>,
    radius: Eight<S>,
    rays: &Rays<Eight<S>>,
    limits: Eight<S>,
    lanes: u32,
) -> Option<Hits> {
    if bits::<S>(may_meet(centre, radius, rays)) & lanes == 0 {
        return None;
    }
    ends(centre, radius, rays)?.hits(limits, lanes)
}

/// Whether rays' lines may meet spheres, in each lane: all that do by [`Sphere::hit`] and few others.
/// NaN rejects nothing but spheres with such a radius.
///
/// For a centre at c from the ray's start, a line of direction d passes it at |c × d| / |d|. A component
/// of the product is off by less than 3u |c| |d|, with u the unit roundoff, so the product by less than
/// 6u |c| |d|. What [`ball`] computes is off by less: |c| is at most 64 radii there, or the line was
/// first advanced.
#[inline(always)]
pub fn may_meet<N: Lanes>(centre: Vector<N>, radius: N, rays: &Rays<N>) -> N::Mask {
    const ROUNDING: f64 = 32.0 * f64::EPSILON;
    let direction = rays.direction;
    let offset = centre - rays.origin;
    let distance_squared = offset.cross(direction).length_squared();
    let most = radius + radius.all(1e-9) * radius + radius.all(ROUNDING) * offset.abs().sum();
    let bound = most * most * direction.length_squared() + radius.all(f64::MIN_POSITIVE);
    !bound.below(distance_squared) & radius.equals(radius)
}

/// The surfaces of spheres where rays hit them at distances `t`, in each lane.
#[inline(always)]
pub fn sphere_surfaces<N: Lanes>(
    centre: Vector<N>,
    radius: N,
    rays: &Rays<N>,
    t: N,
) -> Surfaces<N> {
    let normal = normalised(rays.at(t) - centre, Vector::all(t, DVec3::Z));
    Surfaces {
        point: centre + normal.scaled(radius),
        normal,
        scale: centre.abs().largest().larger(radius),
    }
}

/// Intersects lines with spheres, in each lane.
#[inline(always)]
pub(super) fn ends<N: Lanes>(centre: Vector<N>, radius: N, rays: &Rays<N>) -> Option<Ends<N>> {
    let (position, start) = approach(rays.origin - centre, rays.direction, radius);
    ball(position, rays.direction, radius)?.shifted(start)
}
