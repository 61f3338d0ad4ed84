//! The handle on a worker that traces pictures in the background.

use std::sync::Arc;
use std::sync::mpsc::{self, Sender};
use std::thread::JoinHandle;

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::film::{Film, NoMemory};
use super::frame::{Frame, Job};
use super::shared::Shared;
use super::worker::{self, Order};
use crate::scene::Size;

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

/// Why a job is not traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// The worker has ended, by a panic or because the system gave it no threads; what its `wake`
    /// owned is dropped.
    #[error("the system gives no threads to trace with")]
    Ended,
    /// The picture takes more memory than there is.
    #[error(
        "{}x{}: tracing it takes {:.1} GB of memory, more than the system gives; a smaller size \
         takes less",
        size.width, size.height, *bytes as f64 / 1e9
    )]
    Memory {
        /// Its size.
        size: Size,
        /// What tracing it takes.
        bytes: u64,
    },
}

/// A worker that traces the newest job it was given. Dropping it cancels the work and joins.
#[derive(Debug)]
pub struct Renderer {
    shared: Arc<Shared>,
    /// `None` only while it is dropped.
    orders: Option<Sender<Order>>,
    worker: Option<JoinHandle<()>>,
}

impl Renderer {
    /// Starts the worker. `wake` is called from it whenever a newer frame is to be had, at most
    /// once until [`Renderer::latest`] is next called.
    pub fn new(threads: Threads, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let shared = Arc::new(Shared::default());
        let (orders, inbox) = mpsc::channel();
        let for_worker = Arc::clone(&shared);
        let worker = std::thread::spawn(move || {
            if let Ok(pool) = pool(threads) {
                worker::run(&inbox, &for_worker, &wake, &pool);
            }
        });
        Self {
            shared,
            orders: Some(orders),
            worker: Some(worker),
        }
    }

    /// Makes `job` the one to trace and returns its generation, greater than all before. What is
    /// under way is cancelled, but for a first coarse picture younger than 50 ms; a refused job
    /// cancels nothing.
    pub fn restart(&self, job: Job) -> Result<u64, Refusal> {
        let size = job.settings.size;
        let film = Film::new(&job.settings, job.frames);
        let film = film.map_err(|NoMemory { bytes }| Refusal::Memory { size, bytes })?;
        let generation = self.shared.begin();
        let order = Order {
            generation,
            job,
            film,
        };
        let orders = self.orders.as_ref().ok_or(Refusal::Ended)?;
        orders.send(order).map_err(|_| Refusal::Ended)?;
        Ok(generation)
    }

    /// The newest frame since the last call, if there is one.
    pub fn latest(&self) -> Option<Arc<Frame>> {
        self.shared.take()
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        self.shared.quit();
        drop(self.orders.take());
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
