//! Terminal output: bytes in order, written by a thread that waits for the terminal so that no
//! other thread has to.
//!
//! A terminal that is not read accepts nothing, possibly for ever. The calling thread writes what
//! the terminal accepts at once, so that a healthy terminal causes no detour; the output thread
//! writes the rest.

use std::io;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use rustix::event::Timespec;

use super::tty::TtyWriter;
use crate::queue::spawn;

/// Maximum number of bytes per write call.
const PIECE: usize = 1 << 16;

/// Time for the thread to write the last bytes after room was made for them.
const LAST_PATIENCE: Duration = Duration::from_millis(100);

/// Interval and maximum number of polls for the end of a write that has begun: 100 ms.
const SILENCE_POLL: Timespec = Timespec {
    tv_sec: 0,
    tv_nsec: 1_000_000,
};
const SILENCE_POLLS: u32 = 100;

/// The terminal's output, shared by the interface and the panic hook.
#[derive(Debug)]
pub(super) struct Output {
    shared: Arc<OutputState>,
}

#[derive(Debug)]
struct OutputState {
    line: TtyWriter,
    queue: Mutex<Queue>,
    changed: Condvar,
    /// Whether nothing more may be written.
    is_silent: AtomicBool,
    /// Number of [`Permit`]s.
    permits: AtomicUsize,
}

/// Permission to call `write` once, until dropped.
#[derive(Debug)]
struct Permit<'a>(&'a AtomicUsize);

#[derive(Debug, Default)]
struct Queue {
    /// Bytes that the terminal has not accepted yet.
    bytes: Vec<u8>,
    /// Number of times that `bytes` was replaced.
    edition: u64,
    /// Whether the thread is writing.
    writing: bool,
    /// The error of a failed write; no later write will succeed.
    failed: Option<io::ErrorKind>,
    /// Whether the thread should end.
    closed: bool,
}

impl Output {
    /// Starts the thread; `cleared` is called on it whenever it has written everything or a write
    /// has failed.
    pub(super) fn start(line: TtyWriter, cleared: impl Fn() + Send + 'static) -> io::Result<Self> {
        let shared = Arc::new(OutputState {
            line,
            queue: Mutex::default(),
            changed: Condvar::new(),
            is_silent: AtomicBool::new(false),
            permits: AtomicUsize::new(0),
        });
        let theirs = Arc::clone(&shared);
        spawn("output", move || {
            while theirs.write_next() {
                if theirs.is_clear() {
                    cleared();
                }
            }
        })?;
        Ok(Self { shared })
    }

    /// Appends bytes to the output without waiting.
    pub(super) fn send(&self, bytes: &[u8]) -> io::Result<()> {
        let mut queue = self.shared.lock();
        if let Some(failed) = queue.failed {
            return Err(failed.into());
        }
        let mut rest = bytes;
        while queue.is_clear() && !rest.is_empty() {
            let Some(_permit) = self.shared.permit() else {
                break;
            };
            match self.shared.line.write_at_once(rest)? {
                0 => break,
                count => rest = &rest[count..],
            }
        }
        if !rest.is_empty() {
            queue.bytes.extend_from_slice(rest);
            self.shared.changed.notify_all();
        }
        Ok(())
    }

    /// Whether the terminal has accepted everything, or will accept nothing more.
    pub(super) fn is_clear(&self) -> bool {
        self.shared.is_clear()
    }

    /// Stops all threads from writing, for a signal handler, which writes the last bytes itself.
    ///
    /// Waits for a write that has begun, but not indefinitely: the handler may have interrupted it, and
    /// a write to a shared file may block.
    pub(super) fn fall_silent(&self) {
        self.shared.is_silent.store(true, Ordering::SeqCst);
        for _ in 0..SILENCE_POLLS {
            if self.shared.permits.load(Ordering::SeqCst) == 0 {
                return;
            }
            let _ = rustix::event::poll(&mut [], Some(&SILENCE_POLL));
        }
    }

    /// Replaces the pending bytes by `bytes` and waits for the terminal to accept them, until
    /// `deadline`.
    ///
    /// A terminal that has accepted nothing by then may be read later, when this process has ended:
    /// bytes buffered by the system are discarded to make room for these.
    pub(super) fn send_last(&self, bytes: &[u8], deadline: Instant) -> io::Result<()> {
        {
            let mut queue = self.shared.lock();
            queue.bytes.clear();
            queue.edition += 1;
        }
        self.send(bytes)?;
        self.wait(deadline).or_else(|error| {
            if error.kind() != io::ErrorKind::TimedOut {
                return Err(error);
            }
            // A signal handler may have written its own last bytes.
            let Some(permit) = self.shared.permit() else {
                return Err(error);
            };
            self.shared.line.discard();
            drop(permit);
            self.wait(Instant::now() + LAST_PATIENCE)
        })
    }

    /// Waits until the terminal has accepted everything.
    fn wait(&self, deadline: Instant) -> io::Result<()> {
        let patience = deadline.saturating_duration_since(Instant::now());
        let (queue, changed) = (self.shared.lock(), &self.shared.changed);
        let waited = changed.wait_timeout_while(queue, patience, |queue| !queue.is_clear());
        let (queue, _) = waited.unwrap_or_else(PoisonError::into_inner);
        if !queue.is_clear() {
            return Err(io::ErrorKind::TimedOut.into());
        }
        queue.failed.map_or(Ok(()), |failed| Err(failed.into()))
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        // The thread is not joined: it may be waiting for the terminal.
        self.shared.lock().closed = true;
        self.shared.changed.notify_all();
    }
}

impl OutputState {
    fn lock(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn is_clear(&self) -> bool {
        self.lock().is_clear()
    }

    /// Permission to write, unless the output has fallen silent.
    fn permit(&self) -> Option<Permit<'_>> {
        // Counted before the check, so that either the check sees the silence or the handler sees
        // the permit.
        self.permits.fetch_add(1, Ordering::SeqCst);
        let permit = Permit(&self.permits);
        (!self.is_silent.load(Ordering::SeqCst)).then_some(permit)
    }

    /// Waits for bytes and writes some of them; returns whether to continue.
    fn write_next(&self) -> bool {
        let is_idle = |queue: &mut Queue| queue.bytes.is_empty() && !queue.closed;
        let waited = self.changed.wait_while(self.lock(), is_idle);
        let mut queue = waited.unwrap_or_else(PoisonError::into_inner);
        if queue.bytes.is_empty() {
            return false;
        }
        let piece = queue.bytes[..queue.bytes.len().min(PIECE)].to_vec();
        let edition = queue.edition;
        queue.writing = true;
        drop(queue);
        let is_current = || self.lock().edition == edition;
        let permit = || is_current().then(|| self.permit()).flatten();
        let written = self.line.write(&piece, permit);
        if self.is_silent.load(Ordering::SeqCst) {
            return false;
        }
        let mut queue = self.lock();
        queue.writing = false;
        match written {
            Ok(count) if edition == queue.edition => drop(queue.bytes.drain(..count)),
            Ok(_) => {}
            Err(error) => {
                queue.failed = Some(error.kind());
                queue.bytes.clear();
            }
        }
        self.changed.notify_all();
        true
    }
}

impl Drop for Permit<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::SeqCst);
    }
}

impl Queue {
    fn is_clear(&self) -> bool {
        self.bytes.is_empty() && !self.writing
    }
}

#[cfg(test)]
mod tests;
