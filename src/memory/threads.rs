//! Threads under a memory limit: each takes address space for its stack and its heap, used or not.

use std::sync::OnceLock;
use std::thread;

use rayon::ThreadPoolBuilder;

/// Address space of a thread in bytes: a stack of two megabytes, and the separate heap that the GNU
/// C library reserves.
const EACH: u64 = 66 << 20;

/// A thread pool may take one part in this many of the address space.
const SHARE: u64 = 4;

/// The error that no threads can be started.
#[derive(Clone, Debug, thiserror::Error)]
#[error("cannot start threads")]
pub struct NoThreads;

/// The number of threads that a pool may have, from 1 to `wanted`.
pub fn threads(wanted: usize) -> usize {
    fewer(wanted, address_space_limit())
}

fn fewer(wanted: usize, limit: Option<u64>) -> usize {
    let most = limit.map_or(u64::MAX, |limit| limit / (SHARE * EACH));
    wanted
        .min(usize::try_from(most).unwrap_or(usize::MAX))
        .max(1)
}

/// Address space in bytes to reserve for threads yet to be started.
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

/// Starts rayon's global pool, used by long work outside any other pool, unless it is running. If
/// rayon started it implicitly and got no threads, it would panic.
pub fn start_threads() -> Result<(), NoThreads> {
    static STARTED: OnceLock<Result<(), NoThreads>> = OnceLock::new();
    let start = || {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let builder = ThreadPoolBuilder::new().num_threads(threads(cores));
        match builder.build_global() {
            // It is already running.
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
    fn little_address_space_allows_few_threads() {
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
