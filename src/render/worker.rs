//! The thread behind a renderer, which traces the newest job and publishes its progress.

use std::sync::Arc;
use std::sync::mpsc::Receiver;

use rayon::ThreadPool;

use super::film::Film;
use super::frame::{Frames, Job, Query};
use super::shared::Shared;
use super::shot::Shot;
use super::steps::steps;
use super::touched::Touched;
use super::tracing::{Effort, Ticket, Tracing};
use super::world::World;

/// A job with its generation and film.
pub(crate) struct Submission {
    pub(crate) generation: u64,
    pub(crate) job: Job,
    pub(crate) film: Film,
}

/// Most pixels of a picture that is kept to be continued: about 1.5 GB.
const MOST_KEPT: usize = 1 << 25;

/// State kept for the next job.
struct Left {
    world: Arc<World>,
    /// The last job and its film, if they can be continued.
    traced: Option<Traced>,
}

/// A job as far as it is traced.
struct Traced {
    job: Job,
    film: Film,
    effort: Effort,
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
            if let Some(traced) = traced {
                traced.film.free_later();
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
    let ticket = Ticket::new(generation, shared);
    // A newer job does not cancel the build: it may need the same structures, and while a held key
    // moves objects of a large scene, none would ever be finished.
    let quit = || shared.is_quitting();
    let known = previous.as_ref().map(|left| &*left.world);
    let Some(world) = World::build(Arc::clone(&job.scene), &job.images, known, quit) else {
        return previous;
    };
    let world = Arc::new(world);
    let mut before = Effort::default();
    if let Some(Left {
        world: world_before,
        traced,
    }) = &mut previous
        && let Some(old) = traced.take()
    {
        let changed = Touched::between((&old.job, world_before), (&job, &world));
        match changed.filter(|_| film.can_take_over(&old.film)) {
            Some(changed) => {
                film.take_over(old.film, changed);
                if changed == Touched::NOTHING && 0 < film.reached() {
                    before = old.effort;
                }
            }
            _ => old.film.free_later(),
        }
    }
    let shot = Shot::new(&world, &job.camera, job.settings);
    let query = Query::new(&world, &job);
    let mut picture = Tracing::new(ticket.with_world(), &job, (film, before), wake, query);
    for step in steps(job.settings.spp, job.frames) {
        if !picture.take(&step, &shot) {
            break;
        }
    }
    let (film, effort) = picture.into_film();
    let traced = if job.frames == Frames::Live && film.pixels() <= MOST_KEPT {
        Some(Traced { job, film, effort })
    } else {
        film.free_later();
        None
    };
    Some(Left { world, traced })
}
