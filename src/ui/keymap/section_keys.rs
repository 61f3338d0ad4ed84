//! The keys of each section, with the names and descriptions of what they do.

use super::bindings::{Keymap, Row};
use super::chord::Keys;
use super::section::Section;

/// Keys, and what they do in a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bound {
    /// The keys.
    pub keys: Keys,
    /// Their action; `None` if the user has taken away what they did.
    pub action: Option<NamedHere>,
    /// Whether the user has changed nothing about the keys of the action.
    pub is_default: bool,
}

/// An action of a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NamedHere {
    /// Its name, such as `redo`.
    pub name: &'static str,
    /// Its description.
    pub words: &'static str,
}

impl Keymap {
    /// The keys of a section, in the order of the help. Those of [`Section::Anywhere`] are listed in
    /// other sections only where they differ there.
    pub fn bound_in(&self, section: Section) -> Vec<Bound> {
        let rows = self.rows.iter().filter(|row| section.lists(row));
        let mut bound: Vec<Bound> = Vec::new();
        let mut defaults = Vec::new();
        for row in rows {
            let default = match section {
                Section::In(_) if row.key.is_common() => row.keys.clone(),
                _ => row.key.keys(),
            };
            let keys = row.keys_of(section).to_vec();
            let is_default = keys == default;
            bound.extend(keys.into_iter().map(|keys| Bound {
                keys,
                action: Some(named(row)),
                is_default,
            }));
            defaults.extend(default);
        }
        let is_free = |keys: &Keys| bound.iter().all(|bound| !bound.keys.collides(*keys));
        defaults.retain(is_free);
        bound.extend(defaults.into_iter().map(|keys| Bound {
            keys,
            action: None,
            is_default: false,
        }));
        bound
    }

    /// The actions that keys of a section can have.
    pub fn actions_in(&self, section: Section) -> Vec<NamedHere> {
        let rows = self.rows.iter().filter(|row| row.key.is_in(section));
        let mut found: Vec<NamedHere> = Vec::new();
        for row in rows {
            if found.iter().all(|other| other.name != row.key.name) {
                found.push(named(row));
            }
        }
        found
    }
}

impl Section {
    /// Whether the keys of a row are listed in the section.
    pub(super) fn lists(self, row: &Row) -> bool {
        match self {
            Self::In(context) if row.key.is_common() => {
                row.own.iter().any(|(of, _)| *of == context)
            }
            _ => row.key.is_in(self),
        }
    }
}

fn named(row: &Row) -> NamedHere {
    NamedHere {
        name: row.key.name,
        words: row.key.words,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keymap::bound;

    #[test]
    fn changes_made_again_give_the_same_keys() {
        let changes = "anywhere Ctrl-S=save, anywhere u=, select s=save, select Ctrl-R=, \
            select d d=delete, quit y=";
        let changes: Vec<_> = changes.split(", ").collect();
        for count in 0..=changes.len() {
            let keymap = bound(&changes[..count].join(", "));
            let mut again = Keymap::default();
            for section in Section::all() {
                let bound = keymap.bound_in(section).into_iter().rev();
                for bound in bound.filter(|bound| !bound.is_default) {
                    again.bind(section, bound.keys, bound.action.map(|named| named.name));
                }
            }
            assert_eq!(again, keymap, "{count} changes");
        }
    }
}
