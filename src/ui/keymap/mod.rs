//! The key bindings: one table, as changed by the user, gives the actions of keys, the help page,
//! the hints and the palette.

mod action;
mod bindings;
mod chord;
mod help;
mod line;
mod listed;
mod named;
mod names;
mod rules;
mod section;
mod table;

pub use action::{Action, Context, Fold, Mode, Playback, Stride, Tool};
pub use bindings::{Keymap, Meaning, name};
pub use chord::Keys;
pub use help::{Entry, HelpLine, in_columns};
pub use line::{Line, line_hints};
pub use listed::{Bound, NamedHere};
pub use named::NamedAction;
pub use rules::{begins_value, refusal, types_amount};
pub use section::Section;

use crossterm::event::KeyEvent;

/// The key with this name, such as `j`, `Ctrl-R` or `Shift-Left`, as the help spells it.
pub fn key_named(name: &str) -> Option<KeyEvent> {
    chord::Chord::parse(name).map(chord::Chord::event)
}

/// The names of the keys that are not characters.
pub fn key_names() -> impl Iterator<Item = &'static str> {
    chord::names()
}
