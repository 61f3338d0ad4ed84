//! What both ways of gathering light share: samples, the points that rays come to, shadow rays.

use std::borrow::Cow;

use glam::{DVec2, DVec3};

use super::lights::{self, Incoming};
use super::sampler::Sampler;
use super::utah::Shading;
use super::world::{Nearest, World};
use crate::geometry::{Ray, Surface, ulp};
use crate::scene::{Integrator, Light, Material, Phong, Rgb, Shadows};

/// Rays that one camera sample may trace, shadow rays apart. With reflection and transmission both
/// 1 a tree of depth 30 would have two thousand million.
pub(crate) const RAY_BUDGET: u32 = 4096;

/// Traces samples; keeps its scratch space and counts from one to the next.
///
/// Once `cancelled` says so, what it gives is of no use.
#[derive(Debug)]
pub(crate) struct Tracer<'w, C> {
    pub(crate) world: &'w World,
    /// Whether to stop; asked every few hundred rays.
    pub(crate) cancelled: C,
    integrator: Integrator,
    /// Bounces that rays are followed to.
    pub(crate) depth: u32,
    pub(crate) pending: Vec<Pending>,
    crossed: Vec<(u32, u32)>,
    /// What was traced so far.
    pub(crate) counts: Counts,
}

/// Counts of work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Rays, shadow rays included.
    pub(crate) rays: u64,
    /// Samples that ran out of their budget.
    pub(crate) over_budget: u64,
}

impl Counts {
    /// What was added since `before`.
    pub(crate) fn since(self, before: Self) -> Self {
        Self {
            rays: self.rays - before.rays,
            over_budget: self.over_budget - before.over_budget,
        }
    }

    /// Both counts together.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            over_budget: self.over_budget + other.over_budget,
        }
    }
}

/// A camera ray, and what its sample is made of besides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) ray: Ray,
    /// How far along it things are seen.
    pub(crate) reach: f64,
    /// The middle of its pixel in the picture, 0 to 1 from the top left.
    pub(crate) screen: DVec2,
    /// Its numbers.
    pub(crate) sampler: Sampler,
}

/// A ray yet to be traced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pending {
    pub(crate) ray: Ray,
    /// Which part of its radiance reaches the eye.
    pub(crate) weight: Rgb,
    /// What is lost per unit of length until it meets something.
    pub(crate) absorption: Rgb,
    pub(crate) bounce: u32,
    /// Its place in the tree of rays, for numbers of its own.
    pub(crate) node: u32,
}

/// What a camera ray brings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Seen {
    /// Radiance.
    pub(crate) radiance: Rgb,
    /// The first object met, or [`NO_OBJECT`](super::NO_OBJECT).
    pub(crate) object: u32,
}

/// A point that a ray has come to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) surface: Surface,
    /// The normal to shade with, its bumps included: turned round where the back was hit.
    pub(crate) normal: DVec3,
    /// Whether the ray came from outside.
    pub(crate) front: bool,
    /// Unit vector toward where the ray came from.
    pub(crate) view: DVec3,
}

/// What a surface is made of at a point, with its textures.
#[derive(Clone, Debug)]
pub(crate) enum Matter<'w> {
    /// See [`Material::Phong`].
    Phong(Cow<'w, Phong>),
    /// See [`Material::Utah`].
    Utah(Shading),
    /// See [`Material::Flat`].
    Flat(Rgb),
}

impl<'w, C: Fn() -> bool> Tracer<'w, C> {
    /// A tracer that follows rays to bounce `depth`.
    pub(crate) fn new(world: &'w World, integrator: Integrator, depth: u32, cancelled: C) -> Self {
        Self {
            world,
            cancelled,
            integrator,
            depth,
            pending: Vec::new(),
            crossed: Vec::new(),
            counts: Counts::default(),
        }
    }

    /// Radiance along a camera ray.
    pub(crate) fn radiance(&mut self, sample: &Sample) -> Seen {
        match self.integrator {
            Integrator::Whitted => self.by_whitted(sample),
            Integrator::Path => self.by_path(sample),
        }
    }

