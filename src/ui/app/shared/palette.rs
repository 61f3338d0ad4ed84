//! The state of the palette over the command line: what is chosen, and the history of command lines.

use std::path::PathBuf;

use crate::keymap::{Mode, RowId};
use crate::matching::Likeness;

/// The number of command lines remembered.
const REMEMBERED: usize = 100;

/// The state of the command line's palette.
#[derive(Debug, Default)]
pub struct Palette {
    /// The index of the completion in the line, if any.
    pub chosen: Option<usize>,
    /// The line as typed, before the chosen completion replaced it.
    pub(crate) typed: String,
    /// The command lines of the session, the oldest first.
    past: Vec<String>,
    /// The index of the one in the line, if any.
    recalled: Option<usize>,
    /// The folder listed last, and the names in it; those of folders end in `/`.
    pub(crate) folder: Option<(PathBuf, Vec<String>)>,
}

/// A way to complete the line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// The line that it makes.
    pub line: String,
    /// How it is shown.
    pub shown: String,
    /// What it does.
    pub words: &'static str,
    /// Its key, preceded by the mode if that is not the present one.
    pub keys: String,
    /// The action of a key and the mode that has it; `None` for a command line.
    pub(crate) act: Option<(RowId, Mode)>,
    /// How it answers what was typed.
    pub(crate) likeness: Likeness,
}

impl Palette {
    /// Forgets what was chosen: the line has changed, or is closed.
    pub(crate) fn reset(&mut self) {
        self.chosen = None;
        self.recalled = None;
    }

    pub(crate) fn remember(&mut self, line: &str) {
        if !line.trim().is_empty() && self.past.last().is_none_or(|last| last != line) {
            self.past.push(line.to_owned());
            let surplus = self.past.len().saturating_sub(REMEMBERED);
            self.past.drain(..surplus);
        }
    }

    /// The command line before the recalled one. `None` if the line is another one, or if there is no
    /// further one.
    pub(crate) fn older(&mut self, line: &str) -> Option<String> {
        let at = self.place(line)?.checked_sub(1)?;
        self.recall(at)
    }

    /// The same for the one after it; after the last, an empty line.
    pub(crate) fn newer(&mut self, line: &str) -> Option<String> {
        let at = self.place(line)? + 1;
        self.recall(at)
    }

    /// The index of the line among those remembered, or one after the last for a new line.
    fn place(&self, line: &str) -> Option<usize> {
        let count = self.past.len();
        match self.recalled {
            Some(at) if self.past.get(at).is_some_and(|past| past == line) => Some(at),
            _ if line.is_empty() && self.chosen.is_none() => Some(count),
            _ => None,
        }
    }

    fn recall(&mut self, at: usize) -> Option<String> {
        let count = self.past.len();
        if count < at {
            return None;
        }
        let line = self.past.get(at).cloned().unwrap_or_default();
        self.reset();
        self.recalled = (at < count).then_some(at);
        Some(line)
    }
}
