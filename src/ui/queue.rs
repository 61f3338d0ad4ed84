//! Threads that carry out requests, one after another.

use std::io;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;

/// Handle of a thread that carries out requests; the thread ends after this is dropped.
pub(crate) struct Service<R> {
    requests: Sender<R>,
    /// What the thread does, as a verb with its object: `frees memory`.
    work: &'static str,
}

/// A thread has ended, by a panic that was reported.
#[derive(Debug, thiserror::Error)]
#[error("the thread that {0} has ended")]
pub(crate) struct Ended(&'static str);

impl<R: Send + 'static> Service<R> {
    /// Starts a thread of this name, which runs `follow` until the requests end; `work` says in
    /// messages what it does.
    pub(crate) fn start(
        name: &str,
        work: &'static str,
        follow: impl FnOnce(&Receiver<R>) + Send + 'static,
    ) -> io::Result<Self> {
        let (requests, inbox) = mpsc::channel();
        thread::Builder::new()
            .name(name.to_owned())
            .spawn(move || follow(&inbox))?;
        Ok(Self { requests, work })
    }

    /// Queues a request.
    pub(crate) fn request(&self, request: R) -> Result<(), Ended> {
        self.requests.send(request).map_err(|_| Ended(self.work))
    }
}