    /// Whether to stop before the light of this number, which is asked for some of them: a scene may
    /// have a hundred thousand.
    pub(crate) fn is_cancelled_at(&self, light: usize) -> bool {
        light % 256 == 255 && (self.cancelled)()
    }

    /// What a surface sends back of a light's light, from the part of it that `place` says (see
    /// [`lights::incoming`]): `reflected` gives how much of what comes from a direction at an angle of
    /// some cosine above 0.
    pub(crate) fn direct(
        &mut self,
        point: &Point,
        light: &Light,
        place: Option<[f64; 2]>,
        reflected: impl FnOnce(DVec3, f64) -> Rgb,
    ) -> Rgb {
        let Some(incoming) = lights::incoming(light, point.surface.point, place) else {
            return Rgb::ZERO;
        };
        let cosine = point.normal.dot(incoming.toward);
        // It is NaN where the light stands at the point itself.
        if cosine <= 0.0 || cosine.is_nan() {
            return Rgb::ZERO;
        }
        let reflected = reflected(incoming.toward, cosine);
        if reflected == Rgb::ZERO {
            return Rgb::ZERO;
        }
        let attenuation = lights::attenuation(light, point.surface.point, incoming.toward);
        if attenuation == 0.0 {
            return Rgb::ZERO;
        }
        let arriving = attenuation * light.colour;
        self.visibility(&point.surface, light, incoming) * (reflected * arriving)
    }

    /// The part of a light that reaches a surface.
    pub(crate) fn visibility(
        &mut self,
        surface: &Surface,
        light: &Light,
        incoming: Incoming,
    ) -> f64 {
        if light.shadows == Shadows::Off {
            return 1.0;
        }
        self.counts.rays += 1;
        let origin = surface.leave(incoming.toward);
        let Some(source) = incoming.source else {
            let ray = Ray {
                origin,
                direction: incoming.toward,
            };
            return self
                .world
                .transmittance(&ray, f64::INFINITY, &mut self.crossed);
        };
        let way = source - origin;
        let distance = way.length();
        // The surface that a light lies on does not block it: the way ends before that surface, by
        // as much as rounding may displace it.
        let reach = origin.abs().max(source.abs()).max_element();
        let ray = Ray {
            origin,
            direction: way / distance,
        };
        let end = distance - 32.0 * ulp(reach.max(distance));
        self.world.transmittance(&ray, end, &mut self.crossed)
    }
}

impl Point {
    /// The start of a ray from here.
    pub(crate) fn leave(&self, direction: DVec3) -> Ray {
        Ray {
            origin: self.surface.leave(direction),
            direction,
        }
    }
}

impl World {
    /// The point where a ray meets an object, and what that is made of there.
    pub(crate) fn arrive(&self, ray: &Ray, nearest: Nearest) -> (Point, Matter<'_>) {
        let object = &self.scene.objects[nearest.object as usize];
        let surface = object.shape.surface(ray, nearest.hit);
        let chart = || object.shape.chart(ray, nearest.hit);
        let mut normal = surface.shading;
        let matter = match &self.scene.materials[object.material_at(nearest.hit) as usize] {
            Material::Phong(phong) if phong.colour_texture.is_none() && phong.bump.is_none() => {
                Matter::Phong(Cow::Borrowed(phong))
            }
            Material::Phong(phong) => {
                let mut phong = *phong;
                self.textures.apply(&chart(), &mut phong, &mut normal);
                Matter::Phong(Cow::Owned(phong))
            }
            Material::Utah(utah) => {
                let place = || chart().uv;
                Matter::Utah(Shading::at(utah, &self.mapped, place))
            }
            Material::Flat(colour) => Matter::Flat(*colour),
        };
        // Which side is seen is the surface's to say, not the bumps'.
        let front = ray.direction.dot(surface.normal) < 0.0;
        let point = Point {
            surface,
            normal: if front { normal } else { -normal },
            front,
            view: -ray.direction,
        };
        (point, matter)
    }
}
