//! The thread that reads the keyboard and can release it.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};
use std::thread::JoinHandle;

use super::Event;
use super::keyboard::{Keyboard, Wake, Waker};
use crate::queue::spawn;

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
