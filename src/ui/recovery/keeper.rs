//! The thread that keeps unsaved edits: no save and no other work on files is in its way.

use std::collections::VecDeque;
use std::io;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::Instant;

use super::claim::Claim;
use super::folder;
use super::journal::{Edits, Journal};
use crate::ui::msg::Msg;

/// Work for the thread.
#[derive(Debug)]
pub(crate) enum Order {
    /// Keep a text, which is that of this revision: [`Msg::Kept`].
    Keep(u64, Edits),
    /// Forget what this run has kept.
    Forget,
    /// Forget what an earlier run kept once this one keeps or forgets something.
    Adopt(Arc<Claim>),
    /// Forget what an earlier run kept.
    Discard(Arc<Claim>),
}

/// What is left of unsaved edits at the end.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// Nothing was to be kept.
    Nothing,
    /// The last text that was to be kept is.
    Kept,
    /// It is not; why.
    Lost(String),
}

/// The thread's handle.
pub(crate) struct Keeper {
    orders: Sender<Order>,
    end: Receiver<End>,
    /// Whether there is something to keep.
    keeps: bool,
}

impl Keeper {
    /// Starts the thread; `send` is called on it.
    pub(crate) fn start(send: impl Fn(Msg) + Send + 'static) -> io::Result<Self> {
        let (orders, inbox) = mpsc::channel();
        let (tell, end) = mpsc::channel();
        let work = move || {
            // A program that has lost its patience is gone.
            let _ = tell.send(follow(&inbox, send));
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

    /// Has something done after what was ordered before; of several texts that wait only the last is
    /// kept.
    pub(crate) fn order(&mut self, order: Order) -> Result<(), String> {
        match order {
            Order::Keep(..) => self.keeps = true,
            Order::Forget => self.keeps = false,
            Order::Adopt(_) | Order::Discard(_) => {}
        }
        let sent = self.orders.send(order);
        sent.map_err(|_| "the thread that keeps edits has ended".to_owned())
    }

    /// Waits until all is done, until `deadline` at most.
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

/// Carries orders out until there will be no more.
fn follow(inbox: &Receiver<Order>, send: impl Fn(Msg)) -> End {
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
                // The interface copies a text that others hold when it edits on.
                drop(edits);
                trouble = done.as_ref().err().cloned();
                send(Msg::Kept(revision, done));
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
            send(Msg::Failed(format!("kept edits can't be removed: {error}")));
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

/// The next order worth carrying out; `None` at the end.
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
    fn of_texts_that_wait_only_the_last_is_kept() {
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
