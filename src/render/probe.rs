//! What both ways of gathering light share: samples, and the points that rays come to.

use std::borrow::Cow;

use glam::{DVec2, DVec3};

use super::frame::NO_OBJECT;
use super::intersect::{Crossed, Nearest};
use super::sampler::Sampler;
use super::touched::Touched;
use super::utah::Shading;
use super::world::World;
use crate::geometry::{Ray, Surface};
use crate::scene::{Material, Phong, Rgb};

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
    /// What a path has depended on so far.
    pub(crate) touched: Touched,
    /// What was traced so far.
    pub(crate) counts: Counts,
}

/// Counts of work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Rays, shadow rays included.
    pub(crate) rays: u64,
    /// Shadow rays.
    pub(crate) shadow_rays: u64,
    /// Samples that ran out of their budget.
    pub(crate) over_budget: u64,
}

impl Counts {
    /// What was added since `before`.
    pub(crate) fn since(self, before: Self) -> Self {
        Self {
            rays: self.rays - before.rays,
            shadow_rays: self.shadow_rays - before.shadow_rays,
            over_budget: self.over_budget - before.over_budget,
        }
    }

    /// Both counts together.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            shadow_rays: self.shadow_rays + other.shadow_rays,
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
    /// The first object met, or [`NO_OBJECT`].
    pub(crate) object: u32,
    /// What that depends on.
    pub(crate) touched: Touched,
}

impl Seen {
    /// What a ray brings that has met nothing yet.
    pub(crate) const NOTHING: Self = Self {
        radiance: Rgb::ZERO,
        object: NO_OBJECT,
        touched: Touched::NOTHING,
    };
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
            crossed: Crossed::default(),
            touched: Touched::default(),
            counts: Counts::default(),
        }
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
        let shape = &self.scene.objects[nearest.object as usize].shape;
        let surface = shape.surface(ray, nearest.hit);
        let (matter, bumped) = self.matter(nearest, || (*ray, surface.shading));
        let normal = bumped.unwrap_or(surface.shading);
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

    /// What an object is made of where a ray meets it, and the normal to shade with if it has bumps:
    /// `coming` is that ray, and the normal without them.
    pub(crate) fn matter(
        &self,
        nearest: Nearest,
        coming: impl Fn() -> (Ray, DVec3),
    ) -> (Matter<'_>, Option<DVec3>) {
        let object = &self.scene.objects[nearest.object as usize];
        let chart = || object.shape.chart(&coming().0, nearest.hit);
        match &self.scene.materials[object.material_at(nearest.hit) as usize] {
            Material::Phong(phong) if phong.colour_texture.is_none() && phong.bump.is_none() => {
                (Matter::Phong(Cow::Borrowed(phong)), None)
            }
            Material::Phong(phong) => {
                let mut phong = *phong;
                let (_, mut normal) = coming();
                self.textures.apply(&chart(), &mut phong, &mut normal);
                (Matter::Phong(Cow::Owned(phong)), Some(normal))
            }
            Material::Utah(utah) => {
                let place = || chart().uv;
                (Matter::Utah(Shading::at(utah, &self.mapped, place)), None)
            }
            Material::Flat(colour) => (Matter::Flat(*colour), None),
        }
    }
}
