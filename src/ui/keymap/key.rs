//! Keys as data: what each row of keys says of itself to the bindings, the help, the hints, the
//! palette and the configuration.

use super::chord::{Chord, Keys};
use super::context::{Context, Mode};
use super::section::Section;

/// The most hints of a row.
const HINTS: usize = 6;

/// A row of keys: within its scope, each of them does the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// The name by which a configuration refers to what it does; it never changes. Rows of
    /// one name do corresponding things, each in its contexts.
    pub name: &'static str,
    /// Description of what it does.
    pub words: &'static str,
    /// Everyday words that find it too.
    pub(super) synonyms: &'static str,
    pub(super) scope: Scope,
    presses: Presses,
    hints: [Option<Hint>; HINTS],
    /// The hint that is never omitted.
    pub(super) lasting: Option<&'static str>,
}

/// What is pressed for a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Presses {
    /// Any one of these keys.
    AnyOf(&'static [Chord]),
    /// Two keys, one after the other.
    InTurn(Chord, Chord),
}

/// The contexts of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Active only in these contexts.
    These(&'static [Context]),
    /// Active on pages, and in these contexts.
    PagesAnd(&'static [Context]),
    /// All modes but [`Mode::Move`] and [`Mode::Sequence`]; also the list of errors and the rays behind
    /// a pixel.
    Everywhere,
    /// [`Self::Everywhere`], [`Mode::Move`] and [`Mode::Sequence`], and while a scene is being opened.
    Sceneless,
    /// All contexts, including pages and questions.
    Always,
}

/// A hint in the bottom line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Hint {
    /// The contexts of the row that show it; `None`: all.
    within: Option<&'static [Context]>,
    /// Lower ranks stand further left.
    pub(super) rank: u8,
    /// A word or two. Neighbours with the same words are shown as one.
    pub(super) words: &'static str,
    /// Whether it stays where there is no room for all.
    pub(super) stays: bool,
}

impl Hint {
    /// A hint in all contexts of a row.
    pub(super) const fn new(rank: u8, words: &'static str) -> Self {
        Self {
            within: None,
            rank,
            words,
            stays: false,
        }
    }
}

impl Scope {
    /// Whether a row of this scope is active in a context.
    pub(super) fn holds(self, context: Context) -> bool {
        match self {
            Self::These(contexts) => contexts.contains(&context),
            Self::PagesAnd(others) => {
                Context::PAGES.contains(&context) || others.contains(&context)
            }
            // While something is being transformed or a frame is shown, nothing else may change the
            // text.
            Self::Everywhere => {
                matches!(context, Context::In(mode) if !matches!(mode, Mode::Move | Mode::Sequence))
                    || matches!(context, Context::Errors | Context::Rays)
            }
            Self::Sceneless => {
                let others = [Context::Opening, Context::Errors, Context::Rays];
                matches!(context, Context::In(_)) || others.contains(&context)
            }
            Self::Always => true,
        }
    }
}

impl Key {
    /// A row of keys that do the same.
    pub const fn new(
        scope: Scope,
        name: &'static str,
        chords: &'static [Chord],
        words: &'static str,
    ) -> Self {
        Self {
            name,
            words,
            synonyms: "",
            scope,
            presses: Presses::AnyOf(chords),
            hints: [None; HINTS],
            lasting: None,
        }
    }

    /// A row of two keys that are pressed one after the other.
    pub const fn in_turn(
        scope: Scope,
        name: &'static str,
        [first, second]: [Chord; 2],
        words: &'static str,
    ) -> Self {
        Self {
            presses: Presses::InTurn(first, second),
            ..Self::new(scope, name, &[], words)
        }
    }

    /// Hints at it in all its contexts.
    #[must_use]
    pub const fn hint(self, rank: u8, words: &'static str) -> Self {
        self.with(Hint::new(rank, words))
    }

    /// Hints at it in these contexts. A row has at most six hints.
    #[must_use]
    pub const fn hint_in(self, within: &'static [Context], rank: u8, words: &'static str) -> Self {
        self.with(Hint {
            within: Some(within),
            ..Hint::new(rank, words)
        })
    }

    const fn with(mut self, hint: Hint) -> Self {
        let mut at = 0;
        while self.hints[at].is_some() {
            at += 1;
        }
        self.hints[at] = Some(hint);
        self
    }

    /// Keeps its last hint where others have no room.
    #[must_use]
    pub const fn stays(mut self) -> Self {
        let mut at = HINTS;
        while 0 < at {
            at -= 1;
            if let Some(mut hint) = self.hints[at] {
                hint.stays = true;
                self.hints[at] = Some(hint);
                break;
            }
        }
        self
    }

    /// Lets these everyday words find it too.
    #[must_use]
    pub const fn also(mut self, synonyms: &'static str) -> Self {
        self.synonyms = synonyms;
        self
    }

    /// Hints at it everywhere, even where there is no room for other hints.
    #[must_use]
    pub const fn lasting(mut self, words: &'static str) -> Self {
        self.lasting = Some(words);
        self
    }

    /// Whether it belongs to a section.
    pub fn is_in(&self, section: Section) -> bool {
        match section {
            Section::Anywhere => self.is_common(),
            Section::In(context) => self.scope.holds(context),
        }
    }

    /// The keys, unless the user changes them.
    pub fn keys(&self) -> Vec<Keys> {
        match self.presses {
            Presses::AnyOf(chords) => chords.iter().copied().map(Keys::one).collect(),
            Presses::InTurn(first, second) => vec![Keys::in_turn(first, second)],
        }
    }

    /// Whether it is active in all modes.
    pub fn is_common(&self) -> bool {
        !matches!(self.scope, Scope::These(_) | Scope::PagesAnd(_))
    }

    /// Whether it is active in only one context.
    pub(super) fn is_alone(&self) -> bool {
        matches!(self.scope, Scope::These([_]))
    }

    /// Its hint in a context.
    pub(super) fn hint_of(&self, context: Context) -> Option<Hint> {
        let mut hints = self.hints.iter().flatten().copied();
        hints.find(|hint| hint.within.is_none_or(|within| within.contains(&context)))
    }
}
