//! Rows of keys that do the same in several directions, as one line of help.

use super::bindings::Row;
use super::chord::Keys;
use super::key::Key;

/// What keys next to each other may differ in.
const DIRECTIONS: &[&[&str]] = &[
    &["left", "down", "up", "right"],
    &["in", "out"],
    &["next", "previous"],
    &["nearer", "farther"],
    &["narrow", "widen"],
    &["darker", "brighter"],
    &["smaller", "larger"],
    &["first", "last"],
];

/// The most keys of a row that a short line shows, in characters with the blank between them.
const SHORT: usize = 8;

/// An input and its effect, or a term and what it means.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HelpEntry {
    /// The keys or other input: `j ↓`.
    pub keys: String,
    /// Description of the effect.
    pub words: String,
    /// Everyday words that find it too.
    pub synonyms: String,
}

impl HelpEntry {
    /// An entry that only its own words find.
    pub fn new(keys: &str, words: &str) -> Self {
        Self {
            keys: keys.to_owned(),
            words: words.to_owned(),
            synonyms: String::new(),
        }
    }
}

/// Neighbouring rows whose descriptions differ in a direction.
pub(super) struct Joined {
    /// The description, and the hint of the rows.
    words: String,
    hint: Option<&'static str>,
    /// The directions so far.
    directions: Vec<&'static str>,
    synonyms: Vec<&'static str>,
    /// The keys of each row.
    keys: Vec<Vec<String>>,
}

impl Joined {
    /// One row, with these of its keys.
    pub(super) fn new<'k>(
        key: &Key,
        keys: impl Iterator<Item = &'k Keys>,
        hint: Option<&'static str>,
    ) -> Self {
        Self {
            words: key.words.to_owned(),
            hint,
            directions: direction(key.words).into_iter().collect(),
            synonyms: vec![key.synonyms],
            keys: vec![keys.map(Keys::name).collect()],
        }
    }

    /// Whether another row belongs to the same line.
    pub(super) fn takes(&self, row: &Row, hint: Option<&'static str>) -> bool {
        let words = row.key.words;
        let same_hint = hint.is_some() && hint == self.hint;
        same_hint || words == self.words || self.turned(words).is_some()
    }

    /// Adds another row.
    pub(super) fn add<'k>(&mut self, key: &Key, keys: impl Iterator<Item = &'k Keys>) {
        if let Some(direction) = self.turned(key.words) {
            self.directions.push(direction);
            let all = self.directions.join("/");
            self.words = key.words.replacen(direction, &all, 1);
        } else if key.words != self.words {
            self.words = self.hint.unwrap_or_default().to_owned();
        }
        self.synonyms.push(key.synonyms);
        self.keys.push(keys.map(Keys::name).collect());
    }

    /// The direction of a description that differs in nothing else.
    fn turned(&self, words: &'static str) -> Option<&'static str> {
        let (first, direction) = (self.directions.first()?, direction(words)?);
        let mut alike = DIRECTIONS.iter();
        let alike = alike.find(|alike| alike.contains(first))?;
        let is_new = alike.contains(&direction) && !self.directions.contains(&direction);
        let same = words.replacen(direction, &self.directions.join("/"), 1) == self.words;
        (is_new && same).then_some(direction)
    }

    /// The line with all keys: `h/j/k/l ←/↓/↑/→`.
    pub(super) fn whole(self) -> HelpEntry {
        if let [keys] = self.keys.as_slice() {
            let keys = keys.join(" ");
            return self.with(keys);
        }
        let most = self.keys.iter().map(Vec::len).max().unwrap_or(0);
        let columns = (0..most).map(|at| {
            let keys = self.keys.iter().filter_map(|keys| keys.get(at));
            alternatives(keys.map(String::as_str))
        });
        let columns: Vec<_> = columns.collect();
        self.with(columns.join(" "))
    }

    /// The line with the first keys: `h/j/k/l`.
    pub(super) fn short(self) -> HelpEntry {
        let keys = match self.keys.as_slice() {
            [keys] => {
                let all = keys.join(" ");
                let first = keys.first().cloned().unwrap_or_default();
                Some(all)
                    .filter(|all| all.chars().count() <= SHORT)
                    .unwrap_or(first)
            }
            rows => alternatives(
                rows.iter()
                    .filter_map(|keys| keys.first().map(String::as_str)),
            ),
        };
        self.with(keys)
    }

    fn with(self, keys: String) -> HelpEntry {
        let synonyms: Vec<_> = self
            .synonyms
            .into_iter()
            .filter(|words| !words.is_empty())
            .collect();
        HelpEntry {
            keys,
            words: self.words,
            synonyms: synonyms.join(" "),
        }
    }
}

/// The direction in a description.
fn direction(words: &'static str) -> Option<&'static str> {
    let mut parts = words.split(' ');
    parts.find(|part| DIRECTIONS.iter().any(|alike| alike.contains(part)))
}

/// Keys with bars between them; what all of them hold stands once: `Shift-←/↓/↑/→`.
fn alternatives<'k>(keys: impl Iterator<Item = &'k str>) -> String {
    let keys: Vec<_> = keys.collect();
    let held = |key: &'k str| {
        key.rfind('-')
            .filter(|&at| 0 < at)
            .map_or("", |at| &key[..=at])
    };
    let first = keys.first().map_or("", |key| held(key));
    if first.is_empty() || keys.iter().any(|key| held(key) != first) {
        return keys.join("/");
    }
    let rest: Vec<_> = keys.iter().map(|key| &key[first.len()..]).collect();
    format!("{first}{}", rest.join("/"))
}
