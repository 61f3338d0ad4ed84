//! Keys and their names.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use KeyCode::{BackTab, Char, Down, Left, Right, Up};

/// A key with its modifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Chord(pub(super) KeyCode, pub(super) KeyModifiers);

pub(super) const NONE: KeyModifiers = KeyModifiers::NONE;
pub(super) const SHIFT: KeyModifiers = KeyModifiers::SHIFT;
pub(super) const ALT: KeyModifiers = KeyModifiers::ALT;
pub(super) const CTRL: KeyModifiers = KeyModifiers::CONTROL;

/// A character key. The character already includes Shift.
pub(super) const fn c(character: char) -> Chord {
    Chord(Char(character), NONE)
}

pub(super) const fn ctrl(character: char) -> Chord {
    Chord(Char(character), CTRL)
}

pub(super) const fn alt(character: char) -> Chord {
    Chord(Char(character), ALT)
}

pub(super) const fn key(code: KeyCode) -> Chord {
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
            Char(' ') => name.push_str("Space"),
            Char(character) if held.contains(CTRL) => name.extend(character.to_uppercase()),
            Char(character) => name.push(character),
            Up => name.push('↑'),
            Down => name.push('↓'),
            Left => name.push('←'),
            Right => name.push('→'),
            BackTab => name.push_str("Shift-Tab"),
            other => name.push_str(&other.to_string()),
        }
        name
    }
}
