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

/// Which replies are on their way, so that the terminal is handed to nobody who would take them for
/// keys.
#[derive(Debug, Default)]
pub struct Replies {
    expected: Mutex<Expected>,
    came: Condvar,
}

#[derive(Debug, Default)]
struct Expected {
    /// Whether [`Reply::Attributes`], which ends the answers about colours, is to come.
    attributes: bool,
    /// How many times [`Reply::Status`] is to come.
    statuses: usize,
}

impl Replies {
    /// One that ends with this is on its way.
    pub fn expect(&self, reply: Reply) {
        let mut expected = self.lock();
        match reply {
            Reply::Status => expected.statuses += 1,
            Reply::Attributes => expected.attributes = true,
            Reply::TrueColour | Reply::Mode { .. } => {}
        }
    }

    /// It has come.
    pub fn came(&self, reply: Reply) {
        let mut expected = self.lock();
        match reply {
            Reply::Status => expected.statuses = expected.statuses.saturating_sub(1),
            Reply::Attributes => expected.attributes = false,
            Reply::TrueColour | Reply::Mode { .. } => return,
        }
        self.came.notify_all();
    }

    /// No status will come.
    pub fn forget_statuses(&self) {
        self.lock().statuses = 0;
    }

    /// Waits until none is on its way, until `deadline` at most.
    pub fn wait(&self, deadline: Instant) {
        let time = deadline.saturating_duration_since(Instant::now());
        let is_awaited = |expected: &mut Expected| expected.attributes || 0 < expected.statuses;
        let waited = self.came.wait_timeout_while(self.lock(), time, is_awaited);
        drop(waited.unwrap_or_else(PoisonError::into_inner));
    }

    fn lock(&self) -> MutexGuard<'_, Expected> {
        self.expected.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
