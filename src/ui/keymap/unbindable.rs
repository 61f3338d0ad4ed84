//! Keys that cannot be bound.

use crossterm::event::KeyCode;

use super::bindings::{Keymap, Row};
use super::chord::{CTRL, Chord, Keys, NONE};
use super::context::{Context, Mode};
use super::section::Section;
use super::typed_line::{begins_value, types_amount};

/// Control characters that terminals send for other keys.
const SAME_BYTES: [(char, &str); 4] = [
    ('h', "Backspace"),
    ('i', "Tab"),
    ('m', "Enter"),
    ('[', "Esc"),
];

/// The row that ends the program.
const INTERRUPT: &str = "interrupt";

/// Why keys cannot do what rows with this name do in a section.
pub fn refusal(section: Section, keys: Keys, name: Option<&str>) -> Option<String> {
    let mut pressed = [Some(keys.first), keys.second].into_iter().flatten();
    let fixed = pressed.find_map(|chord| match chord {
        Chord(KeyCode::Char('c'), CTRL) if name == Some(INTERRUPT) => None,
        Chord(KeyCode::Char('c'), CTRL) => Some("it always quits".to_owned()),
        Chord(KeyCode::Char(c), CTRL) => {
            let other = SAME_BYTES.iter().find(|(character, _)| *character == c)?;
            Some(format!("terminals send the same byte for {}", other.1))
        }
        _ => None,
    });
    let typed = || {
        let Chord(KeyCode::Char(c), NONE) = keys.first else {
            return None;
        };
        match section {
            Section::In(Context::In(Mode::Edit)) if begins_value(c) => {
                Some("it begins to type a value".to_owned())
            }
            Section::Anywhere if begins_value(c) => Some(
                "it begins to type a value in EDIT; bind it in the sections of modes".to_owned(),
            ),
            Section::In(Context::In(Mode::Move)) if types_amount(c, "0") => {
                Some("it types the amount".to_owned())
            }
            _ => None,
        }
    };
    let reason = fixed.or_else(typed)?;
    Some(format!("`{}` cannot be bound: {reason}", keys.spelling()))
}

/// Whether terminals often keep a key for themselves.
fn belongs_to_terminals(keys: &Keys) -> bool {
    matches!(keys.first, Chord(KeyCode::F(1 | 10 | 11), NONE))
}

impl Keymap {
    /// Whether an action that had other keys is left with ones that terminals often keep for
    /// themselves: F1, F10 or F11. Returns those keys.
    pub fn unreachable_in(&self, section: Section) -> Option<Keys> {
        let here = || self.rows.iter().filter(|row| row.key.is_in(section));
        let is_lost = |row: &Row| row.keys_of(section).iter().all(belongs_to_terminals);
        here().find_map(|row| {
            let mut same = here().filter(|other| other.key.name == row.key.name);
            // The row is one of them.
            let first = row.keys_of(section).first().copied();
            first.filter(|_| same.all(is_lost))
        })
    }
}
