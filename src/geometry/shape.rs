//! What rays, hits and shapes have in common.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use std::sync::Arc;

use smallvec::SmallVec;

use super::lanes::{Eight, Lanes, Simd, SimdBase, WIDTH, bits};
use super::line::{End, Ends};
use super::ray::{Ray, Rays};
use super::{
    Aabb, Chart, Cone, Csg, Cuboid, Cylinder, Ellipsoid, Instance, Plane, Quadric, Sphere, Surface,
    Surfaces,
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
    /// No ray crosses.
    pub(super) const NONE: Self = Self {
        lanes: 0,
        distances: [0.0; WIDTH],
        parts: [0.0; WIDTH],
    };

    /// Those of each lane.
    #[inline(always)]
    pub fn new(mut hit: impl FnMut(usize) -> Option<Hit>) -> Self {
        let mut hits = Self::NONE;
        for lane in 0..WIDTH {
            hits.put(lane, hit(lane));
        }
        hits
    }

    /// Those of some lanes, one after the other; `None` if there is none.
    #[inline]
    pub fn one_by_one(lanes: u32, hit: impl FnMut(usize) -> Option<Hit>) -> Option<Self> {
        Self::NONE.and(lanes, hit)
    }

    /// Those of other lanes as well, one after the other; `None` if there is none at all.
    #[inline]
    pub(super) fn and(
        mut self,
        lanes: u32,
        mut hit: impl FnMut(usize) -> Option<Hit>,
    ) -> Option<Self> {
        for lane in (0..WIDTH).filter(|lane| lanes >> lane & 1 == 1) {
            self.put(lane, hit(lane));
        }
        (self.lanes != 0).then_some(self)
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, hit: Option<Hit>) {
        if let Some(Hit { t, part }) = hit {
            self.lanes |= 1 << lane;
            self.distances[lane] = t;
            self.parts[lane] = f64::from(part);
        }
    }

    /// How far along their rays they are.
    #[inline(always)]
    pub fn distances<S: Simd>(&self, simd: S) -> Eight<S> {
        Eight::load_array(simd, self.distances)
    }

    /// Both in vectors.
    #[inline(always)]
    fn ends<S: Simd>(&self, simd: S) -> End<Eight<S>> {
        End {
            t: self.distances(simd),
            part: Eight::load_array(simd, self.parts),
        }
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

impl From<Hit> for End<f64> {
    #[inline(always)]
    fn from(Hit { t, part }: Hit) -> Self {
        Self {
            t,
            part: part.into(),
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

impl<S: Simd> End<Eight<S>> {
    /// The crossings in some lanes.
    #[inline(always)]
    pub(super) fn hits(self, lanes: u32) -> Hits {
        Hits {
            lanes,
            distances: *self.t,
            parts: *self.part,
        }
    }
}

impl<S: Simd> Ends<Eight<S>> {
    /// The nearer crossings at 0 < t < limit, in some lanes.
    #[inline(always)]
    pub(super) fn hits(self, limits: Eight<S>, lanes: u32) -> Option<Hits> {
        let (end, met) = self.nearest(limits);
        let lanes = bits(met) & lanes;
        (lanes != 0).then(|| end.hits(lanes))
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

    /// The same crossings as seen from `start` farther back; `None` if a distance is not a number.
    #[inline]
    pub(super) fn later(mut self, start: f64) -> Option<Self> {
        self.enter.t += start;
        self.exit.t += start;
        (self.enter.t <= self.exit.t).then_some(self)
    }
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

    /// Adds the parts of the ray's line that are inside the solid; none for what is not a solid.
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

    /// Whether it is one of the five simple solids.
    pub(super) fn is_simple(&self) -> bool {
        !matches!(
            self,
            Self::Quadric(_) | Self::Csg(_) | Self::Plane(_) | Self::Mesh(_)
        )
    }

    /// Where the lines cross one of the five simple solids, in each lane.
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

    /// The same for eight rays side by side, with nothing of use in lanes that no hit is said of;
    /// `None` if this shape's are only had one by one.
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
