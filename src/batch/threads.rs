//! The thread pool shared by readers of large files.

use std::sync::Once;
use std::thread;

use rayon::ThreadPoolBuilder;

use crate::memory;

/// If no threads can be started, makes the calling thread do the work of rayon's global pool, which
/// would panic otherwise. To be called before the first large file is read.
pub(super) fn prepare() {
    static PREPARED: Once = Once::new();
    PREPARED.call_once(|| {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let probe = ThreadPoolBuilder::new().num_threads(memory::threads(cores));
        if probe.build().is_err() {
            let alone = ThreadPoolBuilder::new().num_threads(1).use_current_thread();
            // This fails only if the pool already exists.
            let _ = alone.build_global();
        }
    });
}
