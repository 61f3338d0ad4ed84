//! The handle on a worker that traces pictures in the background.

use std::sync::Arc;
use std::sync::mpsc::{self, Sender};
use std::thread::JoinHandle;

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::frame::{Frame, Job};
use super::shared::Shared;
use super::worker;

/// How many threads trace, and how they stand beside other work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Threads {
    /// One fewer than the machine's cores (at least one): keys stay quick.
    Preview,
    /// As many as given, at lower priority where the system has priorities for threads.
    Background(usize),
    /// As many as given.
    Exactly(usize),
}

/// A worker that traces the newest job it was given. Dropping it cancels the work and joins.
#[derive(Debug)]
pub struct Renderer {
    shared: Arc<Shared>,
    /// `None` only while it is dropped.
    jobs: Option<Sender<(u64, Job)>>,
    worker: Option<JoinHandle<()>>,
}

impl Renderer {
    /// Starts the worker. `wake` is called from it whenever a newer frame is to be had, at most
    /// once until [`Renderer::latest`] is next called.
    pub fn new(threads: Threads, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let shared = Arc::new(Shared::default());
        let (jobs, inbox) = mpsc::channel();
        let for_worker = Arc::clone(&shared);
        let worker = std::thread::spawn(move || {
            if let Ok(pool) = pool(threads) {
                worker::run(&inbox, &for_worker, &wake, &pool);
            }
        });
        Self {
            shared,
            jobs: Some(jobs),
            worker: Some(worker),
        }
    }

    /// Makes `job` the one to trace and returns its generation, greater than all before. What is
    /// under way is cancelled, but for a first coarse picture younger than 50 ms. `None` if the
    /// worker has ended, by a panic or because the system gave it no threads; what `wake` owns is
    /// dropped then.
    pub fn restart(&self, job: Job) -> Option<u64> {
        let generation = self.shared.begin();
        self.jobs.as_ref()?.send((generation, job)).ok()?;
        Some(generation)
    }

    /// The newest frame since the last call, if there is one.
    pub fn latest(&self) -> Option<Arc<Frame>> {
        self.shared.take()
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        self.shared.quit();
        drop(self.jobs.take());
        if let Some(worker) = self.worker.take() {
            // The panic hook has told of a panic already.
            let _ = worker.join();
        }
    }
}

fn pool(threads: Threads) -> Result<ThreadPool, rayon::ThreadPoolBuildError> {
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    let count = match threads {
        Threads::Preview => cores().saturating_sub(1).max(1),
        Threads::Background(count) | Threads::Exactly(count) => count.max(1),
    };
    let builder = ThreadPoolBuilder::new().num_threads(count);
    match threads {
        Threads::Background(_) => builder.start_handler(|_| lower_priority()).build(),
        Threads::Preview | Threads::Exactly(_) => builder.build(),
    }
}

/// Lets everything else go first: on Linux a thread has a priority of its own.
#[cfg(target_os = "linux")]
fn lower_priority() {
    // Refusal is no harm: the thread merely keeps its priority.
    let _ = rustix::process::setpriority_process(Some(rustix::thread::gettid()), 10);
}

#[cfg(not(target_os = "linux"))]
fn lower_priority() {}
