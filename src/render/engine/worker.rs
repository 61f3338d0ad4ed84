//! The thread behind a renderer, which traces the newest job and publishes its progress.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use std::{iter, mem};

use rayon::ThreadPool;

use super::checkpoint::{Checkpoint, Effort};
use super::edit_difference::edit_difference;
use super::film::Film;
use super::pass_schedule::steps;
use super::renderer_state::RendererState;
use super::tracing::{JobToken, Tracing};
use crate::integrators::{FrameContext, PhotonRules, Photons};
use crate::job::{Frames, Job};
use crate::picture::Query;
use crate::world::{Dependencies, World, WorldSettings};
use geometry::IsCancelled;

/// What the thread is asked for.
pub(crate) enum Request {
    /// To trace what is submitted instead of what it traces.
    Trace,
    /// To drop a job that is not traced, which takes time for a large scene.
    Drop(Box<Job>),
    /// To send the newest picture, as far as it is traced, before it ends.
    Keep(Sender<Checkpoint>),
}

/// The jobs that the worker has not begun: the newest, and before it those that recall a picture, which
/// a newer one may continue. A film may take megabytes, so that the others must not wait with theirs.
#[derive(Debug, Default)]
pub(crate) struct Submissions(Mutex<Vec<Submission>>);

impl Submissions {
    /// Adds the newest job; returns the one in whose place it is traced, if any.
    pub(crate) fn submit(&self, newest: Submission) -> Option<Job> {
        let mut waiting = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let older = waiting.pop_if(|older| older.recalled.is_none());
        waiting.push(newest);
        drop(waiting);
        older.map(|older| older.job)
    }

    fn take(&self) -> Vec<Submission> {
        mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// A job with its generation and film.
#[derive(Debug)]
pub(crate) struct Submission {
    pub(crate) generation: u64,
    pub(crate) job: Job,
    pub(crate) film: Film,
    /// Brings a picture that was kept of the job, or closes if there is none.
    pub(crate) recalled: Option<Receiver<Checkpoint>>,
}

/// Most pixels of a picture that is kept to be continued: about 1.5 GB.
const MOST_KEPT: usize = 1 << 25;

/// Interval between polls of whether to end while a picture is being recalled.
const POLL: Duration = Duration::from_millis(5);

/// State kept for the next job.
struct Left {
    world: Arc<World>,
    photons: Option<Arc<Photons>>,
    /// The last job, if it can be continued.
    traced: Option<Traced>,
}

/// A job as far as it is traced.
struct Traced {
    job: Job,
    checkpoint: Checkpoint,
}

/// Traces jobs until the renderer is dropped or the thread panics.
pub(crate) fn run<W: Fn() + Sync>(
    requests: &Receiver<Request>,
    submissions: &Submissions,
    state: &RendererState,
    wake: &W,
    pool: &ThreadPool,
) {
    let mut left = None;
    let mut keeper = None;
    while let Ok(first) = requests.recv() {
        for request in iter::once(first).chain(requests.try_iter()) {
            match request {
                Request::Trace => {}
                Request::Drop(job) => drop(job),
                Request::Keep(to) => keeper = Some(to),
            }
        }
        for submission in submissions.take() {
            left = pool.install(|| trace(submission, state, wake, left.take()));
        }
    }
    let (world, traced) = left.map_or((None, None), |left| {
        (Some((left.world, left.photons)), left.traced)
    });
    let checkpoint = traced.map(|traced| traced.checkpoint);
    let unwanted = match (keeper, checkpoint) {
        (Some(keeper), Some(checkpoint)) => keeper.send(checkpoint).err().map(|unsent| unsent.0),
        (_, checkpoint) => checkpoint,
    };
    // In the background, because freeing the structures of a large scene takes up to 16 ms for a
    // million spheres.
    pool.spawn(move || {
        drop(world);
        if let Some(unwanted) = unwanted {
            unwanted.free_later();
        }
    });
}

/// Traces a job until it is complete or cancelled.
fn trace<W: Fn() + Sync>(
    submission: Submission,
    state: &RendererState,
    wake: &W,
    previous: Option<Left>,
) -> Option<Left> {
    let Submission {
        generation,
        job,
        mut film,
        recalled,
    } = submission;
    let token = JobToken::new(generation, state);
    let (known, photons, traced) = match previous {
        Some(left) => (Some(left.world), left.photons, left.traced),
        None => (None, None, None),
    };
    // A newer job does not cancel the build: it may need the same structures, and while a held key
    // moves objects of a large scene, none would ever be finished.
    let quit = || state.is_quitting();
    let scene = Arc::clone(&job.scene);
    let settings = WorldSettings::of(&job.settings);
    let world = World::build(scene, &job.images, settings, known.as_deref(), &quit);
    let prepared = world.and_then(|world| {
        let before = known.as_deref().zip(photons.as_ref());
        let photons = match PhotonRules::of(&job.settings) {
            Some(rules) => Some(Photons::build(&world, rules, before, &quit)?),
            None => None,
        };
        Some((Arc::new(world), photons))
    });
    let Some((world, photons)) = prepared else {
        // The picture before is not the newest any more.
        if let Some(traced) = traced {
            traced.checkpoint.free_later();
        }
        return known.map(|world| Left {
            world,
            photons,
            traced: None,
        });
    };
    let changed = |old: &Traced| {
        let before = known.as_deref()?;
        edit_difference((&old.job, before), (&job, &world))
    };
    let before = match traced.map(|old| (changed(&old), old.checkpoint)) {
        Some((Some(changed), checkpoint)) if film.can_take_over(&checkpoint) => {
            film.take_over(checkpoint, changed)
        }
        other => {
            if let Some((_, unfit)) = other {
                unfit.free_later();
            }
            match recalled.and_then(|recalled| await_checkpoint(&recalled, &quit)) {
                Some(checkpoint) if film.can_take_over(&checkpoint) => {
                    film.take_over(checkpoint, Dependencies::NOTHING)
                }
                _ => Effort::default(),
            }
        }
    };
    drop(known);
    let context = FrameContext::new(&world, &job.camera, job.settings);
    let query = Query::new(&world, photons.as_ref(), &job);
    let mut picture = Tracing::new(token.with_world(), &job, (film, before), wake, query);
    for step in steps(job.settings.spp, job.frames) {
        if !picture.take(&step, &context, photons.as_deref()) {
            break;
        }
    }
    let checkpoint = picture.into_checkpoint();
    let traced = if job.frames == Frames::Live && checkpoint.pixels() <= MOST_KEPT {
        Some(Traced { job, checkpoint })
    } else {
        checkpoint.free_later();
        None
    };
    Some(Left {
        world,
        photons,
        traced,
    })
}

/// Waits for a picture to be recalled; `None` if there is none, or once `quit` returns true. A newer
/// job does not end the wait, as it may continue the picture.
fn await_checkpoint(recalled: &Receiver<Checkpoint>, quit: IsCancelled<'_>) -> Option<Checkpoint> {
    while !quit() {
        match recalled.recv_timeout(POLL) {
            Ok(checkpoint) => return Some(checkpoint),
            Err(RecvTimeoutError::Disconnected) => return None,
            Err(RecvTimeoutError::Timeout) => {}
        }
    }
    None
}
