//! Radiance along camera rays, computed by the chosen integrator.

use super::light_component::LightComponent;
use super::path::{PathWave, by_paths};
use super::photon::PhotonMaps;
use super::probe::{Counts, Probe, Sample, SampleResult};
use super::whitted::{WhittedWave, by_whitted};
use crate::world::World;
use scene::Integrator;

/// Traces samples, reusing scratch space and accumulating counts.
///
/// Results are meaningless once `cancelled` returns true.
pub(crate) struct Tracer<'w> {
    integrator: Integrator,
    /// The photons of samples, if there are to be any.
    photon_maps: Option<&'w PhotonMaps>,
    probe: Probe<'w>,
    wave: WhittedWave<'w>,
    path_wave: PathWave,
}

impl<'w> Tracer<'w> {
    /// Creates a tracer that follows rays up to bounce `depth`.
    pub(crate) fn new(
        world: &'w World,
        integrator: Integrator,
        depth: u32,
        cancelled: &'w dyn Fn() -> bool,
    ) -> Self {
        Self {
            integrator,
            photon_maps: None,
            probe: Probe::new(world, depth, cancelled),
            wave: WhittedWave::default(),
            path_wave: PathWave::default(),
        }
    }

    /// Enables recording of dependencies.
    pub(crate) fn noting(mut self) -> Self {
        self.probe.crossed.notes = true;
        self
    }

    /// Adds the light of photons to paths, which must be traced for all samples.
    pub(crate) fn with_photons(mut self, maps: Option<&'w PhotonMaps>) -> Self {
        self.photon_maps = maps;
        self
    }

    /// Restricts the light to a share.
    pub(crate) fn gathering(mut self, component: LightComponent) -> Self {
        self.probe.component = component;
        self.probe.depth = component.depth(self.integrator, self.probe.depth);
        self
    }

    /// Computes the results of camera samples with the same index, in their order.
    pub(crate) fn trace(&mut self, samples: &[Sample], seen: &mut Vec<SampleResult>) {
        seen.clear();
        let probe = &mut self.probe;
        match self.integrator {
            Integrator::Whitted => by_whitted(probe, &mut self.wave, samples, seen),
            Integrator::Path | Integrator::Photon => {
                let index = samples.first().map(|sample| sample.sampler.index());
                let maps = self.photon_maps.zip(index);
                probe.photon_map = maps.and_then(|(maps, index)| maps.get(index));
                by_paths(probe, &mut self.path_wave, samples, seen);
            }
        }
    }

    /// Rays traced so far.
    pub(crate) fn counts(&self) -> Counts {
        self.probe.counts
    }

    /// Counts rays traced elsewhere.
    pub(crate) fn count(&mut self, rays: usize) {
        self.probe.counts.rays += rays as u64;
    }

    /// Whether to stop.
    pub(crate) fn is_cancelled(&self) -> bool {
        (self.probe.cancelled)()
    }
}
