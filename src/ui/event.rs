//! What arrives in the inbox of the main loop, and how it is put there.

use std::sync::mpsc::Sender;
use std::time::Instant;

use crate::msg::{Msg, Target};
use crate::terminal::{self, Reply, Unread};

/// An arrival in the inbox.
#[derive(Debug)]
pub(crate) enum Event {
    /// A message for the state of the interface.
    Msg(Msg),
    /// The keyboard sent this.
    Typed(Box<Self>, Unread),
    /// A signal has arrived, which is handled before everything else here.
    Signalled,
    /// A renderer has a newer frame.
    Ready(Target),
    /// The renderer with this serial number has ended.
    Ended(Target, u64),
    /// Work has begun whose results arrive here.
    Begun,
    /// Work is done: its results have arrived.
    Done,
    /// The terminal has taken everything drawn.
    Cleared,
    /// The terminal replied at this time.
    Replied(Reply, Instant),
}

/// The answer to a paste that is not kept.
const TOO_LONG: &str = "the pasted text is longer than 1 MiB; save it to a file and open that";

/// Work under way. Announces its begin when it is created and its end when it is dropped, which
/// happens after the results are sent.
#[derive(Debug)]
pub(crate) struct Work(Sender<Event>);

impl Work {
    pub(crate) fn begin(sender: &Sender<Event>) -> Self {
        // The inbox is gone only when the program ends.
        let _ = sender.send(Event::Begun);
        Self(sender.clone())
    }
}

impl Drop for Work {
    fn drop(&mut self) {
        let _ = self.0.send(Event::Done);
    }
}

/// Returns a function that puts messages into the inbox.
pub(crate) fn sending(sender: &Sender<Event>) -> impl Fn(Msg) + Clone + Send + Sync + 'static {
    let sender = sender.clone();
    move |msg| {
        // The inbox is gone only when the program ends.
        let _ = sender.send(Event::Msg(msg));
    }
}

impl From<terminal::Event> for Event {
    fn from(event: terminal::Event) -> Self {
        use terminal::Event as E;
        Self::Msg(match event {
            E::Reply(reply) => return Self::Replied(reply, Instant::now()),
            E::Key(key) => Msg::Key(key),
            E::Paste(text) => Msg::Paste(text),
            E::LongPaste => Msg::Failed(TOO_LONG.to_owned()),
            E::Mouse(event) => Msg::Mouse(event),
            E::Resize { columns, rows } => Msg::Resize(columns, rows),
            E::Suspend => Msg::Suspend,
            E::Continue => Msg::Continued,
            E::HangUp => Msg::HangUp,
            E::Terminate { signal } => Msg::Terminate { signal },
            E::Interrupt => Msg::Interrupt,
        })
    }
}
