//! Sections of keys: one for each context, and one for the keys that are the same in all modes.

use super::action::{Context, Mode};
use super::names::{ANYWHERE, of_context};
use super::table::Scope;

/// A section of keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// The keys that act in all modes, unless a mode has another action for them.
    Anywhere,
    /// The keys of one context.
    In(Context),
}

/// Contexts other than modes, by their headings in the help.
pub(super) const DIALOGS: [(&str, Context); 17] = [
    ("the colour picker", Context::Colour),
    ("the rays behind a pixel", Context::Rays),
    ("while a region is drawn", Context::Region),
    ("the list of errors", Context::Errors),
    ("the list of saved views", Context::Views),
    ("the list of recent scenes", Context::Recent),
    ("the undo history", Context::Steps),
    ("the messages so far", Context::Messages),
    ("this page", Context::Help),
    ("merge conflicts", Context::Conflict),
    ("when asked to confirm quitting", Context::Quit),
    ("when asked to confirm deleting", Context::Delete),
    ("when asked to confirm leaving the scene", Context::Leave),
    ("when asked to leave a moved view", Context::MovedView),
    ("when asked to quit during an export", Context::Wait),
    ("when asked to overwrite a picture", Context::Overwrite),
    ("when unsaved edits were found", Context::Recover),
];

impl Section {
    /// All sections, in the order of a configuration.
    pub fn all() -> impl Iterator<Item = Self> {
        let modes = Mode::ALL.into_iter().map(Context::In);
        let contexts = modes.chain(DIALOGS.map(|(_, context)| context));
        [Self::Anywhere].into_iter().chain(contexts.map(Self::In))
    }

    /// The name of the section, such as `select`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Anywhere => ANYWHERE,
            Self::In(context) => of_context(context).unwrap_or(ANYWHERE),
        }
    }

    /// The section with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|section| section.name() == name)
    }

    /// Whether a binding of this scope belongs to the section.
    pub(super) fn has(self, scope: Scope) -> bool {
        match self {
            Self::Anywhere => !matches!(scope, Scope::These(_)),
            Self::In(context) => scope.holds(context),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_found_by_their_names() {
        for section in Section::all() {
            assert_eq!(Section::named(section.name()), Some(section));
        }
        assert_eq!(Section::named("opening"), None);
    }
}
