//! Random numbers, and their mappings to pixels and directions. Knows no scenes.

mod filter;
mod mis;
mod sampler;
pub(crate) mod warp;

pub(crate) use filter::FilterSampler;
pub use mis::Densities;
pub(crate) use mis::{power_heuristic, weight_over_density};
pub(crate) use sampler::{Draws, Fours, Purpose, Sampler};
#[cfg(test)]
pub(crate) use warp::in_cone;
