//! What rays, hits and shapes have in common.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use std::sync::Arc;

use glam::DVec3;
use smallvec::SmallVec;

use super::lanes::{Eight, Lanes, Simd, WIDTH, bits};
use super::line::{End, Ends};
use super::ray::{Ray, Rays};
use super::{
    Aabb, Chart, Cone, Csg, Cuboid, Cylinder, Ellipsoid, Instance, Plane, Quadric, Sphere,
};

/// A crossing of a ray and a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in units of its direction.
    pub t: f64,
    /// Which of the shape's surfaces: numbered by each shape for itself.
    pub part: u32,
}

/// Crossings of eight rays, side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hits {
    /// A bit for each ray that crosses, the lowest for the first.
    pub lanes: u32,
    distances: [f64; WIDTH],
    parts: [f64; WIDTH],
}

impl Hits {
    /// Those of one lane after the other; `None` if there is none.
    #[inline]
    pub fn one_by_one(lanes: u32, mut hit: impl FnMut(usize) -> Option<Hit>) -> Option<Self> {
        let mut hits = Self {
            lanes: 0,
            distances: [0.0; WIDTH],
            parts: [0.0; WIDTH],
        };
        for lane in (0..WIDTH).filter(|lane| lanes >> lane & 1 == 1) {
            if let Some(Hit { t, part }) = hit(lane) {
                hits.lanes |= 1 << lane;
                hits.distances[lane] = t;
                hits.parts[lane] = f64::from(part);
            }
        }
        (hits.lanes != 0).then_some(hits)
    }

    /// The crossing of a ray that has its bit in `lanes`.
    #[inline]
    pub fn hit(&self, lane: usize) -> Hit {
        Hit {
            t: self.distances[lane % WIDTH],
            part: self.parts[lane % WIDTH] as u32,
        }
    }
}

impl From<End<f64>> for Hit {
    #[inline(always)]
    fn from(End { t, part }: End<f64>) -> Self {
        Self {
            t,
            part: part as u32,
        }
    }
}

impl From<Ends<f64>> for Crossings {
    #[inline(always)]
    fn from(Ends { enter, exit, .. }: Ends<f64>) -> Self {
        Self {
            enter: enter.into(),
            exit: exit.into(),
        }
    }
}

impl<S: Simd> Ends<Eight<S>> {
    /// The nearer crossings at 0 < t < limit, in some lanes.
    #[inline(always)]
    pub(super) fn hits(self, limits: Eight<S>, lanes: u32) -> Option<Hits> {
        let (end, met) = self.nearest(limits);
        let lanes = bits(met) & lanes;
        (lanes != 0).then(|| Hits {
            lanes,
            distances: *end.t,
            parts: *end.part,
        })
    }
}

/// Where a line enters and leaves a solid, as distances along a ray, either of which may be
/// negative, or infinite where no surface bounds that end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossings {
    /// Where the line goes in.
    pub enter: Hit,
    /// Where it comes out; not before `enter`.
    pub exit: Hit,
}

/// The parts of a line that are inside a solid: in ascending order and disjoint.
pub type Spans = SmallVec<[Crossings; 4]>;

impl Crossings {
    /// The whole line, which no surface bounds.
    pub(super) const EVERYWHERE: Self = Self {
        enter: Hit {
            t: f64::NEG_INFINITY,
            part: 0,
        },
        exit: Hit {
            t: f64::INFINITY,
            part: 0,
        },
    };

    /// The nearer crossing in the open interval `0 < t < limit`.
    #[inline]
    pub fn nearest(self, limit: f64) -> Option<Hit> {
        [self.enter, self.exit]
            .into_iter()
            .find(|hit| 0.0 < hit.t && hit.t < limit)
    }

    /// The part of the line that is in both solids, if any.
    #[inline]
    pub(super) fn overlap(self, other: Self) -> Option<Self> {
        let enter = if self.enter.t < other.enter.t {
            other.enter
        } else {
            self.enter
        };
        let exit = if other.exit.t < self.exit.t {
            other.exit
        } else {
            self.exit
        };
        (enter.t <= exit.t).then_some(Self { enter, exit })
    }

    /// The same crossings as seen from `start` farther back; `None` if a distance is no number.
    #[inline]
    pub(super) fn later(mut self, start: f64) -> Option<Self> {
        self.enter.t += start;
        self.exit.t += start;
        (self.enter.t <= self.exit.t).then_some(self)
    }
}

