//! Threads under a memory limit: each takes address space for its stack and its heap, used or not.

use std::sync::mpsc;
use std::{io, thread};

use rayon::{ThreadBuilder, ThreadPoolBuilder};

/// Address space of a thread's stack in bytes.
const STACK: u64 = 2 << 20;

/// Address space of a thread in bytes: its stack, and the separate heap that the GNU C library reserves.
const EACH: u64 = STACK + HEAP;

/// Address space of a heap in bytes.
const HEAP: u64 = 64 << 20;

/// A thread pool may take one part in this many of the address space, and so may all heaps but the first.
const SHARE: u64 = 4;

/// The error that no threads can be started.
#[derive(Clone, Debug, thiserror::Error)]
#[error("cannot start threads")]
pub struct NoThreads;

/// The number of threads that a pool may have, from 1 to `wanted`.
pub fn threads(wanted: usize) -> usize {
    fewer(wanted, address_space_limit())
}

/// The number of heaps besides the first that fit into a limit of address space: while one is begun it
/// takes twice its size.
#[cfg(target_os = "linux")]
pub(super) fn more_heaps(limit: u64) -> u64 {
    limit / (SHARE * 2 * HEAP)
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
    let threads = threads(cores) as u64;
    let heaps = address_space_limit().map_or(threads, more_heaps);
    STACK * threads + HEAP * heaps.min(threads)
}

pub(super) fn address_space_limit() -> Option<u64> {
    rustix::process::getrlimit(rustix::process::Resource::As).current
}

/// Starts rayon's global pool, used by work outside any other pool, with as many threads as the
/// system grants up to one per core. To be called once, at the start of the program: rayon would
/// start the pool at its first use, and panic if one of its threads does not start.
pub fn start_threads() -> Result<(), NoThreads> {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    // The pool is built for the threads that run already, since a pool that fails is final.
    let start = |_| {
        let (worker, inbox) = mpsc::channel::<ThreadBuilder>();
        let run = move || inbox.recv().map_or((), ThreadBuilder::run);
        thread::Builder::new().spawn(run).ok().map(|_| worker)
    };
    let workers: Vec<_> = (0..threads(cores)).map_while(start).collect();
    if workers.is_empty() {
        return Err(NoThreads);
    }
    let hand_out = |worker: ThreadBuilder| {
        let thread = &workers[worker.index()];
        thread
            .send(worker)
            .map_err(|_| io::ErrorKind::BrokenPipe.into())
    };
    let builder = ThreadPoolBuilder::new().num_threads(workers.len());
    let started = builder.spawn_handler(hand_out).build_global();
    started.map_err(|_| NoThreads)
}

/// Starts the pool; if no thread can be started, the calling thread does the work of the pool.
pub fn start_threads_or_none() {
    if start_threads().is_err() {
        let alone = ThreadPoolBuilder::new().num_threads(1).use_current_thread();
        // This fails only if a pool has been started before.
        let _ = alone.build_global();
    }
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

    #[test]
    #[cfg(target_os = "linux")]
    fn little_address_space_holds_few_heaps() {
        const GB: u64 = 1 << 30;
        for (limit, more) in [(0, 0), (GB / 2, 1), (4 * GB, 8)] {
            assert_eq!(more_heaps(limit), more, "{limit}");
        }
    }
}
