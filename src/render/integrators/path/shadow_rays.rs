//! Next event estimation at the surfaces that paths meet at a bounce, all together: light samples in
//! lanes, shadow rays in packets. [Lights](super::light_samples) and [emitters](super::emitter_samples)
//! are sampled one after another, and share what is here.

use crate::integrators::probe::Probe;
use crate::world::Occlusion;
use geometry::Packets;
use scene::Rgb;

/// Shadow rays, and what they carry.
#[derive(Debug, Default)]
pub(crate) struct ShadowRays {
    pub(super) rays: Packets,
    pub(super) transmittances: Vec<f64>,
}

/// The light that a surface sends back along a path, without its emission.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VertexLight {
    /// Index of the path.
    pub(crate) path: usize,
    /// Whether its side emits and reflects light.
    pub(crate) is_lit: bool,
    /// The light of lights that it reflects.
    pub(crate) of_lights: Rgb,
    /// The light of emitters that it reflects.
    pub(crate) of_emitters: Rgb,
    /// The light of photons that it reflects.
    pub(crate) of_photons: Rgb,
}

impl ShadowRays {
    /// Computes the transmittances of all rays, given the last simple object that occluded one.
    pub(super) fn trace(
        &mut self,
        probe: &mut Probe<'_>,
        blocker: &mut Option<u32>,
        occlusion: Occlusion,
    ) {
        probe.world.transmittance_each(
            &self.rays,
            occlusion,
            blocker,
            &mut probe.crossed,
            &mut self.transmittances,
        );
    }
}

impl VertexLight {
    /// None yet.
    pub(crate) fn new(path: usize, is_lit: bool) -> Self {
        Self {
            path,
            is_lit,
            of_lights: Rgb::ZERO,
            of_emitters: Rgb::ZERO,
            of_photons: Rgb::ZERO,
        }
    }
}
