//! The key bindings as text: the help page and the line of hints.

use super::bindings::{Keymap, RowId};
use super::chord::Keys;
use super::context::{Context, Mode};
use super::joined::{HelpEntry, Joined};
use super::key::Hint;
use super::section::Section;
use super::typed_line::{Line, line_hints};

/// The rank of keys without a hint, where all are shown.
const UNHINTED: u8 = 50;

/// The rank of keys whose hints are never omitted, among those of a mode.
const LASTING: u8 = 200;

/// A part of the help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topic {
    /// What it is about: `SELECT`, `anywhere`.
    pub heading: &'static str,
    /// Its lines, the most useful first.
    pub entries: Vec<HelpEntry>,
}

/// Command line arguments.
const START: [(&str, &str); 2] = [
    ("--color 24", "use 24-bit colour even if not detected"),
    ("halflight doctor", "what was detected, and why"),
];

const MOUSE: [(&str, &str); 15] = [
    ("click the list", "select"),
    ("click a field", "move the cursor there"),
    ("click it again", "choose or type a value"),
    ("drag a slider", "set a number from 0 to 1"),
    ("click a menu", "move there; again: choose"),
    ("click the picture", "select the object or symbol there"),
    ("drag it in VIEW", "orbit"),
    ("drag it with Ctrl or right", "in VIEW, pan"),
    ("drag it in MOVE", "move, rotate or scale"),
    ("drag it in COMPARE", "move the wipe line"),
    ("drag it in TRACE", "pan, or draw the region"),
    ("drag a border", "resize the panels"),
    ("wheel", "scroll; in VIEW, dolly; in TRACE, zoom"),
    ("Ctrl and wheel", "zoom the preview"),
    ("drag with another button", "pan the zoomed preview"),
];

/// An input and its description.
pub type Entry = (String, &'static str);

/// A hint for keys that would do something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RankedHint {
    /// The keys and their effect.
    pub entry: Entry,
    /// Whether it stays where there is no room for all.
    pub stays: bool,
}

impl Keymap {
    /// The keys that a mode has, in order of use: those with hints, then its own, then those that others
    /// have too. Of each row the first key, and one line for keys that differ in their direction.
    pub fn card(&self, mode: Mode) -> Vec<HelpEntry> {
        let here = Context::In(mode);
        let acting = self.rows_in(here).filter_map(|row| {
            let keys: Vec<_> = self.keys_of(row, here).take(2).collect();
            let hint = row.key.hint_of(here);
            (!keys.is_empty()).then_some((row, hint, keys))
        });
        let mut acting: Vec<_> = acting.collect();
        acting.sort_by_key(|(row, hint, _)| match hint {
            Some(hint) => (hint.rank, false),
            None if row.key.lasting.is_some() => (LASTING, false),
            None => (u8::MAX, !row.key.is_alone()),
        });
        let mut joined: Vec<Joined> = Vec::new();
        for (row, hint, keys) in acting {
            let hint = hint.map(|hint| hint.words);
            if let Some(last) = joined.last_mut()
                && last.takes(row, hint)
            {
                last.add(&row.key, keys.into_iter().take(1));
            } else {
                joined.push(Joined::new(&row.key, keys.into_iter(), hint));
            }
        }
        joined.into_iter().map(Joined::short).collect()
    }

    /// Everything that keys and typed lines do, by what has them; what `mode` has comes first, and what
    /// several have is listed once.
    pub fn topics(&self, mode: Mode) -> Vec<Topic> {
        let here = Context::In(mode);
        let mut topics = Vec::new();
        let mut listed = Vec::new();
        let others = Context::all().filter(|context| *context != here);
        let sections = [Section::In(here), Section::Anywhere].into_iter();
        for section in sections.chain(others.map(Section::In)) {
            let heading = match section {
                Section::In(context) => context.heading(),
                Section::Anywhere => "anywhere",
            };
            let entries = self.entries(section, &mut listed);
            topics.push(Topic { heading, entries });
        }
        let owned = |(keys, words): &(&str, &str)| HelpEntry::new(keys, words);
        for (heading, line) in [
            ("while a value is typed", Line::Value),
            ("in a menu, where typing filters", Line::Menu),
            ("after :", Line::Command),
            ("while the list is filtered", Line::List),
            ("after /", Line::Search),
        ] {
            let entries = line_hints(line).iter().map(owned).collect();
            topics.push(Topic { heading, entries });
        }
        for (heading, lines) in [("mouse", &MOUSE[..]), ("command line", &START)] {
            let entries = lines.iter().map(owned).collect();
            topics.push(Topic { heading, entries });
        }
        topics.retain(|topic| !topic.entries.is_empty());
        topics
    }

    /// Returns the hints that are never omitted in a context: how to get help, to give a command,
    /// and to quit.
    pub fn lasting_hints(&self, context: Context) -> Vec<Entry> {
        let hints = self.rows.iter().filter_map(|row| {
            let words = row.key.lasting?;
            Some((self.key(context, row.key.name)?, words))
        });
        hints.collect()
    }

    /// Returns the hints for a context in the words that they always have.
    #[cfg(test)]
    pub fn hints(&self, context: Context, acts: impl Fn(RowId) -> bool) -> Vec<RankedHint> {
        self.worded_hints(context, acts, |_| None)
    }

