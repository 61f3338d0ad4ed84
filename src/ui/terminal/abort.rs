//! Restores the terminal after an abort (by a failed allocation, a stack overflow, or a panic while
//! panicking), an illegal instruction or a forbidden system call. The state of the process is unreliable
//! by then, so a signal handler writes a few bytes and sets the terminal's modes.
//!
//! `SIGSEGV` and `SIGBUS` are left to Rust, which uses them to detect a stack overflow and aborts:
//! its handler has its own stack, this one does not.
#![allow(
    unsafe_code,
    reason = "a handler that runs during an abort cannot be registered otherwise"
)]

use std::io;
use std::sync::Arc;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fd::BorrowedFd;
use rustix::termios::{OptionalActions, QueueSelector, tcflush, tcgetattr, tcsetattr};
use signal_hook::consts::{SIGABRT, SIGFPE, SIGILL, SIGSYS, SIGTRAP};
use signal_hook::low_level;
use signal_hook_registry::register_signal_unchecked;

use super::ownership::{GuardState, Ownership};
use super::tty;

/// The signals with the message printed on the restored screen: Rust's own message before an abort
/// goes to the alternate screen.
const FATAL: [(i32, &str); 5] = [
    (SIGABRT, "halflight aborted"),
    (SIGFPE, "halflight was ended by SIGFPE"),
    (SIGILL, "halflight was ended by SIGILL"),
    (SIGSYS, "halflight was ended by SIGSYS"),
    (SIGTRAP, "halflight was ended by SIGTRAP"),
];

/// Appended to the message if known to be true.
const KEPT: &str = "; unsaved edits are kept, the next run of the scene offers them";

/// Maximum time to wait for a terminal that accepts no bytes.
const PATIENCE: Timespec = Timespec {
    tv_sec: 0,
    tv_nsec: 200_000_000,
};

/// Restores the terminal if the process dies of one of these signals while it owns the terminal.
///
/// The current modes of the terminal are those to restore; `leave` restores the screen. The
/// handlers stay registered: an illegal instruction whose signal is not handled would be retried
/// for ever.
pub(super) fn install(shared: &Arc<GuardState>, leave: &'static str) -> io::Result<()> {
    let modes = tcgetattr(tty::keyboard()?)?;
    for (signal, words) in FATAL {
        let (terminal, modes, shared) = (tty::keyboard()?, modes.clone(), Arc::clone(shared));
        let restore = move || {
            if shared.ownership_in_signal() == Ownership::Ours {
                shared.output.fall_silent();
                let kept = if shared.has_kept_edits() { KEPT } else { "" };
                let keys = shared.keys_ending();
                let parts = [shared.ending(), keys, leave, words, kept, "\r\n"];
                let _ = parts.iter().all(|part| write(part.as_bytes()));
                let _ = tcsetattr(&terminal, OptionalActions::Now, &modes);
            }
            // The process ends as it would without this handler.
            let _ = low_level::emulate_default_handler(signal);
        };
        // SAFETY: the handler waits for no lock, allocates nothing and does not panic. It makes the
        // system calls poll, write and ioctl, and raises the signal again, so that it never returns
        // to an instruction that failed.
        unsafe { register_signal_unchecked(signal, restore) }?;
    }
    Ok(())
}

/// Writes bytes; returns whether the terminal accepted all of them.
fn write(mut bytes: &[u8]) -> bool {
    let output = rustix::stdio::stdout();
    while !bytes.is_empty() {
        if !has_room(output) {
            // Discards unread output to make room for the bytes that restore the screen, once it is
            // read.
            let _ = tcflush(output, QueueSelector::OFlush);
            if !has_room(output) {
                return false;
            }
        }
        match rustix::io::write(output, bytes) {
            Ok(written @ 1..) => bytes = bytes.get(written..).unwrap_or_default(),
            _ => return false,
        }
    }
    true
}

fn has_room(output: BorrowedFd) -> bool {
    let mut ready = [PollFd::new(&output, PollFlags::OUT)];
    matches!(poll(&mut ready, Some(&PATIENCE)), Ok(1))
}
