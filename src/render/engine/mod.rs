//! Traces jobs: films, the order of their samples, workers, blocks, and whether a job fits.

mod adaptive;
mod assembly;
mod block;
mod block_tracer;
mod blocks;
mod checkpoint;
mod edit_difference;
mod film;
mod noise;
mod pass_schedule;
mod pixel_sampler;
mod preflight;
mod renderer;
mod renderer_state;
mod tile;
mod tracing;
mod worker;

pub use assembly::Assembly;
pub use block::Block;
pub use block_tracer::BlockTracer;
pub use blocks::{BLOCK, Blocks};
pub use checkpoint::Checkpoint;
#[cfg(test)]
pub(crate) use edit_difference::edit_difference;
#[cfg(test)]
pub(crate) use film::Film;
#[cfg(test)]
pub(crate) use noise::Doubling;
#[cfg(test)]
pub(crate) use pass_schedule::{Step, steps};
pub use preflight::{Refusal, check_memory, memory_for, memory_for_blocks, photons_kept};
pub use renderer::{Renderer, Threads};
pub use tile::PixelHistory;
#[cfg(test)]
pub(crate) use tile::Remembers;
