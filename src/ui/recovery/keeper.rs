//! The thread that keeps unsaved edits, so that neither saves nor other file work delay it.

use std::collections::VecDeque;
use std::io;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::Instant;

use super::claim::Claim;
use super::folder;
use super::journal::{Edits, Journal};

/// An order for the thread.
#[derive(Debug)]
pub(crate) enum Order {
    /// Keep the text of this revision; answered by [`Outcome::Kept`].
    Keep(u64, Edits),
    /// Forget what this run has kept.
    Forget,
    /// Forget an earlier run's journal once this run keeps or forgets something.
    Adopt(Arc<Claim>),
    /// Forget an earlier run's journal.
    Discard(Arc<Claim>),
}

/// The outcome of an order.
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
    orders: Sender<Order>,
    end: Receiver<End>,
    /// Whether there is something to keep.
    keeps: bool,
}

impl Keeper {
    /// Starts the thread, which calls `report`.
    pub(crate) fn start(report: impl Fn(Outcome) + Send + 'static) -> io::Result<Self> {
        let (orders, inbox) = mpsc::channel();
        let (tell, end) = mpsc::channel();
        let work = move || {
            // Fails only if the program has stopped waiting.
            let _ = tell.send(follow(&inbox, report));
        };
        thread::Builder::new()
            .name("journal".to_owned())
            .spawn(work)?;
        Ok(Self {
            orders,
            end,
            keeps: false,
        })
    }

    /// Queues an order. Of several waiting texts only the last is kept.
    pub(crate) fn order(&mut self, order: Order) -> Result<(), String> {
        match order {
            Order::Keep(..) => self.keeps = true,
            Order::Forget => self.keeps = false,
            Order::Adopt(_) | Order::Discard(_) => {}
        }
        let sent = self.orders.send(order);
        sent.map_err(|_| "the thread that keeps edits has ended".to_owned())
    }

    /// Waits until all orders are done, at most until `deadline`.
    pub(crate) fn finish(self, deadline: Instant) -> End {
        drop(self.orders);
        let lost = |reason: &str| End::Lost(reason.to_owned());
        match self
            .end
            .recv_timeout(deadline.saturating_duration_since(Instant::now()))
        {
            Ok(end) => end,
            Err(_) if !self.keeps => End::Nothing,
            Err(RecvTimeoutError::Timeout) => lost("the recovery folder is not responding"),
            Err(RecvTimeoutError::Disconnected) => lost("the thread that keeps them has ended"),
        }
    }
}

/// Executes orders until the channel is closed.
fn follow(inbox: &Receiver<Order>, report: impl Fn(Outcome)) -> End {
    let mut journal = folder::state().map(Journal::new);
    let mut waiting = VecDeque::new();
    let mut adopted = Vec::new();
    let mut trouble = None;
    while let Some(order) = next(inbox, &mut waiting) {
        let removed = match order {
            Order::Keep(revision, edits) => {
                let done = match &mut journal {
                    Ok(journal) => journal.write(&edits).map_err(|error| error.to_string()),
                    Err(error) => Err(error.to_string()),
                };
                // While others hold a text, the interface has to copy it for its next edit.
                drop(edits);
                trouble = done.as_ref().err().cloned();
                report(Outcome::Kept(revision, done));
                if trouble.is_some() {
                    continue;
                }
                remove_all(&mut adopted)
            }
            Order::Forget => {
                trouble = None;
                let forgotten = journal.as_mut().map_or(Ok(()), Journal::forget);
                forgotten.and_then(|()| remove_all(&mut adopted))
            }
            Order::Adopt(claim) => {
                adopted.push(claim);
                continue;
            }
            Order::Discard(claim) => claim.remove(),
        };
        if let Err(error) = removed {
            report(Outcome::Failed(format!(
                "kept edits cannot be removed: {error}"
            )));
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

/// The next order worth executing; `None` at the end.
fn next(inbox: &Receiver<Order>, waiting: &mut VecDeque<Order>) -> Option<Order> {
    if waiting.is_empty() {
        waiting.push_back(inbox.recv().ok()?);
    }
    waiting.extend(inbox.try_iter());
    let settles = |order: &Order| matches!(order, Order::Keep(..) | Order::Forget);
    loop {
        let order = waiting.pop_front()?;
        if !settles(&order) || !waiting.iter().any(settles) {
            return Some(order);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use crate::language::Language;

    #[test]
    fn only_the_last_waiting_text_is_kept() {
        let keep = |revision| {
            let known = Document::new(Language::Ray, String::new()).snapshot();
            let edits = Edits { scene: None, known };
            Order::Keep(revision, edits)
        };
        let left = |orders: Vec<Order>| {
            let (send, inbox) = mpsc::channel();
            for order in orders {
                send.send(order).expect("it is there");
            }
            drop(send);
            let mut waiting = VecDeque::new();
            let orders = std::iter::from_fn(|| next(&inbox, &mut waiting));
            orders.collect::<Vec<_>>()
        };
        let found = left(vec![keep(1), Order::Forget, keep(2), keep(3)]);
        assert!(matches!(found[..], [Order::Keep(3, _)]), "{found:?}");
        let found = left(vec![keep(1), keep(2), Order::Forget]);
        assert!(matches!(found[..], [Order::Forget]), "{found:?}");
    }
}
