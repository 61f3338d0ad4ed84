//! Threads under a limit on memory: each takes address space for its stack and for what its
//! allocations come from, used or not. Where the system gives fewer than wanted, fewer do the work.

use std::hint::black_box;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use rayon::{ThreadPool, ThreadPoolBuilder};

/// Address space that a thread may take: a stack of two megabytes, and the heap of its own that the
/// GNU C library reserves.
const EACH: u64 = 66 << 20;

/// The part of the address space that a pool of threads may take is one in so many.
const SHARE: u64 = 4;

/// How many threads of pools run, whose address space is taken already.
static RUNNING: AtomicUsize = AtomicUsize::new(0);

/// The system gives no threads.
#[derive(Clone, Debug, thiserror::Error)]
#[error("the system gives no threads to work with")]
pub struct NoThreads;

/// How many threads a pool may have of the number wanted: at least one.
fn threads(wanted: usize) -> usize {
    fewer(wanted, address_space_limit())
}

fn fewer(wanted: usize, limit: Option<u64>) -> usize {
    let most = limit.map_or(u64::MAX, |limit| limit / (SHARE * EACH));
    wanted
        .min(usize::try_from(most).unwrap_or(usize::MAX))
        .max(1)
}

fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// Address space that threads to be started may take.
#[cfg(target_os = "linux")]
pub(super) fn address_space() -> u64 {
    let running = RUNNING.load(Ordering::Relaxed);
    EACH * threads(cores()).saturating_sub(running) as u64
}

fn address_space_limit() -> Option<u64> {
    #[cfg(unix)]
    {
        rustix::process::getrlimit(rustix::process::Resource::As).current
    }
    #[cfg(not(unix))]
    None
}

/// Starts a pool of the threads wanted, or of as many as the system gives. Each calls `begin` first.
/// Where there are none, the calling thread is the pool: only its own work is done then, and the pool
/// is never freed.
pub fn pool(wanted: usize, begin: impl Fn() + Clone + Send + Sync + 'static) -> ThreadPool {
    if let Some(pool) = started(wanted, &begin) {
        return pool;
    }
    begin();
    let alone = ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    alone
        .build()
        .expect("nothing is started, and a thread calls this once")
}

/// A pool of as many threads as the system gives of those wanted; `None` if it gives none.
fn started(
    wanted: usize,
    begin: &(impl Fn() + Clone + Send + Sync + 'static),
) -> Option<ThreadPool> {
    let mut count = threads(wanted);
    while 0 < count {
        let begin = begin.clone();
        let builder = ThreadPoolBuilder::new().num_threads(count);
        if let Ok(pool) = builder.start_handler(move |_| begin()).build() {
            return Some(pool);
        }
        count /= 2;
    }
    None
}

/// What becomes of work for threads that the system does not give.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WithoutThreads {
    /// It is refused.
    Refused,
    /// The thread that calls does it. No other one may ask for such work.
    DoneByCaller,
}

/// Starts the threads that long work is shared among outside any pool, unless they run already: as many
/// as the system gives. Left to start by themselves they panic where it gives none.
pub fn start_threads(otherwise: WithoutThreads) -> Result<(), NoThreads> {
    static STARTED: OnceLock<Result<(), NoThreads>> = OnceLock::new();
    let start = || {
        // They can be tried to start only once, so others are tried before.
        let tried = started(cores(), &|| ()).map(|pool| pool.current_num_threads());
        let builder = match (tried, otherwise) {
            (Some(count), _) => ThreadPoolBuilder::new().num_threads(count),
            (None, WithoutThreads::DoneByCaller) => {
                ThreadPoolBuilder::new().num_threads(1).use_current_thread()
            }
            (None, WithoutThreads::Refused) => return Err(NoThreads),
        };
        match builder.build_global() {
            // Others have started them.
            Err(error) if std::error::Error::source(&error).is_none() => {}
            started => started.map_err(|_| NoThreads)?,
        }
        // From here on the address space that each takes is known.
        let _ = rayon::broadcast(|_| drop(black_box(vec![0_u8])));
        RUNNING.fetch_add(tried.unwrap_or(0), Ordering::Relaxed);
        Ok(())
    };
    STARTED.get_or_init(start).clone()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_os = "linux")]
    fn no_room_is_kept_for_threads_that_run() {
        start_threads(WithoutThreads::Refused).expect("threads");
        assert_eq!(address_space(), 0);
    }

    #[test]
    fn little_address_space_means_few_threads() {
        const GB: u64 = 1 << 30;
        for (wanted, limit, got) in [
            (8, None, 8),
            (8, Some(16 * GB), 8),
            (8, Some(GB), 3),
            (8, Some(1), 1),
            (0, None, 1),
        ] {
            assert_eq!(fewer(wanted, limit), got, "{wanted} within {limit:?}");
        }
    }
}
