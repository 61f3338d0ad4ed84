//! Photons: the light that lights send to matte and glossy surfaces over mirrors and boundaries, as
//! caustics, which paths from the camera meet by chance or never.
//!
//! Where photons are traced, a path takes from a [`photon map`](super::photon_map) what arrives at a
//! surface over mirrors and boundaries from lights that emit photons; it no longer counts it where a
//! scattered path meets such a light over them, and what lies between a surface and such a light
//! blocks it, transparent or not. Direct light and what mirrors and glass show of a light are the
//! path's, as are other lights, emission and the environment.
//!
//! Maps follow probabilistic progressive photon mapping (Knaus and Zwicker, "Progressive Photon
//! Mapping: A Probabilistic Approach", 2011): the samples with an index use the map with that index,
//! which depends on scene and settings alone, and whose kernel shrinks from map to map, so that the
//! mean of samples converges to the light of paths. Nothing is known of a pixel but its sum, unlike
//! in stochastic progressive photon mapping, where each has a radius of its own: pictures are
//! divided, interrupted and continued as those of paths are, with the same bytes.
//!
//! The first radius is that within which half of the first map's photons have 16 others: it follows
//! the light, so that the finest caustics are the sharpest.

mod aim;
mod emission;
mod flight;

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use super::photon_map::{Photon, PhotonMap};
use super::sampler::Sampler;
use super::world::World;
use crate::scene::{FalloffRule, GlossRule, MAX_SPP};
use emission::Emission;
use flight::follow;

/// The range of the number of photons of a map: as many as the picture has pixels.
const COUNTS: [u32; 2] = [1 << 14, 1 << 17];

/// Maps held at once: samples are taken by as many at a time.
pub(crate) const MAPS: u32 = 8;

/// Photons traced by one task.
const CHUNK: u32 = 1024;

/// The part of the photons within a kernel that shrinking it keeps: α.
const KEPT: f64 = 2.0 / 3.0;

/// The neighbours of a photon within the first radius.
const NEIGHBOURS: usize = 16;

/// The photons whose neighbours are counted.
const ASKED: usize = 256;

/// Apart from the random numbers of pixels.
const SEED: u32 = 0x7068_6F74;

/// The settings that photons depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PhotonRules {
    /// The photons of each map.
    pub(crate) count: u32,
    /// Maximum bounces of a path.
    pub(crate) depth: u32,
    pub(crate) seed: u32,
    /// Those of the world.
    pub(crate) falloff: FalloffRule,
    pub(crate) gloss: GlossRule,
}

/// What is needed to trace photon maps.
#[derive(Debug)]
pub(crate) struct Photons {
    rules: PhotonRules,
    emission: Emission,
    /// The radius of the first map.
    radius: f64,
    first: Arc<PhotonMap>,
}

/// The maps for the samples of a step.
#[derive(Clone, Debug)]
pub(crate) struct PhotonMaps {
    /// The index of the first.
    first: u32,
    maps: Vec<Arc<PhotonMap>>,
}

impl PhotonMaps {
    /// The map for the samples with an index.
    pub(crate) fn get(&self, index: u32) -> Option<&PhotonMap> {
        let at = index.checked_sub(self.first)?;
        self.maps.get(at as usize).map(AsRef::as_ref)
    }
}

impl PhotonRules {
    /// The number of photons of a map for a picture of this many pixels: about as many.
    pub(crate) fn count(pixels: usize) -> u32 {
        let [least, most] = COUNTS;
        let pixels = u32::try_from(pixels).unwrap_or(u32::MAX);
        pixels.clamp(least, most) / CHUNK * CHUNK
    }

    /// About the most bytes of all maps held at once, while another is sorted.
    pub(crate) fn bytes(&self) -> u64 {
        // More than one of most photons is kept only where mirrors face each other.
        let each = u64::from(2 * self.count) * (size_of::<Photon>() + size_of::<u32>()) as u64;
        u64::from(MAPS + 2) * each
    }
}

