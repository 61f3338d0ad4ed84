//! The keys in use: the rows, as changed by the user.

use crossterm::event::{KeyCode, KeyEvent};

use super::chord::{Chord, Keys};
use super::context::{Context, Mode};
use super::key::{Key, Scope};
use super::section::Section;

/// The meanings of keys.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keymap {
    pub(super) rows: Vec<Row>,
}

/// The place of a row among those that a keymap was made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowId(pub usize);

/// A row of keys, as changed by the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Row {
    pub(super) key: Key,
    pub(super) id: RowId,
    /// Its keys where `own` has no others.
    pub(super) keys: Vec<Keys>,
    /// Contexts in which it has other keys.
    pub(super) own: Vec<(Context, Vec<Keys>)>,
}

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Does at once what its row does.
    Does(RowId),
    /// Is the first of two keys.
    Begins,
    /// Nothing.
    None,
}

impl Keymap {
    /// The keys of these rows, the most useful first.
    pub fn new(keys: impl Iterator<Item = Key>) -> Self {
        let rows = keys.enumerate().map(|(at, key)| Row {
            key,
            id: RowId(at),
            keys: key.keys(),
            own: Vec::new(),
        });
        Self {
            rows: rows.collect(),
        }
    }

    /// The meaning of a key in a context, after another one that began a sequence, if any.
    pub fn meaning(&self, context: Context, before: Option<KeyEvent>, key: KeyEvent) -> Meaning {
        let pressed = Chord::of(key);
        let bound = || {
            let rows = self.rows_in(context);
            rows.flat_map(|row| row.keys_in(context).iter().map(move |keys| (row, keys)))
        };
        if let Some(before) = before {
            let wanted = Keys::in_turn(Chord::of(before), pressed);
            if let Some((row, _)) = bound().find(|(_, keys)| **keys == wanted) {
                return Meaning::Does(row.id);
            }
        }
        match bound().find(|(_, keys)| keys.first == pressed) {
            Some((row, keys)) if keys.second.is_none() => Meaning::Does(row.id),
            Some(_) => Meaning::Begins,
            None => Meaning::None,
        }
    }

    /// The first mode other than that of `context` in which a key acts, the key of `context` that
    /// leads there, and the description of the action.
    pub fn elsewhere(
        &self,
        context: Context,
        key: KeyEvent,
    ) -> Option<(Mode, Option<String>, &'static str)> {
        let pressed = Chord::of(key);
        let has = |row: &Row, mode| {
            let mut keys = row.keys_in(mode).iter();
            mode != context && keys.any(|keys| *keys == Keys::one(pressed))
        };
        let mode_of = |row: &Row| {
            let mut modes = Mode::ALL.into_iter().map(|mode| (mode, Context::In(mode)));
            modes.find(|&(_, mode)| has(row, mode))
        };
        let mut own = self.rows.iter().filter(|row| !row.key.is_common());
        let (words, (mode, _)) = own.find_map(|row| Some((row.key.words, mode_of(row)?)))?;
        let entry = mode.entry().and_then(|name| self.key(context, name));
        Some((mode, entry, words))
    }

    /// The first key in a context of the rows with this name, as the help shows it.
    pub fn key(&self, context: Context, name: &str) -> Option<String> {
        debug_assert!(self.rows.iter().any(|row| row.key.name == name), "{name}");
        let mut rows = self.rows_in(context).filter(|row| row.key.name == name);
        rows.find_map(|row| Some(self.keys_of(row, context).next()?.name()))
    }

    /// The first row in a context with this name.
    pub fn row(&self, context: Context, name: &str) -> Option<RowId> {
        let mut rows = self.rows_in(context);
        rows.find(|row| row.key.name == name).map(|row| row.id)
    }

