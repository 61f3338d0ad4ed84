//! Threads that answer requests.

use std::io;

use crate::event::Work;
use crate::queue::{Ended, Service};

/// A thread whose requests count as work until they are answered.
pub(crate) type Answering<R> = Service<(R, Work)>;

impl<R: Send + 'static> Answering<R> {
    /// Starts a thread that answers every request.
    pub(crate) fn each(
        name: &str,
        work: &'static str,
        mut answer: impl FnMut(R) + Send + 'static,
    ) -> io::Result<Self> {
        Self::start(name, work, move |inbox| {
            for (request, work) in inbox {
                answer(request);
                drop(work);
            }
        })
    }

    /// Starts a thread that answers only the last of several pending requests.
    pub(crate) fn latest(
        name: &str,
        work: &'static str,
        mut answer: impl FnMut(R) + Send + 'static,
    ) -> io::Result<Self> {
        Self::start(name, work, move |inbox| {
            while let Ok(first) = inbox.recv() {
                let (request, work) = inbox.try_iter().last().unwrap_or(first);
                answer(request);
                drop(work);
            }
        })
    }

    /// Queues a request, which is work from now on.
    pub(crate) fn ask(&self, request: R, work: Work) -> Result<(), Ended> {
        self.request((request, work))
    }
}
