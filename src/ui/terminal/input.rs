//! The thread that reads the keyboard and can release it.
//!
//! On Unix the bytes are read here, not by crossterm 0.29: its reader blocks in the middle of a
//! sequence, where it cannot be parked, and spins when the terminal is gone (crossterm#793).

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};
use std::thread::JoinHandle;

use super::Event;
use crate::queue::spawn;

#[cfg(unix)]
use unix::{Keyboard, Waker};
#[cfg(not(unix))]
use windows::{Keyboard, Waker};

/// The most that may be unread, in keys and in bytes of pastes, before no more is read. Then the
/// system and the terminal hold back the rest, however much is typed.
const MOST_UNREAD: usize = 1024;

/// Reads the keyboard on its own thread until dropped.
#[derive(Debug)]
pub struct Input {
    requests: Sender<Request>,
    flow: Arc<Flow>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
enum Request {
    /// Releases the keyboard and acknowledges.
    Park(Sender<()>),
    Resume,
    Stop,
}

/// Counts what was sent and not yet handled.
#[derive(Debug)]
struct Flow {
    unread: AtomicUsize,
    waker: Waker,
}

/// Counts an event as unread until it is dropped.
#[derive(Debug)]
pub struct Unread {
    size: usize,
    flow: Arc<Flow>,
}

impl Flow {
    fn is_full(&self) -> bool {
        MOST_UNREAD <= self.unread.load(Ordering::SeqCst)
    }
}

impl Unread {
    fn new(event: &Event, flow: &Arc<Flow>) -> Self {
        let size = match event {
            Event::Paste(text) => 1 + text.len(),
            _ => 1,
        };
        flow.unread.fetch_add(size, Ordering::SeqCst);
        Self {
            size,
            flow: Arc::clone(flow),
        }
    }
}

impl Drop for Unread {
    fn drop(&mut self) {
        let before = self.flow.unread.fetch_sub(self.size, Ordering::SeqCst);
        if MOST_UNREAD <= before && !self.flow.is_full() {
            self.flow.waker.wake();
        }
    }
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
    /// Starts reading; `send` is called on the reading thread, which pauses while too much is unread.
    /// The thread ends by itself when the terminal is gone.
    pub fn start(send: impl Fn(Event, Unread) + Send + 'static) -> io::Result<Self> {
        let (keyboard, waker) = Keyboard::open()?;
        let flow = Arc::new(Flow {
            unread: AtomicUsize::new(0),
            waker,
        });
        let (requests, inbox) = mpsc::channel();
        let theirs = Arc::clone(&flow);
        let send = move |event| {
            let unread = Unread::new(&event, &theirs);
            send(event, unread);
        };
        let theirs = Arc::clone(&flow);
        let thread = spawn("keyboard", move || read(keyboard, &inbox, &theirs, &send))?;
        Ok(Self {
            requests,
            flow,
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
        self.flow.waker.wake();
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

fn read(mut keyboard: Keyboard, inbox: &Receiver<Request>, flow: &Flow, send: &impl Fn(Event)) {
    let mut is_parked = false;
    loop {
        let request = if is_parked {
            inbox.recv().map_err(TryRecvError::from)
        } else {
            inbox.try_recv()
        };
        match request {
            Ok(Request::Park(done)) => {
                is_parked = true;
                let _ = done.send(());
            }
            Ok(Request::Resume) => is_parked = false,
            Ok(Request::Stop) | Err(TryRecvError::Disconnected) => return,
            Err(TryRecvError::Empty) => {
                let woken = if flow.is_full() {
                    keyboard.pause()
                } else {
                    keyboard.wait(send)
                };
                if woken == Wake::Gone {
                    return;
                }
            }
        }
    }
}

#[cfg(unix)]
mod unix {
    use std::io::{self, Write};
    use std::os::fd::OwnedFd;
    use std::os::unix::net::UnixStream;
    use std::time::Instant;

    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    use rustix::io::Errno;

    use super::Wake;
    use crate::terminal::decode::Decoder;
    use crate::terminal::{Event, tty};

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
}

#[cfg(not(unix))]
mod windows {
    use std::io;
    use std::time::Duration;

    use crossterm::event::{self, KeyEventKind, MouseEventKind};

    use super::Wake;
    use crate::terminal::Event;

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

        #[expect(clippy::unused_self, reason = "the same on all systems")]
        pub(super) fn pause(&self) -> Wake {
            std::thread::sleep(PATIENCE);
            Wake::Again
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
