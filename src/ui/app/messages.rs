//! Messages that wait to be shown, and those of the session so far.

use std::collections::VecDeque;

use crate::text::Severity;

/// The number of messages remembered.
const REMEMBERED: usize = 50;

/// The number of messages that may wait; more are only remembered.
const WAITING: usize = 9;

/// A message to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// `None` for success and information.
    pub severity: Option<Severity>,
    /// Its text, without the system's error numbers.
    pub text: String,
}

/// The messages that are not in the status line.
#[derive(Debug, Default)]
pub struct Messages {
    /// Messages that came together with another, the next one first.
    waiting: VecDeque<Message>,
    /// The last messages, the newest first.
    past: VecDeque<Message>,
    /// Whether the message in the status line came in this step, so that nobody has seen it.
    pub(super) is_unseen: bool,
    /// Why the message in the status line may become obsolete.
    pub(super) lasts: Lasts,
}

/// How long a message is worth showing, unless a key dismisses it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Lasts {
    /// Until another message comes.
    #[default]
    UntilNext,
    /// Until another message comes, but never longer than the text has errors.
    WhileErrors,
    /// It reports the end of something that the user waits for: other reports wait.
    Report,
}

impl Messages {
    /// The last messages, the newest first.
    pub fn past(&self) -> impl ExactSizeIterator<Item = &Message> {
        self.past.iter()
    }

    /// The number of messages that wait.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }

    /// Remembers a message.
    pub(super) fn remember(&mut self, message: &Message) {
        if self.past.front() != Some(message) {
            self.past.push_front(message.clone());
            self.past.truncate(REMEMBERED);
        }
    }

    /// Lets a message wait, unless it already does.
    pub(super) fn queue(&mut self, message: Message) {
        if self.waiting.len() < WAITING && !self.waiting.contains(&message) {
            self.waiting.push_back(message);
        }
    }

    /// Drops a message that waits.
    pub(super) fn withdraw(&mut self, text: &str) {
        self.waiting.retain(|message| message.text != text);
    }

    /// Takes the next message that waits.
    pub(super) fn next(&mut self) -> Option<Message> {
        self.waiting.pop_front()
    }
}
