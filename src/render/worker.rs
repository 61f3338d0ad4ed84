//! The thread behind a renderer, which traces the newest job and publishes its progress.

use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use rayon::ThreadPool;

use super::camera::Projection;
use super::film::{Film, Raster};
use super::filter::Spread;
use super::frame::{Frame, Frames, Job, NO_OBJECT, Progress, Query};
use super::probe::Counts;
use super::shared::Shared;
use super::shot::Shot;
use super::steps::{Step, steps};
use super::touched::Touched;
use super::world::World;
use crate::scene::Size;

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

/// A job with its generation and film.
pub(crate) struct Submission {
    pub(crate) generation: u64,
    pub(crate) job: Job,
    pub(crate) film: Film,
}

/// State kept for the next job.
struct Left {
    world: Arc<World>,
    /// The last job and its film, if they can be continued.
    traced: Option<(Job, Film)>,
}

/// Traces jobs until the renderer is dropped or the thread panics.
pub(crate) fn run<W: Fn() + Sync>(
    submissions: &Receiver<Submission>,
    shared: &Shared,
    wake: &W,
    pool: &ThreadPool,
) {
    let mut left = None;
    while let Ok(newest) = submissions.recv() {
        let submission = submissions.try_iter().last().unwrap_or(newest);
        left = pool.install(|| trace(submission, shared, wake, left.take()));
    }
    // In the background, because freeing the structures of a large scene takes up to 16 ms for a
    // million spheres.
    pool.spawn(move || {
        if let Some(Left { world, traced }) = left {
            drop(world);
            if let Some((_, film)) = traced {
                film.free_later();
            }
        }
    });
}

/// Traces a job until it is complete or cancelled.
fn trace<W: Fn() + Sync>(
    submission: Submission,
    shared: &Shared,
    wake: &W,
    mut previous: Option<Left>,
) -> Option<Left> {
    let Submission {
        generation,
        job,
        mut film,
    } = submission;
    let begun = Instant::now();
    // A newer job does not cancel the build: it may need the same structures, and while a held key
    // moves objects of a large scene, none would ever be finished.
    let quit = || shared.is_quitting();
    let known = previous.as_ref().map(|left| &*left.world);
    let Some(world) = World::build(Arc::clone(&job.scene), &job.images, known, quit) else {
        return previous;
    };
    let world = Arc::new(world);
    if let Some(Left {
        world: before,
        traced,
    }) = &mut previous
        && let Some((job_before, old)) = traced.take()
    {
        match Touched::between((&job_before, before), (&job, &world)) {
            Some(changed) => film.take_over(old, changed),
            None => old.free_later(),
        }
    }
    let shot = Shot {
        world: &world,
        projection: Projection::new(&job.camera, job.settings.size),
        eye: job.camera.eye,
        settings: job.settings,
        spread: Spread::of(job.settings.filter),
    };
    let ticket = Ticket {
        generation,
        built: Instant::now(),
        shared,
    };
    let query = Query::new(&world, &job);
    let mut picture = Tracing::new(ticket, begun, &job, film, wake, query);
    for step in steps(job.settings.spp, job.frames) {
        if !picture.take(&step, &shot) {
            break;
        }
    }
    let film = picture.film;
    let traced = if film.remembers() {
        Some((job, film))
    } else {
        film.free_later();
        None
    };
    Some(Left { world, traced })
}

/// Decides whether a job may continue.
#[derive(Clone, Copy)]
struct Ticket<'s> {
    generation: u64,
    /// When the world was ready.
    built: Instant,
    shared: &'s Shared,
}

impl Ticket<'_> {
    /// Whether to stop: at once when the renderer is dropped; for a newer job once a frame of this
    /// one was published, or its grace period is over.
    fn cancelled(&self, published: Option<Instant>) -> bool {
        self.shared.is_old(self.generation)
            && (published.is_some() || GRACE <= self.built.elapsed() || self.shared.is_quitting())
    }

    /// Whether a finished frame is no longer wanted; a first frame is shown despite newer jobs.
    fn unwanted(&self, published: Option<Instant>) -> bool {
        self.shared.is_quitting() || (published.is_some() && self.shared.is_old(self.generation))
    }
}

/// The picture of a job in progress.
struct Tracing<'s, W> {
    ticket: Ticket<'s>,
    wake: &'s W,
    begun: Instant,
    film: Film,
    size: Size,
    spp: u32,
    frames: Frames,
    numbers: Option<&'s [u32]>,
    query: Query,
    counts: Counts,
    /// Samples taken, divided by the number of pixels.
    taken: f64,
    pass: u32,
    whole_samples: u32,
    /// Tiles in the next batch.
    batch: usize,
    /// Time of the last publication.
    published: Option<Instant>,
    /// Time spent on developing the last frame.
    developing: Duration,
}

