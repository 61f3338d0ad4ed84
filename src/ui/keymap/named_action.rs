//! The actions of keys by their descriptions, for the palette.

use super::bindings::{Keymap, RowId, names};
use super::context::{Context, Mode};

/// The row that opens the palette.
const COMMAND: &str = "command";

/// An action of a key, by its description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedAction {
    /// The row of its keys.
    pub row: RowId,
    /// The name of what they do.
    pub name: &'static str,
    /// The mode that has the key.
    pub mode: Mode,
    /// Its keys: `j ↓`; empty if it has none.
    pub keys: String,
    /// Its description.
    pub words: &'static str,
    /// Everyday words that find it too.
    pub synonyms: &'static str,
}

impl Keymap {
    /// Returns the actions of all modes, those of `mode` first.
    pub fn actions(&self, mode: Mode) -> Vec<NamedAction> {
        let others = Mode::ALL.into_iter().filter(|other| *other != mode);
        let mut found: Vec<NamedAction> = Vec::new();
        for mode in [mode].into_iter().chain(others) {
            let context = Context::In(mode);
            let rows = self.rows.iter().filter(|row| row.key.scope.holds(context));
            for row in rows.filter(|row| row.key.name != COMMAND) {
                let action = (row.key.name, row.key.words);
                let mut actions = found.iter_mut();
                let known = actions.find(|named| (named.name, named.words) == action);
                let keys = names(self.keys_of(row, context));
                match known {
                    None => found.push(NamedAction {
                        row: row.id,
                        name: row.key.name,
                        mode,
                        keys,
                        words: row.key.words,
                        synonyms: row.key.synonyms,
                    }),
                    // Another row of the same mode: `gg`, `Home`.
                    Some(named) if named.mode == mode && !keys.is_empty() => {
                        if !named.keys.is_empty() {
                            named.keys.push(' ');
                        }
                        named.keys.push_str(&keys);
                    }
                    Some(_) => {}
                }
            }
        }
        found
    }
}
