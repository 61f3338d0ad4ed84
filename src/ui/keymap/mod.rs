//! The key bindings: rows of keys, as changed by the user, give what keys do, the help page, the
//! hints, the palette and the printed configuration. What a row does is defined beside the row, in
//! the `keys.rs` of its room.

mod bindings;
mod chord;
mod context;
mod help;
mod joined;
mod key;
mod named_action;
mod section;
mod section_keys;
mod typed_line;
mod unbindable;

#[cfg(test)]
pub(crate) use bindings::tests::bound;
pub use bindings::{Keymap, Meaning, RowId, name};
pub use chord::{Chord, Keys, alt, c, ctrl, key, key_named, key_names, shift};
pub use context::{Context, Mode};
pub use help::{Entry, RankedHint, Topic};
pub use joined::HelpEntry;
pub use key::{Key, Scope};
pub use named_action::NamedAction;
pub use section::Section;
pub use section_keys::{Bound, NamedHere};
pub use typed_line::{Line, begins_value, line_hints, types_amount};
pub use unbindable::refusal;
