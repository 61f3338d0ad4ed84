//! Waits for the bytes of the keyboard and decodes them.
//!
//! crossterm 0.29 is not used for this: its reader blocks in the middle of a sequence, where it cannot
//! be parked, and spins when the terminal is gone (crossterm#793).

use std::io::{self, Write};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::time::Instant;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;

use super::decode::Decoder;
use super::{Event, tty};

/// Reason why the keyboard stopped waiting.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Wake {
    /// Something was read, a deadline has passed, or requests must be checked.
    Again,
    /// No more keys will come.
    Gone,
}

/// The input side of the terminal.
#[derive(Debug)]
pub(super) struct Keyboard {
    tty: OwnedFd,
    woken: UnixStream,
    decoder: Decoder,
}

/// Ends a wait from another thread.
#[derive(Debug)]
pub(super) struct Waker(UnixStream);

impl Waker {
    pub(super) fn wake(&self) {
        // A full pipe also wakes the thread.
        let _ = (&self.0).write(&[0]);
    }
}

impl Keyboard {
    pub(super) fn open() -> io::Result<(Self, Waker)> {
        let (woken, waker) = UnixStream::pair()?;
        woken.set_nonblocking(true)?;
        waker.set_nonblocking(true)?;
        let keyboard = Self {
            tty: tty::keyboard()?,
            woken,
            decoder: Decoder::default(),
        };
        Ok((keyboard, Waker(waker)))
    }

    /// Waits for keys, for the timeout of a held key, or for the waker.
    pub(super) fn wait(&mut self, send: &impl Fn(Event)) -> Wake {
        let timeout = self.decoder.deadline().and_then(|deadline| {
            Timespec::try_from(deadline.saturating_duration_since(Instant::now())).ok()
        });
        let mut sources = [
            PollFd::new(&self.tty, PollFlags::IN),
            PollFd::new(&self.woken, PollFlags::IN),
        ];
        match poll(&mut sources, timeout.as_ref()) {
            Ok(_) => {}
            Err(Errno::INTR) => return Wake::Again,
            Err(_) => return Wake::Gone,
        }
        let [keys, woken] = sources.map(|source| source.revents());
        if !woken.is_empty() {
            tty::drain(&self.woken);
        }
        if keys.intersects(PollFlags::HUP | PollFlags::ERR | PollFlags::NVAL) {
            return Wake::Gone;
        }
        // Pending bytes are read before the terminal counts as gone.
        if keys.contains(PollFlags::IN) {
            return self.read(send);
        }
        self.decoder.expire(Instant::now(), send);
        Wake::Again
    }

    /// Waits for the waker only. A held key waits too: what decides about it may be among the
    /// bytes that are not read.
    pub(super) fn pause(&self) -> Wake {
        match poll(&mut [PollFd::new(&self.woken, PollFlags::IN)], None) {
            Ok(_) => tty::drain(&self.woken),
            Err(Errno::INTR) => {}
            Err(_) => return Wake::Gone,
        }
        Wake::Again
    }

    fn read(&mut self, send: &impl Fn(Event)) -> Wake {
        let mut bytes = [0; 1024];
        match rustix::io::read(&self.tty, &mut bytes) {
            Ok(0) => Wake::Gone,
            Ok(count) => {
                self.decoder.feed(&bytes[..count], Instant::now(), send);
                Wake::Again
            }
            Err(Errno::INTR | Errno::AGAIN) => Wake::Again,
            Err(_) => Wake::Gone,
        }
    }
}
