//! The keys in use: the table, as changed by the user.

use crossterm::event::{KeyCode, KeyEvent};

use super::action::{Action, Context, Mode};
use super::chord::{Chord, Keys};
use super::section::Section;
use super::table::{Scope, TABLE};

/// The meanings of keys.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keymap {
    /// One for each row of the table, in its order.
    pub(super) rows: Vec<Row>,
}

/// An action with its keys.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Row {
    pub(super) scope: Scope,
    pub(super) action: Action,
    /// Description of the action.
    pub(super) words: &'static str,
    /// Its keys where `own` has no others.
    pub(super) keys: Vec<Keys>,
    /// Contexts in which it has other keys.
    pub(super) own: Vec<(Context, Vec<Keys>)>,
}

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Acts at once.
    Action(Action),
    /// Is the first of two keys.
    Begins,
    /// Nothing.
    None,
}

impl Default for Keymap {
    fn default() -> Self {
        let rows = TABLE.iter().map(|row| Row {
            scope: row.scope,
            action: row.action,
            words: row.words,
            keys: row.keys(),
            own: Vec::new(),
        });
        Self {
            rows: rows.collect(),
        }
    }
}

impl Keymap {
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
                return Meaning::Action(row.action);
            }
        }
        match bound().find(|(_, keys)| keys.first == pressed) {
            Some((row, keys)) if keys.second.is_none() => Meaning::Action(row.action),
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
            mode != context && keys.any(|keys| keys.first == pressed)
        };
        let mode_of = |row: &Row| {
            let mut modes = Mode::ALL.into_iter().map(|mode| (mode, Context::In(mode)));
            modes.find(|&(_, mode)| has(row, mode))
        };
        let mut own = self.rows.iter().filter(|row| !row.is_common());
        let (words, (mode, _)) = own.find_map(|row| Some((row.words, mode_of(row)?)))?;
        Some((mode, self.key(context, Action::Go(mode)), words))
    }

    /// The first key of an action in a context, as the help shows it.
    pub fn key(&self, context: Context, action: Action) -> Option<String> {
        let mut rows = self.rows_in(context).filter(|row| row.action == action);
        rows.find_map(|row| Some(self.keys_of(row, context).next()?.name()))
    }

    /// The keys of a row that act in a context: those of the context itself take precedence over
    /// those that act anywhere.
    pub(super) fn keys_of<'k>(
        &'k self,
        row: &'k Row,
        context: Context,
    ) -> impl Iterator<Item = &'k Keys> {
        let own = self.rows.iter().filter(|other| !other.is_common());
        let taken = own.flat_map(move |other| other.keys_in(context));
        let is_free = move |keys: &&Keys| {
            !row.is_common() || taken.clone().all(|other| !other.collides(**keys))
        };
        row.keys_in(context).iter().filter(is_free)
    }

    /// The two keys of a sequence that has an action anywhere, by its name in the help: `gg`.
    pub fn sequence_named(&self, name: &str) -> Option<[KeyEvent; 2]> {
        let own = |row: &'_ Row| row.own.iter().flat_map(|(_, keys)| keys.clone()).collect();
        let rows = self.rows.iter();
        let mut all = rows.flat_map(|row| [row.keys.clone(), own(row)]).flatten();
        let keys = all.find(|keys| keys.second.is_some() && keys.name() == name)?;
        Some([keys.first, keys.second?].map(Chord::event))
    }

    /// Gives keys an action in a section instead of what they do there; `None` leaves them without
    /// one. They become the first keys of the action. An action that the section does not have is
    /// ignored.
    pub fn bind(&mut self, section: Section, keys: Keys, action: Option<Action>) {
        let is_default = |at: usize| TABLE[at].keys().contains(&keys);
        let candidates = || {
            let rows = self.rows.iter().enumerate();
            rows.filter(|(_, row)| section.has(row.scope) && Some(row.action) == action)
                .map(|(at, _)| at)
        };
        // Several rows may have one action.
        let chosen = candidates().find(|&at| is_default(at));
        let chosen = chosen.or_else(|| candidates().next());
        // What acts anywhere keeps them: the keys of a mode itself take precedence.
        let is_own = chosen.is_some_and(|at| !self.rows[at].is_common());
        for (at, row) in self.rows.iter_mut().enumerate() {
            if section.has(row.scope) && !(is_own && row.is_common()) {
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
        let here = move |row: &&Row| row.scope.holds(context);
        let own = self.rows.iter().filter(|row| !row.is_common());
        let common = self.rows.iter().filter(|row| row.is_common());
        own.chain(common).filter(here)
    }
}

impl Row {
    /// Its keys in a context; none where the action does not exist.
    pub(super) fn keys_in(&self, context: Context) -> &[Keys] {
        let own = self.own.iter().find(|(of, _)| *of == context);
        match own {
            Some((_, keys)) => keys,
            None if self.scope.holds(context) => &self.keys,
            None => &[],
        }
    }

    /// Whether the action exists in all modes.
    pub(super) fn is_common(&self) -> bool {
        !matches!(self.scope, Scope::These(_))
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
mod tests {
    use super::*;
    use crate::ui::keymap::chord::SHIFT;

    const SELECT: Context = Context::In(Mode::Select);

    fn event(name: &str) -> KeyEvent {
        Chord::parse(name).expect("a key").event()
    }

    fn bound(changes: &[(Section, &str, Option<Action>)]) -> Keymap {
        let mut keymap = Keymap::default();
        for &(section, keys, action) in changes {
            keymap.bind(section, Keys::parse(keys).expect("keys"), action);
        }
        keymap
    }

    fn check(keymap: &Keymap, context: Context, key: &str, action: Option<Action>) {
        let meaning = match action {
            Some(action) => Meaning::Action(action),
            None => Meaning::None,
        };
        assert_eq!(keymap.meaning(context, None, event(key)), meaning, "{key}");
    }

    #[test]
    fn shift_is_part_of_a_character() {
        let keymap = Keymap::default();
        for (key, action) in [
            (KeyCode::Char('G'), Action::Last),
            (KeyCode::BackTab, Action::Cycle(-1)),
        ] {
            let found = keymap.meaning(SELECT, None, KeyEvent::new(key, SHIFT));
            assert_eq!(found, Meaning::Action(action));
        }
    }

    #[test]
    fn two_keys_act_together_and_the_second_alone_if_it_does_not_follow() {
        let keymap = Keymap::default();
        let after = |before, key| keymap.meaning(SELECT, Some(event(before)), event(key));
        assert_eq!(keymap.meaning(SELECT, None, event("g")), Meaning::Begins);
        assert_eq!(after("g", "g"), Meaning::Action(Action::First));
        assert_eq!(after("g", "j"), Meaning::Action(Action::Move(1)));
        assert_eq!(after("j", "g"), Meaning::Begins);
    }

    #[test]
    fn a_bound_key_changes_its_section_only() {
        let keymap = bound(&[
            (Section::In(SELECT), "s", Some(Action::Save)),
            (Section::In(SELECT), "D", None),
        ]);
        check(&keymap, SELECT, "s", Some(Action::Save));
        check(&keymap, SELECT, "w", Some(Action::Save));
        check(&keymap, SELECT, "D", None);
        assert_eq!(keymap.key(SELECT, Action::Save).as_deref(), Some("s"));
        let edit = Context::In(Mode::Edit);
        assert_eq!(keymap.key(edit, Action::Save).as_deref(), Some("w"));
        let scale = Action::Transform(crate::ui::keymap::Tool::Scale);
        assert_eq!(keymap.key(SELECT, scale), None);
        check(&keymap, edit, "s", Some(scale));
    }

    #[test]
    fn a_modes_own_key_beats_one_bound_anywhere() {
        let keymap = bound(&[(Section::Anywhere, "d", Some(Action::Undo))]);
        check(&keymap, SELECT, "d", Some(Action::Delete));
        check(&keymap, Context::In(Mode::View), "d", Some(Action::Undo));
    }

    #[test]
    fn a_key_that_a_mode_has_for_itself_is_not_offered_for_what_it_does_anywhere() {
        let keymap = Keymap::default();
        let compare = Context::In(Mode::Compare);
        check(&keymap, compare, "w", Some(Action::Wipe));
        assert_eq!(keymap.key(compare, Action::Save), None);
        let view = Context::In(Mode::View);
        check(&keymap, view, "=", Some(Action::Dolly(1)));
        assert_eq!(keymap.key(view, Action::Go(Mode::Compare)), None);
        let moved = bound(&[(Section::In(compare), "W", Some(Action::Wipe))]);
        assert_eq!(moved.key(compare, Action::Save), None);
        let freed = bound(&[(Section::In(compare), "w", Some(Action::Save))]);
        assert_eq!(freed.key(compare, Action::Save).as_deref(), Some("w"));
    }

    #[test]
    fn a_sequence_and_its_first_key_exclude_each_other() {
        let keymap = bound(&[(Section::In(SELECT), "d d", Some(Action::Delete))]);
        assert_eq!(keymap.meaning(SELECT, None, event("d")), Meaning::Begins);
        let keymap = bound(&[(Section::In(SELECT), "g", Some(Action::Outline))]);
        check(&keymap, SELECT, "g", Some(Action::Outline));
        assert_eq!(keymap.key(SELECT, Action::First).as_deref(), Some("Home"));
    }
}