impl Photons {
    /// Traces the first map of a world, on the current thread pool, or returns the photons of another
    /// if they are the same; `None` once `cancelled` returns true.
    pub(crate) fn build(
        world: &World,
        rules: PhotonRules,
        known: Option<(&World, &Arc<Self>)>,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Option<Arc<Self>> {
        let serve = |(before, photons): &(&World, &Arc<Self>)| {
            photons.rules == rules
                && world.textures.are_those_of(&before.textures)
                && (Arc::ptr_eq(&world.scene, &before.scene) || world.scene == before.scene)
        };
        if let Some((_, photons)) = known.filter(serve) {
            return Some(Arc::clone(photons));
        }
        let mut photons = Self {
            rules,
            emission: Emission::of(world, cancelled)?,
            radius: 1.0,
            first: Arc::new(PhotonMap::new(&[], 1.0, 1.0)),
        };
        let first = photons.trace(world, 0, cancelled)?;
        let radius = radius(&first).unwrap_or_else(|| world.scene.bounds().half_diagonal() / 64.0);
        if 0.0 < radius && radius.is_finite() {
            photons.radius = radius;
        }
        photons.first = Arc::new(photons.map_of(&first, 0));
        Some(Arc::new(photons))
    }

    /// Returns the maps with these indices, traced on the current thread pool; `None` once
    /// `cancelled` returns true.
    pub(crate) fn maps(
        &self,
        world: &World,
        indices: Range<u32>,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Option<PhotonMaps> {
        let first = indices.start;
        let map = |index| {
            if let Some(map) = self.known(index) {
                return Some(map);
            }
            let photons = self.trace(world, index, cancelled)?;
            Some(Arc::new(self.map_of(&photons, index)))
        };
        let maps: Option<_> = indices.map(map).collect();
        Some(PhotonMaps { first, maps: maps? })
    }

    /// Returns the map with an index, traced on the current thread; `None` once `cancelled` returns
    /// true.
    pub(crate) fn map_alone(
        &self,
        world: &World,
        index: u32,
        cancelled: impl Fn() -> bool,
    ) -> Option<Arc<PhotonMap>> {
        if let Some(map) = self.known(index) {
            return Some(map);
        }
        let mut photons = Vec::new();
        for chunk in 0..self.chunks() {
            if cancelled() {
                return None;
            }
            photons.extend(self.chunk(world, index, chunk));
        }
        Some(Arc::new(self.map_of(&photons, index)))
    }

    /// The map with an index that need not be traced.
    fn known(&self, index: u32) -> Option<Arc<PhotonMap>> {
        let is_known = index == 0 || self.emission.power == 0.0;
        is_known.then(|| Arc::clone(&self.first))
    }

    /// Sorts the photons of a map.
    fn map_of(&self, photons: &[Photon], index: u32) -> PhotonMap {
        let unit = self.emission.power / f64::from(self.rules.count);
        PhotonMap::new(photons, self.radius_of(index), unit)
    }

    /// The radius of the kernel of a map: r²ᵢ₊₁ = r²ᵢ (i + α) / (i + 1), counting from 1.
    fn radius_of(&self, index: u32) -> f64 {
        let shrunk = |square: f64, number: u32| {
            let number = f64::from(number);
            square * ((number + KEPT) / (number + 1.0))
        };
        self.radius * (1..=index).fold(1.0, shrunk).sqrt()
    }

    /// Traces the photons of a map, in the order of their emission.
    fn trace(
        &self,
        world: &World,
        index: u32,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Photon>> {
        let chunks = (0..self.chunks()).into_par_iter();
        let chunks = chunks.map(|chunk| {
            let photons = self.chunk(world, index, chunk);
            (!cancelled()).then_some(photons)
        });
        let chunks: Option<Vec<_>> = chunks.collect();
        Some(chunks?.concat())
    }

    fn chunks(&self) -> u32 {
        if self.emission.power == 0.0 {
            0
        } else {
            self.rules.count / CHUNK
        }
    }

    /// Traces some photons of a map.
    fn chunk(&self, world: &World, index: u32, chunk: u32) -> Vec<Photon> {
        let mut arrived = Vec::new();
        for number in chunk * CHUNK..(chunk + 1) * CHUNK {
            // The sequence of a sampler is no longer.
            let (part, number) = (number / MAX_SPP, number % MAX_SPP);
            let sampler = Sampler::new(index, part, number, self.rules.seed ^ SEED);
            if let Some(emitted) = self.emission.emit(sampler) {
                follow(world, emitted, self.rules.depth, sampler, &mut arrived);
            }
        }
        arrived
    }
}

/// The radius within which half of the photons have enough neighbours, judging by some of them;
/// `None` if there are none apart from each other.
fn radius(photons: &[Photon]) -> Option<f64> {
    let step = photons.len().div_ceil(ASKED).max(1);
    let asked: Vec<_> = photons.iter().step_by(step).collect();
    let reach = |photon: &&Photon| {
        let distances = photons.iter();
        let distances = distances.map(|other| other.point.distance_squared(photon.point));
        let mut distances: Vec<_> = distances.collect();
        let at = NEIGHBOURS.min(distances.len() - 1);
        *distances.select_nth_unstable_by(at, f64::total_cmp).1
    };
    let mut reaches: Vec<_> = asked.par_iter().map(reach).collect();
    reaches.sort_unstable_by(f64::total_cmp);
    let later = reaches.into_iter().skip(asked.len() / 2);
    let mut positive = later.filter(|&square| 0.0 < square);
    positive.next().map(f64::sqrt)
}