/// A point on a surface, as exact as `f64` holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// The point, re-projected onto the surface.
    pub point: DVec3,
    /// The outward geometric normal, of unit length.
    pub normal: DVec3,
    /// The normal that light is computed with, of unit length: the geometric one, but on a mesh
    /// with normals of its own.
    pub shading: DVec3,
    /// The largest magnitude that entered the computation of the point (coordinates of the shape's
    /// origin, its size), times the cancellation of a skewed frame: a few [`ulp`] of it bound how
    /// far from the surface the point is.
    pub scale: f64,
}

/// How many [`ulp`] of its scale a ray starts off the surface it leaves.
///
/// Rounding the point costs one, taking it into the shape's frame again a few more. Of the five
/// million rays of the tests thousands come back from 1 and none from 2; 16 has a factor of eight
/// in hand for frames that those do not meet, and is still far below any distance that shows.
pub(super) const CLEARANCE: f64 = 16.0;

impl Surface {
    /// The start of a ray that leaves the surface toward `direction`: moved off it by a few units
    /// in the last place of `scale`, to the side the direction points to.
    pub fn leave(&self, direction: DVec3) -> DVec3 {
        let clearance = CLEARANCE * ulp(self.scale);
        if direction.dot(self.normal) < 0.0 {
            self.point - clearance * self.normal
        } else {
            self.point + clearance * self.normal
        }
    }
}

/// The unit in the last place of `x`: the gap from |x| to the next larger `f64`. `x` is finite.
pub fn ulp(x: f64) -> f64 {
    x.abs().next_up() - x.abs()
}

/// What a ray can meet: a closed solid, or a surface that need not bound one.
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
    /// A quadric cut by half-spaces: may be concave, and may have no end.
    Quadric(Box<Quadric>),
    /// A solid made of solids.
    Csg(Arc<Csg>),
    /// An affine image of a square; no solid.
    Plane(Box<Plane>),
    /// An affine image of a mesh of triangles; no solid.
    Mesh(Box<Instance>),
}

impl Shape {
    /// The tight axis-aligned box.
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

    /// Adds the parts of the ray's line that are inside the solid; none for what is no solid.
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

    /// The nearest crossing with `0 < t < limit`, entering or leaving. Tries every triangle of a
    /// mesh; [`Instance::line`] is for those who know better.
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
                let (end, met) = self.ends(&ray.into())?.nearest(limit);
                met.then_some(end.into())
            }
        }
    }

    /// The same for eight rays side by side; `None` if no lane may be hit. Lanes whose bit in `lanes`
    /// is 0 may be left out.
    #[inline(always)]
    pub fn hits<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        limits: Eight<S>,
        lanes: u32,
    ) -> Option<Hits> {
        match self {
            Self::Quadric(_) | Self::Csg(_) | Self::Plane(_) | Self::Mesh(_) => {
                Hits::one_by_one(lanes, |lane| self.hit(&rays.ray(lane), limits[lane]))
            }
            Self::Sphere(_)
            | Self::Ellipsoid(_)
            | Self::Cuboid(_)
            | Self::Cylinder(_)
            | Self::Cone(_) => self.ends(rays)?.hits(limits, lanes),
        }
    }

    /// Where the lines cross one of the five simple solids, in each lane.
    #[inline(always)]
    fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
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
            Self::Sphere(sphere) => sphere.surface(ray, hit),
            Self::Ellipsoid(ellipsoid) => ellipsoid.surface(ray, hit),
            Self::Cuboid(cuboid) => cuboid.surface(ray, hit),
            Self::Cylinder(cylinder) => cylinder.surface(ray, hit),
            Self::Cone(cone) => cone.surface(ray, hit),
            Self::Quadric(quadric) => quadric.surface(ray, hit),
            Self::Csg(csg) => csg.surface(ray, hit),
            Self::Plane(plane) => plane.surface(ray, hit),
            Self::Mesh(instance) => instance.surface(ray, hit),
        }
    }

    /// The texture coordinates at a hit of this shape, in the solid's own frame.
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

    /// The tag of what was hit, if the shape has parts with tags of their own.
    pub fn tag(&self, hit: Hit) -> Option<u32> {
        match self {
            Self::Csg(csg) => Some(csg.tag(hit)),
            Self::Mesh(instance) => instance.tag(hit),
            _ => None,
        }
    }

    /// How many parts there are.
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
