//! A picture being traced: its passes, its publication and when it is complete.

use std::ops::Range;
use std::time::{Duration, Instant};

use super::checkpoint::{Checkpoint, Effort};
use super::film::{Film, Raster};
use super::pass_schedule::Step;
use super::renderer_state::RendererState;
use crate::integrators::{Counts, FrameContext, MAPS, Photons};
use crate::job::{Frames, Job, Limit, NO_OBJECT};
use crate::picture::{Frame, Guides, Noisy, Progress, Query};

/// Time for refining a first picture before it is shown: half of what counts as immediate, so that
/// even the picture of an edit that waited for its predecessor is in time.
const FIRST_PICTURE: Duration = Duration::from_millis(20);

/// Time during which newer jobs cannot cancel one that has shown nothing. Without it, holding a key
/// shows no picture at all; with it, one per edit.
const GRACE: Duration = Duration::from_millis(50);

/// How the tiles of a step are divided into batches for the pool. Progress is published between
/// batches, where some threads must wait for others.
struct Batches {
    /// Tiles per thread in the first batch.
    first: usize,
    /// Target duration of later batches.
    time: Duration,
}

impl Batches {
    fn of(frames: Frames) -> Self {
        match frames {
            Frames::Live => Self {
                first: 2,
                time: Duration::from_millis(8),
            },
            // Frames contain only the progress.
            Frames::Last | Frames::LastWithValues => Self {
                first: 32,
                time: Duration::from_millis(50),
            },
        }
    }
}

/// Decides whether a job may continue, and tells how long it has been at work.
#[derive(Clone, Copy)]
pub(crate) struct JobToken<'s> {
    generation: u64,
    state: &'s RendererState,
    begun: Instant,
    /// Pauses of the renderer before.
    pauses: Duration,
    /// When the world was ready.
    built: Instant,
}

impl<'s> JobToken<'s> {
    /// The token of a job that begins now.
    pub(crate) fn new(generation: u64, state: &'s RendererState) -> Self {
        let begun = Instant::now();
        Self {
            generation,
            state,
            begun,
            pauses: state.pauses(),
            built: begun,
        }
    }

    /// Notes that the world is ready.
    pub(crate) fn with_world(self) -> Self {
        Self {
            built: Instant::now(),
            ..self
        }
    }

    /// Whether to stop: at once when the renderer is dropped; for a newer job once a frame of this
    /// one was published, or its grace period is over. Returns after a pause.
    fn cancelled(&self, published: Option<Instant>) -> bool {
        self.state.wait(self.generation);
        self.state.is_old(self.generation)
            && (published.is_some() || GRACE <= self.built.elapsed() || self.state.is_quitting())
    }

    /// Whether a finished frame is no longer wanted; a first frame is shown despite newer jobs.
    fn unwanted(&self, published: Option<Instant>) -> bool {
        self.state.is_quitting() || (published.is_some() && self.state.is_old(self.generation))
    }

    /// The time since the job began, without pauses.
    fn elapsed(&self) -> Duration {
        let pauses = self.state.pauses().saturating_sub(self.pauses);
        self.begun.elapsed().saturating_sub(pauses)
    }
}

/// The picture of a job in progress.
pub(crate) struct Tracing<'s, W> {
    token: JobToken<'s>,
    job: &'s Job,
    wake: &'s W,
    film: Film,
    query: Query,
    /// What guides noise reduction, if the job asks for it.
    guides: Guides,
    /// What was spent on the film before.
    before: Effort,
    counts: Counts,
    /// Samples taken, divided by the number of pixels.
    taken: f64,
    /// The share of pixels that take part in the current step.
    unfinished: f64,
    pass: u32,
    whole_samples: u32,
    complete: bool,
    /// Tiles in the next batch.
    batch: usize,
    /// Time of the last publication.
    published: Option<Instant>,
    /// Time spent on developing the last frame.
    developing: Duration,
}

impl<'s, W: Fn() + Sync> Tracing<'s, W> {
    /// Prepares to trace a job, or to continue on a film that took some effort.
    pub(crate) fn new(
        token: JobToken<'s>,
        job: &'s Job,
        (film, before): (Film, Effort),
        wake: &'s W,
        query: Query,
    ) -> Self {
        Self {
            token,
            job,
            wake,
            film,
            query,
            guides: Guides::default(),
            before,
            counts: before.counts,
            taken: 0.0,
            unfinished: 1.0,
            pass: 1,
            whole_samples: 0,
            complete: false,
            batch: Batches::of(job.frames).first * rayon::current_num_threads(),
            published: None,
            developing: Duration::ZERO,
        }
    }

