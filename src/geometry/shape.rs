//! The shapes that rays intersect: solids, their combinations, and surfaces.

use std::sync::Arc;

use super::hit::{Hit, Hits, Spans};
use super::lanes::{Eight, Lanes, Simd};
use super::ray::{Ray, Rays};
use super::{Aabb, Chart, Csg, Instance, Plane, Shaded, Solid, Surface};

/// A solid, or a surface that need not bound one.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A single solid.
    Solid(Solid),
    /// Solids combined by set operations.
    Csg(Arc<Csg>),
    /// An affine image of a square, not a solid.
    Plane(Box<Plane>),
    /// An affine image of a triangle mesh, not a solid.
    Mesh(Box<Instance>),
}

impl Shape {
    /// The axis-aligned bounding box: tight, or conservative for quadrics, CSG and rotated meshes.
    pub fn bounds(&self) -> Aabb {
        match self {
            Self::Solid(solid) => solid.bounds(),
            Self::Csg(csg) => csg.bounds(),
            Self::Plane(plane) => plane.bounds(),
            Self::Mesh(instance) => instance.bounds(),
        }
    }

    /// Adds the parts of the ray's line inside the solid; none for squares and meshes.
    pub fn spans(&self, ray: &Ray, spans: &mut Spans) {
        match self {
            Self::Solid(solid) => solid.spans(ray, spans),
            Self::Csg(csg) => csg.spans(ray, spans),
            Self::Plane(_) | Self::Mesh(_) => {}
        }
    }

    /// The nearest hit with `0 < t < limit`, entering or leaving. Tests every triangle of a mesh;
    /// see [`Instance::line`] for testing candidates only.
    #[inline]
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        match self {
            Self::Solid(solid) => solid.hit(ray, limit),
            Self::Csg(csg) => csg.hit(ray, limit),
            Self::Plane(plane) => {
                let (end, hit) = plane.ends(&ray.into())?.nearest(limit);
                hit.then_some(end.into())
            }
            Self::Mesh(instance) => instance.hit(ray, limit),
        }
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
        match self {
            Self::Solid(solid) => solid.hits(rays, limits, lanes),
            Self::Csg(csg) => csg.hits(rays, limits, lanes),
            Self::Plane(plane) => plane.ends(rays)?.hits(limits, lanes),
            Self::Mesh(_) => {
                Hits::one_by_one(lanes, |lane| self.hit(&rays.ray(lane), limits[lane]))
            }
        }
    }

    /// The surface at a hit of this shape.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        match self {
            Self::Solid(solid) => solid.surface(ray, hit),
            Self::Csg(csg) => csg.surface(ray, hit),
            Self::Plane(plane) => plane.surface(&ray.into(), hit.into()).into(),
            Self::Mesh(instance) => instance.surface(ray, hit),
        }
    }

    /// The same for a packet of eight rays; lanes without a hit are undefined. `None` if the shape
    /// supports single rays only.
    #[inline(always)]
    pub fn surfaces<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        hits: &Hits,
    ) -> Option<Shaded<Eight<S>>> {
        let like = rays.origin.x;
        match self {
            Self::Solid(solid) => solid.surfaces(rays, hits).map(Shaded::from),
            Self::Csg(csg) => like.outlined(
                #[inline(always)]
                || csg.surfaces(rays, hits).map(Shaded::from),
            ),
            Self::Plane(plane) => {
                let surfaces = plane.surface(rays, hits.ends(rays.origin.x.simd));
                Some(surfaces.into())
            }
            Self::Mesh(instance) => like.outlined(
                #[inline(always)]
                || Some(instance.surfaces(rays, hits)),
            ),
        }
    }

    /// The texture coordinates at a hit of this shape, in its own frame.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        match self {
            Self::Solid(solid) => solid.chart(ray, hit),
            Self::Csg(csg) => csg.chart(ray, hit),
            Self::Plane(plane) => plane.chart(ray, hit),
            Self::Mesh(instance) => instance.chart(ray, hit),
        }
    }

    /// The tag of the part that was hit, if parts of the shape have tags.
    #[inline]
    pub fn tag(&self, hit: Hit) -> Option<u32> {
        match self {
            Self::Csg(csg) => Some(csg.tag(hit)),
            Self::Mesh(instance) => instance.tag(hit),
            Self::Solid(_) | Self::Plane(_) => None,
        }
    }
}