    /// The name of what a row does.
    pub fn name_of(&self, id: RowId) -> &'static str {
        self.rows[id.0].key.name
    }

    /// Whether a row is active in all contexts, and does the same in each.
    pub fn is_reserved(&self, id: RowId) -> bool {
        self.rows[id.0].key.scope == Scope::Always
    }

    /// The keys of a row that act in a context: those of the context itself take precedence over
    /// those that act anywhere.
    pub(super) fn keys_of<'k>(
        &'k self,
        row: &'k Row,
        context: Context,
    ) -> impl Iterator<Item = &'k Keys> {
        let own = self.rows.iter().filter(|other| !other.key.is_common());
        let taken = own.flat_map(move |other| other.keys_in(context));
        let is_free = move |keys: &&Keys| {
            !row.key.is_common() || taken.clone().all(|other| !other.collides(**keys))
        };
        row.keys_in(context).iter().filter(is_free)
    }

    /// The two keys of a sequence that has a meaning anywhere, by its name in the help: `gg`.
    pub fn sequence_named(&self, name: &str) -> Option<[KeyEvent; 2]> {
        let own = |row: &'_ Row| row.own.iter().flat_map(|(_, keys)| keys.clone()).collect();
        let rows = self.rows.iter();
        let mut all = rows.flat_map(|row| [row.keys.clone(), own(row)]).flatten();
        let keys = all.find(|keys| keys.second.is_some() && keys.name() == name)?;
        Some([keys.first, keys.second?].map(Chord::event))
    }

    /// Makes keys do in a section what rows with this name do, instead of what they do there; `None`
    /// leaves them without a meaning. They become its first keys. A name that the section does not
    /// have is ignored.
    pub fn bind(&mut self, section: Section, keys: Keys, name: Option<&str>) {
        let is_default = |at: usize| self.rows[at].key.keys().contains(&keys);
        let candidates = || {
            let rows = self.rows.iter().enumerate();
            rows.filter(|(_, row)| row.key.is_in(section) && Some(row.key.name) == name)
                .map(|(at, _)| at)
        };
        // Several rows may have one name.
        let chosen = candidates().find(|&at| is_default(at));
        let chosen = chosen.or_else(|| candidates().next());
        // What acts anywhere keeps them: the keys of a mode itself take precedence.
        let is_own = chosen.is_some_and(|at| !self.rows[at].key.is_common());
        for (at, row) in self.rows.iter_mut().enumerate() {
            if row.key.is_in(section) && !(is_own && row.key.is_common()) {
                row.change(section, |bound| {
                    bound.retain(|other| !other.collides(keys));
                    if chosen == Some(at) {
                        bound.insert(0, keys);
                    }
                });
            }
        }
    }

    /// The rows of a context, those that are not the same everywhere first.
    pub(super) fn rows_in(&self, context: Context) -> impl Iterator<Item = &Row> {
        let here = move |row: &&Row| row.key.scope.holds(context);
        let own = self.rows.iter().filter(|row| !row.key.is_common());
        let common = self.rows.iter().filter(|row| row.key.is_common());
        own.chain(common).filter(here)
    }
}

impl Row {
    /// Its keys in a context; none where it does not act.
    pub(super) fn keys_in(&self, context: Context) -> &[Keys] {
        let own = self.own.iter().find(|(of, _)| *of == context);
        match own {
            Some((_, keys)) => keys,
            None if self.key.scope.holds(context) => &self.keys,
            None => &[],
        }
    }

    /// Its keys in a section.
    pub(super) fn keys_of(&self, section: Section) -> &[Keys] {
        match section {
            Section::Anywhere => &self.keys,
            Section::In(context) => self.keys_in(context),
        }
    }

    /// Changes its keys in a section.
    fn change(&mut self, section: Section, change: impl FnOnce(&mut Vec<Keys>)) {
        let Section::In(context) = section else {
            change(&mut self.keys);
            return;
        };
        let mut keys = self.keys_in(context).to_vec();
        change(&mut keys);
        self.own.retain(|(of, _)| *of != context);
        if keys != self.keys {
            self.own.push((context, keys));
        }
    }
}

/// The names of keys, as the help shows them: `j ↓`.
pub(super) fn names<'k>(keys: impl IntoIterator<Item = &'k Keys>) -> String {
    let names: Vec<_> = keys.into_iter().map(Keys::name).collect();
    names.join(" ")
}

