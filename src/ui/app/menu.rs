//! A menu of what can be added, or of kinds to change to: typing filters it.

use tui_input::Input;

/// A menu over the list.
#[derive(Debug)]
pub struct Menu {
    /// What choosing an entry does.
    pub purpose: Purpose,
    /// The entries, each with a description.
    entries: Vec<(&'static str, &'static str)>,
    /// Only entries that contain this text are shown.
    pub filter: Input,
    /// The index of the selected entry among those shown.
    pub at: usize,
}

/// What choosing an entry of a menu does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Adds a thing of the kind.
    Add,
    /// Changes the selected thing to the kind.
    Retype,
}

impl Menu {
    pub(super) fn new(
        purpose: Purpose,
        entries: Vec<(&'static str, &'static str)>,
        at: usize,
    ) -> Self {
        Self {
            purpose,
            entries,
            filter: Input::default(),
            at,
        }
    }

    /// The entries that contain the typed text, those that begin with it first.
    pub fn shown(&self) -> Vec<(&'static str, &'static str)> {
        let typed = self.filter.value().trim().to_lowercase();
        let holds = |entry: &&(&str, &str)| entry.0.contains(&typed) || entry.1.contains(&typed);
        let mut shown: Vec<_> = self.entries.iter().filter(holds).copied().collect();
        let rank = |name: &str| match name.find(&typed) {
            Some(0) => 0,
            Some(_) => 1,
            None => 2,
        };
        shown.sort_by_key(|(name, _)| rank(name));
        shown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_menu_shows_what_begins_with_the_typed_text_first() {
        let entries = vec![
            ("box", "six faces"),
            ("sphere", "round"),
            ("ellipsoid", "a sphere"),
        ];
        let mut menu = Menu::new(Purpose::Add, entries, 0);
        assert_eq!(menu.shown().len(), 3);
        menu.filter = Input::from("sph");
        assert!(
            menu.shown()
                .iter()
                .map(|entry| entry.0)
                .eq(["sphere", "ellipsoid"])
        );
        menu.filter = Input::from("cone");
        assert!(menu.shown().is_empty());
    }
}
