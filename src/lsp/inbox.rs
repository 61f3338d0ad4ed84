//! The arrivals in their order, of which it is known before their turn which requests are cancelled.

use std::collections::{BTreeSet, VecDeque};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Instant;

use serde_json::Value;

use crate::Event;

/// The arrivals that wait for their turn.
pub(crate) struct Inbox {
    arrivals: Receiver<Event>,
    waiting: VecDeque<Event>,
    /// The IDs in the cancellations that wait.
    cancelled: BTreeSet<String>,
}

impl Inbox {
    pub(crate) fn new(arrivals: Receiver<Event>) -> Self {
        Self {
            arrivals,
            waiting: VecDeque::new(),
            cancelled: BTreeSet::new(),
        }
    }

    /// The next arrival, if it is there.
    pub(crate) fn next(&mut self) -> Option<Event> {
        while let Ok(event) = self.arrivals.try_recv() {
            self.put(event);
        }
        let event = self.waiting.pop_front()?;
        if let Some(id) = cancels(&event) {
            self.cancelled.remove(&id);
        }
        Some(event)
    }

    /// Waits for an arrival, until a time if there is one.
    ///
    /// # Errors
    ///
    /// Fails at that time, or if nothing can arrive any more.
    pub(crate) fn wait(&mut self, due: Option<Instant>) -> Result<(), RecvTimeoutError> {
        let arrived = match due {
            Some(due) => {
                let patience = due.saturating_duration_since(Instant::now());
                self.arrivals.recv_timeout(patience)?
            }
            None => self.arrivals.recv()?,
        };
        self.put(arrived);
        Ok(())
    }

    /// The ID of a question about a document that is cancelled before it was answered.
    pub(crate) fn cancelled<'m>(&self, message: &'m Value) -> Option<&'m Value> {
        let is_question = message["method"].as_str()?.starts_with("textDocument/");
        let id = message.get("id").filter(|_| is_question)?;
        self.cancelled.contains(&id.to_string()).then_some(id)
    }

    fn put(&mut self, event: Event) {
        self.cancelled.extend(cancels(&event));
        self.waiting.push_back(event);
    }
}

/// The ID of the request that a message cancels.
fn cancels(event: &Event) -> Option<String> {
    let Event::Editor(Some(Ok(message))) = event else {
        return None;
    };
    let is_it = message.get("method")? == "$/cancelRequest";
    let id = message["params"].get("id").filter(|_| is_it)?;
    Some(id.to_string())
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;
    use std::time::Duration;

    use super::*;
    use serde_json::json;

    #[test]
    fn requests_are_cancelled_until_the_cancellation_has_its_turn() {
        let (sender, arrivals) = mpsc::channel();
        let mut inbox = Inbox::new(arrivals);
        let request = |method: &str, id: Value| json!({ "method": method, "id": id });
        let cancel = |id: Value| json!({ "method": "$/cancelRequest", "params": { "id": id } });
        let hover = "textDocument/hover";
        let messages = [
            (request(hover, json!(1)), false),
            (request(hover, json!("1")), true),
            (request(hover, json!(2)), true),
            (request("shutdown", json!(2)), false),
            (cancel(json!("1")), false),
            (request(hover, json!("1")), false),
            (cancel(json!(2)), false),
            (json!({ "method": "$/cancelRequest" }), false),
            (json!(null), false),
        ];
        for (message, _) in &messages {
            let event = Event::Editor(Some(Ok(message.clone())));
            sender.send(event).expect("it is received");
        }
        for (message, is_cancelled) in &messages {
            let event = inbox.next();
            let Some(Event::Editor(Some(Ok(next)))) = event else {
                panic!("{event:?}");
            };
            assert_eq!(next, *message);
            assert_eq!(inbox.cancelled(&next).is_some(), *is_cancelled, "{next}");
        }
        assert!(inbox.next().is_none());
        let soon = Instant::now() + Duration::from_millis(1);
        assert_eq!(inbox.wait(Some(soon)), Err(RecvTimeoutError::Timeout));
        drop(sender);
        assert_eq!(inbox.wait(None), Err(RecvTimeoutError::Disconnected));
    }
}
