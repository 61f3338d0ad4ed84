//! The solids, which rays intersect and set operations combine.

use super::hit::{Crossings, Hit, Hits, Spans};
use super::lanes::{Eight, Lanes, Simd};
use super::line::Ends;
use super::ray::{Ray, Rays};
use super::{Aabb, Chart, Cone, Cuboid, Cylinder, Ellipsoid, Quadric, Sphere, Surface, Surfaces};

/// A closed solid.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// A sphere.
    Sphere(Sphere),
    /// An affine image of the unit sphere.
    Ellipsoid(Box<Ellipsoid>),
    /// An affine image of the unit cube.
    Cuboid(Box<Cuboid>),
    /// An affine image of the unit cylinder.
    Cylinder(Box<Cylinder>),
    /// An affine image of the unit cone.
    Cone(Box<Cone>),
    /// A quadric clipped by half-spaces; it may be concave or unbounded.
    Quadric(Box<Quadric>),
}

impl Solid {
    /// The axis-aligned bounding box: tight, or conservative for quadrics.
    pub fn bounds(&self) -> Aabb {
        match self {
            Self::Sphere(sphere) => sphere.bounds(),
            Self::Ellipsoid(ellipsoid) => ellipsoid.bounds(),
            Self::Cuboid(cuboid) => cuboid.bounds(),
            Self::Cylinder(cylinder) => cylinder.bounds(),
            Self::Cone(cone) => cone.bounds(),
            Self::Quadric(quadric) => quadric.bounds(),
        }
    }

    /// Adds the parts of the ray's line inside the solid.
    pub fn spans(&self, ray: &Ray, spans: &mut Spans) {
        match self.as_quadric() {
            Some(quadric) => spans.extend(quadric.crossings(ray).into_iter().flatten()),
            None => spans.extend(self.ends(&ray.into()).map(Crossings::from)),
        }
    }

    /// The nearest hit with `0 < t < limit`, entering or leaving.
    #[inline]
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        if let Some(quadric) = self.as_quadric() {
            return quadric.hit(ray, limit);
        }
        let (end, hit) = self.ends(&ray.into())?.nearest(limit);
        hit.then_some(end.into())
    }

    /// The same for a packet of eight rays; `None` if no lane hits. Lanes whose bit in `lanes` is 0
    /// may be skipped.
    #[inline(always)]
    pub fn hits<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        limits: Eight<S>,
        lanes: u32,
    ) -> Option<Hits> {
        match self.as_quadric() {
            Some(quadric) => {
                Hits::one_by_one(lanes, |lane| quadric.hit(&rays.ray(lane), limits[lane]))
            }
            None => self.with_ends(
                rays,
                #[inline(always)]
                |ends| ends.hits(limits, lanes),
            ),
        }
    }

    /// Whether every line hits the solid in at most one span: all but quadrics.
    pub(super) fn is_simple(&self) -> bool {
        self.as_quadric().is_none()
    }

    /// The solid that a line may hit in several spans, one ray at a time; `None` if it is simple.
    #[inline(always)]
    fn as_quadric(&self) -> Option<&Quadric> {
        match self {
            Self::Quadric(quadric) => Some(quadric),
            Self::Sphere(_)
            | Self::Ellipsoid(_)
            | Self::Cuboid(_)
            | Self::Cylinder(_)
            | Self::Cone(_) => None,
        }
    }

    /// The crossings of a simple solid in each lane; `None` for quadrics.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        self.with_ends(rays, Some)
    }

    /// Calls `result` with those crossings. For all solids but spheres, the two are compiled as one
    /// function, so that crossings stay in registers.
    #[inline(always)]
    fn with_ends<N: Lanes, R>(
        &self,
        rays: &Rays<N>,
        result: impl FnOnce(Ends<N>) -> Option<R>,
    ) -> Option<R> {
        let like = rays.origin.x;
        match self {
            Self::Sphere(sphere) => result(sphere.ends(rays)?),
            Self::Ellipsoid(ellipsoid) => like.outlined(
                #[inline(always)]
                || result(ellipsoid.ends(rays)?),
            ),
            Self::Cuboid(cuboid) => like.outlined(
                #[inline(always)]
                || result(cuboid.ends(rays)?),
            ),
            Self::Cylinder(cylinder) => like.outlined(
                #[inline(always)]
                || result(cylinder.ends(rays)?),
            ),
            Self::Cone(cone) => like.outlined(
                #[inline(always)]
                || result(cone.ends(rays)?),
            ),
            Self::Quadric(_) => None,
        }
    }

    /// The surface at a hit of this solid.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        match self {
            Self::Sphere(sphere) => sphere.surface(&ray.into(), hit.into()).into(),
            Self::Ellipsoid(ellipsoid) => ellipsoid.surface(&ray.into(), hit.into()).into(),
            Self::Cuboid(cuboid) => cuboid.surface(&ray.into(), hit.into()).into(),
            Self::Cylinder(cylinder) => cylinder.surface(&ray.into(), hit.into()).into(),
            Self::Cone(cone) => cone.surface(&ray.into(), hit.into()).into(),
            Self::Quadric(quadric) => quadric.surface(ray, hit),
        }
    }

    /// The same for a packet of eight rays; lanes without a hit are undefined. `None` for quadrics,
    /// which support single rays only.
    #[inline(always)]
    pub fn surfaces<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        hits: &Hits,
    ) -> Option<Surfaces<Eight<S>>> {
        // Outlined, because combinations of solids use it as well.
        rays.origin.x.outlined(
            #[inline(always)]
            || {
                let at = hits.ends(rays.origin.x.simd);
                Some(match self {
                    Self::Sphere(sphere) => sphere.surface(rays, at),
                    Self::Ellipsoid(ellipsoid) => ellipsoid.surface(rays, at),
                    Self::Cuboid(cuboid) => cuboid.surface(rays, at),
                    Self::Cylinder(cylinder) => cylinder.surface(rays, at),
                    Self::Cone(cone) => cone.surface(rays, at),
                    Self::Quadric(_) => return None,
                })
            },
        )
    }

    /// The texture coordinates at a hit of this solid, in its own frame.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        match self {
            Self::Sphere(sphere) => sphere.chart(ray, hit),
            Self::Ellipsoid(ellipsoid) => ellipsoid.chart(ray, hit),
            Self::Cuboid(cuboid) => cuboid.chart(ray, hit),
            Self::Cylinder(cylinder) => cylinder.chart(ray, hit),
            Self::Cone(cone) => cone.chart(ray, hit),
            Self::Quadric(quadric) => quadric.chart(ray, hit),
        }
    }

    /// The number of parts of the surface.
    pub(super) fn parts(&self) -> u32 {
        match self {
            Self::Sphere(_) | Self::Ellipsoid(_) => 1,
            Self::Cuboid(_) => 6,
            Self::Cylinder(_) => 3,
            Self::Cone(_) => 2,
            Self::Quadric(quadric) => quadric.parts(),
        }
    }
}
