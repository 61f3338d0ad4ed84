//! What both ways of gathering light share: samples, the points that rays come to, shadow rays.

use std::borrow::Cow;

use glam::{DVec2, DVec3};

use super::intersect::{Crossed, Nearest};
use super::lights::{self, Incoming};
use super::sampler::Sampler;
use super::utah::Shading;
use super::world::World;
use crate::geometry::{Ray, Surface, ulp};
use crate::scene::{Light, Material, Phong, Rgb, Shadows};

/// Rays that one camera sample may trace, shadow rays apart. With reflection and transmission both
/// 1 a tree of depth 30 would have two thousand million.
pub(crate) const RAY_BUDGET: u32 = 4096;

/// Asks a world for light, and counts what that takes.
///
/// Once `cancelled` says so, what it gives is of no use.
#[derive(Debug)]
pub(crate) struct Probe<'w, C> {
    pub(crate) world: &'w World,
    /// Whether to stop; asked every few hundred rays.
    pub(crate) cancelled: C,
    /// Bounces that rays are followed to.
    pub(crate) depth: u32,
    /// Scratch space.
    pub(crate) crossed: Crossed,
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

impl<'w, C: Fn() -> bool> Probe<'w, C> {
    /// A probe that follows rays to bounce `depth`.
    pub(crate) fn new(world: &'w World, depth: u32, cancelled: C) -> Self {
        Self {
            world,
            cancelled,
            depth,
            crossed: Vec::new(),
            counts: Counts::default(),
        }
    }

    /// Whether to stop before the light of this number, which is asked for some of them: a scene may
    /// have a hundred thousand.
    pub(crate) fn is_cancelled_at(&self, light: usize) -> bool {
        light % 16 == 15 && (self.cancelled)()
    }

    /// What a surface sends back of a light's light: see [`ask`].
    pub(crate) fn direct(
        &mut self,
        point: &Point,
        light: &Light,
        place: Option<[f64; 2]>,
        reflected: impl FnOnce(DVec3, f64) -> Rgb,
    ) -> Rgb {
        match ask(point, light, place, reflected) {
            Some(asked) => self.visibility(asked.shadow) * asked.unblocked,
            None => Rgb::ZERO,
        }
    }

    /// The part of light that passes along a shadow ray; all of it without one.
    pub(crate) fn visibility(&mut self, shadow: Option<Shadow>) -> f64 {
        let Some(Shadow { ray, end }) = shadow else {
            return 1.0;
        };
        self.counts.rays += 1;
        self.world.transmittance(&ray, end, &mut self.crossed)
    }
}

/// A ray toward a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shadow {
    pub(crate) ray: Ray,
    /// How far along it something is in the way.
    pub(crate) end: f64,
}

/// Light that is asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    /// What is sent back of it if nothing is in the way.
    pub(crate) unblocked: Rgb,
    /// Where something may be.
    pub(crate) shadow: Option<Shadow>,
}

/// What a surface sends back of a light's light, from the part of it that `place` says (see
/// [`lights::incoming`]): `reflected` gives how much of what comes from a direction at an angle of
/// some cosine above 0. `None` if that is nothing.
#[inline]
pub(crate) fn ask(
    point: &Point,
    light: &Light,
    place: Option<[f64; 2]>,
    reflected: impl FnOnce(DVec3, f64) -> Rgb,
) -> Option<Asked> {
    let incoming = lights::incoming(light, point.surface.point, place)?;
    let cosine = point.normal.dot(incoming.toward);
    // It is NaN where the light stands at the point itself.
    if cosine <= 0.0 || cosine.is_nan() {
        return None;
    }
    let reflected = reflected(incoming.toward, cosine);
    if reflected == Rgb::ZERO {
        return None;
    }
    let attenuation = lights::attenuation(light, point.surface.point, incoming.toward);
    if attenuation == 0.0 {
        return None;
    }
    let arriving = attenuation * light.colour;
    Some(Asked {
        unblocked: reflected * arriving,
        shadow: shadow(&point.surface, light, incoming),
    })
}

/// The ray from a surface to a light, unless nothing keeps that light from others.
#[inline]
pub(crate) fn shadow(surface: &Surface, light: &Light, incoming: Incoming) -> Option<Shadow> {
    if light.shadows == Shadows::Off {
        return None;
    }
    let origin = surface.leave(incoming.toward);
    let Some(source) = incoming.source else {
        let ray = Ray {
            origin,
            direction: incoming.toward,
        };
        let end = f64::INFINITY;
        return Some(Shadow { ray, end });
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
    Some(Shadow { ray, end })
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