    /// Returns the hints for a context, the most useful first, of keys that would do something; `words`
    /// gives those that depend on what is true now. Without hints of their own, questions and pages show all
    /// of their keys.
    pub fn worded_hints(
        &self,
        context: Context,
        acts: impl Fn(RowId) -> bool,
        words: impl Fn(RowId) -> Option<&'static str>,
    ) -> Vec<RankedHint> {
        let here = self.rows.iter().filter(|row| row.key.scope.holds(context));
        let mut own = here.clone().filter(|row| row.key.is_alone());
        let is_terse = own.any(|row| row.key.hint_of(context).is_some());
        let hints = here.filter(|row| acts(row.id)).filter_map(|row| {
            let all =
                || (!is_terse && row.key.is_alone()).then(|| Hint::new(UNHINTED, row.key.words));
            let mut hint = row.key.hint_of(context).or_else(all)?;
            hint.words = words(row.id).unwrap_or(hint.words);
            Some((hint, self.key(context, row.key.name)?))
        });
        let mut hints: Vec<_> = hints.collect();
        hints.sort_by_key(|(hint, _)| hint.rank);
        let mut entries: Vec<RankedHint> = Vec::new();
        for (Hint { words, stays, .. }, key) in hints {
            match entries.last_mut() {
                Some(last) if last.entry.1 == words => {
                    last.entry.0 = format!("{}/{key}", last.entry.0);
                }
                _ => entries.push(RankedHint {
                    entry: (key, words),
                    stays,
                }),
            }
        }
        entries
    }

    /// The rows of a section that have keys and are not listed with the same ones elsewhere.
    fn entries(&self, section: Section, listed: &mut Vec<(RowId, Vec<Keys>)>) -> Vec<HelpEntry> {
        let mut joined: Vec<Joined> = Vec::new();
        for row in self.rows.iter().filter(|row| section.lists(row)) {
            let keys = row.keys_of(section);
            let known = (row.id, keys.to_vec());
            if keys.is_empty() || listed.contains(&known) {
                continue;
            }
            listed.push(known);
            match joined.last_mut() {
                Some(last) if last.takes(row, None) => last.add(&row.key, keys.iter()),
                _ => joined.push(Joined::new(&row.key, keys.iter(), None)),
            }
        }
        joined.into_iter().map(Joined::whole).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_keys_of_the_mode_come_first_and_no_key_is_missing() {
        let topics = Keymap::default().topics(Mode::View);
        let headings: Vec<_> = topics.iter().map(|topic| topic.heading).collect();
        assert_eq!(headings[..3], ["VIEW", "anywhere", "SELECT"]);
        let entries = topics.iter().flat_map(|topic| &topic.entries);
        let shown: Vec<_> = entries.flat_map(|entry| each(&entry.keys)).collect();
        for row in Keymap::default().rows {
            for keys in &row.keys {
                assert!(shown.contains(&keys.name()), "{row:?}");
            }
        }
    }

    /// The single keys of `h/j Shift-←/↓`.
    fn each(keys: &str) -> Vec<String> {
        let one = |keys: &str| -> Vec<String> {
            let held = keys.rfind('-').filter(|&at| 0 < at).map_or(0, |at| at + 1);
            let (held, rest) = if keys.contains("-/") || keys.ends_with('/') {
                ("", keys)
            } else {
                keys.split_at(held)
            };
            let mut all: Vec<_> = rest.split('/').map(|key| format!("{held}{key}")).collect();
            all.push(keys.to_owned());
            all
        };
        keys.split(' ').flat_map(one).collect()
    }

    #[test]
    fn what_several_modes_have_is_listed_once() {
        for mode in Mode::ALL {
            let topics = Keymap::default().topics(mode);
            let entries = topics.iter().flat_map(|topic| &topic.entries);
            let found = entries.filter(|entry| entry.words == "show a wireframe, for slow links");
            assert_eq!(found.count(), 1, "{mode:?}");
        }
    }

    #[test]
    fn the_card_of_a_mode_begins_with_what_is_hinted() {
        for (mode, first) in [
            (Mode::Select, ["j/k", "Enter e", "a"]),
            (Mode::View, ["h/j/k/l", "+/-", "f"]),
            (Mode::Trace, ["+/-", "h/j/k/l", "z"]),
            (Mode::Move, ["h/j/k/l", "x/y/z", "Enter"]),
        ] {
            let card = Keymap::default().card(mode);
            let keys: Vec<_> = card.iter().map(|entry| entry.keys.as_str()).collect();
            assert_eq!(keys[..3], first, "{mode:?}");
            let words: Vec<_> = card.iter().map(|entry| entry.words.as_str()).collect();
            for (at, word) in words.iter().enumerate() {
                assert!(!words[..at].contains(word), "{mode:?} {word}");
            }
        }
    }

    #[test]
    fn every_hint_has_a_key() {
        for context in Context::all() {
            for hint in Keymap::default().hints(context, |_| true) {
                let (keys, words) = hint.entry;
                let whole = keys.split('/').all(|key| !key.is_empty());
                assert!(keys == "/" || whole, "{context:?} {words}");
            }
        }
        let hints = Keymap::default().hints(Context::In(Mode::View), |_| true);
        assert_eq!(hints[0].entry, ("h/j/k/l".to_owned(), "orbit"));
    }

    #[test]
    fn a_question_shows_only_its_answers() {
        let keymap = Keymap::default();
        let is_answer = |id: RowId| keymap.rows[id.0].key.name != "write-view";
        let hints = keymap.hints(Context::Quit, is_answer);
        let keys: Vec<_> = hints.into_iter().map(|hint| hint.entry.0).collect();
        assert_eq!(keys, ["y", "w", "n"]);
    }
}
