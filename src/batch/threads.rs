//! The threads that reading shares.

use std::sync::Once;
use std::thread;

use rayon::ThreadPoolBuilder;

use crate::memory;

/// Where the system does not give the threads that large files are read with, has the calling thread
/// do their work: without them rayon's shared pool panics. Called before the first large file.
pub(super) fn settle() {
    static SETTLED: Once = Once::new();
    SETTLED.call_once(|| {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let probe = ThreadPoolBuilder::new().num_threads(memory::threads(cores));
        if probe.build().is_err() {
            let alone = ThreadPoolBuilder::new().num_threads(1).use_current_thread();
            // It is an error only where the pool is there already.
            let _ = alone.build_global();
        }
    });
}
