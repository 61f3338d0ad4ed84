//! Camera samples traced together, one ray of each at a time.

use std::mem;

use crate::integrators::hit_material::HitMaterial;
use crate::integrators::probe::{Counts, RAY_BUDGET, Sample};
use crate::sampling::Sampler;
use crate::world::{HitPoints, NearestHits};
use geometry::{Packets, Ray};
use scene::{Material, Rgb};

/// The state of a ray apart from its geometry.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayState {
    /// Index of its sample.
    pub(crate) tree: usize,
    /// Weight of its radiance in the pixel.
    pub(crate) weight: Rgb,
    /// Absorption per unit of length up to the next hit.
    pub(crate) absorption: Rgb,
    pub(crate) bounce: u32,
    /// Node in the ray tree, which selects its random numbers.
    pub(crate) node: u32,
}

/// The rays of a camera sample.
#[derive(Debug, Default)]
pub(crate) struct RayTree {
    /// Rays to be traced after the one in the next front, last in first out.
    pub(crate) pending: Vec<(Ray, RayState)>,
    /// The number of rays traced so far, apart from shadow rays.
    pub(crate) traced: u32,
}

impl RayTree {
    /// Moves the tree's next ray to the next front: `pushed`, the last secondary ray of the current one,
    /// or else the last pending one. A ray beyond the budget stays pending and ends the tree.
    #[inline(always)]
    pub(crate) fn move_on(&mut self, pushed: Option<(Ray, RayState)>, next: &mut Front) {
        let Some((ray, state)) = pushed.or_else(|| self.pending.pop()) else {
            return;
        };
        if self.traced == RAY_BUDGET {
            self.pending.push((ray, state));
            next.refused += 1;
        } else {
            self.traced += 1;
            next.push(&ray, f64::INFINITY, state);
        }
    }
}

/// At most one ray of each tree, in the order of the trees.
#[derive(Debug, Default)]
pub(crate) struct Front {
    pub(crate) rays: Packets,
    pub(crate) states: Vec<RayState>,
    /// The number of trees that end here because their rays exceed the budget.
    refused: u64,
}

impl Front {
    fn clear(&mut self) {
        self.rays.clear();
        self.states.clear();
        self.refused = 0;
    }

    /// Adds a ray, which ends at a distance.
    #[inline(always)]
    fn push(&mut self, ray: &Ray, end: f64, state: RayState) {
        self.rays.push(ray, end);
        self.states.push(state);
    }
}

/// The shaded hit of a ray.
#[derive(Debug)]
pub(crate) struct ShadedHit<'w> {
    pub(crate) material: HitMaterial<'w>,
    /// Weight of its radiance in the pixel.
    pub(crate) weight: Rgb,
    /// Radiance toward the origin of the ray.
    pub(crate) radiance: Rgb,
}

/// Camera samples traced together; the current ray of each forms the front.
#[derive(Debug, Default)]
pub(crate) struct WhittedWave<'w> {
    pub(crate) trees: Vec<RayTree>,
    pub(crate) front: Front,
    /// The front after this one.
    pub(crate) next: Front,
    /// Nearest hits of the front, packet by packet.
    pub(crate) nearest: Vec<NearestHits>,
    /// Surface points of the front.
    pub(crate) hit_points: Vec<HitPoints>,
    /// Shaded hits of the front.
    pub(crate) shaded: Vec<ShadedHit<'w>>,
    /// Materials of the hits with maps applied.
    pub(crate) mapped: Vec<Material>,
    /// Shadow rays from the hits to one light.
    pub(crate) shadows: Packets,
    /// For each shadow ray, the index of its hit and the reflected light if unoccluded.
    pub(crate) unblocked: Vec<(usize, Rgb)>,
    pub(crate) transmittances: Vec<f64>,
    /// For each light, the last simple object that occluded it.
    pub(crate) blockers: Vec<Option<u32>>,
}

impl WhittedWave<'_> {
    /// Starts a tree for each sample.
    pub(crate) fn start(&mut self, samples: &[Sample]) {
        self.trees.resize_with(samples.len(), RayTree::default);
        self.next.clear();
        for (number, (tree, sample)) in self.trees.iter_mut().zip(samples).enumerate() {
            tree.traced = 1;
            tree.pending.clear();
            let state = RayState {
                tree: number,
                weight: Rgb::ONE,
                absorption: Rgb::ZERO,
                bounce: 0,
                node: Sampler::ROOT,
            };
            self.next.push(&sample.ray, sample.reach, state);
        }
    }

    /// Makes the next front the current one; returns whether it has any rays.
    pub(crate) fn advance(&mut self, counts: &mut Counts) -> bool {
        mem::swap(&mut self.front, &mut self.next);
        self.next.clear();
        counts.over_budget += self.front.refused;
        counts.rays += self.front.states.len() as u64;
        !self.front.states.is_empty()
    }
}
