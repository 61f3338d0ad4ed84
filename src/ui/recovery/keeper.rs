//! The thread that keeps unsaved edits, so that neither saves nor other file work delay it.

use std::collections::VecDeque;
use std::io;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Instant;

use super::claim::Claim;
use super::journal::{Edits, Journal};
use crate::queue::{Ended, Service};
use file::state_folder;

/// A request for the thread.
#[derive(Debug)]
pub(crate) enum Request {
    /// Keep the text of this revision; answered by [`Outcome::Kept`].
    Keep(u64, Edits),
    /// Forget what this run has kept.
    Forget,
    /// Forget an earlier run's journal once this run keeps or forgets something.
    Adopt(Arc<Claim>),
    /// Forget an earlier run's journal.
    Discard(Arc<Claim>),
}

/// The outcome of a request.
#[derive(Debug)]
pub(crate) enum Outcome {
    /// The text of this revision is kept, or the reason why not.
    Kept(u64, Result<(), String>),
    /// The reason why kept edits cannot be removed.
    Failed(String),
}

/// The state of unsaved edits at the end.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// There was nothing to keep.
    Nothing,
    /// The last text is kept.
    Kept,
    /// The last text is not kept, for this reason.
    Lost(String),
}

/// A handle to the thread.
pub(crate) struct Keeper {
    service: Service<Request>,
    end: Receiver<End>,
    /// Whether there is something to keep.
    keeps: bool,
}

impl Keeper {
    /// Starts the thread, which calls `report`.
    pub(crate) fn start(report: impl Fn(Outcome) + Send + 'static) -> io::Result<Self> {
        let (tell, end) = mpsc::channel();
        let service = Service::start("journal", "keeps edits", move |inbox| {
            // Fails only if the program has stopped waiting.
            let _ = tell.send(follow(inbox, report));
        })?;
        Ok(Self {
            service,
            end,
            keeps: false,
        })
    }

    /// Queues a request. Of several waiting texts only the last is kept.
    pub(crate) fn request(&mut self, request: Request) -> Result<(), Ended> {
        match request {
            Request::Keep(..) => self.keeps = true,
            Request::Forget => self.keeps = false,
            Request::Adopt(_) | Request::Discard(_) => {}
        }
        self.service.request(request)
    }

    /// Waits until all requests are done, at most until `deadline`.
    pub(crate) fn finish(self, deadline: Instant) -> End {
        drop(self.service);
        let lost = |reason: &str| End::Lost(reason.to_owned());
        let patience = deadline.saturating_duration_since(Instant::now());
        match self.end.recv_timeout(patience) {
            Ok(end) => end,
            Err(_) if !self.keeps => End::Nothing,
            Err(RecvTimeoutError::Timeout) => lost("the recovery folder is not responding"),
            Err(RecvTimeoutError::Disconnected) => lost("the thread that keeps them has ended"),
        }
    }
}

/// Executes requests until the channel is closed.
fn follow(inbox: &Receiver<Request>, report: impl Fn(Outcome)) -> End {
    let mut journal = state_folder::path().map(Journal::new);
    let mut waiting = VecDeque::new();
    let mut adopted = Vec::new();
    let mut trouble = None;
    while let Some(request) = next(inbox, &mut waiting) {
        let removed = match request {
            Request::Keep(revision, edits) => {
                let done = match &mut journal {
                    Ok(journal) => journal.write(edits).map_err(|error| error.to_string()),
                    Err(error) => Err(error.to_string()),
                };
                trouble = done.as_ref().err().cloned();
                report(Outcome::Kept(revision, done));
                if trouble.is_some() {
                    continue;
                }
                remove_all(&mut adopted)
            }
            Request::Forget => {
                trouble = None;
                let forgotten = journal.as_mut().map_or(Ok(()), Journal::forget);
                forgotten.and_then(|()| remove_all(&mut adopted))
            }
            Request::Adopt(claim) => {
                adopted.push(claim);
                continue;
            }
            Request::Discard(claim) => claim.remove(),
        };
        if let Err(error) = removed {
            let reason = format!("kept edits cannot be removed: {error}");
            report(Outcome::Failed(reason));
        }
    }
    match trouble {
        Some(reason) => End::Lost(reason),
        None if journal.is_ok_and(|journal| journal.is_kept()) => End::Kept,
        None => End::Nothing,
    }
}

fn remove_all(claims: &mut Vec<Arc<Claim>>) -> io::Result<()> {
    claims.drain(..).try_for_each(|claim| claim.remove())
}

/// The next request worth executing; `None` at the end.
fn next(inbox: &Receiver<Request>, waiting: &mut VecDeque<Request>) -> Option<Request> {
    if waiting.is_empty() {
        waiting.push_back(inbox.recv().ok()?);
    }
    waiting.extend(inbox.try_iter());
    let settles = |request: &Request| matches!(request, Request::Keep(..) | Request::Forget);
    loop {
        let request = waiting.pop_front()?;
        if !settles(&request) || !waiting.iter().any(settles) {
            return Some(request);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use document::Document;
    use language::Language;

    #[test]
    fn only_the_last_waiting_text_is_kept() {
        let keep = |revision| {
            let known = Document::new(Language::Ray, String::new()).snapshot();
            let edits = Edits { scene: None, known };
            Request::Keep(revision, edits)
        };
        let left = |requests: Vec<Request>| {
            let (send, inbox) = mpsc::channel();
            for request in requests {
                send.send(request).expect("it is there");
            }
            drop(send);
            let mut waiting = VecDeque::new();
            let requests = std::iter::from_fn(|| next(&inbox, &mut waiting));
            requests.collect::<Vec<_>>()
        };
        let found = left(vec![keep(1), Request::Forget, keep(2), keep(3)]);
        assert!(matches!(found[..], [Request::Keep(3, _)]), "{found:?}");
        let found = left(vec![keep(1), keep(2), Request::Forget]);
        assert!(matches!(found[..], [Request::Forget]), "{found:?}");
    }
}
