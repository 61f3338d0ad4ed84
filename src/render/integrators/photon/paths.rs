//! The paths of photons from lights via mirrors and boundaries.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use super::map::{Photon, PhotonMap};
use super::{CHUNK, Emission, Emitted, PhotonMaps, PhotonRules, Photons, SEED, radius};
use crate::material::{Bsdf, transmitted};
use crate::sampling::{Purpose, Sampler};
use crate::world::World;
use geometry::IsCancelled;
use scene::MAX_SPP;

impl Photons {
    /// Traces the first map of a world, on the current thread pool, or returns the photons of another
    /// if they are the same; `None` once `cancelled` returns true.
    pub(crate) fn build(
        world: &World,
        rules: PhotonRules,
        known: Option<(&World, &Arc<Self>)>,
        cancelled: IsCancelled<'_>,
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
        cancelled: IsCancelled<'_>,
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
        cancelled: &dyn Fn() -> bool,
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

    /// Traces the photons of a map, in the order of their emission.
    fn trace(&self, world: &World, index: u32, cancelled: IsCancelled<'_>) -> Option<Vec<Photon>> {
        let chunks = (0..self.chunks()).into_par_iter();
        let chunks = chunks.map(|chunk| {
            let photons = self.chunk(world, index, chunk);
            (!cancelled()).then_some(photons)
        });
        let chunks: Option<Vec<_>> = chunks.collect();
        Some(chunks?.concat())
    }

    /// Traces some photons of a map.
    fn chunk(&self, world: &World, index: u32, chunk: u32) -> Vec<Photon> {
        let mut arrived = Vec::new();
        for number in chunk * CHUNK..(chunk + 1) * CHUNK {
            // The sequence of a sampler is no longer.
            let (part, number) = (number / MAX_SPP, number % MAX_SPP);
            let sampler = Sampler::new(index, part, number, self.rules.seed ^ SEED);
            if let Some(emitted) = self.emission.emit(sampler) {
                trace_photon(world, emitted, self.rules.depth, sampler, &mut arrived);
            }
        }
        arrived
    }
}

/// Follows a photon via mirrors and boundaries and keeps it where it arrives at surfaces that
/// scatter.
fn trace_photon(
    world: &World,
    emitted: Emitted,
    depth: u32,
    sampler: Sampler,
    arrived: &mut Vec<Photon>,
) {
    let Emitted {
        mut ray,
        mut power,
        is_seen,
    } = emitted;
    let mut kept = 0;
    for bounce in 0..=depth {
        let Some(nearest) = world.nearest(&ray, f64::INFINITY) else {
            return;
        };
        let distance = nearest.hit.t;
        if world.sphere_lights.nearest(&ray, distance).is_some() {
            return;
        }
        let mut mapped = None;
        let (point, material) = world.shading_point(&ray, nearest, &mut mapped);
        let bsdf = Bsdf::at(&point, material, world.gloss);
        if 0 < bounce && bsdf.takes_photons(&point) {
            kept += 1;
            let [.., chance] = sampler.four(bounce, Purpose::Spread);
            // Of the photons kept on one way, of which mirrors make many, the nth with a chance
            // of 1/n, which bounds the memory.
            if chance * f64::from(kept) < 1.0 {
                arrived.push(Photon {
                    point: point.surface.point,
                    toward: point.view.as_vec3().to_array(),
                    normal: point.side.turn(point.surface.normal).as_vec3().to_array(),
                    power: (f64::from(kept) * power).as_vec3().to_array(),
                    bounces: (bounce + u32::from(is_seen)) as u16,
                });
            }
        }
        let Some(next) = bsdf.sample_adjoint(&point, sampler, bounce) else {
            return;
        };
        power *= next.weight * transmitted(next.absorption, distance);
        if !power.is_finite() {
            return;
        }
        ray = next.ray;
    }
}
