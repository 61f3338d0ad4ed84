//! What a renderer and its worker share: which job is the newest, and the newest frame.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::frame::Frame;

/// The generation that no job has: it tells the worker to end.
const QUIT: u64 = u64::MAX;

/// The renderer's two shared cells.
#[derive(Debug, Default)]
pub(crate) struct Shared {
    newest: AtomicU64,
    slot: Mutex<Option<Arc<Frame>>>,
}

impl Shared {
    /// Makes all jobs before old; the generation of the new one.
    pub(crate) fn begin(&self) -> u64 {
        self.newest.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Makes all jobs old for good.
    pub(crate) fn quit(&self) {
        self.newest.store(QUIT, Ordering::Relaxed);
    }

    /// Whether there is to be no further job.
    pub(crate) fn is_quitting(&self) -> bool {
        self.newest.load(Ordering::Relaxed) == QUIT
    }

    /// Whether a newer job was begun.
    pub(crate) fn is_old(&self, generation: u64) -> bool {
        self.newest.load(Ordering::Relaxed) != generation
    }

    /// Puts a frame where [`Shared::take`] finds it, and returns the one that was not taken.
    pub(crate) fn publish(&self, frame: Frame) -> Option<Arc<Frame>> {
        self.lock().replace(Arc::new(frame))
    }

    /// Takes the newest frame since the last call.
    pub(crate) fn take(&self) -> Option<Arc<Frame>> {
        self.lock().take()
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Option<Arc<Frame>>> {
        // A frame is put in whole: a panic elsewhere leaves nothing half done.
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