    /// Takes a step, by as many samples at a time as photon maps are held, if there are to be any;
    /// returns whether more are wanted: false if cancelled or complete.
    pub(crate) fn take(
        &mut self,
        step: &Step,
        context: &FrameContext<'_>,
        photons: Option<&Photons>,
    ) -> bool {
        if let Step::Samples(indices) = step
            && 0 < indices.start
        {
            self.pass += 1;
        }
        let selected = self.film.select(step);
        if selected == 0.0 {
            self.complete = true;
            self.publish(context);
            return false;
        }
        self.unfinished = selected;
        let is_lacking = self.film.stretch(0, 0, step) < self.film.tiles();
        for part in step.parts(photons.map_or(u32::MAX, |_| MAPS)) {
            // Before the tiles, whose threads must not wait for each other.
            let maps = photons.filter(|_| is_lacking).map(|photons| {
                let (token, published) = (self.token, self.published);
                let cancelled = || token.cancelled(published);
                photons.maps(context.world, part.clone(), &cancelled)
            });
            if maps.as_ref().is_some_and(Option::is_none) {
                return false;
            }
            let maps = maps.flatten();
            let share = selected * step.share(&part);
            if !self.take_part((step, part), share, &context.with_photons(maps.as_ref())) {
                return false;
            }
        }
        self.whole_samples = step.whole_after();
        self.complete = self.whole_samples == self.job.settings.spp || self.is_enough(step);
        if self.complete || self.is_due() || self.is_first_due(step) {
            self.publish(context);
        }
        !self.complete
    }

    /// Takes a part of a step that is this share of a sample of all pixels; returns false if cancelled.
    fn take_part(
        &mut self,
        (step, part): (&Step, Range<u32>),
        share: f64,
        context: &FrameContext<'_>,
    ) -> bool {
        let before = self.taken;
        let tiles = self.film.tiles();
        let mut next = 0;
        while next < tiles {
            let until = self.film.stretch(next, self.batch, step);
            let begun = self.token.elapsed();
            let (token, published) = (self.token, self.published);
            let cancelled = || token.cancelled(published);
            let part = (step, part.clone());
            let counts = self.film.advance(next..until, part, context, &cancelled);
            self.counts = self.counts.and(counts);
            if cancelled() {
                return false;
            }
            let took = self.token.elapsed().saturating_sub(begun);
            self.batch = next_batch(self.batch, took, Batches::of(self.job.frames).time);
            next = until;
            self.taken = before + share * (next as f64 / tiles as f64);
            if next < tiles && self.is_due() {
                self.publish(context);
            }
        }
        true
    }

    /// The picture as far as it is traced.
    pub(crate) fn into_checkpoint(self) -> Checkpoint {
        let time = self.elapsed();
        self.film.into_checkpoint(time)
    }

    fn elapsed(&self) -> Duration {
        self.before.time + self.token.elapsed()
    }

    /// Whether the limit of the job is met after a step. No pixel may have more samples than the
    /// others then.
    fn is_enough(&self, step: &Step) -> bool {
        if self.whole_samples == 0 || step.level() < self.film.reached() {
            return false;
        }
        match self.job.limit {
            None => false,
            Some(Limit::Time(limit)) => {
                let next = self
                    .whole_samples
                    .min(self.job.settings.spp - self.whole_samples);
                let growth = 1.0 + f64::from(next) / f64::from(self.whole_samples);
                limit.as_secs_f64() < growth * self.elapsed().as_secs_f64()
            }
            Some(Limit::Noise(limit)) => self.film.noise().is_some_and(|noise| noise < limit),
        }
    }

    /// The fraction of the work done. Noise falls with the square root of the number of samples.
    fn done(&self) -> f64 {
        let all = f64::from(self.job.settings.spp);
        let share = (self.taken / all).max(1.0 - self.unfinished);
        match (self.job.limit, self.film.noise()) {
            _ if self.complete => 1.0,
            (Some(Limit::Time(limit)), _) => {
                share.max(self.elapsed().as_secs_f64() / limit.as_secs_f64())
            }
            (Some(Limit::Noise(limit)), Some(noise)) => {
                let ratio = noise / limit;
                let needed = f64::from(self.whole_samples.max(1)) * ratio * ratio;
                self.taken / needed.max(1.0).min(all)
            }
            _ => share,
        }
        .min(1.0)
    }

