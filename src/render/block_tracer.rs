//! Traces blocks of a picture, without a worker.

use std::sync::Arc;
use std::time::Duration;

use rayon::ThreadPool;
use rayon::prelude::*;

use super::block::{Block, Blocks};
use super::frame::{Aov, Job};
use super::gather::Gather;
use super::refusal::{self, Refusal};
use super::renderer::{Threads, pool};
use super::shot::Shot;
use super::tile::Work;
use super::tracer::Tracer;
use super::world::World;

/// A scene prepared to be traced block by block on threads of its own.
#[derive(Debug)]
pub struct BlockTracer {
    world: World,
    job: Job,
    pool: ThreadPool,
}

impl BlockTracer {
    /// Prepares to trace a job, whose limit and frames do not matter. `None` once `stopped` returns
    /// true. Refuses a scene whose acceleration structures do not fit into memory; how many blocks are
    /// held at once is up to the caller.
    pub fn new(
        job: Job,
        threads: usize,
        stopped: impl Fn() -> bool + Sync,
    ) -> Result<Option<Self>, Refusal> {
        let pool = pool(Threads::Exactly(threads)).map_err(|error| Refusal::Threads {
            count: threads,
            reason: error.to_string(),
        })?;
        job.settings.traced().within(job.settings.size)?;
        refusal::check_memory(&job, refusal::memory_for_blocks(&job, 0))?;
        let build = || {
            let rules = job.settings.rules();
            World::build(Arc::clone(&job.scene), &job.images, rules, None, &stopped)
        };
        let world = pool.install(build);
        Ok(world.map(|world| Self { world, job, pool }))
    }

    /// The blocks of the traced region.
    pub fn blocks(&self) -> Blocks {
        Blocks::of(self.job.settings.traced().size())
    }

    /// Continues blocks to `spp` samples of each pixel, and returns once all are handed over: each
    /// when it is done, and whenever it took another `interval`. Once `stopped` returns true, those
    /// begun are handed over soon, as they are.
    pub fn trace(
        &self,
        blocks: impl Iterator<Item = Block> + Send,
        spp: u32,
        interval: Duration,
        stopped: impl Fn() -> bool + Sync,
        hand_over: impl Fn(Block) + Sync,
    ) {
        let settings = self.job.settings;
        // As in previews, so that they share the compiled code.
        let cancelled: &(dyn Fn() -> bool + Sync) = &stopped;
        let shot = Shot::new(&self.world, &self.job.camera, settings);
        let work = || {
            let tracer = Tracer::new(&self.world, settings.integrator, settings.depth, cancelled);
            let tracer = tracer.gathering(Gather::of(settings.aov));
            Work::new(match settings.aov {
                // Only then are rays told apart by samples.
                Some(Aov::Cost) => tracer.noting(),
                _ => tracer,
            })
        };
        let trace = |work: &mut Work<'_, _>, mut block: Block| {
            if !stopped() {
                let keep = |block: &Block| hand_over(block.clone());
                block.trace(spp, &shot, work, (interval, keep));
                hand_over(block);
            }
        };
        self.pool
            .install(|| blocks.par_bridge().for_each_init(work, trace));
    }
}
