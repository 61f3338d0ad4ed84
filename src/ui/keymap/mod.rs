//! The key bindings: one table gives both the action of a key and the help page.

mod action;
mod chord;
mod help;
mod line;
mod named;
mod table;

pub use action::{Action, Context, Fold, Mode, Stride, Tool};
pub use help::{Entry, HelpLine, help, hints, in_columns, lasting_hints};
pub use line::{Line, line_hints};
pub use named::{NamedAction, actions};
pub use table::{action, elsewhere, name};

use crossterm::event::KeyEvent;

/// The key with this name, such as `j`, `Ctrl-R` or `Shift-Left`, as the help spells it.
pub fn key_named(name: &str) -> Option<KeyEvent> {
    chord::Chord::parse(name).map(chord::Chord::event)
}

/// The names of the keys that are not characters.
pub fn key_names() -> impl Iterator<Item = &'static str> {
    chord::names()
}
