//! The key bindings: one table gives both the action of a key and the help page.

mod action;
mod chord;
mod help;
mod table;

pub use action::{Action, Context, Mode, Stride};
pub use help::{
    Entry, HelpLine, Line, NamedAction, actions, help, hints, in_columns, lasting_hints, line_hints,
};
pub use table::{action, elsewhere, name};
