//! What control sequences and function keys mean (xterm's `ctlseqs`, "PC-Style Function Keys" and
//! "Extended coordinates"; the Linux console).

use crossterm::event::{KeyCode, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::keys::{function_key, key, modifiers, numbered_key};
use super::kitty;
use crate::terminal::{Event, Reply, query};

/// The meaning of a sequence.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    Event(Event),
    /// A mouse report in the old format: three more bytes follow.
    OldMouse,
    /// The beginning of a paste.
    Paste,
    /// None here: an answer to another program's question, or an unknown key.
    Nothing,
}

/// The meaning of `ESC [`, parameters and a final byte.
pub(super) fn meaning(parameters: &[u8], last: u8) -> Meaning {
    let reply = |reply: Option<Reply>| reply.map(Event::Reply);
    let event = match (parameters, last) {
        (b"", b'M') => return Meaning::OldMouse,
        (b"200", b'~') => return Meaning::Paste,
        (b"0" | b"3", b'n') => reply(Some(Reply::Status)),
        ([b'<', report @ ..], b'M' | b'm') => mouse(report, last),
        ([b'?', report @ ..], b'y') => reply(mode(report)),
        ([b'?', report @ ..], b'c') => {
            let numbers = numbers(report).unwrap_or_default();
            reply(Some(query::attributes(&numbers)))
        }
        ([b'?', report @ ..], b'u') => reply(numbers(report).map(|_| Reply::KeysApart)),
        (_, b't') => reply(numbers(parameters).and_then(|numbers| query::window(&numbers))),
        (_, b'u') => kitty::key_of(parameters),
        _ => numbers(parameters).and_then(|numbers| sequence_key(&numbers, last)),
    };
    event.map_or(Meaning::Nothing, Meaning::Event)
}

/// The meaning of `ESC O`, parameters and a final byte.
pub(super) fn function(parameters: &[u8], last: u8) -> Meaning {
    let code = match last {
        b'M' => Some(KeyCode::Enter),
        _ => function_key(last),
    };
    let held = numbers(parameters).map(|numbers| modifiers(numbers.last().copied().unwrap_or(1)));
    match (code, held) {
        (Some(code), Some(held)) => Meaning::Event(key(code, held)),
        _ => Meaning::Nothing,
    }
}

/// The meaning of `ESC [ [` and a final byte: the first five function keys of the Linux console.
pub(super) fn console(last: u8) -> Meaning {
    match last {
        b'A'..=b'E' => Meaning::Event(key(KeyCode::F(last - b'A' + 1), KeyModifiers::NONE)),
        _ => Meaning::Nothing,
    }
}

/// Decodes `number ; state $`.
fn mode(report: &[u8]) -> Option<Reply> {
    let &[number, state] = numbers(report.strip_suffix(b"$")?)?.as_slice() else {
        return None;
    };
    Some(Reply::Mode { number, state })
}

fn sequence_key(numbers: &[u16], last: u8) -> Option<Event> {
    let modifiers = modifiers(numbers.get(1).copied().unwrap_or(1));
    let code = match (last, numbers) {
        (b'Z', _) => return Some(key(KeyCode::BackTab, modifiers | KeyModifiers::SHIFT)),
        (b'~', &[number, ..]) => numbered_key(number)?,
        // The position of the cursor in the first row, rather than F3 with modifiers.
        (b'R', [_, _, ..]) => return None,
        // With another number it is a report.
        (_, [] | [1, ..]) => function_key(last)?,
        _ => return None,
    };
    Some(key(code, modifiers))
}

/// Decodes a report of mode 1006: button and modifiers, column, row.
fn mouse(parameters: &[u8], last: u8) -> Option<Event> {
    let &[code, column, row] = numbers(parameters)?.as_slice() else {
        return None;
    };
    let button = match code & 3 {
        0 => MouseButton::Left,
        1 => MouseButton::Middle,
        _ => MouseButton::Right,
    };
    let kind = match (code & 0b1100_0011, code & 32 != 0, last) {
        (64, ..) => MouseEventKind::ScrollUp,
        (65, ..) => MouseEventKind::ScrollDown,
        (66, ..) => MouseEventKind::ScrollLeft,
        (67, ..) => MouseEventKind::ScrollRight,
        (0..=2, true, _) => MouseEventKind::Drag(button),
        (0..=2, false, b'm') => MouseEventKind::Up(button),
        (0..=2, false, _) => MouseEventKind::Down(button),
        _ => return None,
    };
    Some(Event::Mouse(MouseEvent {
        kind,
        column: column.checked_sub(1)?,
        row: row.checked_sub(1)?,
        modifiers: modifiers(1 + (code >> 2 & 7)),
    }))
}

/// Decodes numbers separated by semicolons; an empty one is 1, xterm's default for keys.
fn numbers(parameters: &[u8]) -> Option<Vec<u16>> {
    if parameters.is_empty() {
        return Some(Vec::new());
    }
    let text = std::str::from_utf8(parameters).ok()?;
    let number = |part: &str| match part {
        "" => Some(1),
        part => part.parse().ok(),
    };
    text.split(';').map(number).collect()
}
