//! Signals that ask a long render to keep what it has and stop.

use std::fs;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The signals that stop a render that can be continued, and their names. `SIGUSR1` is what Slurm's
/// `--signal` is usually set to, to warn that time is running out.
const SIGNALS: [(i32, &str); 4] = [
    (signal_hook::consts::SIGHUP, "SIGHUP"),
    (signal_hook::consts::SIGTERM, "SIGTERM"),
    (signal_hook::consts::SIGUSR1, "SIGUSR1"),
    (signal_hook::consts::SIGINT, "SIGINT"),
];

/// The number of the last such signal; 0 before the first.
#[derive(Clone, Debug, Default)]
pub(super) struct Signals(Arc<AtomicUsize>);

impl Signals {
    /// Notes signals from now on, instead of being ended by them.
    pub(super) fn noted() -> io::Result<Self> {
        let noted = Self::default();
        for (signal, _) in SIGNALS {
            if signal == signal_hook::consts::SIGHUP && may_be_ignored(signal) {
                continue;
            }
            let cell = Arc::clone(&noted.0);
            signal_hook::flag::register_usize(signal, cell, signal as usize)?;
        }
        Ok(noted)
    }

    /// Whether one has arrived.
    pub(super) fn arrived(&self) -> bool {
        self.0.load(Ordering::Relaxed) != 0
    }

    /// The last one that has arrived.
    pub(super) fn last(&self) -> Option<Signal> {
        let number = self.0.load(Ordering::Relaxed);
        (number != 0).then_some(Signal(number as u8))
    }
}

/// Whether a signal was ignored when the program began, as by nohup, so that it must stay without
/// effect. Where the system has no table of these, every signal may be.
fn may_be_ignored(signal: i32) -> bool {
    let table = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = table.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    ignored.is_none_or(|mask| mask & (1 << (signal - 1)) != 0)
}

/// A signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signal(u8);

impl Signal {
    /// Whether it came from the keyboard.
    pub fn is_interrupt(self) -> bool {
        self.name() == "SIGINT"
    }

    /// Its name, such as `SIGTERM`.
    pub fn name(self) -> &'static str {
        for (number, name) in SIGNALS {
            if number == i32::from(self.0) {
                return name;
            }
        }
        "a signal"
    }
}
