//! Threads under a limit on memory: each takes address space for its stack and for what its
//! allocations come from, used or not.

use std::sync::OnceLock;
use std::thread;

use rayon::ThreadPoolBuilder;

/// Address space that a thread may take: a stack of two megabytes, and the heap of its own that the
/// GNU C library reserves.
const EACH: u64 = 66 << 20;

/// The part of the address space that a pool of threads may take is one in so many.
const SHARE: u64 = 4;

/// The system gives no threads.
#[derive(Clone, Debug, thiserror::Error)]
#[error("the system gives no threads to work with")]
pub struct NoThreads;

/// How many threads a pool may have of the number wanted: at least one.
pub fn threads(wanted: usize) -> usize {
    fewer(wanted, address_space_limit())
}

fn fewer(wanted: usize, limit: Option<u64>) -> usize {
    let most = limit.map_or(u64::MAX, |limit| limit / (SHARE * EACH));
    wanted
        .min(usize::try_from(most).unwrap_or(usize::MAX))
        .max(1)
}

/// Address space that threads to be started may take.
#[cfg(target_os = "linux")]
pub(super) fn address_space() -> u64 {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    EACH * threads(cores) as u64
}

fn address_space_limit() -> Option<u64> {
    #[cfg(unix)]
    {
        rustix::process::getrlimit(rustix::process::Resource::As).current
    }
    #[cfg(not(unix))]
    None
}

/// Starts the threads that long work is shared among outside any pool, unless they run already. Left to
/// start by themselves they panic where the system gives none.
pub fn start_threads() -> Result<(), NoThreads> {
    static STARTED: OnceLock<Result<(), NoThreads>> = OnceLock::new();
    let start = || {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let builder = ThreadPoolBuilder::new().num_threads(threads(cores));
        match builder.build_global() {
            // Others have started them.
            Err(error) if std::error::Error::source(&error).is_none() => Ok(()),
            started => started.map_err(|_| NoThreads),
        }
    };
    STARTED.get_or_init(start).clone()
}

#[cfg(test)]
mod tests {
    use super::*;

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
