//! The terminal after an abort: of an allocation that failed, a stack that overflowed, a panic while
//! panicking. Nothing of the process can be relied on any more, so a signal handler writes a few bytes
//! and sets the terminal's modes.
#![allow(
    unsafe_code,
    reason = "a handler that runs amid an abort can't be registered otherwise"
)]

use std::io;
use std::sync::Arc;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};
use signal_hook::SigId;
use signal_hook::consts::SIGABRT;
use signal_hook::low_level;

use super::panics::{Shared, Tenure};
use super::tty;

/// Printed on the restored screen: what Rust prints before an abort goes to the alternate one.
const WORDS: &[u8] = b"halflight aborted, most likely because memory ran out; \
    the next start offers to restore unsaved edits\r\n";

/// How long a terminal that takes no bytes is waited for.
const PATIENCE: Timespec = Timespec {
    tv_sec: 0,
    tv_nsec: 200_000_000,
};

/// Gives the terminal back if the process is aborted, until it is dropped.
#[derive(Debug)]
pub(super) struct Abort(SigId);

impl Abort {
    /// Remembers the terminal's modes, which are those to give back, and that `leave` gives back the
    /// screen.
    pub(super) fn install(shared: Arc<Shared>, leave: &'static str) -> io::Result<Self> {
        let terminal = tty::keyboard()?;
        let modes = tcgetattr(&terminal)?;
        let restore = move || {
            if shared.tenure_amid_signal() == Tenure::Ours {
                write(leave.as_bytes());
                write(WORDS);
                let _ = tcsetattr(&terminal, OptionalActions::Now, &modes);
            }
            // The process ends as it would without this handler.
            let _ = low_level::emulate_default_handler(SIGABRT);
        };
        // SAFETY: the handler takes no lock that it waits for, allocates nothing and does not panic.
        // It makes the system calls poll, write and ioctl, and raises the signal again.
        let registered = unsafe { low_level::register(SIGABRT, restore) };
        registered.map(Self)
    }
}

impl Drop for Abort {
    fn drop(&mut self) {
        low_level::unregister(self.0);
    }
}

fn write(mut bytes: &[u8]) {
    let output = rustix::stdio::stdout();
    while !bytes.is_empty() {
        let mut ready = [PollFd::new(&output, PollFlags::OUT)];
        if !matches!(poll(&mut ready, Some(&PATIENCE)), Ok(1)) {
            break;
        }
        match rustix::io::write(output, bytes) {
            Ok(written @ 1..) => bytes = bytes.get(written..).unwrap_or_default(),
            _ => break,
        }
    }
}
