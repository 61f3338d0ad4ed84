//! Keys in kitty's keyboard protocol, which keeps the Esc key and Alt apart from the beginnings of
//! sequences: `ESC [`, the code of the key, `;`, modifiers and `u`.
//!
//! A key means the same as in terminals without the protocol, so that what those cannot tell apart
//! is one key here too: Ctrl-I is Tab, Shift-Enter is Enter.

use crossterm::event::{KeyCode, KeyModifiers};

use super::keys::{character, key, modifiers, with_alt};
use crate::terminal::Event;

/// The bits of the modifiers Super and Hyper, with which no key has a meaning, and of Meta, which
/// is Alt.
const SUPER_OR_HYPER: u16 = 8 | 16;
const META: u16 = 32;

/// The bit of Alt.
const ALT: u16 = 2;

/// The third kind of event, after presses and repetitions.
const RELEASE: &str = "3";

/// The keys of the numeric keypad that move, by their codes from [`KEYPAD`] on.
const KEYPAD_MOVES: [KeyCode; 10] = [
    KeyCode::Left,
    KeyCode::Right,
    KeyCode::Up,
    KeyCode::Down,
    KeyCode::PageUp,
    KeyCode::PageDown,
    KeyCode::Home,
    KeyCode::End,
    KeyCode::Insert,
    KeyCode::Delete,
];
const KEYPAD: u32 = 57417;

/// The characters of the numeric keypad, by their codes from [`KEYPAD_TYPES`] on; the Enter key is
/// among them.
const TYPED: &[u8; 17] = b"0123456789./*-+\r=";
const KEYPAD_TYPES: u32 = 57399;

/// Decodes `code : shifted : base ; modifiers : kind`, of which all but the code may be missing.
pub(super) fn key_of(parameters: &[u8]) -> Option<Event> {
    let text = std::str::from_utf8(parameters).ok()?;
    let mut fields = text.split(';');
    let mut codes = fields.next()?.split(':').map(|code| code.parse().ok());
    let code: u32 = codes.next()??;
    let [shifted, base] = [codes.next().flatten(), codes.next().flatten()];
    let mut state = fields.next().unwrap_or_default().split(':');
    let mut bits = match state.next() {
        None | Some("") => 0,
        Some(number) => number.parse::<u16>().ok()?.checked_sub(1)?,
    };
    if state.next() == Some(RELEASE) || bits & SUPER_OR_HYPER != 0 {
        return None;
    }
    if bits & META != 0 {
        bits |= ALT;
    }
    let held = modifiers(bits.checked_add(1)?);
    let at = |first: u32| code.checked_sub(first).map(|at| at as usize);
    if let Some(&moves) = at(KEYPAD).and_then(|at| KEYPAD_MOVES.get(at)) {
        return Some(key(moves, held));
    }
    let typed = at(KEYPAD_TYPES).and_then(|at| TYPED.get(at));
    let code = typed.map_or(code, |&typed| typed.into());
    named(code, held).or_else(|| {
        let code = match (shifted, base) {
            // The key at the same place of a Latin layout.
            (_, Some(base)) if held.contains(KeyModifiers::CONTROL) && 0x7f < code => base,
            (Some(shifted), _) if held.contains(KeyModifiers::SHIFT) => shifted,
            _ => code,
        };
        typing(char::from_u32(code)?, held)
    })
}

/// A key with a name. Only Shift-Tab differs with Shift, and none with Ctrl.
fn named(code: u32, held: KeyModifiers) -> Option<Event> {
    let alt = held & KeyModifiers::ALT;
    Some(match code {
        0x1b => key(KeyCode::Esc, KeyModifiers::NONE),
        0x0d => key(KeyCode::Enter, alt),
        0x09 if held.contains(KeyModifiers::SHIFT) => {
            key(KeyCode::BackTab, alt | KeyModifiers::SHIFT)
        }
        0x09 => key(KeyCode::Tab, alt),
        0x7f => key(KeyCode::Backspace, alt),
        // F13 to F24.
        57376..=57387 => key(KeyCode::F((code - 57376) as u8 + 13), held),
        _ => return None,
    })
}

/// A key with a character, which stands for no other key.
fn typing(typed: char, held: KeyModifiers) -> Option<Event> {
    if typed.is_control() || ('\u{e000}'..='\u{f8ff}').contains(&typed) {
        return None;
    }
    let alt = held & KeyModifiers::ALT;
    if held.contains(KeyModifiers::CONTROL) {
        let code = match typed.to_ascii_lowercase() {
            '[' => return named(0x1b, alt),
            'h' => return named(0x7f, alt),
            'i' => return named(0x09, alt),
            'm' => return named(0x0d, alt),
            '@' => ' ',
            typed => typed,
        };
        return Some(key(KeyCode::Char(code), alt | KeyModifiers::CONTROL));
    }
    let event = if held.contains(KeyModifiers::SHIFT) {
        character(typed.to_ascii_uppercase())
    } else {
        character(typed)
    };
    Some(if alt.is_empty() {
        event
    } else {
        with_alt(event)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_means_the_same_as_without_the_protocol() {
        const NONE: KeyModifiers = KeyModifiers::NONE;
        const SHIFT: KeyModifiers = KeyModifiers::SHIFT;
        const ALT: KeyModifiers = KeyModifiers::ALT;
        const CTRL: KeyModifiers = KeyModifiers::CONTROL;
        use KeyCode::{BackTab, Backspace, Char, Enter, Esc, F, Left, Tab};
        for (parameters, code, held) in [
            ("27", Esc, NONE),
            ("27;3", Esc, NONE),
            ("27;129", Esc, NONE),
            ("13;2", Enter, NONE),
            ("13;3", Enter, ALT),
            ("9;5", Tab, NONE),
            ("9;2", BackTab, SHIFT),
            ("127;3", Backspace, ALT),
            ("97", Char('a'), NONE),
            ("108;3", Char('l'), ALT),
            ("108;33", Char('l'), ALT),
            ("108:76;4", Char('L'), SHIFT | ALT),
            ("108;4", Char('L'), SHIFT | ALT),
            ("91:123;4", Char('{'), ALT),
            ("55:47;4", Char('/'), ALT),
            ("99;5", Char('c'), CTRL),
            ("99:67;6", Char('c'), CTRL),
            ("1089::99;5", Char('c'), CTRL),
            ("1092;3", Char('ф'), ALT),
            ("122;7", Char('z'), CTRL | ALT),
            ("32;5", Char(' '), CTRL),
            ("50:64;6", Char(' '), CTRL),
            ("91;5", Esc, NONE),
            ("104;5", Backspace, NONE),
            ("105;5", Tab, NONE),
            ("106;5", Char('j'), CTRL),
            ("109;5", Enter, NONE),
            ("108;3:2", Char('l'), ALT),
            ("57414", Enter, NONE),
            ("57417;2", Left, SHIFT),
            ("57426", KeyCode::Delete, NONE),
            ("57399", Char('0'), NONE),
            ("57413", Char('+'), NONE),
            ("57376;5", F(13), CTRL),
        ] {
            let event = key_of(parameters.as_bytes());
            assert_eq!(event, Some(key(code, held)), "{parameters}");
        }
    }

    #[test]
    fn other_reports_are_no_keys() {
        let ignored = "108;3:3 108;9 108;17 57358 57441;2 57427 57400;0 0 5";
        let malformed = "; : 1114112 55296 4294967296 x 108;x 108;65536 ?5";
        for parameters in ignored.split(' ').chain(malformed.split(' ')).chain([""]) {
            assert_eq!(key_of(parameters.as_bytes()), None, "{parameters}");
        }
    }
}