    /// Whether to show the first picture after a grid: if the next grid, with three times as many
    /// points as all so far, would end too late.
    fn is_first_due(&self, step: &Step) -> bool {
        let elapsed = self.token.built.elapsed();
        self.published.is_none() && (*step == Step::Grid(1) || FIRST_PICTURE <= 4 * elapsed)
    }

    /// Whether to publish a frame: often at first, less often later, and never so often that a
    /// large picture is mostly developed instead of traced.
    fn is_due(&self) -> bool {
        let interval = match self.token.begun.elapsed().as_millis() {
            0..1000 => 33,
            1000..4000 => 100,
            4000..16_000 => 250,
            _ => 500,
        };
        let interval = Duration::from_millis(interval).max(4 * self.developing);
        match self.published {
            Some(last) => interval <= last.elapsed(),
            // Frames without pixels do not need every tile to be begun.
            None => self.job.frames != Frames::Live,
        }
    }

    fn publish(&mut self, context: &FrameContext<'_>) {
        let begun = Instant::now();
        let (token, published) = (self.token, self.published);
        let unwanted = || token.unwanted(published);
        let raster = match self.job.frames {
            _ if self.complete => self.film.finish(&unwanted),
            Frames::Live => self.film.develop(&unwanted),
            Frames::Last | Frames::LastWithValues => Some(Raster::default()),
        };
        let Some(mut raster) = raster else {
            return;
        };
        let denoised = self.denoised(&raster, context);
        if unwanted() {
            return;
        }
        let denoised = match (denoised, self.job.frames) {
            (denoised, Frames::Live) => denoised.unwrap_or_default(),
            (Some(denoised), _) => {
                raster.replace(denoised, context.settings.transfer);
                Vec::new()
            }
            (None, _) => Vec::new(),
        };
        if self.job.frames == Frames::Last {
            raster.values = Vec::new();
        }
        let Raster {
            pixels,
            mut objects,
            values,
            errors,
            overexposure,
            range,
        } = raster;
        if let Some(numbers) = self.job.numbers.as_deref() {
            let number = |index: u32| numbers.get(index as usize).copied().unwrap_or(NO_OBJECT);
            for object in &mut objects {
                *object = number(*object);
            }
        }
        self.developing = begun.elapsed();
        let traced = self.job.settings.traced();
        let untaken = self.token.state.publish(Frame {
            generation: self.token.generation,
            size: traced.size(),
            corner: traced.corner(),
            pixels,
            objects,
            values,
            denoised,
            errors,
            range,
            overexposure,
            query: Some(self.query.clone()),
            progress: self.progress(),
        });
        if untaken.is_none() {
            (self.wake)();
        }
        self.published = Some(Instant::now());
    }

    /// The values of a raster with less noise, if the job asks for it and each pixel has a sample.
    fn denoised(&mut self, raster: &Raster, context: &FrameContext<'_>) -> Option<Vec<[f32; 3]>> {
        let is_due = self.job.denoises() && 0 < self.whole_samples && !raster.values.is_empty();
        let (token, published) = (self.token, self.published);
        let unwanted = || token.unwanted(published);
        if !is_due {
            return None;
        }
        let variances = self.film.variances(context)?;
        if variances.iter().all(|&variance| variance == 0.0) {
            return Some(raster.values.clone());
        }
        if !self.guides.extend(self.whole_samples, context, &unwanted) {
            return None;
        }
        let noisy = Noisy {
            level: context.world.level,
            width: context.settings.traced().size().width as usize,
            values: &raster.values,
            variances: &variances,
            guides: &self.guides,
        };
        Some(noisy.denoised(&unwanted))
    }

    fn progress(&self) -> Progress {
        Progress {
            pass: self.pass,
            passes: self.job.settings.passes(),
            spp: self.whole_samples,
            mean_spp: self.taken,
            done: self.done(),
            elapsed: self.elapsed(),
            rays: self.counts.rays,
            shadow_rays: self.counts.shadow_rays,
            over_budget: self.film.over_budget(),
            noise: self.film.noise(),
            complete: self.complete,
        }
    }
}

/// The size of the next batch, given the duration of the last one and the target.
fn next_batch(batch: usize, took: Duration, wanted: Duration) -> usize {
    let ratio = wanted.as_secs_f64() / took.as_secs_f64().max(1e-6);
    let least = 2 * rayon::current_num_threads();
    ((batch as f64 * ratio.min(4.0)) as usize).max(least)
}
