//! What goes to the terminal: bytes in order, on a thread that waits for the terminal so that no
//! other has to.
//!
//! A terminal that is not read takes nothing, ever. What it takes at once is written by the calling
//! thread, which costs a healthy terminal no detour; the rest is left to this one.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::tty::{Line, Taken};

/// The most that is written in one call to the system.
const PIECE: usize = 1 << 16;

/// How long the thread may take to write the last bytes after room was made for them.
const LAST_PATIENCE: Duration = Duration::from_millis(100);

/// The terminal's output, shared by the interface and the panic hook.
#[derive(Debug)]
pub(super) struct Output {
    shared: Arc<Shared>,
}

#[derive(Debug)]
struct Shared {
    line: Line,
    queue: Mutex<Queue>,
    changed: Condvar,
    /// Whether the thread is to write no more.
    is_silent: AtomicBool,
}

#[derive(Debug, Default)]
struct Queue {
    /// What the terminal has not taken yet.
    bytes: Vec<u8>,
    /// Counts the times that `bytes` was replaced.
    edition: u64,
    /// Whether the thread is writing.
    writing: bool,
    /// What a write has failed with; no other will succeed.
    failed: Option<io::ErrorKind>,
    /// Whether the thread is to end.
    closed: bool,
}

impl Output {
    /// Starts the thread; `cleared` is called on it whenever it has written all there was, or
    /// failed to.
    pub(super) fn start(line: Line, cleared: impl Fn() + Send + 'static) -> io::Result<Self> {
        let shared = Arc::new(Shared {
            line,
            queue: Mutex::default(),
            changed: Condvar::new(),
            is_silent: AtomicBool::new(false),
        });
        let theirs = Arc::clone(&shared);
        thread::Builder::new()
            .name("output".to_owned())
            .spawn(move || {
                while theirs.write_next() {
                    if theirs.is_clear() {
                        cleared();
                    }
                }
            })?;
        Ok(Self { shared })
    }

    /// Sends bytes after those before, without waiting.
    pub(super) fn send(&self, bytes: &[u8]) -> io::Result<()> {
        let mut queue = self.shared.lock();
        if let Some(failed) = queue.failed {
            return Err(failed.into());
        }
        let mut rest = bytes;
        while queue.is_clear() && !rest.is_empty() {
            match self.shared.line.write_at_once(rest) {
                Ok(Taken::Bytes(count)) => rest = &rest[count..],
                Ok(Taken::Nothing) => break,
                Err(error) => return Err(error),
            }
        }
        if !rest.is_empty() {
            queue.bytes.extend_from_slice(rest);
            self.shared.changed.notify_all();
        }
        Ok(())
    }

    /// Whether the terminal has taken everything, or takes nothing more.
    pub(super) fn is_clear(&self) -> bool {
        self.shared.is_clear()
    }

    /// Has the thread write no more, for a signal handler, which writes the last bytes itself.
    #[cfg(unix)]
    pub(super) fn fall_silent(&self) {
        self.shared.is_silent.store(true, Ordering::SeqCst);
    }

    /// Sends bytes instead of those that are still to be sent, and waits for the terminal to take
    /// them, until `deadline` at most.
    ///
    /// A terminal that has taken nothing by then may be read later, when nobody is left to write:
    /// what the system holds for it makes room for these bytes.
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
            self.shared.line.discard();
            self.wait(Instant::now() + LAST_PATIENCE)
        })
    }

    /// Waits until the terminal has taken everything.
    fn wait(&self, deadline: Instant) -> io::Result<()> {
        let mut queue = self.shared.lock();
        while !queue.is_clear() {
            let time = deadline.saturating_duration_since(Instant::now());
            if time.is_zero() {
                return Err(io::ErrorKind::TimedOut.into());
            }
            let waited = self.shared.changed.wait_timeout(queue, time);
            queue = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        queue.failed.map_or(Ok(()), |failed| Err(failed.into()))
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        // The thread is not waited for: it may be waiting for the terminal.
        self.shared.lock().closed = true;
        self.shared.changed.notify_all();
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn is_clear(&self) -> bool {
        self.lock().is_clear()
    }

    /// Waits for bytes and writes some of them; whether to go on.
    fn write_next(&self) -> bool {
        let mut queue = self.lock();
        while queue.bytes.is_empty() && !queue.closed {
            queue = self
                .changed
                .wait(queue)
                .unwrap_or_else(PoisonError::into_inner);
        }
        if queue.bytes.is_empty() {
            return false;
        }
        let piece = queue.bytes[..queue.bytes.len().min(PIECE)].to_vec();
        let edition = queue.edition;
        queue.writing = true;
        drop(queue);
        let is_silent = || self.is_silent.load(Ordering::SeqCst);
        let is_wanted = || !is_silent() && self.lock().edition == edition;
        let written = self.line.write(&piece, is_wanted);
        if is_silent() {
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

impl Queue {
    fn is_clear(&self) -> bool {
        self.bytes.is_empty() && !self.writing
    }
}

#[cfg(all(test, unix))]
mod tests;
