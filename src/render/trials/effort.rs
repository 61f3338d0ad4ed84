//! How much work trials are, counted rather than timed: advice is the same on every machine.

use super::candidates::glows;
use crate::geometry::Shape;
use crate::render::frame::{Frame, Settings};
use crate::render::photons::PhotonRules;
use crate::render::probe::RAY_BUDGET;
use crate::scene::{FalloffRule, Integrator, Scene};

/// The rays of all trials for a picture, with what else takes as long: less than a second of a core.
const MOST: u64 = 4_000_000;

/// What it takes to trace a photon and to find it, in rays.
const PHOTON: u64 = 64;

/// Scenes with more objects and triangles are not prepared unasked: that takes longer than the trials.
const MOST_TRIANGLES: usize = 1_000_000;

/// What is left of the work permitted, and what that of a picture depends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    left: u64,
    lights: usize,
    /// Whether anything emits photons, without a falloff and by the square.
    emits: [bool; 2],
}

impl Effort {
    /// All of it, for a scene.
    pub(super) fn of(scene: &Scene) -> Self {
        let emits = [FalloffRule::None, FalloffRule::Square].map(|rule| {
            let mut lights = scene.lights.iter();
            glows(scene) || lights.any(|light| light.emits_photons(rule))
        });
        Self {
            left: MOST,
            lights: scene.lights.len(),
            emits,
        }
    }

    /// Whether anything emits photons by a falloff.
    pub(super) fn emits(&self, falloff: FalloffRule) -> bool {
        self.emits[usize::from(falloff == FalloffRule::Square)]
    }

    /// Takes what a picture was; returns the rays of a sample of it.
    pub(super) fn spend(&mut self, picture: &Frame, settings: &Settings) -> f64 {
        let rays = picture.progress.rays;
        let all = rays.saturating_add(self.photons(settings));
        self.left = self.left.saturating_sub(all);
        rays as f64 / samples(settings)
    }

    /// Whether a picture with so many rays a sample takes at most this part of what is left.
    pub(super) fn permits(&self, settings: &Settings, rate: f64, part: f64) -> bool {
        let all = rate * samples(settings) + self.photons(settings) as f64;
        all <= part * self.left as f64
    }

    /// More rays than any sample takes.
    pub(super) fn most_rays(&self, settings: &Settings) -> f64 {
        let depth = settings.depth.min(RAY_BUDGET);
        // A path goes on by one ray, and two more find what glows; others branch in two.
        let [rays, shadows] = if settings.integrator.traces_paths() {
            [f64::from(depth) + 1.0, 2.0]
        } else {
            let branches = libm::exp2(f64::from(depth) + 1.0);
            [branches.min(f64::from(RAY_BUDGET)), 0.0]
        };
        rays * (1.0 + shadows + self.lights as f64)
    }

    /// What photons of a picture take.
    fn photons(&self, settings: &Settings) -> u64 {
        if settings.integrator != Integrator::Photon || !self.emits(settings.falloff) {
            return 0;
        }
        let count = PhotonRules::count(settings.size.pixels());
        u64::from(settings.spp) * u64::from(count) * PHOTON
    }
}

fn samples(settings: &Settings) -> f64 {
    settings.size.pixels() as f64 * f64::from(settings.spp)
}

/// Whether preparing a scene takes about as long as reading it, or is quick.
pub(super) fn is_small(scene: &Scene) -> bool {
    let triangles = scene.objects.iter().map(|object| match &object.shape {
        Shape::Mesh(instance) => instance.mesh().len(),
        _ => 1,
    });
    triangles.fold(0, usize::saturating_add) <= MOST_TRIANGLES
}
