//! Traces blocks of a picture, without a worker.

use std::sync::Arc;
use std::time::{Duration, Instant};

use rayon::ThreadPool;
use rayon::prelude::*;

use super::block::Block;
use super::blocks::Blocks;
use super::pixel_sampler::PixelSampler;
use super::preflight;
use super::preflight::Refusal;
use super::renderer::{Threads, pool};
use crate::integrators::{FrameContext, LightComponent, MAPS, PhotonRules, Photons, Tracer};
use crate::job::{Aov, Job};
use crate::world::{World, WorldSettings};
use geometry::IsCancelled;

/// A scene prepared to be traced block by block on threads of its own.
#[derive(Debug)]
pub struct BlockTracer {
    world: World,
    photons: Option<Arc<Photons>>,
    job: Job,
    pool: ThreadPool,
}

impl BlockTracer {
    /// Prepares to trace a job, whose limit and frames do not matter. `None` once `cancelled` returns
    /// true. Refuses a scene whose acceleration structures do not fit into memory; how many blocks are
    /// held at once is up to the caller.
    pub fn new(
        job: Job,
        threads: usize,
        cancelled: IsCancelled<'_>,
    ) -> Result<Option<Self>, Refusal> {
        let pool = pool(Threads::Exactly(threads)).map_err(|error| Refusal::Threads {
            count: threads,
            reason: error.to_string(),
        })?;
        job.settings.traced().within(job.settings.size)?;
        preflight::check_memory(&job, preflight::memory_for_blocks(&job, 0, None))?;
        let build = || {
            let settings = WorldSettings::of(&job.settings);
            let scene = Arc::clone(&job.scene);
            let world = World::build(scene, &job.images, settings, None, cancelled)?;
            let photons = match PhotonRules::of(&job.settings) {
                Some(rules) => Some(Photons::build(&world, rules, None, cancelled)?),
                None => None,
            };
            Some((world, photons))
        };
        let built = pool.install(build);
        Ok(built.map(|(world, photons)| Self {
            world,
            photons,
            job,
            pool,
        }))
    }

    /// The blocks of the traced region.
    pub fn blocks(&self) -> Blocks {
        Blocks::of(self.job.settings.traced().size())
    }

    /// Continues blocks to `spp` samples of each pixel, and returns once all are handed over: each
    /// when it is done, and whenever it took another `interval`. Once `cancelled` returns true, those
    /// begun are handed over soon, as they are.
    pub fn trace(
        &self,
        blocks: impl Iterator<Item = Block> + Send,
        spp: u32,
        interval: Duration,
        cancelled: IsCancelled<'_>,
        hand_over: impl Fn(Block) + Sync,
    ) {
        if let Some(photons) = &self.photons {
            let blocks = blocks.collect();
            let trace =
                || self.trace_together(photons, blocks, spp, interval, cancelled, &hand_over);
            return self.pool.install(trace);
        }
        let context = FrameContext::new(&self.world, &self.job.camera, self.job.settings);
        let new_sampler = || pixel_sampler(&context, cancelled);
        let trace = |sampler: &mut PixelSampler<'_>, mut block: Block| {
            if !cancelled() {
                let keep = |block: &Block| hand_over(block.clone());
                block.trace(spp, &context, sampler, (interval, keep));
                hand_over(block);
            }
        };
        self.pool
            .install(|| blocks.par_bridge().for_each_init(new_sampler, trace));
    }

    /// Continues blocks by a few samples of all of them at a time, whose photon maps are held.
    fn trace_together(
        &self,
        photons: &Photons,
        mut blocks: Vec<Block>,
        spp: u32,
        interval: Duration,
        cancelled: IsCancelled<'_>,
        hand_over: &(impl Fn(Block) + Sync),
    ) {
        let least = |blocks: &[Block]| blocks.iter().map(|block| block.samples).min();
        let mut handed_over = Instant::now();
        while let Some(samples) = least(&blocks).filter(|&samples| samples < spp && !cancelled()) {
            let goal = spp.min(samples.saturating_add(MAPS));
            let Some(maps) = photons.maps(&self.world, samples..goal, cancelled) else {
                break;
            };
            let context = FrameContext::new(&self.world, &self.job.camera, self.job.settings);
            let context = context.with_photons(Some(&maps));
            let trace = |sampler: &mut PixelSampler<'_>, block: &mut Block| {
                block.trace(goal, &context, sampler, (Duration::MAX, |_: &Block| {}));
            };
            let lacking = blocks.par_iter_mut().filter(|block| block.samples < goal);
            lacking.for_each_init(|| pixel_sampler(&context, cancelled), trace);
            if interval <= handed_over.elapsed() && goal < spp {
                blocks.iter().cloned().for_each(hand_over);
                handed_over = Instant::now();
            }
        }
        let begun = blocks.into_iter().filter(|block| 0 < block.samples);
        begun.for_each(hand_over);
    }
}

/// What a thread traces blocks with.
fn pixel_sampler<'w>(context: &FrameContext<'w>, cancelled: IsCancelled<'w>) -> PixelSampler<'w> {
    let settings = context.settings;
    let tracer = Tracer::new(
        context.world,
        settings.integrator,
        settings.depth,
        cancelled,
    );
    let tracer = tracer
        .gathering(LightComponent::of(settings.aov))
        .with_photons(context.photons);
    PixelSampler::new(match settings.aov {
        // Only then are rays told apart by samples.
        Some(Aov::Cost) => tracer.noting(),
        _ => tracer,
    })
}
