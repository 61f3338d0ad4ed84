//! Sections of keys: one for each context, and one for the keys that are the same in all modes.

use super::context::Context;

/// The name of the section of the keys that are the same in all modes.
const ANYWHERE: &str = "anywhere";

/// A section of keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// The keys that act in all modes, unless a mode has another action for them.
    Anywhere,
    /// The keys of one context.
    In(Context),
}

impl Section {
    /// All sections, in the order of a configuration.
    pub fn all() -> impl Iterator<Item = Self> {
        let contexts = Context::all().map(Self::In);
        [Self::Anywhere].into_iter().chain(contexts)
    }

    /// The name of the section, such as `select`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Anywhere => ANYWHERE,
            Self::In(context) => context.section().unwrap_or(ANYWHERE),
        }
    }

    /// The section with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|section| section.name() == name)
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
