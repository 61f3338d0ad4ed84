//! The handle to a worker that traces pictures in the background.

use std::mem;
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Weak};
use std::thread::JoinHandle;

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::checkpoint::Checkpoint;
use super::film::{Film, NoMemory};
use super::preflight::Refusal;
use super::renderer_state::RendererState;
use super::worker::{Request, Submission, Submissions};
use super::{preflight, worker};
use crate::job::Job;
use crate::picture::Frame;
use scene::Scene;

/// The number of tracing threads and their priority.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Threads {
    /// One fewer than the machine's cores, at least one, so that keys are answered quickly.
    Preview,
    /// This many, at lower priority where threads have priorities.
    Background(usize),
    /// This many, at normal priority.
    Exactly(usize),
}

/// A worker that traces the newest job. Dropping it cancels the work and joins the thread.
#[derive(Debug)]
pub struct Renderer {
    state: Arc<RendererState>,
    /// The reason if threads cannot be started; [`Refusal::Ended`] only during drop.
    worker: Result<Worker, Refusal>,
    /// The scene of the last accepted job.
    accepted: Weak<Scene>,
}

#[derive(Debug)]
struct Worker {
    submissions: Arc<Submissions>,
    requests: Sender<Request>,
    thread: JoinHandle<()>,
}

impl Renderer {
    /// Starts the worker. It calls `wake` when a newer frame is available, at most once between
    /// calls of [`Renderer::latest`]. If threads cannot be started, every job is refused.
    pub fn new(threads: Threads, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let state = Arc::new(RendererState::default());
        let count = threads.count();
        let worker = Worker::start(threads, Arc::clone(&state), wake);
        Self {
            state,
            worker: worker.map_err(|reason| Refusal::Threads { count, reason }),
            accepted: Weak::new(),
        }
    }

    /// Makes `job` the one to trace and returns its generation, greater than all before. Cancels
    /// the current job, except a first coarse picture younger than 50 ms; a refused job cancels
    /// nothing. It continues the picture of the one before, if they differ only in the materials,
    /// the colours of lights, the number of samples or the limit.
    pub fn restart(&mut self, job: Job) -> Result<u64, Refusal> {
        self.submit(job, None)
    }

    /// Like [`Renderer::restart`], but a job that does not continue the picture before waits for one
    /// that was kept of it, of the same scene, camera and settings: `recalled` brings it, or closes
    /// if there is none.
    pub fn restart_from(
        &mut self,
        job: Job,
        recalled: Receiver<Checkpoint>,
    ) -> Result<u64, Refusal> {
        self.submit(job, Some(recalled))
    }

    fn submit(&mut self, job: Job, recalled: Option<Receiver<Checkpoint>>) -> Result<u64, Refusal> {
        let worker = self.worker.as_ref().map_err(Refusal::clone)?;
        let region = job.settings.traced().within(job.settings.size)?;
        preflight::fits(&job, self.accepted.upgrade().as_ref())?;
        let scene = Arc::downgrade(&job.scene);
        let film = Film::new(&job);
        let film = film.map_err(|NoMemory { bytes }| Refusal::Memory {
            size: region.size(),
            bytes,
        })?;
        let generation = self.state.begin();
        let submission = Submission {
            generation,
            job,
            film,
            recalled,
        };
        let older = worker.submissions.submit(submission);
        let older = older.map(|job| Request::Drop(Box::new(job)));
        for request in older.into_iter().chain([Request::Trace]) {
            let sent = worker.requests.send(request);
            sent.map_err(|_| Refusal::Ended)?;
        }
        self.accepted = scene;
        Ok(generation)
    }

    /// Makes the job old without a newer one. It can be continued: the next job starts from its
    /// pixels if it differs from it in the materials, the colours of lights, the number of samples
    /// or the limit.
    pub fn stop(&mut self) {
        self.state.begin();
    }

    /// Pauses the newest job within a few milliseconds: its threads wait. Ends with
    /// [`Renderer::resume`] or the next job.
    pub fn pause(&mut self) {
        self.state.pause();
    }

    /// Continues a paused job.
    pub fn resume(&mut self) {
        self.state.resume();
    }

    /// Ends the work and returns the newest picture as far as it is traced, paused or not; `None` if
    /// nothing is traced of it, or it is not one to be continued (see [`Frames::Live`]). Takes as
    /// long as dropping the renderer.
    ///
    /// [`Frames::Live`]: crate::Frames::Live
    pub fn into_checkpoint(self) -> Option<Checkpoint> {
        let (keeper, kept) = mpsc::channel();
        let worker = self.worker.as_ref().ok()?;
        worker.requests.send(Request::Keep(keeper)).ok()?;
        drop(self);
        kept.try_recv().ok()
    }

    /// Returns the newest frame since the last call, if any.
    pub fn latest(&self) -> Option<Arc<Frame>> {
        self.state.take()
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        self.state.quit();
        if let Ok(Worker {
            requests, thread, ..
        }) = mem::replace(&mut self.worker, Err(Refusal::Ended))
        {
            drop(requests);
            // The panic hook has already reported any panic.
            let _ = thread.join();
        }
    }
}

impl Worker {
    fn start(
        threads: Threads,
        state: Arc<RendererState>,
        wake: impl Fn() + Send + Sync + 'static,
    ) -> Result<Self, String> {
        let pool = pool(threads).map_err(|error| error.to_string())?;
        let (requests, inbox) = mpsc::channel();
        let submissions = Arc::new(Submissions::default());
        let submitted = Arc::clone(&submissions);
        let thread = std::thread::Builder::new()
            .name("renderer".to_owned())
            .spawn(move || worker::run(&inbox, &submitted, &state, &wake, &pool))
            .map_err(|error| error.to_string())?;
        Ok(Self {
            submissions,
            requests,
            thread,
        })
    }
}

impl Threads {
    fn count(self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        match self {
            Self::Preview => cores().saturating_sub(1).max(1),
            Self::Background(count) | Self::Exactly(count) => count.max(1),
        }
    }
}

/// The threads that trace.
pub(crate) fn pool(threads: Threads) -> Result<ThreadPool, rayon::ThreadPoolBuildError> {
    let builder = ThreadPoolBuilder::new().num_threads(memory::threads(threads.count()));
    match threads {
        Threads::Background(_) => builder.start_handler(|_| lower_priority()).build(),
        Threads::Preview | Threads::Exactly(_) => builder.build(),
    }
}

/// Yields to all other work; on Linux each thread has its own priority.
#[cfg(target_os = "linux")]
fn lower_priority() {
    // If refused, the thread merely keeps its priority.
    let _ = rustix::process::setpriority_process(Some(rustix::thread::gettid()), 10);
}

#[cfg(not(target_os = "linux"))]
fn lower_priority() {}
