//! Replies of the terminal to queries.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use super::graphics::Protocol;
use super::tmux;

/// Requests a status report (DSR, ECMA-48 8.3.35), which the terminal sends when everything before
/// has arrived. No key sends the same bytes; a report of the cursor position in the first row, in
/// contrast, looks like F3.
pub(super) const ASK_STATUS: &str = "\x1b[5n";

/// A reply of the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reply {
    /// Everything before has arrived.
    Status,
    /// The terminal shows 24-bit colours.
    TrueColour,
    /// The state of a DEC private mode (DECRPM): 1 set, 2 reset, 0 unknown to the terminal.
    Mode {
        /// The number of the mode.
        number: u16,
        /// The state of the mode.
        state: u16,
    },
    /// The terminal knows kitty's keyboard protocol, which keeps keys apart from the beginnings of
    /// sequences.
    KeysApart,
    /// The device attributes (DA1). Every terminal sends them, and in order, so that they end the
    /// replies before.
    Attributes,
    /// The same of a terminal that shows sixel pictures.
    AttributesWithSixel,
    /// The terminal shows pictures sent in this way.
    Shows(Protocol),
    /// The size of a cell in pixels.
    CellSize {
        /// Its width.
        width: u16,
        /// Its height.
        height: u16,
    },
    /// What tmux says of itself and of the terminal behind it.
    Tmux(tmux::Client),
}

impl Reply {
    /// Whether it ends the replies to queries.
    pub fn is_last(self) -> bool {
        matches!(self, Self::Attributes | Self::AttributesWithSixel)
    }
}

/// Replies in flight, awaited before the terminal is handed to a program that would take them for
/// keys.
#[derive(Debug, Default)]
pub struct Replies {
    expected: Mutex<Expected>,
    came: Condvar,
}

#[derive(Debug, Default)]
struct Expected {
    /// Whether [`Reply::Attributes`], which ends the answers to queries, is in flight.
    attributes: bool,
    /// Number of [`Reply::Status`] in flight.
    statuses: usize,
}

impl Replies {
    /// Counts a reply of this kind as in flight.
    pub fn expect(&self, reply: Reply) {
        let mut expected = self.lock();
        match reply {
            Reply::Status => expected.statuses += 1,
            reply if reply.is_last() => expected.attributes = true,
            _ => {}
        }
    }

    /// Counts a reply of this kind as arrived.
    pub fn came(&self, reply: Reply) {
        let mut expected = self.lock();
        match reply {
            Reply::Status => expected.statuses = expected.statuses.saturating_sub(1),
            reply if reply.is_last() => expected.attributes = false,
            _ => return,
        }
        self.came.notify_all();
    }

    /// Stops expecting status reports.
    pub fn forget_statuses(&self) {
        self.lock().statuses = 0;
    }

    /// Waits until no reply is in flight, or until `deadline`.
    pub fn wait(&self, deadline: Instant) {
        let time = deadline.saturating_duration_since(Instant::now());
        let waited = self
            .came
            .wait_timeout_while(self.lock(), time, |expected| expected.is_any());
        drop(waited.unwrap_or_else(PoisonError::into_inner));
    }

    fn lock(&self) -> MutexGuard<'_, Expected> {
        self.expected.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Expected {
    fn is_any(&self) -> bool {
        self.attributes || 0 < self.statuses
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::thread;
    use std::time::Duration;

    use super::*;

    const MODE: Reply = Reply::Mode {
        number: 2026,
        state: 1,
    };

    #[test]
    fn replies_are_counted_by_kind() {
        use Reply::{Attributes, Status, TrueColour};
        for (expected, arrived, is_any) in [
            (&[][..], &[][..], false),
            (&[Status], &[], true),
            (&[Status], &[Status], false),
            (&[Status, Status], &[Status], true),
            (&[Status, Status], &[Status, Status], false),
            (&[Status], &[Attributes], true),
            (&[Attributes], &[Status, Status], true),
            (&[Attributes], &[TrueColour, MODE], true),
            (&[Attributes], &[TrueColour, Attributes], false),
            (&[Attributes], &[Reply::AttributesWithSixel], false),
            (&[Attributes, Status], &[Attributes], true),
            (&[Attributes, Status], &[Status, Attributes], false),
            (&[TrueColour, MODE], &[], false),
            // A forgotten one arrives late.
            (&[], &[Status], false),
        ] {
            let replies = Replies::default();
            for &reply in expected {
                replies.expect(reply);
            }
            for &reply in arrived {
                replies.came(reply);
            }
            let found = replies.lock().is_any();
            assert_eq!(found, is_any, "{arrived:?} of {expected:?}");
        }
    }

    #[test]
    fn forgetting_reports_does_not_forget_the_attributes() {
        let replies = Replies::default();
        replies.expect(Reply::Status);
        replies.forget_statuses();
        assert!(!replies.lock().is_any());
        replies.expect(Reply::Status);
        replies.expect(Reply::Attributes);
        replies.forget_statuses();
        assert!(replies.lock().is_any());
    }

    #[test]
    fn the_last_reply_ends_the_wait() {
        let replies = Arc::new(Replies::default());
        replies.expect(Reply::Status);
        replies.wait(Instant::now());
        assert!(replies.lock().is_any(), "the deadline has passed");
        let theirs = Arc::clone(&replies);
        let arrival = thread::spawn(move || theirs.came(Reply::Status));
        let begun = Instant::now();
        replies.wait(begun + Duration::from_secs(60));
        assert!(begun.elapsed() < Duration::from_secs(30));
        arrival.join().expect("no panic");
    }
}
