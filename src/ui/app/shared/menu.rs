//! A menu of what can be added, of kinds to change to, of the values of a field, or of what to
//! compare with: typing filters it.

use super::filter::Filter;
use super::live_edit::LiveEdit;
use language::Node;

/// A menu over the list.
#[derive(Debug)]
pub struct Menu {
    /// What choosing an entry does.
    pub purpose: Purpose,
    entries: Vec<Entry>,
    /// The name of the entry that is the present one, if any was when the menu was opened.
    pub(crate) opened: Option<String>,
    /// What a new name makes, offered after the entries.
    pub(crate) offer: Option<Entry>,
    /// The typed filter, and the cursor among the entries shown.
    pub filter: Filter,
    /// The change of the text by the entry under the cursor; `None` if that waits for Enter.
    pub(crate) live_edit: Option<LiveEdit>,
    /// Whether the entry under the cursor is the answer to the mode that asks.
    pub(crate) is_answered: bool,
}

/// An entry of a menu.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name, or the value it stands for.
    pub name: String,
    /// What it is.
    pub words: String,
    /// The node that it refers to.
    pub node: Option<Node>,
}

/// What choosing an entry of a menu does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Adds a thing of the kind.
    Add,
    /// Changes the selected thing to the kind.
    Retype,
    /// Sets the component under the cursor of the field with this name.
    Value(&'static str),
    /// Answers COMPARE, which asks what to compare with.
    Reference,
}

impl Entry {
    pub(crate) fn new(name: impl Into<String>, words: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            words: words.into(),
            node: None,
        }
    }
}

impl Menu {
    /// A menu with its cursor on the present entry, otherwise on the first.
    pub(crate) fn new(purpose: Purpose, entries: Vec<Entry>, present: Option<usize>) -> Self {
        let opened = present.and_then(|at| entries.get(at));
        Self {
            purpose,
            opened: opened.map(|entry| entry.name.clone()),
            entries,
            offer: None,
            filter: Filter::at(present.unwrap_or(0)),
            live_edit: None,
            is_answered: false,
        }
    }

    /// The entries that answer the typed text, the best first. What may be a new name is not taken for
    /// another one misspelt.
    pub fn shown(&self) -> Vec<&Entry> {
        let texts = self.entries.iter();
        let texts = texts.map(|entry| (entry.name.as_str(), entry.words.as_str()));
        let shown = self.filter.shown(texts).into_iter();
        let shown = shown.filter(|&(_, is_guess)| self.offer.is_none() || !is_guess);
        let shown = shown.filter_map(|(index, _)| self.entries.get(index));
        shown.chain(&self.offer).collect()
    }

    /// The entry under the cursor.
    pub(crate) fn chosen(&self) -> Option<&Entry> {
        self.shown().get(self.filter.at).copied()
    }

    /// Whether an entry has exactly this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.entries.iter().any(|entry| entry.name == name)
    }
}
