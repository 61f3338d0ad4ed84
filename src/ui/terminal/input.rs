//! The thread that reads the keyboard and can release it.
//!
//! On Unix the bytes are read here, not by crossterm 0.29: its reader blocks in the middle of a
//! sequence, where it cannot be parked, and spins when the terminal is gone (crossterm#793).

use std::io;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread::{self, JoinHandle};

use super::Event;

#[cfg(unix)]
use unix::{Keyboard, Waker};
#[cfg(not(unix))]
use windows::{Keyboard, Waker};

/// Reads the keyboard on its own thread until dropped.
#[derive(Debug)]
pub struct Input {
    requests: Sender<Request>,
    waker: Waker,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
enum Request {
    /// Releases the keyboard and acknowledges.
    Park(Sender<()>),
    Resume,
    Stop,
}

/// Reason why the keyboard stopped waiting.
#[derive(Debug, PartialEq, Eq)]
enum Wake {
    /// Something was read, a deadline has passed, or requests must be checked.
    Again,
    /// No more keys will come.
    Gone,
}

impl Input {
    /// Starts reading; `send` is called on the reading thread. The thread ends by itself when the
    /// terminal is gone.
    pub fn start(send: impl Fn(Event) + Send + 'static) -> io::Result<Self> {
        let (keyboard, waker) = Keyboard::open()?;
        let (requests, inbox) = mpsc::channel();
        let thread = thread::Builder::new()
            .name("keyboard".to_owned())
            .spawn(move || read(keyboard, &inbox, &send))?;
        Ok(Self {
            requests,
            waker,
            thread: Some(thread),
        })
    }

    /// Stops reading and returns once other programs may read the keyboard.
    pub fn park(&self) {
        let (done, parked) = mpsc::channel();
        self.request(Request::Park(done));
        // An error means that the thread has ended, which also frees the keyboard.
        let _ = parked.recv();
    }

    /// Resumes reading after [`Input::park`].
    pub fn resume(&self) {
        self.request(Request::Resume);
    }

    fn request(&self, request: Request) {
        // A thread that has ended needs no requests.
        let _ = self.requests.send(request);
        self.waker.wake();
    }
}

impl Drop for Input {
    fn drop(&mut self) {
        self.request(Request::Stop);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn read(mut keyboard: Keyboard, inbox: &Receiver<Request>, send: &impl Fn(Event)) {
    loop {
        match inbox.try_recv() {
            Ok(Request::Park(done)) => {
                let _ = done.send(());
                if !wait_for_resume(inbox) {
                    return;
                }
            }
            Ok(Request::Resume) => {}
            Ok(Request::Stop) | Err(mpsc::TryRecvError::Disconnected) => return,
            Err(mpsc::TryRecvError::Empty) => {
                if keyboard.wait(send) == Wake::Gone {
                    return;
                }
            }
        }
    }
}

/// Waits for the request to resume; returns whether to continue reading.
fn wait_for_resume(inbox: &Receiver<Request>) -> bool {
    loop {
        match inbox.recv() {
            Ok(Request::Park(done)) => {
                let _ = done.send(());
            }
            Ok(Request::Resume) => return true,
            Ok(Request::Stop) | Err(_) => return false,
        }
    }
}

#[cfg(unix)]
mod unix {
    use std::io::{self, Read, Write};
    use std::os::fd::OwnedFd;
    use std::os::unix::net::UnixStream;
    use std::time::Instant;

    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    use rustix::io::Errno;

    use super::Wake;
    use crate::ui::terminal::decode::Decoder;
    use crate::ui::terminal::{Event, tty};

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
                while (&self.woken)
                    .read(&mut [0; 64])
                    .is_ok_and(|bytes| bytes != 0)
                {}
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

        fn read(&mut self, send: &impl Fn(Event)) -> Wake {
            let mut bytes = [0; 4096];
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
}

#[cfg(not(unix))]
mod windows {
    use std::io;
    use std::time::Duration;

    use crossterm::event::{self, KeyEventKind, MouseEventKind};

    use super::Wake;
    use crate::ui::terminal::Event;

    /// Maximum duration of a wait, and therefore of parking.
    const PATIENCE: Duration = Duration::from_millis(20);

    /// The console, read by crossterm.
    #[derive(Debug)]
    pub(super) struct Keyboard;

    /// Does nothing, as waits are short.
    #[derive(Debug)]
    pub(super) struct Waker;

    impl Waker {
        pub(super) fn wake(&self) {}
    }

    impl Keyboard {
        pub(super) fn open() -> io::Result<(Self, Waker)> {
            Ok((Self, Waker))
        }

        pub(super) fn wait(&mut self, send: &impl Fn(Event)) -> Wake {
            match event::poll(PATIENCE) {
                Ok(false) => return Wake::Again,
                Ok(true) => {}
                Err(_) => return Wake::Gone,
            }
            match event::read() {
                Ok(event) => meaning(event).into_iter().for_each(send),
                Err(_) => return Wake::Gone,
            }
            Wake::Again
        }
    }

    fn meaning(event: event::Event) -> Option<Event> {
        match event {
            event::Event::Key(key) if key.kind != KeyEventKind::Release => Some(Event::Key(key)),
            event::Event::Mouse(mouse) if mouse.kind != MouseEventKind::Moved => {
                Some(Event::Mouse(mouse))
            }
            event::Event::Paste(text) => Some(Event::Paste(text)),
            event::Event::Resize(columns, rows) => Some(Event::Resize { columns, rows }),
            _ => None,
        }
    }
}
