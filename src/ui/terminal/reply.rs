//! What the terminal says when it is asked.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Has the terminal say that it is there (DSR, ECMA-48 8.3.35), which it does when everything
/// before has arrived. No key sends what it replies, unlike the position of the cursor, which in
/// the first row looks like F3.
pub(super) const ASK_STATUS: &str = "\x1b[5n";

/// An answer of the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reply {
    /// It has taken everything before.
    Status,
    /// It shows 24-bit colours.
    TrueColour,
    /// How a DEC private mode stands, as DECRPM says it: 1 set, 2 reset, 0 unknown to it.
    Mode {
        /// The mode's number.
        number: u16,
        /// How it stands.
        state: u16,
    },
    /// What it is (DA1). Every terminal answers this, and answers in order: no other is to come.
    Attributes,
}

/// Counts replies that are on their way, so that the terminal is handed to nobody who would take
/// them for keys.
#[derive(Debug, Default)]
pub struct Replies {
    expected: Mutex<usize>,
    came: Condvar,
}

impl Replies {
    /// One more is on its way.
    pub fn expect(&self) {
        *self.lock() += 1;
    }

    /// One has come.
    pub fn came(&self) {
        let mut expected = self.lock();
        *expected = expected.saturating_sub(1);
        self.came.notify_all();
    }

    /// None will come.
    pub fn forget(&self) {
        *self.lock() = 0;
    }

    /// Waits until none is on its way, until `deadline` at most.
    pub fn wait(&self, deadline: Instant) {
        let time = deadline.saturating_duration_since(Instant::now());
        let waited = self
            .came
            .wait_timeout_while(self.lock(), time, |expected| 0 < *expected);
        drop(waited.unwrap_or_else(PoisonError::into_inner));
    }

    fn lock(&self) -> MutexGuard<'_, usize> {
        self.expected.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
