//! The actions of keys by their descriptions, for the palette.

use super::action::{Action, Context, Mode};
use super::table::TABLE;

/// An action of a key, by its description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedAction {
    /// The action.
    pub action: Action,
    /// The mode that has the key.
    pub context: Context,
    /// Its keys: `j ↓`.
    pub keys: String,
    /// Its description.
    pub words: &'static str,
}

/// Returns the actions of the keys of all modes, those of `mode` first.
pub fn actions(mode: Mode) -> Vec<NamedAction> {
    let others = Mode::ALL.into_iter().filter(|other| *other != mode);
    let mut found: Vec<NamedAction> = Vec::new();
    for context in [mode].into_iter().chain(others).map(Context::In) {
        let rows = TABLE.iter().filter(|row| row.scope.holds(context));
        for row in rows.filter(|row| !matches!(row.action, Action::G | Action::Command)) {
            let is_known =
                |named: &NamedAction| named.action == row.action && named.words == row.words;
            if !found.iter().any(is_known) {
                found.push(NamedAction {
                    action: row.action,
                    context,
                    keys: row.keys(),
                    words: row.words,
                });
            }
        }
    }
    found
}