impl<'s, W: Fn() + Sync> Tracing<'s, W> {
    fn new(
        ticket: Ticket<'s>,
        begun: Instant,
        job: &'s Job,
        film: Film,
        wake: &'s W,
        query: Query,
    ) -> Self {
        Self {
            ticket,
            wake,
            begun,
            film,
            size: job.settings.size,
            spp: job.settings.spp,
            frames: job.frames,
            numbers: job.numbers.as_deref(),
            query,
            counts: Counts::default(),
            taken: 0.0,
            pass: 1,
            whole_samples: 0,
            batch: Batches::of(job.frames).first * rayon::current_num_threads(),
            published: None,
            developing: Duration::ZERO,
        }
    }

    /// Takes a step; returns false if cancelled.
    fn take(&mut self, step: &Step, shot: &Shot<'_>) -> bool {
        if let Step::Samples(indices) = step
            && 0 < indices.start
        {
            self.pass += 1;
        }
        let before = self.taken;
        let tiles = self.film.tiles();
        let mut next = 0;
        while next < tiles {
            let until = self.film.stretch(next, self.batch, step);
            let begun = Instant::now();
            let (ticket, published) = (self.ticket, self.published);
            let cancelled = || ticket.cancelled(published);
            self.counts = self
                .counts
                .and(self.film.advance(next..until, step, shot, cancelled));
            if cancelled() {
                return false;
            }
            let wanted = Batches::of(self.frames).time;
            self.batch = next_batch(self.batch, begun.elapsed(), wanted);
            next = until;
            self.taken = before + step.share() * (next as f64 / tiles as f64);
            if next < tiles && self.is_due() {
                self.publish();
            }
        }
        self.whole_samples = step.whole_after();
        let complete = self.whole_samples == self.spp;
        if complete || self.is_due() || self.is_first_due(step) {
            self.publish();
        }
        true
    }

    /// Whether to show the first picture after a grid: if the next grid, with three times as many
    /// points as all so far, would end too late.
    fn is_first_due(&self, step: &Step) -> bool {
        let elapsed = self.ticket.built.elapsed();
        self.published.is_none() && (*step == Step::Grid(1) || FIRST_PICTURE <= 4 * elapsed)
    }

    /// Whether to publish a frame: often at first, less often later, and never so often that a
    /// large picture is mostly developed instead of traced.
    fn is_due(&self) -> bool {
        let interval = match self.begun.elapsed().as_millis() {
            0..1000 => 33,
            1000..4000 => 100,
            4000..16_000 => 250,
            _ => 500,
        };
        let interval = Duration::from_millis(interval).max(4 * self.developing);
        match self.published {
            Some(last) => interval <= last.elapsed(),
            // Frames without pixels do not need every tile to be begun.
            None => self.frames != Frames::Live,
        }
    }

    fn publish(&mut self) {
        let begun = Instant::now();
        let complete = self.whole_samples == self.spp;
        let (ticket, published) = (self.ticket, self.published);
        let unwanted = || ticket.unwanted(published);
        let raster = match self.frames {
            _ if complete => self.film.finish(unwanted),
            Frames::Live => self.film.develop(unwanted),
            Frames::Last | Frames::LastWithValues => Some(Raster::default()),
        };
        let Some(Raster {
            pixels,
            mut objects,
            values,
            errors,
            range,
        }) = raster
        else {
            return;
        };
        if let Some(numbers) = self.numbers {
            let number = |index: u32| numbers.get(index as usize).copied().unwrap_or(NO_OBJECT);
            for object in &mut objects {
                *object = number(*object);
            }
        }
        self.developing = begun.elapsed();
        let untaken = self.ticket.shared.publish(Frame {
            generation: self.ticket.generation,
            size: self.size,
            pixels,
            objects,
            values,
            errors,
            range,
            progress: Progress {
                pass: self.pass,
                passes: 1 + self.spp.next_power_of_two().ilog2(),
                spp: self.whole_samples,
                done: if complete {
                    1.0
                } else {
                    self.taken / f64::from(self.spp)
                },
                elapsed: self.begun.elapsed(),
                rays: self.counts.rays,
                shadow_rays: self.counts.shadow_rays,
                over_budget: self.film.over_budget(),
                noise: self.film.noise(),
                complete,
            },
            query: Some(self.query.clone()),
        });
        if untaken.is_none() {
            (self.wake)();
        }
        self.published = Some(Instant::now());
    }
}

/// The size of the next batch, given the duration of the last one and the target.
fn next_batch(batch: usize, took: Duration, wanted: Duration) -> usize {
    let ratio = wanted.as_secs_f64() / took.as_secs_f64().max(1e-6);
    let least = 2 * rayon::current_num_threads();
    ((batch as f64 * ratio.min(4.0)) as usize).max(least)
}
