//! Threads that carry out requests, one after another.

use std::convert::Infallible;
use std::io;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread::{self, JoinHandle};
use std::time::Instant;

/// Handle of a thread that carries out requests; the thread ends after this is dropped.
pub(crate) struct Service<R> {
    requests: Sender<R>,
    /// What the thread does, as a verb with its object: `frees memory`.
    work: &'static str,
    /// Disconnected when the thread ends.
    end: Receiver<Infallible>,
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
        Self::run(name, work, requests, move || follow(&inbox))
    }

    /// As [`Service::start`], for a thread that also lets others make requests: it ends when `follow` does.
    pub(crate) fn start_shared(
        name: &str,
        work: &'static str,
        follow: impl FnOnce(&Receiver<R>, &Sender<R>) + Send + 'static,
    ) -> io::Result<Self> {
        let (requests, inbox) = mpsc::channel();
        let to_inbox = requests.clone();
        Self::run(name, work, requests, move || follow(&inbox, &to_inbox))
    }

    fn run(
        name: &str,
        work: &'static str,
        requests: Sender<R>,
        follow: impl FnOnce() + Send + 'static,
    ) -> io::Result<Self> {
        let (at_work, end) = mpsc::channel();
        spawn(name, move || {
            let _at_work = at_work;
            follow();
        })?;
        Ok(Self {
            requests,
            work,
            end,
        })
    }

    /// Queues a request.
    pub(crate) fn request(&self, request: R) -> Result<(), Ended> {
        self.requests.send(request).map_err(|_| Ended(self.work))
    }

    /// Waits until all requests are carried out, at most until `deadline`.
    pub(crate) fn finish(self, deadline: Instant) {
        drop(self.requests);
        let patience = deadline.saturating_duration_since(Instant::now());
        // Nothing is ever sent: the end of the thread ends the wait.
        let _ = self.end.recv_timeout(patience);
    }
}

/// Starts a thread of this name.
pub(crate) fn spawn<T: Send + 'static>(
    name: &str,
    work: impl FnOnce() -> T + Send + 'static,
) -> io::Result<JoinHandle<T>> {
    // Boxed, so that starting a thread is compiled once for each type of result, not for each closure.
    let work: Box<dyn FnOnce() -> T + Send> = Box::new(work);
    thread::Builder::new().name(name.to_owned()).spawn(work)
}
