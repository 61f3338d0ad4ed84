//! Shared by all integrators: samples, and the points that rays hit.

use std::borrow::Cow;

use glam::{DVec2, DVec3};

use super::frame::NO_OBJECT;
use super::gather::Gather;
use super::intersect::{Crossed, Nearest};
use super::photon_map::PhotonMap;
use super::sampler::Sampler;
use super::shading::Side;
use super::touched::Touched;
use super::world::World;
use crate::geometry::{Ray, Surface};
use crate::scene::{Material, Rgb};

/// Ray budget of a camera sample, not counting shadow rays. With reflection and transmission both
/// 1, a tree of depth 30 would have two billion.
pub(crate) const RAY_BUDGET: u32 = 4096;

/// Queries a world for radiance and counts the rays.
///
/// Results are meaningless once `cancelled` returns true.
#[derive(Debug)]
pub(crate) struct Probe<'w, C> {
    pub(crate) world: &'w World,
    /// Whether to stop; polled every few hundred rays.
    pub(crate) cancelled: C,
    /// Maximum bounces.
    pub(crate) depth: u32,
    /// The light to gather.
    pub(crate) gather: Gather,
    /// The photons of the current sample, if there are to be any.
    pub(crate) photon_map: Option<&'w PhotonMap>,
    /// Scratch space.
    pub(crate) crossed: Crossed,
    /// Rays traced so far.
    pub(crate) counts: Counts,
}

/// Counts of work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Rays, including shadow rays.
    pub rays: u64,
    /// Shadow rays.
    pub shadow_rays: u64,
    /// Samples that exceeded their ray budget.
    pub over_budget: u64,
}

impl Counts {
    /// The difference since `before`.
    #[must_use]
    pub fn since(self, before: Self) -> Self {
        Self {
            rays: self.rays - before.rays,
            shadow_rays: self.shadow_rays - before.shadow_rays,
            over_budget: self.over_budget - before.over_budget,
        }
    }

    /// The sum of both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            shadow_rays: self.shadow_rays + other.shadow_rays,
            over_budget: self.over_budget + other.over_budget,
        }
    }
}

/// A camera ray with the inputs of its sample.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) ray: Ray,
    /// Length of the ray up to the far limit.
    pub(crate) reach: f64,
    /// The pixel's centre in the picture, 0 to 1 from the top left.
    pub(crate) screen: DVec2,
    /// Its random numbers.
    pub(crate) sampler: Sampler,
}

/// The result of a camera ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Seen {
    /// Radiance or AOV.
    pub(crate) radiance: Rgb,
    /// The first object hit, or [`NO_OBJECT`].
    pub(crate) object: u32,
    /// Dependencies of the radiance.
    pub(crate) touched: Touched,
    /// Rays traced for the radiance, including shadow rays.
    pub(crate) rays: u32,
}

impl Seen {
    /// The initial result of a ray.
    pub(crate) const NOTHING: Self = Self {
        radiance: Rgb::ZERO,
        object: NO_OBJECT,
        touched: Touched::NOTHING,
        rays: 0,
    };
}

/// A point hit by a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) surface: Surface,
    /// Shading normal including bumps, flipped on back faces.
    pub(crate) normal: DVec3,
    pub(crate) side: Side,
    /// Unit vector toward the origin of the ray.
    pub(crate) view: DVec3,
}

impl<'w, C: Fn() -> bool> Probe<'w, C> {
    /// Creates a probe that follows rays up to bounce `depth`.
    pub(crate) fn new(world: &'w World, depth: u32, cancelled: C) -> Self {
        Self {
            world,
            cancelled,
            depth,
            gather: Gather::All,
            photon_map: None,
            crossed: Crossed::default(),
            counts: Counts::default(),
        }
    }

    /// Adds the light of photons to paths.
    pub(crate) fn with_photons(self, photon_map: Option<&'w PhotonMap>) -> Self {
        Self { photon_map, ..self }
    }
}

impl Point {
    /// Starts a ray from this point.
    pub(crate) fn leave(&self, direction: DVec3) -> Ray {
        Ray {
            origin: self.surface.leave(direction),
            direction,
        }
    }
}

impl World {
    /// Returns the point where a ray hits an object, and its material there, which is in `mapped` if
    /// it has maps.
    pub(crate) fn arrive<'m>(
        &'m self,
        ray: &Ray,
        nearest: Nearest,
        mapped: &'m mut Option<Material>,
    ) -> (Point, &'m Material) {
        let shape = &self.scene.objects[nearest.object as usize].shape;
        let surface = shape.surface(ray, nearest.hit);
        let (material, bumped) = self.material(nearest, || (*ray, surface.shading));
        let normal = bumped.unwrap_or(surface.shading);
        // Bumps do not affect which side is seen.
        let side = Side::hit(ray.direction, surface.normal);
        let point = Point {
            surface,
            normal: side.turn(normal),
            side,
            view: -ray.direction,
        };
        let material = match material {
            Cow::Borrowed(material) => material,
            Cow::Owned(material) => mapped.insert(material),
        };
        (point, material)
    }

    /// Returns the material of an object at a hit with its maps applied, and the shading normal if
    /// it has bumps; `coming` holds the ray's direction and the normal without bumps.
    #[inline]
    pub(crate) fn material(
        &self,
        nearest: Nearest,
        coming: impl Fn() -> (Ray, DVec3),
    ) -> (Cow<'_, Material>, Option<DVec3>) {
        let object = &self.scene.objects[nearest.object as usize];
        let material = &self.scene.materials[object.material_at(nearest.hit) as usize];
        let Some(maps) = &material.maps else {
            return (Cow::Borrowed(material), None);
        };
        let (ray, normal) = coming();
        let chart = object.shape.chart(&ray, nearest.hit);
        let applied = self.textures.applied(maps, material, chart.uv);
        let bumped = maps.bump;
        let bumped = bumped.map(|bump| self.textures.bumped(bump, &chart, normal));
        (Cow::Owned(applied), bumped)
    }
}
