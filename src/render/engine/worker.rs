//! The thread behind a renderer, which traces the newest job and publishes its progress.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use std::{iter, mem};

use rayon::ThreadPool;

use super::checkpoint::{Effort, Kept};
use super::difference::difference;
use super::film::Film;
use super::pass_schedule::steps;
use super::shared::Shared;
use super::tracing::{Ticket, Tracing};
use crate::integrators::{FrameContext, PhotonRules, Photons};
use crate::job::{Frames, Job};
use crate::picture::Query;
use crate::world::{Dependencies, Rules, World};

/// What the thread is asked for.
pub(crate) enum Request {
    /// To trace what is submitted instead of what it traces.
    Trace,
    /// To drop a job that is not traced, which takes time for a large scene.
    Drop(Box<Job>),
    /// To send the newest picture, as far as it is traced, before it ends.
    Keep(Sender<Kept>),
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
    pub(crate) recalled: Option<Receiver<Kept>>,
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
    kept: Kept,
}

/// Traces jobs until the renderer is dropped or the thread panics.
pub(crate) fn run<W: Fn() + Sync>(
    requests: &Receiver<Request>,
    submissions: &Submissions,
    shared: &Shared,
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
            left = pool.install(|| trace(submission, shared, wake, left.take()));
        }
    }
    let (world, traced) = left.map_or((None, None), |left| {
        (Some((left.world, left.photons)), left.traced)
    });
    let kept = traced.map(|traced| traced.kept);
    let unwanted = match (keeper, kept) {
        (Some(keeper), Some(kept)) => keeper.send(kept).err().map(|unsent| unsent.0),
        (_, kept) => kept,
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
    shared: &Shared,
    wake: &W,
    previous: Option<Left>,
) -> Option<Left> {
    let Submission {
        generation,
        job,
        mut film,
        recalled,
    } = submission;
    let ticket = Ticket::new(generation, shared);
    let (known, photons, traced) = match previous {
        Some(left) => (Some(left.world), left.photons, left.traced),
        None => (None, None, None),
    };
    // A newer job does not cancel the build: it may need the same structures, and while a held key
    // moves objects of a large scene, none would ever be finished.
    let quit = || shared.is_quitting();
    let scene = Arc::clone(&job.scene);
    let rules = Rules::of(&job.settings);
    let world = World::build(scene, &job.images, rules, known.as_deref(), &quit);
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
            traced.kept.free_later();
        }
        return known.map(|world| Left {
            world,
            photons,
            traced: None,
        });
    };
    let changed = |old: &Traced| {
        let before = known.as_deref()?;
        difference((&old.job, before), (&job, &world))
    };
    let before = match traced.map(|old| (changed(&old), old.kept)) {
        Some((Some(changed), kept)) if film.can_take_over(&kept) => film.take_over(kept, changed),
        other => {
            if let Some((_, unfit)) = other {
                unfit.free_later();
            }
            match recalled.and_then(|recalled| await_kept(&recalled, quit)) {
                Some(kept) if film.can_take_over(&kept) => {
                    film.take_over(kept, Dependencies::NOTHING)
                }
                _ => Effort::default(),
            }
        }
    };
    drop(known);
    let shot = FrameContext::new(&world, &job.camera, job.settings);
    let query = Query::new(&world, photons.as_ref(), &job);
    let mut picture = Tracing::new(ticket.with_world(), &job, (film, before), wake, query);
    for step in steps(job.settings.spp, job.frames) {
        if !picture.take(&step, &shot, photons.as_deref()) {
            break;
        }
    }
    let kept = picture.keep();
    let traced = if job.frames == Frames::Live && kept.pixels() <= MOST_KEPT {
        Some(Traced { job, kept })
    } else {
        kept.free_later();
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
fn await_kept(recalled: &Receiver<Kept>, quit: impl Fn() -> bool) -> Option<Kept> {
    while !quit() {
        match recalled.recv_timeout(POLL) {
            Ok(kept) => return Some(kept),
            Err(RecvTimeoutError::Disconnected) => return None,
            Err(RecvTimeoutError::Timeout) => {}
        }
    }
    None
}
