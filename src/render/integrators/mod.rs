//! Radiance along camera rays, and what else is known of the first surface.
//!
//! Whitted's integrator traces a [wave](WhittedWave) of samples at once; the other two follow paths
//! bounce by bounce, the third with the light of photons. All query the world through a [`probe`].
//!
//! The steps of [`path`] and [`whitted`] are open to explanations, which run them for one sample.

mod caustics;
mod direct;
mod first_hit;
mod frame_context;
mod hit_material;
mod light_component;
pub(crate) mod path;
mod photon;
mod probe;
mod tracer;
mod vertex;
pub(crate) mod whitted;

pub(crate) use direct::{LightGeometry, ShadingPoints};
pub(crate) use first_hit::{Guide, first_hit, guide};
pub(crate) use frame_context::FrameContext;
pub(crate) use light_component::LightComponent;
#[cfg(test)]
pub(crate) use photon::PhotonMaps;
pub(crate) use photon::{MAPS, PhotonMap, PhotonRules, Photons};
pub use probe::Counts;
pub(crate) use probe::{Probe, Sample, SampleResult};
pub(crate) use tracer::Tracer;
pub(crate) use vertex::Vertex;
pub(crate) use whitted::{RayState, WhittedWave};
