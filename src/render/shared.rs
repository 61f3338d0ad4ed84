//! State shared by a renderer and its worker: the newest generation and the newest frame.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::frame::Frame;

/// A generation that no job has, which tells the worker to end.
const QUIT: u64 = u64::MAX;

/// The two shared cells.
#[derive(Debug, Default)]
pub(crate) struct Shared {
    newest: AtomicU64,
    slot: Mutex<Option<Arc<Frame>>>,
}

impl Shared {
    /// Makes all previous jobs old; returns the generation of the new one.
    pub(crate) fn begin(&self) -> u64 {
        self.newest.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Makes all jobs old and tells the worker to end.
    pub(crate) fn quit(&self) {
        self.newest.store(QUIT, Ordering::Relaxed);
    }

    /// Whether the worker is to end.
    pub(crate) fn is_quitting(&self) -> bool {
        self.newest.load(Ordering::Relaxed) == QUIT
    }

    /// Whether a newer job has begun.
    pub(crate) fn is_old(&self, generation: u64) -> bool {
        self.newest.load(Ordering::Relaxed) != generation
    }

    /// Stores a frame for [`Shared::take`] and returns the previous one if it was not taken.
    pub(crate) fn publish(&self, frame: Frame) -> Option<Arc<Frame>> {
        self.lock().replace(Arc::new(frame))
    }

    /// Takes the newest frame since the last call.
    pub(crate) fn take(&self) -> Option<Arc<Frame>> {
        self.lock().take()
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Option<Arc<Frame>>> {
        // Replacing a frame is atomic: a panic elsewhere leaves it valid.
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
