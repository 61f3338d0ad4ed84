//! Hits, spans, and the shapes that rays intersect.

#![expect(
    clippy::inline_always,
    reason = "these must be inlined into callers compiled for wider vectors"
)]

use std::sync::Arc;

use super::hit::{Crossings, Hit, Hits, Spans};
use super::lanes::{Eight, Lanes, Simd};
use super::line::Ends;
use super::ray::{Ray, Rays};
use super::{
    Aabb, Chart, Cone, Csg, Cuboid, Cylinder, Ellipsoid, Instance, Plane, Quadric, Sphere, Surface,
    Surfaces,
};

/// A closed solid, or a surface that need not bound one.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
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
    /// A solid made of solids by set operations.
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
            Self::Sphere(sphere) => sphere.bounds(),
            Self::Ellipsoid(ellipsoid) => ellipsoid.bounds(),
            Self::Cuboid(cuboid) => cuboid.bounds(),
            Self::Cylinder(cylinder) => cylinder.bounds(),
            Self::Cone(cone) => cone.bounds(),
            Self::Quadric(quadric) => quadric.bounds(),
            Self::Csg(csg) => csg.bounds(),
            Self::Plane(plane) => plane.bounds(),
            Self::Mesh(instance) => instance.bounds(),
        }
    }

    /// Adds the parts of the ray's line inside the solid; none for squares and meshes.
    pub fn spans(&self, ray: &Ray, spans: &mut Spans) {
        match self {
            Self::Quadric(quadric) => spans.extend(quadric.crossings(ray).into_iter().flatten()),
            Self::Csg(csg) => csg.spans(ray, spans),
            Self::Plane(_) | Self::Mesh(_) => {}
            Self::Sphere(_)
            | Self::Ellipsoid(_)
            | Self::Cuboid(_)
            | Self::Cylinder(_)
            | Self::Cone(_) => spans.extend(self.ends(&ray.into()).map(Crossings::from)),
        }
    }

    /// The nearest hit with `0 < t < limit`, entering or leaving. Tests every triangle of a mesh;
    /// see [`Instance::line`] for testing candidates only.
    #[inline]
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        match self {
            Self::Quadric(quadric) => quadric.hit(ray, limit),
            Self::Csg(csg) => csg.hit(ray, limit),
            Self::Plane(plane) => plane.hit(ray, limit),
            Self::Mesh(instance) => instance.hit(ray, limit),
            Self::Sphere(_)
            | Self::Ellipsoid(_)
            | Self::Cuboid(_)
            | Self::Cylinder(_)
            | Self::Cone(_) => {
                let (end, hit) = self.ends(&ray.into())?.nearest(limit);
                hit.then_some(end.into())
            }
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
            Self::Csg(csg) => csg.hits(rays, limits, lanes),
            Self::Quadric(_) | Self::Plane(_) | Self::Mesh(_) => {
                Hits::one_by_one(lanes, |lane| self.hit(&rays.ray(lane), limits[lane]))
            }
            Self::Sphere(_)
            | Self::Ellipsoid(_)
            | Self::Cuboid(_)
            | Self::Cylinder(_)
            | Self::Cone(_) => self.ends(rays)?.hits(limits, lanes),
        }
    }

    /// Whether the shape is one of the five simple solids.
    pub(super) fn is_simple(&self) -> bool {
        !matches!(
            self,
            Self::Quadric(_) | Self::Csg(_) | Self::Plane(_) | Self::Mesh(_)
        )
    }

    /// The crossings of one of the five simple solids, in each lane; `None` for other shapes.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        match self {
            Self::Sphere(sphere) => sphere.ends(rays),
            Self::Ellipsoid(ellipsoid) => ellipsoid.ends(rays),
            Self::Cuboid(cuboid) => cuboid.ends(rays),
            Self::Cylinder(cylinder) => cylinder.ends(rays),
            Self::Cone(cone) => cone.ends(rays),
            Self::Quadric(_) | Self::Csg(_) | Self::Plane(_) | Self::Mesh(_) => None,
        }
    }

    /// The surface at a hit of this shape.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        match self {
            Self::Sphere(sphere) => sphere.surface(&ray.into(), hit.into()).into(),
            Self::Ellipsoid(ellipsoid) => ellipsoid.surface(&ray.into(), hit.into()).into(),
            Self::Cuboid(cuboid) => cuboid.surface(&ray.into(), hit.into()).into(),
            Self::Cylinder(cylinder) => cylinder.surface(&ray.into(), hit.into()).into(),
            Self::Cone(cone) => cone.surface(&ray.into(), hit.into()).into(),
            Self::Quadric(quadric) => quadric.surface(ray, hit),
            Self::Csg(csg) => csg.surface(ray, hit),
            Self::Plane(plane) => plane.surface(ray, hit),
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
    ) -> Option<Surfaces<Eight<S>>> {
        let at = hits.ends(rays.origin.x.simd);
        match self {
            Self::Sphere(sphere) => Some(sphere.surface(rays, at)),
            Self::Ellipsoid(ellipsoid) => Some(ellipsoid.surface(rays, at)),
            Self::Cuboid(cuboid) => Some(cuboid.surface(rays, at)),
            Self::Cylinder(cylinder) => Some(cylinder.surface(rays, at)),
            Self::Cone(cone) => Some(cone.surface(rays, at)),
            Self::Quadric(_) | Self::Csg(_) | Self::Plane(_) | Self::Mesh(_) => None,
        }
    }

    /// The texture coordinates at a hit of this shape, in its own frame.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        match self {
            Self::Sphere(sphere) => sphere.chart(ray, hit),
            Self::Ellipsoid(ellipsoid) => ellipsoid.chart(ray, hit),
            Self::Cuboid(cuboid) => cuboid.chart(ray, hit),
            Self::Cylinder(cylinder) => cylinder.chart(ray, hit),
            Self::Cone(cone) => cone.chart(ray, hit),
            Self::Quadric(quadric) => quadric.chart(ray, hit),
            Self::Csg(csg) => csg.chart(ray, hit),
            Self::Plane(plane) => plane.chart(ray, hit),
            Self::Mesh(instance) => instance.chart(ray, hit),
        }
    }

    /// The tag of the part that was hit, if parts of the shape have tags.
    pub fn tag(&self, hit: Hit) -> Option<u32> {
        match self {
            Self::Csg(csg) => Some(csg.tag(hit)),
            Self::Mesh(instance) => instance.tag(hit),
            _ => None,
        }
    }

    /// The number of parts.
    pub(super) fn parts(&self) -> u32 {
        match self {
            Self::Sphere(_) | Self::Ellipsoid(_) | Self::Plane(_) => 1,
            Self::Cuboid(_) => 6,
            Self::Cylinder(_) => 3,
            Self::Cone(_) => 2,
            Self::Quadric(quadric) => quadric.parts(),
            Self::Csg(csg) => csg.parts(),
            Self::Mesh(instance) => instance.mesh().len() as u32,
        }
    }
}
