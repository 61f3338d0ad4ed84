//! Camera samples on their way side by side: one ray of each at a time.

use super::intersect::Nearest;
use super::probe::{Counts, Matter, RAY_BUDGET, Sample};
use super::sampler::Sampler;
use super::surfaces::Landing;
use crate::geometry::{Packets, Ray};
use crate::scene::Rgb;

/// What a ray brings with it, besides where it goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// The number of its sample.
    pub(super) tree: usize,
    /// Which part of its radiance reaches the eye.
    pub(super) weight: Rgb,
    /// What is lost per unit of length until it meets something.
    pub(super) absorption: Rgb,
    pub(super) bounce: u32,
    /// Its place in the tree of rays, for numbers of its own.
    pub(super) node: u32,
}

/// The rays of a camera sample.
#[derive(Debug, Default)]
pub(super) struct Tree {
    /// Those yet to be traced, the last first.
    pub(super) pending: Vec<(Ray, Way)>,
    traced: u32,
}

/// What a ray has come to.
#[derive(Debug)]
pub(super) struct Arrived<'w> {
    /// [`Matter::Flat`] if no light is asked for: it met nothing, or what shines by itself.
    pub(super) matter: Matter<'w>,
    /// Which part of its radiance reaches the eye.
    pub(super) weight: Rgb,
    /// What leaves the point toward where the ray came from.
    pub(super) radiance: Rgb,
}

/// Camera samples on their way side by side: one ray of each at a time, which are the front.
#[derive(Debug, Default)]
pub(crate) struct Wave<'w> {
    pub(super) trees: Vec<Tree>,
    /// The numbers of the trees that are not done.
    growing: Vec<usize>,
    /// The rays of the front, and what each brings with it.
    pub(super) rays: Packets,
    pub(super) ways: Vec<Way>,
    /// What each meets.
    pub(super) nearest: Vec<Option<Nearest>>,
    /// Where each comes to.
    pub(super) landings: Vec<Landing>,
    /// What is there.
    pub(super) arrived: Vec<Arrived<'w>>,
    /// The ways from there to a light.
    pub(super) shadows: Packets,
    /// For each of these the ray that came, and what is sent back if nothing is in the way.
    pub(super) asking: Vec<(usize, Rgb)>,
    pub(super) transmittances: Vec<f64>,
    /// By light: the last simple object that kept it from a surface.
    pub(super) blockers: Vec<Option<u32>>,
}

impl Wave<'_> {
    /// Plants a tree for each sample.
    pub(super) fn start(&mut self, samples: &[Sample]) {
        self.trees.resize_with(samples.len(), Tree::default);
        self.growing.clear();
        self.growing.extend(0..samples.len());
        for (number, (tree, sample)) in self.trees.iter_mut().zip(samples).enumerate() {
            let way = Way {
                tree: number,
                weight: Rgb::ONE,
                absorption: Rgb::ZERO,
                bounce: 0,
                node: Sampler::ROOT,
            };
            tree.traced = 0;
            tree.pending.clear();
            tree.pending.push((sample.ray, way));
        }
    }

    /// Takes the next ray of each tree to the front; `false` if there is none.
    pub(super) fn advance(&mut self, samples: &[Sample], counts: &mut Counts) -> bool {
        self.rays.clear();
        self.ways.clear();
        let Self {
            trees,
            growing,
            rays,
            ways,
            ..
        } = self;
        growing.retain(|&number| {
            let tree = &mut trees[number];
            let Some((ray, way)) = tree.pending.pop() else {
                return false;
            };
            if tree.traced == RAY_BUDGET {
                counts.over_budget += 1;
                return false;
            }
            tree.traced += 1;
            let end = match way.bounce {
                0 => samples[number].reach,
                _ => f64::INFINITY,
            };
            rays.push(&ray, end);
            ways.push(way);
            true
        });
        counts.rays += ways.len() as u64;
        !ways.is_empty()
    }
}
