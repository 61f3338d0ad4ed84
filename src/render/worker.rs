//! The thread behind a renderer: traces one job at a time, the newest, and publishes its progress.

use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use rayon::ThreadPool;

use super::camera::Projection;
use super::film::{Film, Raster};
use super::filter::Spread;
use super::frame::{Frame, Frames, Job, Progress};
use super::probe::Counts;
use super::shared::Shared;
use super::shot::Shot;
use super::steps::{Step, steps};
use super::touched::Touched;
use super::world::World;
use crate::scene::Size;

/// How long a first picture may be refined before it is shown: half of what passes for immediate,
/// so that the picture of an edit that had to wait for the one before still comes in time.
const FIRST_PICTURE: Duration = Duration::from_millis(20);

/// How long a job is safe from newer ones while it has shown nothing. With naive cancelling a held
/// key shows no picture at all; with this, one for every edit.
const GRACE: Duration = Duration::from_millis(50);

/// How the tiles of a step go to the pool: progress is published between two batches, and some threads
/// wait for others.
struct Batches {
    /// How many tiles a thread the first holds.
    first: usize,
    /// How long later ones take, about.
    time: Duration,
}

impl Batches {
    fn of(frames: Frames) -> Self {
        match frames {
            Frames::Live => Self {
                first: 2,
                time: Duration::from_millis(8),
            },
            // Only progress is told.
            Frames::Last | Frames::LastWithValues => Self {
                first: 32,
                time: Duration::from_millis(50),
            },
        }
    }
}

/// A job and what it needs.
pub(crate) struct Order {
    pub(crate) generation: u64,
    pub(crate) job: Job,
    pub(crate) film: Film,
}

/// What a job leaves to the next one.
struct Left {
    world: World,
    /// What it traced, and how far it came, if that may be gone on with.
    traced: Option<(Job, Film)>,
}

/// Traces jobs until the renderer is dropped, or a panic ends the thread.
pub(crate) fn run<W: Fn() + Sync>(
    orders: &Receiver<Order>,
    shared: &Shared,
    wake: &W,
    pool: &ThreadPool,
) {
    let mut left = None;
    while let Ok(newest) = orders.recv() {
        let order = orders.try_iter().last().unwrap_or(newest);
        left = pool.install(|| trace(order, shared, wake, left.take()));
    }
    // Nobody is to wait while the system takes back the structure of a large scene: up to 16 ms for a
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

/// Traces a job to its end, unless it is cancelled.
fn trace<W: Fn() + Sync>(
    order: Order,
    shared: &Shared,
    wake: &W,
    mut previous: Option<Left>,
) -> Option<Left> {
    let Order {
        generation,
        job,
        mut film,
    } = order;
    let begun = Instant::now();
    // A newer job does not cancel the building: it may need the same structure, and if a held key
    // moved the objects of a large scene, no structure would ever be finished.
    let quit = || shared.is_quitting();
    let known = previous.as_ref().map(|left| &left.world);
    let Some(world) = World::build(Arc::clone(&job.scene), &job.images, known, quit) else {
        return previous;
    };
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
    let mut picture = Picture::new(ticket, begun, &job, film, wake);
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

/// What says whether a job may go on.
#[derive(Clone, Copy)]
struct Ticket<'s> {
    generation: u64,
    /// When its world was ready.
    built: Instant,
    shared: &'s Shared,
}

impl Ticket<'_> {
    /// Whether to stop: at once when the renderer is dropped; for a newer job once something of
    /// this one was published, or its grace is over.
    fn cancelled(&self, published: Option<Instant>) -> bool {
        self.shared.is_old(self.generation)
            && (published.is_some() || GRACE <= self.built.elapsed() || self.shared.is_quitting())
    }

    /// Whether not even a picture that is traced is to be shown any more: a first one is, in spite
    /// of newer jobs.
    fn unwanted(&self, shown: bool) -> bool {
        self.shared.is_quitting() || (shown && self.shared.is_old(self.generation))
    }
}

/// The picture of a job, as far as it is.
struct Picture<'s, W> {
    ticket: Ticket<'s>,
    wake: &'s W,
    begun: Instant,
    film: Film,
    size: Size,
    spp: u32,
    frames: Frames,
    counts: Counts,
    /// Samples taken, in pixels' worth.
    taken: f64,
    pass: u32,
    whole_samples: u32,
    /// Tiles that go to the pool at once.
    batch: usize,
    /// When it was last published.
    published: Option<Instant>,
    /// How long making the last frame took.
    developing: Duration,
}

impl<'s, W: Fn() + Sync> Picture<'s, W> {
    fn new(ticket: Ticket<'s>, begun: Instant, job: &Job, film: Film, wake: &'s W) -> Self {
        Self {
            ticket,
            wake,
            begun,
            film,
            size: job.settings.size,
            spp: job.settings.spp,
            frames: job.frames,
            counts: Counts::default(),
            taken: 0.0,
            pass: 1,
            whole_samples: 0,
            batch: Batches::of(job.frames).first * rayon::current_num_threads(),
            published: None,
            developing: Duration::ZERO,
        }
    }

    /// Takes a step; `false` if it was cancelled.
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

    /// Whether the first picture is to be shown now, at the end of a grid: it is if the next grid,
    /// with three times the points so far, would end after its time.
    fn is_first_due(&self, step: &Step) -> bool {
        let elapsed = self.ticket.built.elapsed();
        self.published.is_none() && (*step == Step::Grid(1) || FIRST_PICTURE <= 4 * elapsed)
    }

    /// Whether it is time for another picture: often at first, ever more seldom later, and never so
    /// often that a large picture is developed rather than traced.
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
            // What only tells how far it is can do so before every tile was come to.
            None => self.frames != Frames::Live,
        }
    }

    fn publish(&mut self) {
        let begun = Instant::now();
        let complete = self.whole_samples == self.spp;
        let (ticket, shown) = (self.ticket, self.published.is_some());
        let unwanted = || ticket.unwanted(shown);
        let raster = match self.frames {
            _ if complete => self.film.finish(unwanted),
            Frames::Live => self.film.develop(unwanted),
            Frames::Last | Frames::LastWithValues => Some(Raster::default()),
        };
        let Some(Raster {
            pixels,
            objects,
            values,
        }) = raster
        else {
            return;
        };
        self.developing = begun.elapsed();
        let untaken = self.ticket.shared.publish(Frame {
            generation: self.ticket.generation,
            size: self.size,
            pixels,
            objects,
            values,
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
        });
        if untaken.is_none() {
            (self.wake)();
        }
        self.published = Some(Instant::now());
    }
}

/// How many tiles to hand out next, to take as long as wanted, when this many took that long.
fn next_batch(batch: usize, took: Duration, wanted: Duration) -> usize {
    let ratio = wanted.as_secs_f64() / took.as_secs_f64().max(1e-6);
    let least = 2 * rayon::current_num_threads();
    ((batch as f64 * ratio.min(4.0)) as usize).max(least)
}
