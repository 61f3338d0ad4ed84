//! The names of steps, and the numbers of the texts between them.

use std::fmt;

/// Identifies a text in the history of a session: no other text has the same one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StateId(pub(super) u64);

/// What a step changed, for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepName {
    /// What was done, or the place of the value that was replaced.
    what: String,
    /// The value before and after.
    values: Option<[String; 2]>,
    /// The number of changes merged into the step.
    pub(super) changes: usize,
}

impl Default for StepName {
    /// The name of a step that nobody named.
    fn default() -> Self {
        Self::done("edit")
    }
}

impl StepName {
    /// The name of a step by what was done: `deleted object 2 (box)`.
    pub fn done(what: impl Into<String>) -> Self {
        Self {
            what: what.into(),
            values: None,
            changes: 1,
        }
    }

    /// The name of a step that replaced a value: its place, and the value before and after.
    pub fn set(place: impl Into<String>, before: &str, after: &str) -> Self {
        Self {
            values: Some([before, after].map(str::to_owned)),
            ..Self::done(place)
        }
    }

    /// The name of a step that a change with this name was merged into.
    pub(super) fn continuing(mut self, before: &Self) -> Self {
        self.changes += before.changes;
        if let (Some([old, _]), Some([first, _])) = (&mut self.values, &before.values) {
            old.clone_from(first);
        }
        self
    }
}

impl fmt::Display for StepName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)?;
        if let Some([before, after]) = &self.values {
            write!(f, ": {before} → {after}")?;
        }
        if 1 < self.changes {
            write!(f, ", {} nudges", self.changes)?;
        }
        Ok(())
    }
}

/// A text of the history.
#[derive(Clone, Copy, Debug)]
pub struct State<'a> {
    /// Identifies the text.
    pub id: StateId,
    /// The step that led to it; `None` for the first text.
    pub name: Option<&'a StepName>,
}
