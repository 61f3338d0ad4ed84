//! The key bindings: rows of keys, as changed by the user, give what keys do, the help page, the
//! hints, the palette and the printed configuration. What a row does is defined beside the row, in
//! the `keys.rs` of its room.

mod bindings;
mod chord;
mod context;
mod help;
mod key;
mod line;
mod listed;
mod named;
mod rules;
mod section;

#[cfg(test)]
pub(in crate::ui) use bindings::tests::bound;
pub use bindings::{Keymap, Meaning, RowId, name};
pub use chord::{Chord, Keys, alt, c, ctrl, key, key_named, key_names, shift};
pub use context::{Context, Mode};
pub use help::{Entry, HelpLine, in_columns};
pub use key::{Key, Scope};
pub use line::{Line, line_hints};
pub use listed::{Bound, NamedHere};
pub use named::NamedAction;
pub use rules::{begins_value, refusal, types_amount};
pub use section::Section;
