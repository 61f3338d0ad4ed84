//! Keys and their names.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use KeyCode::{BackTab, Char, Down, Left, Right, Up};

/// A key with its modifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chord(pub(super) KeyCode, pub(super) KeyModifiers);

/// A key, or two keys pressed one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keys {
    pub(super) first: Chord,
    pub(super) second: Option<Chord>,
}

impl Keys {
    pub(super) const fn one(first: Chord) -> Self {
        Self {
            first,
            second: None,
        }
    }

    pub(super) const fn in_turn(first: Chord, second: Chord) -> Self {
        Self {
            first,
            second: Some(second),
        }
    }

    /// The keys with these names, separated by a blank: `Ctrl-R`, `g g`.
    pub fn parse(names: &str) -> Option<Self> {
        let mut names = names.split(' ').filter(|name| !name.is_empty());
        let first = Chord::parse(names.next()?)?;
        let second = match names.next() {
            Some(name) => Some(Chord::parse(name)?),
            None => None,
        };
        let rest = names.next();
        rest.is_none().then_some(Self { first, second })
    }

    /// The names of the keys, as they are parsed.
    pub fn spelling(&self) -> String {
        match self.second {
            Some(second) => format!("{} {}", self.first.name(), second.name()),
            None => self.first.name(),
        }
    }

    /// The keys as the help shows them: two characters need no blank.
    pub(super) fn name(&self) -> String {
        match (self.first, self.second) {
            (Chord(Char(first), NONE), Some(Chord(Char(second), NONE)))
                if ![first, second].contains(&' ') =>
            {
                format!("{first}{second}")
            }
            _ => self.spelling(),
        }
    }

    /// Whether both cannot have a meaning in the same place.
    pub fn collides(self, other: Self) -> bool {
        self.first == other.first
            && (self.second.is_none() || other.second.is_none() || self.second == other.second)
    }
}

pub(super) const NONE: KeyModifiers = KeyModifiers::NONE;
const SHIFT: KeyModifiers = KeyModifiers::SHIFT;
const ALT: KeyModifiers = KeyModifiers::ALT;
pub(super) const CTRL: KeyModifiers = KeyModifiers::CONTROL;

/// A character key. The character already includes Shift.
pub const fn c(character: char) -> Chord {
    Chord(Char(character), NONE)
}

/// A character key with Ctrl.
pub const fn ctrl(character: char) -> Chord {
    Chord(Char(character), CTRL)
}

/// A key with Alt.
pub const fn alt(code: KeyCode) -> Chord {
    Chord(code, ALT)
}

/// A key that is no character, with Shift.
pub const fn shift(code: KeyCode) -> Chord {
    Chord(code, SHIFT)
}

/// A key without modifiers.
pub const fn key(code: KeyCode) -> Chord {
    Chord(code, NONE)
}

impl Chord {
    /// The chord of a key event; Shift is dropped from characters.
    pub(super) fn of(event: KeyEvent) -> Self {
        let held = event.modifiers & (SHIFT | ALT | CTRL);
        match event.code {
            Char(_) => Self(event.code, held - SHIFT),
            BackTab => Self(BackTab, held - SHIFT),
            code => Self(code, held),
        }
    }

    /// The display name of the key.
    pub(super) fn name(&self) -> String {
        let Self(code, held) = *self;
        let mut name = String::new();
        for (modifier, prefix) in [(CTRL, "Ctrl-"), (ALT, "Alt-"), (SHIFT, "Shift-")] {
            if held.contains(modifier) {
                name.push_str(prefix);
            }
        }
        match code {
            Char(character) if held.contains(CTRL) && character != ' ' => {
                name.extend(character.to_uppercase());
            }
            code => match (NAMES.iter().find(|(named, _)| *named == code), code) {
                (Some((_, known)), _) => name.push_str(known),
                (None, Char(character)) => name.push(character),
                (None, other) => name.push_str(&other.to_string()),
            },
        }
        name
    }

