//! The state of the palette over the command line: what is chosen, and the history of command lines.

use std::path::PathBuf;

use crate::ui::keymap::{Context, RowId};

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
    /// The action of a key and where that has it; `None` for a command line.
    pub(crate) act: Option<(RowId, Context)>,
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

    /// The command line before (or after) the recalled one. `None` if the line is another one, or
    /// if there is no further one.
    pub(crate) fn recall(&mut self, line: &str, older: bool) -> Option<String> {
        let count = self.past.len();
        let at = match self.recalled {
            Some(at) if self.past.get(at).is_some_and(|past| past == line) => at,
            _ if line.is_empty() && self.chosen.is_none() => count,
            _ => return None,
        };
        let at = if older { at.checked_sub(1)? } else { at + 1 };
        if count < at {
            return None;
        }
        let line = self.past.get(at).cloned().unwrap_or_default();
        self.reset();
        self.recalled = (at < count).then_some(at);
        Some(line)
    }
}
