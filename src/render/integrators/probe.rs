//! What all integrators share: the queries of a world, and the samples that they answer.

use glam::DVec2;

use super::light_component::LightComponent;
use super::photon::PhotonMap;
use crate::job::NO_OBJECT;
use crate::sampling::Sampler;
use crate::world::{Crossed, Dependencies, Occlusion, World};
use geometry::Ray;
use scene::{FalloffRule, Light, Rgb};

/// Ray budget of a camera sample, not counting shadow rays. With reflection and transmission both
/// 1, a tree of depth 30 would have two billion.
pub(crate) const RAY_BUDGET: u32 = 4096;

/// Queries a world for radiance and counts the rays.
///
/// Results are meaningless once `cancelled` returns true.
pub(crate) struct Probe<'w> {
    pub(crate) world: &'w World,
    /// Whether to stop; polled every few hundred rays.
    pub(crate) cancelled: &'w dyn Fn() -> bool,
    /// Maximum bounces.
    pub(crate) depth: u32,
    /// The part of the light that is traced.
    pub(crate) component: LightComponent,
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
    /// Counts shadow rays.
    #[inline]
    pub(crate) fn add_shadow_rays(&mut self, rays: u64) {
        self.rays += rays;
        self.shadow_rays += rays;
    }

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
pub(crate) struct SampleResult {
    /// Radiance or AOV.
    pub(crate) radiance: Rgb,
    /// The first object hit, or [`NO_OBJECT`].
    pub(crate) object: u32,
    /// Dependencies of the radiance.
    pub(crate) touched: Dependencies,
    /// Rays traced for the radiance, including shadow rays.
    pub(crate) rays: u32,
}

impl SampleResult {
    /// The initial result of a ray.
    pub(crate) const NOTHING: Self = Self {
        radiance: Rgb::ZERO,
        object: NO_OBJECT,
        touched: Dependencies::NOTHING,
        rays: 0,
    };
}

/// Whether paths may go on from the surfaces of a bounce.
#[derive(Clone, Copy, Debug)]
pub(crate) enum BounceStage {
    /// They may.
    Inner,
    /// They end there: no BSDF sample can hit a light any more.
    Last,
}

impl<'w> Probe<'w> {
    /// Creates a probe that follows rays up to bounce `depth`.
    pub(crate) fn new(world: &'w World, depth: u32, cancelled: &'w dyn Fn() -> bool) -> Self {
        Self {
            world,
            cancelled,
            depth,
            component: LightComponent::All,
            photon_map: None,
            crossed: Crossed::default(),
            counts: Counts::default(),
        }
    }

    /// Adds the light of photons to paths.
    pub(crate) fn with_photons(self, photon_map: Option<&'w PhotonMap>) -> Self {
        Self { photon_map, ..self }
    }

    /// Whether a bounce of a path is its last.
    #[inline]
    pub(crate) fn stage(&self, bounce: u32) -> BounceStage {
        if bounce < self.depth {
            BounceStage::Inner
        } else {
            BounceStage::Last
        }
    }

    /// Whether photons carry what arrives from a light via mirrors and boundaries.
    #[cold]
    pub(crate) fn is_by_photons(&self, light: &Light) -> bool {
        self.photon_map.is_some() && light.emits_photons(FalloffRule::None)
    }

    /// What shadow rays to a light pass through.
    pub(crate) fn occlusion(&self, light: &Light) -> Occlusion {
        // Photons carry what passes through.
        if self.photon_map.is_some() && self.is_by_photons(light) {
            Occlusion::Complete
        } else {
            Occlusion::ByMaterial
        }
    }
}
