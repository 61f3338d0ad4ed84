//! The terminal after an abort: of an allocation that failed, a stack that overflowed, a panic while
//! panicking; and after an instruction that the processor refuses. Nothing of the process can be relied
//! on any more, so a signal handler writes a few bytes and sets the terminal's modes.
//!
//! `SIGSEGV` and `SIGBUS` are left to Rust, which tells a stack that overflowed by them and aborts: its
//! handler has a stack of its own, this one has not.
#![allow(
    unsafe_code,
    reason = "a handler that runs amid an abort can't be registered otherwise"
)]

use std::io;
use std::sync::Arc;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fd::BorrowedFd;
use rustix::termios::{OptionalActions, QueueSelector, tcflush, tcgetattr, tcsetattr};
use signal_hook::consts::{SIGABRT, SIGFPE, SIGILL};
use signal_hook::low_level;
use signal_hook_registry::register_signal_unchecked;

use super::panics::{Shared, Tenure};
use super::tty;

/// The signals, and what is printed on the restored screen: what Rust prints before an abort goes to the
/// alternate one.
const FATAL: [(i32, &str); 3] = [
    (SIGABRT, "halflight aborted"),
    (SIGFPE, "halflight was ended by SIGFPE"),
    (SIGILL, "halflight was ended by SIGILL"),
];

/// Printed behind it where it is known to be true.
const KEPT: &str = "; unsaved edits are kept, the next run of the scene offers them";

/// How long a terminal that takes no bytes is waited for.
const PATIENCE: Timespec = Timespec {
    tv_sec: 0,
    tv_nsec: 200_000_000,
};

/// Has the terminal given back if the process dies of one of these signals while the terminal is ours.
///
/// The terminal's modes now are those to give back; `leave` gives back the screen. The handlers stay:
/// an instruction that is refused while nothing handles its signal would be tried for ever.
pub(super) fn install(shared: &Arc<Shared>, leave: &'static str) -> io::Result<()> {
    let modes = tcgetattr(tty::keyboard()?)?;
    for (signal, words) in FATAL {
        let (terminal, modes, shared) = (tty::keyboard()?, modes.clone(), Arc::clone(shared));
        let restore = move || {
            if shared.tenure_amid_signal() == Tenure::Ours {
                shared.output().fall_silent();
                let kept = if shared.are_edits_kept() { KEPT } else { "" };
                let parts = [leave, words, kept, "\r\n"];
                let _ = parts.iter().all(|part| write(part.as_bytes()));
                let _ = tcsetattr(&terminal, OptionalActions::Now, &modes);
            }
            // The process ends as it would without this handler.
            let _ = low_level::emulate_default_handler(signal);
        };
        // SAFETY: the handler takes no lock that it waits for, allocates nothing and does not panic.
        // It makes the system calls poll, write and ioctl, and raises the signal again, so that it
        // never returns to an instruction that failed.
        unsafe { register_signal_unchecked(signal, restore) }?;
    }
    Ok(())
}

/// Whether the terminal has taken all of it.
fn write(mut bytes: &[u8]) -> bool {
    let output = rustix::stdio::stdout();
    while !bytes.is_empty() {
        if !has_room(output) {
            // What nobody reads makes room for what shows the screen again once somebody does.
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