    /// The chord with this name, in any case except for characters; arrows may also be spelled out.
    pub(super) fn parse(name: &str) -> Option<Self> {
        let mut held = NONE;
        let mut rest = name;
        let mut left = vec![(CTRL, "ctrl-"), (ALT, "alt-"), (SHIFT, "shift-")];
        while let Some(at) = left
            .iter()
            .position(|(_, prefix)| starts_with(rest, prefix))
        {
            let (modifier, prefix) = left.remove(at);
            held |= modifier;
            rest = &rest[prefix.len()..];
        }
        let mut characters = rest.chars();
        let code = match (characters.next()?, characters.next()) {
            (_, Some(_)) => code_of(rest)?,
            (_, None) if code_of(rest).is_some() => code_of(rest)?,
            (character, None) if held.contains(CTRL) => {
                Char(character.to_lowercase().next().unwrap_or(character))
            }
            // Shift is part of a character.
            (character, None) if held.contains(SHIFT) => Char(character.to_ascii_uppercase()),
            (character, None) => Char(character),
        };
        match code {
            Char(_) => Some(Self(code, held - SHIFT)),
            KeyCode::Tab if held.contains(SHIFT) => Some(Self(BackTab, held - SHIFT)),
            code => Some(Self(code, held)),
        }
    }

    /// The event of this key.
    pub(super) fn event(self) -> KeyEvent {
        KeyEvent::new(self.0, self.1)
    }
}

/// Keys that are not named by a character, and other spellings after the first.
const NAMES: [(KeyCode, &str); 20] = [
    (Char(' '), "Space"),
    (Up, "↑"),
    (Down, "↓"),
    (Left, "←"),
    (Right, "→"),
    (Up, "Up"),
    (Down, "Down"),
    (Left, "Left"),
    (Right, "Right"),
    (BackTab, "Shift-Tab"),
    (KeyCode::Tab, "Tab"),
    (KeyCode::Enter, "Enter"),
    (KeyCode::Esc, "Esc"),
    (KeyCode::Backspace, "Backspace"),
    (KeyCode::Delete, "Delete"),
    (KeyCode::Home, "Home"),
    (KeyCode::End, "End"),
    (KeyCode::PageUp, "PageUp"),
    (KeyCode::PageDown, "PageDown"),
    (KeyCode::Insert, "Insert"),
];

/// The key with this name, such as `j`, `Ctrl-R` or `Shift-Left`, as the help spells it.
pub fn key_named(name: &str) -> Option<KeyEvent> {
    Chord::parse(name).map(Chord::event)
}

/// The names of keys that are not characters, without modifiers.
pub fn key_names() -> impl Iterator<Item = &'static str> {
    NAMES.iter().map(|(_, name)| *name)
}

fn starts_with(text: &str, prefix: &str) -> bool {
    let start = text.get(..prefix.len());
    // A prefix alone names its last character.
    prefix.len() < text.len() && start.is_some_and(|start| start.eq_ignore_ascii_case(prefix))
}

fn code_of(name: &str) -> Option<KeyCode> {
    if let Some(number) = name.strip_prefix(['F', 'f']) {
        let number = number.parse().ok()?;
        return (1..=24).contains(&number).then_some(KeyCode::F(number));
    }
    let mut names = NAMES.iter();
    let known = names.find(|(_, known)| known.eq_ignore_ascii_case(name));
    known.map(|&(code, _)| code)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_a_chord_is_parsed_back() {
        let codes = NAMES.iter().map(|&(code, _)| code);
        let codes = codes.chain(['a', 'G', '-', '+', '/', 'é'].map(Char));
        for code in codes.chain([1, 5, 12].map(KeyCode::F)) {
            for held in [NONE, CTRL, ALT, SHIFT, ALT | CTRL, ALT | SHIFT] {
                let chord = Chord::of(KeyEvent::new(code, held));
                let is_upper = matches!(code, Char(c) if c.is_uppercase());
                let is_back_tab = code == KeyCode::Tab && held.contains(SHIFT);
                if held.contains(CTRL) && is_upper || is_back_tab {
                    // Terminals never send these.
                    continue;
                }
                assert_eq!(Chord::parse(&chord.name()), Some(chord), "{}", chord.name());
            }
        }
    }

    #[test]
    fn names_are_read_in_any_usual_spelling() {
        for (name, chord) in [
            ("ctrl-r", ctrl('r')),
            ("Shift-Left", shift(Left)),
            ("Shift-g", c('G')),
            ("alt-l", alt(Char('l'))),
            ("pagedown", key(KeyCode::PageDown)),
            ("f5", key(KeyCode::F(5))),
            ("-", c('-')),
        ] {
            assert_eq!(Chord::parse(name), Some(chord), "{name}");
        }
        for name in ["", "jj", "F0", "F99", "Entr", "Ctrl-Entr"] {
            assert_eq!(Chord::parse(name), None, "{name}");
        }
    }
}
