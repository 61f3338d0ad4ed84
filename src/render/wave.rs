//! Camera samples traced together, one ray of each at a time.

use super::intersect::Nearest;
use super::probe::{Counts, RAY_BUDGET, Sample};
use super::sampler::Sampler;
use super::surfaces::Landing;
use crate::geometry::{Packets, Ray};
use crate::scene::{Material, Rgb};

/// The state of a ray apart from its geometry.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayState {
    /// Index of its sample.
    pub(super) tree: usize,
    /// Weight of its radiance in the pixel.
    pub(super) weight: Rgb,
    /// Absorption per unit of length up to the next hit.
    pub(super) absorption: Rgb,
    pub(super) bounce: u32,
    /// Node in the ray tree, which selects its random numbers.
    pub(super) node: u32,
}

/// The rays of a camera sample.
#[derive(Debug, Default)]
pub(super) struct RayTree {
    /// Rays yet to be traced, last in first out.
    pub(super) pending: Vec<(Ray, RayState)>,
    /// The number of rays traced so far, apart from shadow rays.
    pub(super) traced: u32,
}

/// The shaded hit of a ray.
#[derive(Debug)]
pub(super) struct Arrived<'w> {
    pub(super) found: Found<'w>,
    /// Weight of its radiance in the pixel.
    pub(super) weight: Rgb,
    /// Radiance toward the origin of the ray.
    pub(super) radiance: Rgb,
}

/// The material at the hit of a ray.
#[derive(Clone, Copy, Debug)]
pub(super) enum Found<'w> {
    /// The ray missed.
    Nothing,
    /// A material of the scene without maps.
    Plain(&'w Material),
    /// A material with its maps applied, by its index in [`Wave::mapped`].
    Mapped(usize),
}

impl<'w> Found<'w> {
    /// Returns the material, given those with maps applied.
    #[inline]
    pub(super) fn material<'m>(self, mapped: &'m [Material]) -> Option<&'m Material>
    where
        'w: 'm,
    {
        match self {
            Self::Nothing => None,
            Self::Plain(material) => Some(material),
            Self::Mapped(place) => mapped.get(place),
        }
    }
}

/// Camera samples traced together; the current ray of each forms the front.
#[derive(Debug, Default)]
pub(crate) struct Wave<'w> {
    pub(super) trees: Vec<RayTree>,
    /// Indices of the unfinished trees.
    growing: Vec<usize>,
    /// The rays of the front and their states.
    pub(super) rays: Packets,
    pub(super) states: Vec<RayState>,
    /// Nearest hits of the front.
    pub(super) nearest: Vec<Option<Nearest>>,
    /// Surface points of the front.
    pub(super) landings: Vec<Landing>,
    /// Shaded hits of the front.
    pub(super) arrived: Vec<Arrived<'w>>,
    /// Materials of the hits with maps applied.
    pub(super) mapped: Vec<Material>,
    /// Shadow rays from the hits to one light.
    pub(super) shadows: Packets,
    /// For each shadow ray, the index of its hit and the reflected light if unoccluded.
    pub(super) asking: Vec<(usize, Rgb)>,
    pub(super) transmittances: Vec<f64>,
    /// For each light, the last simple object that occluded it.
    pub(super) blockers: Vec<Option<u32>>,
}

impl Wave<'_> {
    /// Starts a tree for each sample.
    pub(super) fn start(&mut self, samples: &[Sample]) {
        self.trees.resize_with(samples.len(), RayTree::default);
        self.growing.clear();
        self.growing.extend(0..samples.len());
        for (number, (tree, sample)) in self.trees.iter_mut().zip(samples).enumerate() {
            let state = RayState {
                tree: number,
                weight: Rgb::ONE,
                absorption: Rgb::ZERO,
                bounce: 0,
                node: Sampler::ROOT,
            };
            tree.traced = 0;
            tree.pending.clear();
            tree.pending.push((sample.ray, state));
        }
    }

    /// Moves the next ray of each tree to the front; returns whether there are any.
    pub(super) fn advance(&mut self, samples: &[Sample], counts: &mut Counts) -> bool {
        self.rays.clear();
        self.states.clear();
        let Self {
            trees,
            growing,
            rays,
            states,
            ..
        } = self;
        growing.retain(|&number| {
            let tree = &mut trees[number];
            let Some((ray, state)) = tree.pending.pop() else {
                return false;
            };
            if tree.traced == RAY_BUDGET {
                counts.over_budget += 1;
                return false;
            }
            tree.traced += 1;
            let end = match state.bounce {
                0 => samples[number].reach,
                _ => f64::INFINITY,
            };
            rays.push(&ray, end);
            states.push(state);
            true
        });
        counts.rays += states.len() as u64;
        !states.is_empty()
    }
}
