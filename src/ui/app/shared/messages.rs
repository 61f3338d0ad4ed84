//! Messages that wait to be shown, and those of the session so far.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use crate::msg::Polled;
use text::Severity;

/// The number of messages remembered.
const REMEMBERED: usize = 50;

/// The number of messages that may wait; more are only remembered.
const WAITING: usize = 9;

/// The time to notice a message.
const NOTICE: Duration = Duration::from_secs(2);

/// The time to read a character.
const READING: Duration = Duration::from_millis(50);

/// The number of characters to read at most; the rest can be read in the history.
const MOST_READ: usize = 120;

/// Files that messages complain about, at most as long as something is wrong with them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum About {
    /// The scene's file cannot be read or taken.
    Scene,
    /// Files that the scene names cannot be read.
    Assets,
    /// The track file cannot be read or played.
    Track,
    /// They are polled.
    Polling(Polled),
}

/// A message to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// `None` for success and information.
    pub severity: Option<Severity>,
    /// Its text, without the system's error numbers.
    pub text: String,
}

/// The messages that wait, those of the session so far, and how long the one in the status line lasts.
#[derive(Debug, Default)]
pub struct Messages {
    /// Messages that came while another was shown, the next one first: errors before others.
    waiting: VecDeque<(Message, Lasts)>,
    /// The last messages, the newest first.
    past: VecDeque<Message>,
    /// What was said last about files that something is wrong with.
    pub(crate) complaints: BTreeMap<About, String>,
    /// Whether the newest of them tells how something stands that still goes on.
    is_passing: bool,
    /// Whether the message in the status line came in this step, so that nobody has seen it.
    pub(crate) is_unseen: bool,
    /// How long the message in the status line is worth showing.
    pub(crate) lasts: Lasts,
    /// The message in the status line when the time to read it began, while others wait.
    timed: Option<Message>,
}

/// How long a message is worth showing, unless a key dismisses it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Lasts {
    /// Until it could be read and another one waits.
    #[default]
    UntilRead,
    /// As long, but never longer than the text has errors.
    WhileErrors,
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

    /// Remembers how something stands, in place of how it stood before.
    pub(crate) fn remember_passing(&mut self, message: &Message) {
        if self.is_passing {
            self.past.pop_front();
        }
        self.remember(message);
        self.is_passing = true;
    }

    /// Keeps what was said last of something, which is over.
    pub(crate) fn end_passing(&mut self) {
        self.is_passing = false;
    }

    /// Remembers a message.
    pub(crate) fn remember(&mut self, message: &Message) {
        self.is_passing = false;
        if self.past.front() != Some(message) {
            self.past.push_front(message.clone());
            self.past.truncate(REMEMBERED);
        }
    }

    /// Lets a message wait, unless it already does: an error before all that are none.
    pub(crate) fn queue(&mut self, message: Message, lasts: Lasts) {
        let is_error = |message: &Message| message.severity == Some(Severity::Error);
        let mut waiting = self.waiting.iter();
        if WAITING <= waiting.len() || waiting.any(|(other, _)| *other == message) {
            return;
        }
        let at = if is_error(&message) {
            self.waiting.partition_point(|(other, _)| is_error(other))
        } else {
            self.waiting.len()
        };
        self.waiting.insert(at, (message, lasts));
    }

    /// Drops a message that waits. Returns whether it did.
    pub(crate) fn withdraw(&mut self, text: &str) -> bool {
        let before = self.waiting.len();
        self.waiting.retain(|(message, _)| message.text != text);
        self.waiting.len() < before
    }

    /// Drops the messages about errors that wait.
    pub(crate) fn forgive_errors(&mut self) {
        self.waiting
            .retain(|(_, lasts)| *lasts != Lasts::WhileErrors);
    }

    /// Takes the next message that waits.
    pub(crate) fn next(&mut self) -> Option<(Message, Lasts)> {
        self.waiting.pop_front()
    }

    /// The time to read the message shown, if it begins now: it has not begun yet, and others wait.
    pub(crate) fn time_to_read(&mut self, shown: Option<&Message>) -> Option<Duration> {
        let shown = shown.filter(|_| !self.waiting.is_empty());
        if self.timed.as_ref() == shown {
            return None;
        }
        self.timed = shown.cloned();
        let characters = shown?.text.chars().count().min(MOST_READ);
        Some(NOTICE + READING * characters as u32)
    }

    /// Whether the time that has elapsed is that of the message shown, and others wait.
    pub(crate) fn is_timed(&self, shown: Option<&Message>) -> bool {
        shown.is_some() && self.timed.as_ref() == shown && !self.waiting.is_empty()
    }
}
