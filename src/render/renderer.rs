//! The handle on a worker that traces pictures in the background.

use std::cell::RefCell;
use std::mem;
use std::sync::mpsc::{self, Sender};
use std::sync::{Arc, Weak};
use std::thread::JoinHandle;

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::film::{Film, NoMemory};
use super::frame::{Frame, Job};
use super::room;
use super::shared::Shared;
use super::worker::{self, Order};
use crate::memory::{self, OutOfMemory};
use crate::scene::{Scene, Size};

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
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// The worker has ended by a panic; what its `wake` owned is dropped.
    #[error("the renderer has stopped")]
    Ended,
    /// The system does not give the worker its threads; what its `wake` owned is dropped.
    #[error("can't start the rendering threads ({count}): {reason}; --threads N sets how many")]
    Threads {
        /// How many trace.
        count: usize,
        /// What the system said.
        reason: String,
    },
    /// The objects or the picture do not fit into memory.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
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
    /// Why there is none, where threads can't be started; else [`Refusal::Ended`] only while it is
    /// dropped.
    worker: Result<Worker, Refusal>,
    /// The scene of the last job that was not refused.
    accepted: RefCell<Weak<Scene>>,
}

#[derive(Debug)]
struct Worker {
    orders: Sender<Order>,
    thread: JoinHandle<()>,
}

impl Renderer {
    /// Starts the worker. `wake` is called from it whenever a newer frame is to be had, at most
    /// once until [`Renderer::latest`] is next called. Where threads can't be started every job is
    /// refused.
    pub fn new(threads: Threads, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let shared = Arc::new(Shared::default());
        let count = threads.count();
        let worker = Worker::start(threads, Arc::clone(&shared), wake);
        Self {
            shared,
            worker: worker.map_err(|reason| Refusal::Threads { count, reason }),
            accepted: RefCell::default(),
        }
    }

    /// Makes `job` the one to trace and returns its generation, greater than all before. What is
    /// under way is cancelled, but for a first coarse picture younger than 50 ms; a refused job
    /// cancels nothing.
    pub fn restart(&self, job: Job) -> Result<u64, Refusal> {
        let worker = self.worker.as_ref().map_err(Refusal::clone)?;
        let size = job.settings.size;
        room::fits(&job, self.accepted.borrow().upgrade().as_ref())?;
        let scene = Arc::downgrade(&job.scene);
        let film = Film::new(&job.settings, job.frames);
        let film = film.map_err(|NoMemory { bytes }| Refusal::Memory { size, bytes })?;
        let generation = self.shared.begin();
        let order = Order {
            generation,
            job,
            film,
        };
        worker.orders.send(order).map_err(|_| Refusal::Ended)?;
        self.accepted.replace(scene);
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
        if let Ok(Worker { orders, thread }) = mem::replace(&mut self.worker, Err(Refusal::Ended)) {
            drop(orders);
            // The panic hook has told of a panic already.
            let _ = thread.join();
        }
    }
}

impl Worker {
    fn start(
        threads: Threads,
        shared: Arc<Shared>,
        wake: impl Fn() + Send + Sync + 'static,
    ) -> Result<Self, String> {
        let pool = pool(threads).map_err(|error| error.to_string())?;
        let (orders, inbox) = mpsc::channel();
        let thread = std::thread::Builder::new()
            .name("renderer".to_owned())
            .spawn(move || worker::run(&inbox, &shared, &wake, &pool))
            .map_err(|error| error.to_string())?;
        Ok(Self { orders, thread })
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

fn pool(threads: Threads) -> Result<ThreadPool, rayon::ThreadPoolBuildError> {
    let builder = ThreadPoolBuilder::new().num_threads(memory::threads(threads.count()));
    match threads {
        Threads::Background(_) => builder.start_handler(|_| lower_priority()).build(),
        Threads::Preview | Threads::Exactly(_) => builder.build(),
    }
}

/// Lets everything else go first: on Linux a thread has a priority of its own.
#[cfg(target_os = "linux")]
fn lower_priority() {
    // Refusal does no harm: the thread merely keeps its priority.
    let _ = rustix::process::setpriority_process(Some(rustix::thread::gettid()), 10);
}

#[cfg(not(target_os = "linux"))]
fn lower_priority() {}
