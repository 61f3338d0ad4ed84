//! Random numbers, and their mappings to pixels and directions. Knows no scenes.

mod filter;
mod heuristic;
mod sampler;
pub(crate) mod warp;

pub(crate) use filter::Spread;
pub use heuristic::Densities;
pub(crate) use heuristic::{power_heuristic, share};
pub(crate) use sampler::{Draws, Fours, Sampler, Use};
#[cfg(test)]
pub(crate) use warp::in_cone;
