//! State shared by a renderer and its worker: the newest generation and whether it is paused, and
//! the newest frame.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::picture::Frame;

/// A state that no generation has, which tells the worker to end.
const QUIT: u64 = u64::MAX;

/// The bit of the state that says that its generation is paused; the others are the generation.
const PAUSED: u64 = 1;

/// The two shared cells, and the signal that the first has changed.
#[derive(Debug, Default)]
pub(crate) struct RendererState {
    state: AtomicU64,
    slot: Mutex<Slot>,
    changed: Condvar,
}

/// The newest frame, and how long the worker was paused.
#[derive(Debug, Default)]
struct Slot {
    frame: Option<Arc<Frame>>,
    /// When the present pause began.
    paused: Option<Instant>,
    /// The duration of all pauses before.
    pauses: Duration,
}

impl RendererState {
    /// Makes all previous jobs old and ends a pause; returns the generation of the new one.
    pub(crate) fn begin(&self) -> u64 {
        let generation = self.state.load(Ordering::Relaxed) / 2 + 1;
        self.change(2 * generation);
        generation
    }

    /// Makes all jobs old and tells the worker to end.
    pub(crate) fn quit(&self) {
        self.change(QUIT);
    }

    /// Pauses the newest job.
    pub(crate) fn pause(&self) {
        self.change(self.state.load(Ordering::Relaxed) | PAUSED);
    }

    /// Ends a pause.
    pub(crate) fn resume(&self) {
        self.change(self.state.load(Ordering::Relaxed) & !PAUSED);
    }

    /// Whether the worker is to end.
    pub(crate) fn is_quitting(&self) -> bool {
        self.state.load(Ordering::Relaxed) == QUIT
    }

    /// Whether a newer job has begun.
    pub(crate) fn is_old(&self, generation: u64) -> bool {
        self.state.load(Ordering::Relaxed) / 2 != generation
    }

    /// Waits while this generation is paused; its job may go on, be old, or end after that.
    #[inline]
    pub(crate) fn wait(&self, generation: u64) {
        let is_paused = || self.state.load(Ordering::Relaxed) == (2 * generation) | PAUSED;
        if is_paused() {
            let slot = self.lock();
            let waited = self.changed.wait_while(slot, |_| is_paused());
            drop(waited.unwrap_or_else(PoisonError::into_inner));
        }
    }

    /// The duration of all pauses.
    pub(crate) fn pauses(&self) -> Duration {
        let slot = self.lock();
        let present = slot.paused.map_or(Duration::ZERO, |begun| begun.elapsed());
        slot.pauses + present
    }

    /// Stores a frame for [`RendererState::take`] and returns the previous one if it was not taken.
    pub(crate) fn publish(&self, frame: Frame) -> Option<Arc<Frame>> {
        self.lock().frame.replace(Arc::new(frame))
    }

    /// Takes the newest frame since the last call.
    pub(crate) fn take(&self) -> Option<Arc<Frame>> {
        self.lock().frame.take()
    }

    fn change(&self, state: u64) {
        // With the lock, no thread can be between finding a pause and waiting for its end.
        let mut slot = self.lock();
        self.state.store(state, Ordering::Relaxed);
        if state & PAUSED == 0 || state == QUIT {
            let begun = slot.paused.take();
            slot.pauses += begun.map_or(Duration::ZERO, |begun| begun.elapsed());
            self.changed.notify_all();
        } else {
            slot.paused.get_or_insert_with(Instant::now);
        }
    }

    fn lock(&self) -> MutexGuard<'_, Slot> {
        // Every change is atomic: a panic elsewhere leaves the slot valid.
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