/// The name of a key, as in the help; `None` for keys that cannot be bound.
pub fn name(event: KeyEvent) -> Option<String> {
    let is_key = !matches!(
        event.code,
        KeyCode::Null
            | KeyCode::Modifier(_)
            | KeyCode::Media(_)
            | KeyCode::CapsLock
            | KeyCode::NumLock
            | KeyCode::ScrollLock
    );
    is_key.then(|| Chord::of(event).name())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crossterm::event::KeyModifiers;

    const SELECT: Context = Context::In(Mode::Select);
    const EDIT: Context = Context::In(Mode::Edit);
    const VIEW: Context = Context::In(Mode::View);
    const COMPARE: Context = Context::In(Mode::Compare);

    fn event(name: &str) -> KeyEvent {
        Chord::parse(name).expect("a key").event()
    }

    /// The default keys with changes such as `select s=save, select D=`.
    pub(crate) fn bound(changes: &str) -> Keymap {
        let mut keymap = Keymap::default();
        for change in changes.split_terminator(", ") {
            let (section, binding) = change.split_once(' ').expect("a section");
            let (keys, action) = binding.split_once('=').expect("keys");
            let action = Some(action).filter(|action| !action.is_empty());
            let section = Section::named(section).expect("a section");
            keymap.bind(section, Keys::parse(keys).expect("keys"), action);
        }
        keymap
    }

    /// The name of what keys do.
    fn does(keymap: &Keymap, meaning: Meaning) -> Option<&'static str> {
        match meaning {
            Meaning::Does(id) => Some(keymap.rows[id.0].key.name),
            Meaning::Begins | Meaning::None => None,
        }
    }

    #[test]
    fn shift_is_part_of_a_character() {
        let keymap = Keymap::default();
        for (key, action) in [
            (KeyCode::Char('G'), "last"),
            (KeyCode::BackTab, "previous-item"),
        ] {
            let found = keymap.meaning(SELECT, None, KeyEvent::new(key, KeyModifiers::SHIFT));
            assert_eq!(does(&keymap, found), Some(action));
        }
    }

    #[test]
    fn two_keys_act_together_and_the_second_alone_if_it_does_not_follow() {
        let keymap = Keymap::default();
        let after = |before, key| keymap.meaning(SELECT, Some(event(before)), event(key));
        assert_eq!(keymap.meaning(SELECT, None, event("g")), Meaning::Begins);
        assert_eq!(does(&keymap, after("g", "g")), Some("first"));
        assert_eq!(does(&keymap, after("g", "j")), Some("down"));
        assert_eq!(after("j", "g"), Meaning::Begins);
    }

    #[test]
    fn a_bound_key_changes_its_section_only() {
        for (changes, context, key, action) in table! {
            "select s=save, select D=", SELECT, "s" => Some("save");
            "select s=save, select D=", SELECT, "w" => Some("save");
            "select s=save, select D=", SELECT, "D" => None;
            "select s=save, select D=", EDIT, "s" => Some("scale");
            // A mode's own key beats one bound anywhere.
            "anywhere d=undo", SELECT, "d" => Some("delete");
            "anywhere d=undo", VIEW, "d" => Some("undo");
            "", COMPARE, "w" => Some("wipe");
            "", VIEW, "=" => Some("nearer");
            // The first key of a sequence excludes it.
            "select g=outline", SELECT, "g" => Some("outline");
        } {
            let keymap = bound(changes);
            let found = keymap.meaning(context, None, event(key));
            assert_eq!(does(&keymap, found), action, "{key} of {changes}");
        }
        let meaning = bound("select d d=delete").meaning(SELECT, None, event("d"));
        assert_eq!(meaning, Meaning::Begins);
    }

    #[test]
    fn only_a_key_that_acts_is_offered() {
        for (changes, context, action, key) in table! {
            "select s=save", SELECT, "save" => Some("s");
            "select s=save", EDIT, "save" => Some("w");
            "select s=save", SELECT, "scale" => None;
            // The mode has the key for itself.
            "", COMPARE, "save" => None;
            "", VIEW, "compare" => None;
            "compare W=wipe", COMPARE, "save" => None;
            "compare w=save", COMPARE, "save" => Some("w");
            // The sequence is excluded by its first key.
            "select g=outline", SELECT, "first" => Some("Home");
        } {
            let found = bound(changes).key(context, action);
            assert_eq!(found.as_deref(), key, "{action} of {changes}");
        }
    }
}
