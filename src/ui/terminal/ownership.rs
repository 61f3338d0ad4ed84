//! Who owns the terminal, and what a panic does with it meanwhile.
//!
//! A panic on the interface's thread restores the terminal before it is reported. A panic on any
//! other thread is kept for later, because the interface is still drawing.

use std::backtrace::{Backtrace, BacktraceStatus};
use std::panic::{self, PanicHookInfo};
use std::sync::TryLockError;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, Weak};
use std::thread::{self, ThreadId};

use super::graphics::{self, Means};
use super::output::Output;
use super::tty;
use text::visible;

/// Owner of the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ownership {
    /// The interface draws on it.
    Ours,
    /// Another program, such as the editor, until it ends.
    Lent,
    /// The parent program: its modes are restored.
    GivenBack,
}

/// What ends pictures: nothing if none were sent. What is not among them depends on the pane of tmux.
const ENDINGS: [&str; 4] = [
    "",
    graphics::END,
    graphics::REMOVE,
    graphics::REMOVE_THROUGH_TMUX,
];

/// Restores the setting of keys from before the interface changed it (kitty's keyboard protocol).
const KEYS_AS_BEFORE: &str = "\x1b[<u";

/// State shared by the terminal guard, the panic hook and the handler of aborts.
#[derive(Debug)]
pub(super) struct GuardState {
    interface: ThreadId,
    /// The output of the terminal.
    pub(super) output: Output,
    ownership: Mutex<Ownership>,
    has_kept_edits: AtomicBool,
    /// Whether the terminal keeps the Esc key apart from the beginnings of sequences for us.
    has_keys_apart: AtomicBool,
    /// What ends pictures, as an index into [`ENDINGS`], or their number for `pane_ending`.
    ending: AtomicUsize,
    /// What ends pictures of this pane, which stays the same.
    pane_ending: OnceLock<String>,
    panics: Mutex<Vec<String>>,
}

impl GuardState {
    /// Marks the calling thread as the interface's and catches panics until the result is dropped.
    pub(super) fn install(output: Output, restore: fn(&Self)) -> Arc<Self> {
        let shared = Arc::new(Self {
            interface: thread::current().id(),
            output,
            ownership: Mutex::new(Ownership::GivenBack),
            has_kept_edits: AtomicBool::new(false),
            has_keys_apart: AtomicBool::new(false),
            ending: AtomicUsize::new(0),
            pane_ending: OnceLock::new(),
            panics: Mutex::new(Vec::new()),
        });
        let previous = panic::take_hook();
        let weak = Arc::downgrade(&shared);
        panic::set_hook(Box::new(move |panic| match Weak::upgrade(&weak) {
            Some(shared) => shared.caught(panic, restore),
            None => previous(panic),
        }));
        shared
    }

    /// Locks the owner of the terminal; held while the ownership changes.
    pub(super) fn ownership(&self) -> MutexGuard<'_, Ownership> {
        let locked = self.ownership.lock();
        // A panic while it was locked has left a valid value.
        locked.unwrap_or_else(PoisonError::into_inner)
    }

    /// The owner of the terminal, for a signal handler, which must not wait; the interface while
    /// the ownership is changing.
    pub(super) fn ownership_in_signal(&self) -> Ownership {
        match self.ownership.try_lock() {
            Ok(ownership) => *ownership,
            Err(TryLockError::Poisoned(ownership)) => *ownership.into_inner(),
            Err(TryLockError::WouldBlock) => Ownership::Ours,
        }
    }

    /// Whether the current unsaved edits are stored for recovery, for a signal handler.
    pub(super) fn has_kept_edits(&self) -> bool {
        self.has_kept_edits.load(Ordering::Relaxed)
    }

    pub(super) fn note_kept_edits(&self, are_kept: bool) {
        self.has_kept_edits.store(are_kept, Ordering::Relaxed);
    }

    pub(super) fn has_keys_apart(&self) -> bool {
        self.has_keys_apart.load(Ordering::Relaxed)
    }

    pub(super) fn note_keys_apart(&self) {
        self.has_keys_apart.store(true, Ordering::Relaxed);
    }

    /// What ends the setting of keys, also for a signal handler: nothing if there is none.
    pub(super) fn keys_ending(&self) -> &'static str {
        if self.has_keys_apart() {
            KEYS_AS_BEFORE
        } else {
            ""
        }
    }

    /// What ends pictures on the screen, also for a signal handler: nothing if there are none.
    pub(super) fn ending(&self) -> &str {
        let known = ENDINGS.get(self.ending.load(Ordering::Acquire));
        known.map_or_else(
            || self.pane_ending.get().map_or("", String::as_str),
            |known| *known,
        )
    }

    /// Records how pictures are sent, if any are.
    pub(super) fn note_means(&self, means: Option<Means>) {
        let ending = means.map(Means::ending).unwrap_or_default();
        let known = ENDINGS.iter().position(|known| *known == ending);
        let index = known.unwrap_or_else(|| {
            self.pane_ending.get_or_init(|| ending.into_owned());
            ENDINGS.len()
        });
        self.ending.store(index, Ordering::Release);
    }

    /// Returns the panics of other threads since the last call.
    pub(super) fn take_panics(&self) -> Vec<String> {
        std::mem::take(&mut *self.panics())
    }

    fn caught(&self, panic: &PanicHookInfo, restore: fn(&Self)) {
        let text = description(panic);
        if thread::current().id() == self.interface {
            restore(self);
        }
        // A panic of the interface itself has given the terminal back.
        if *self.ownership() == Ownership::GivenBack {
            tty::complain(text);
        } else {
            self.panics().push(text);
        }
    }

    fn panics(&self) -> MutexGuard<'_, Vec<String>> {
        self.panics.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn description(panic: &PanicHookInfo) -> String {
    let thread = thread::current();
    let mut text = format!("thread '{}' {panic}", thread.name().unwrap_or("<unnamed>"));
    let backtrace = Backtrace::capture();
    if backtrace.status() == BacktraceStatus::Captured {
        text.push('\n');
        text.push_str(&backtrace.to_string());
    }
    printable(&text)
}

/// Escapes everything in each line that could control or spoof the terminal: a panic may quote a
/// hostile file.
fn printable(text: &str) -> String {
    let lines: Vec<_> = text.split('\n').map(visible).collect();
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminal_controls_become_visible() {
        for (text, shown) in [
            ("plain 'é'\n\"ok\" \\", "plain 'é'\n\"ok\" \\"),
            ("\x1b]52;c;eA==\x07", "\\u{1b}]52;c;eA==\\u{7}"),
            ("a\u{9b}2J\u{202e}b", "a\\u{9b}2J\\u{202e}b"),
        ] {
            assert_eq!(printable(text), shown);
        }
    }
}
