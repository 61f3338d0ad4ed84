//! Photons carry light from lights via mirrors and boundaries to matte and glossy surfaces: caustics,
//! which camera paths rarely or never sample.
//!
//! With photons, a path takes light that reached a surface via mirrors and boundaries from a
//! [`photon map`](self::map), if the light emits photons. It then ignores such a light where
//! a path that was scattered reaches it via mirrors or boundaries, and anything between a surface and
//! such a light blocks it, transparent or not. Direct light, lights seen in mirrors and glass, other
//! lights, emission and the environment are left to the path.
//!
//! Maps follow probabilistic progressive photon mapping (Knaus and Zwicker, "Progressive Photon
//! Mapping: A Probabilistic Approach", 2011): sample i of every pixel uses map i, which depends on
//! scene and settings alone, and whose kernel shrinks from map to map, so that the mean of the samples
//! converges to the light of paths. A pixel has no state but its sum, unlike in stochastic progressive
//! photon mapping, where each has a radius of its own: pictures are divided, interrupted and continued
//! like those of paths, with the same bytes.
//!
//! Within the first radius, half of the photons of the first map have 16 others: it follows the
//! light, so that fine caustics start out sharp.

mod aim;
mod emission;
mod map;
mod paths;

pub(crate) use map::{Photon, PhotonMap, hash};

use std::sync::Arc;

use rayon::prelude::*;

use crate::job::Settings;
pub(crate) use emission::{Emission, Emitted};
use scene::{FalloffRule, GlossRule, Integrator};

/// The range of the number of photons of a map: as many as the picture has pixels.
const COUNTS: [u32; 2] = [1 << 14, 1 << 17];

/// Maps held at once: samples are taken by as many at a time.
pub(crate) const MAPS: u32 = 8;

/// Photons traced by one task.
pub(crate) const CHUNK: u32 = 1024;

/// The part of the photons within a kernel that shrinking it keeps: α.
const KEPT: f64 = 2.0 / 3.0;

/// The neighbours of a photon within the first radius.
const NEIGHBOURS: usize = 16;

/// The photons whose neighbours are counted.
const ASKED: usize = 256;

/// Apart from the random numbers of pixels.
pub(crate) const SEED: u32 = 0x7068_6F74;

/// The settings that photons depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PhotonRules {
    /// The photons of each map.
    pub(crate) count: u32,
    /// Maximum bounces of a path.
    pub(crate) depth: u32,
    pub(crate) seed: u32,
    /// The falloff rule of the world.
    pub(crate) falloff: FalloffRule,
    /// The gloss rule of the world.
    pub(crate) gloss: GlossRule,
}

/// What is needed to trace photon maps.
#[derive(Debug)]
pub(crate) struct Photons {
    pub(crate) rules: PhotonRules,
    pub(crate) emission: Emission,
    /// The radius of the first map.
    pub(crate) radius: f64,
    pub(crate) first: Arc<PhotonMap>,
}

/// The maps for the samples of a step.
#[derive(Clone, Debug)]
pub(crate) struct PhotonMaps {
    /// The index of the first.
    pub(crate) first: u32,
    pub(crate) maps: Vec<Arc<PhotonMap>>,
}

impl PhotonMaps {
    /// The map for the samples with an index.
    pub(crate) fn get(&self, index: u32) -> Option<&PhotonMap> {
        let at = index.checked_sub(self.first)?;
        self.maps.get(at as usize).map(AsRef::as_ref)
    }
}

impl PhotonRules {
    /// The rules of these settings; `None` without any photons.
    pub(crate) fn of(settings: &Settings) -> Option<Self> {
        let has_photons = settings.integrator == Integrator::Photon && settings.surface().is_none();
        has_photons.then(|| Self {
            count: Self::count(settings.size.pixels()),
            depth: settings.depth,
            seed: settings.seed,
            falloff: settings.falloff,
            gloss: settings.gloss,
        })
    }

    /// The number of photons of a map for a picture of this many pixels: about as many.
    pub(crate) fn count(pixels: usize) -> u32 {
        let [least, most] = COUNTS;
        let pixels = u32::try_from(pixels).unwrap_or(u32::MAX);
        pixels.clamp(least, most) / CHUNK * CHUNK
    }

    /// About how many bytes all maps held at once take, while another is sorted, for a picture of `spp`
    /// samples, if each map keeps this many photons; the most if that is not known.
    pub(crate) fn bytes(&self, spp: u32, kept: Option<u64>) -> u64 {
        // More than one of most photons is kept only where mirrors face each other.
        let kept = kept.unwrap_or_else(|| u64::from(2 * self.count));
        let photon = size_of::<Photon>() as u64;
        let map = kept * photon + kept.next_power_of_two() * size_of::<u32>() as u64;
        // The first is held besides those of a step. A map is sorted from a copy, and where photons arrive
        // they are listed with room for as many more.
        let held = u64::from(1 + MAPS.min(spp));
        held * map + 3 * kept * photon
    }
}

impl Photons {
    /// The photons that the first map keeps.
    pub(crate) fn kept(&self) -> u64 {
        self.first.count() as u64
    }

    /// The map with an index that need not be traced.
    pub(crate) fn known(&self, index: u32) -> Option<Arc<PhotonMap>> {
        let is_known = index == 0 || self.emission.power == 0.0;
        is_known.then(|| Arc::clone(&self.first))
    }

    /// Sorts the photons of a map.
    pub(crate) fn map_of(&self, photons: &[Photon], index: u32) -> PhotonMap {
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

    /// The number of tasks that trace a map.
    pub(crate) fn chunks(&self) -> u32 {
        if self.emission.power == 0.0 {
            0
        } else {
            self.rules.count / CHUNK
        }
    }
}

/// The radius within which half of the photons have enough neighbours, judging by some of them;
/// `None` if there are none apart from each other.
pub(crate) fn radius(photons: &[Photon]) -> Option<f64> {
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
