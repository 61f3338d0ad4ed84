//! Decodes bytes from the keyboard: a pure state machine from bytes and times to events.
//!
//! The grammar is that of xterm's control sequences (`ctlseqs`, sections "PC-Style Function Keys"
//! and "Extended coordinates") and of the Linux console. An escape sequence may arrive in pieces;
//! its beginning is held for [`PATIENCE`] before it is taken for the Esc key.

use std::time::{Duration, Instant};

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::{Event, Reply, query};

/// Maximum time for the rest of an escape sequence: longer than the gaps caused by networks, and
/// too short to be noticed on the Esc key.
pub(super) const PATIENCE: Duration = Duration::from_millis(25);

/// Maximum pause within a paste before it is accepted as it is.
const PASTE_PATIENCE: Duration = Duration::from_secs(1);

/// Maximum length of a sequence in bytes; anything longer is noise.
const LONGEST: usize = 64;

/// Maximum time for the rest of a device control string, and its maximum length in bytes: it is an
/// answer of the terminal, and its rest would be taken for typed text.
const STRING_PATIENCE: Duration = Duration::from_secs(1);
const LONGEST_STRING: usize = 4096;

/// Introducers of a device control string and of an application program command.
const STRINGS: [&[u8]; 2] = [b"\x1bP", b"\x1b_"];

const PASTE_END: &[u8] = b"\x1b[201~";

/// Decodes bytes to events.
#[derive(Debug, Default)]
pub struct Decoder {
    pending: Vec<u8>,
    mode: Mode,
    /// Time of the last bytes.
    fed: Option<Instant>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Mode {
    #[default]
    Keys,
    /// Within a bracketed paste.
    Paste,
    /// In a sequence with too many parameters; further ones are ignored as well.
    Noise,
    /// In a device control string longer than any answer; ignored up to its end.
    NoiseString,
}

/// The first token of the pending bytes.
#[derive(Debug, PartialEq, Eq)]
enum Token {
    /// The beginning of a sequence whose end has yet to arrive.
    Unfinished,
    /// The number of bytes and their event.
    Event(usize, Event),
    /// The number of bytes to ignore.
    Noise(usize),
    /// The number of bytes that begin a paste.
    PasteBegin(usize),
}

impl Decoder {
    /// Decodes bytes and emits the events that they complete.
    pub fn feed(&mut self, bytes: &[u8], now: Instant, mut emit: impl FnMut(Event)) {
        self.pending.extend_from_slice(bytes);
        self.fed = Some(now);
        self.advance(&mut emit);
    }

    /// Returns when [`Decoder::expire`] is due, `None` if no bytes are held.
    pub fn deadline(&self) -> Option<Instant> {
        let patience = match self.mode {
            Mode::Paste => PASTE_PATIENCE,
            Mode::Keys if self.pending.is_empty() => return None,
            Mode::NoiseString => STRING_PATIENCE,
            Mode::Keys if is_string(&self.pending) => STRING_PATIENCE,
            Mode::Keys | Mode::Noise => PATIENCE,
        };
        self.fed.map(|fed| fed + patience)
    }

    /// Emits held bytes whose time is up: the Esc key, Alt with a key, or a paste whose end was
    /// lost.
    pub fn expire(&mut self, now: Instant, mut emit: impl FnMut(Event)) {
        if self.deadline().is_none_or(|deadline| now < deadline) {
            return;
        }
        if self.mode == Mode::Paste {
            emit(Event::Paste(pasted(&self.pending)));
        } else {
            match self.pending[..] {
                [0x1b] => emit(key(KeyCode::Esc, KeyModifiers::NONE)),
                [0x1b, introducer @ (b'[' | b'O')] => {
                    emit(with_alt(character(introducer.into())));
                }
                _ => {}
            }
        }
        self.mode = Mode::Keys;
        self.pending.clear();
    }

    fn advance(&mut self, emit: &mut impl FnMut(Event)) {
        let mut start = 0;
        while start < self.pending.len() {
            let rest = &self.pending[start..];
            if self.mode == Mode::Paste {
                let Some(end) = find(rest, PASTE_END) else {
                    break;
                };
                emit(Event::Paste(pasted(&rest[..end])));
                self.mode = Mode::Keys;
                start += end + PASTE_END.len();
                continue;
            }
            if self.mode == Mode::Noise {
                let noise = rest.iter().take_while(|&&byte| is_parameter(byte)).count();
                start += noise;
                if noise == rest.len() {
                    break;
                }
                self.mode = Mode::Keys;
                continue;
            }
            if self.mode == Mode::NoiseString {
                let body = rest.iter().take_while(|byte| !byte.is_ascii_control());
                let body = body.count();
                start += body;
                match &rest[body..] {
                    [] | [0x1b] => break,
                    [0x1b, b'\\', ..] => start += 2,
                    _ => {}
                }
                self.mode = Mode::Keys;
                continue;
            }
            match token(rest) {
                Token::Unfinished if rest.len() < longest(rest) => break,
                Token::Unfinished => {
                    self.mode = if is_string(rest) {
                        Mode::NoiseString
                    } else {
                        Mode::Noise
                    };
                    // A trailing escape may belong to the terminator.
                    start += rest.len() - usize::from(rest.ends_with(b"\x1b"));
                }
                Token::Noise(length) => start += length,
                Token::PasteBegin(length) => {
                    self.mode = Mode::Paste;
                    start += length;
                }
                Token::Event(length, event) => {
                    emit(event);
                    start += length;
                }
            }
        }
        self.pending.drain(..start);
    }
}

fn is_string(bytes: &[u8]) -> bool {
    STRINGS
        .iter()
        .any(|introducer| bytes.starts_with(introducer))
}

fn longest(bytes: &[u8]) -> usize {
    if is_string(bytes) {
        LONGEST_STRING
    } else {
        LONGEST
    }
}

fn token(bytes: &[u8]) -> Token {
    match bytes {
        // Alt-P begins the same way; what follows the introducer of an answer is a parameter. An
        // answer about graphics begins with a G.
        [0x1b] | [0x1b, b'P' | b'_'] => Token::Unfinished,
        [0x1b, b'P', 0x30..=0x3f, ..] | [0x1b, b'_', b'G', ..] => control_string(bytes),
        [0x1b, b'[', ..] => control_sequence(bytes),
        [0x1b, b'O', rest @ ..] => match rest.first() {
            None => Token::Unfinished,
            Some(&end) => match function_key(end) {
                Some(code) => Token::Event(3, key(code, KeyModifiers::NONE)),
                None => Token::Noise(3),
            },
        },
        [0x1b, 0x1b, ..] => Token::Event(1, key(KeyCode::Esc, KeyModifiers::NONE)),
        [0x1b, rest @ ..] => match plain(rest) {
            Token::Event(length, event) => Token::Event(length + 1, with_alt(event)),
            Token::Noise(length) => Token::Noise(length + 1),
            other => other,
        },
        _ => plain(bytes),
    }
}

/// Decodes a character or a control character.
fn plain(bytes: &[u8]) -> Token {
    let control = |code: char| key(KeyCode::Char(code), KeyModifiers::CONTROL);
    let event = match bytes[0] {
        0 => control(' '),
        b'\t' => key(KeyCode::Tab, KeyModifiers::NONE),
        b'\r' => key(KeyCode::Enter, KeyModifiers::NONE),
        0x08 | 0x7f => key(KeyCode::Backspace, KeyModifiers::NONE),
        byte @ 0x01..=0x1f => control((byte + 0x40).to_ascii_lowercase().into()),
        byte @ b' '..=b'~' => character(byte.into()),
        _ => return beyond_ascii(bytes),
    };
    Token::Event(1, event)
}

fn beyond_ascii(bytes: &[u8]) -> Token {
    let length = match bytes[0] {
        0xc2..=0xdf => 2,
        0xe0..=0xef => 3,
        0xf0..=0xf4 => 4,
        _ => return Token::Noise(1),
    };
    let available = &bytes[..length.min(bytes.len())];
    match std::str::from_utf8(available) {
        Ok(text) => match text.chars().next() {
            Some(c) if !c.is_control() => Token::Event(length, character(c)),
            _ => Token::Noise(length),
        },
        Err(error) if error.error_len().is_none() => Token::Unfinished,
        Err(_) => Token::Noise(1),
    }
}

/// Decodes `ESC [`, parameters and a final byte (ECMA-48, 5.4).
fn control_sequence(bytes: &[u8]) -> Token {
    if let [_, _, b'[', rest @ ..] = bytes {
        // The first five function keys of the Linux console.
        return match rest.first() {
            None => Token::Unfinished,
            Some(&end @ b'A'..=b'E') => {
                Token::Event(4, key(KeyCode::F(end - b'A' + 1), KeyModifiers::NONE))
            }
            Some(_) => Token::Noise(3),
        };
    }
    let body = &bytes[2..];
    let Some(end) = body.iter().position(|&byte| !is_parameter(byte)) else {
        return Token::Unfinished;
    };
    let length = end + 3;
    if LONGEST < length {
        // The byte after so much noise is decoded separately, regardless of when it arrives.
        return Token::Noise(length - 1);
    }
    let parameters = &body[..end];
    match body[end] {
        b'M' if parameters.is_empty() => {
            // A mouse report in the old format: three more bytes that are not keys.
            if bytes.len() < length + 3 {
                Token::Unfinished
            } else {
                Token::Noise(length + 3)
            }
        }
        b'~' if parameters == b"200" => Token::PasteBegin(length),
        b'n' if matches!(parameters, b"0" | b"3") => {
            Token::Event(length, Event::Reply(Reply::Status))
        }
        last @ (b'M' | b'm') if parameters.first() == Some(&b'<') => {
            event_or_noise(mouse(&parameters[1..], last), length)
        }
        b'y' if parameters.starts_with(b"?") => event_or_noise(mode_report(parameters), length),
        b'c' if parameters.starts_with(b"?") => {
            let numbers = numbers(&parameters[1..]).unwrap_or_default();
            Token::Event(length, Event::Reply(query::attributes(&numbers)))
        }
        b't' => {
            let reply = numbers(parameters).and_then(|numbers| query::window(&numbers));
            event_or_noise(reply.map(Event::Reply), length)
        }
        last @ 0x40..=0x7e => event_or_noise(sequence_key(parameters, last), length),
        // Another sequence interrupts this one and is decoded separately.
        _ => Token::Noise(length - 1),
    }
}

/// Whether a byte may occur between the introducer and the final byte of a control sequence.
fn is_parameter(byte: u8) -> bool {
    (0x20..0x40).contains(&byte)
}

/// Decodes `ESC P` or `ESC _`, printable characters and the terminator `ESC \\` (ECMA-48, 5.6).
fn control_string(bytes: &[u8]) -> Token {
    let (introducer, body) = bytes.split_at(STRINGS[0].len());
    let Some(end) = body.iter().position(u8::is_ascii_control) else {
        return Token::Unfinished;
    };
    match body[end..] {
        [0x1b] => Token::Unfinished,
        [0x1b, b'\\', ..] => {
            let reply = if introducer == STRINGS[0] {
                query::answer(&body[..end])
            } else {
                query::command(&body[..end])
            };
            event_or_noise(reply.map(Event::Reply), introducer.len() + end + 2)
        }
        // Another sequence interrupts this one and is decoded separately.
        _ => Token::Noise(introducer.len() + end),
    }
}

fn event_or_noise(event: Option<Event>, length: usize) -> Token {
    event.map_or(Token::Noise(length), |event| Token::Event(length, event))
}

/// Decodes `? number ; state $`.
fn mode_report(parameters: &[u8]) -> Option<Event> {
    let inner = parameters.strip_prefix(b"?")?.strip_suffix(b"$")?;
    let &[number, state] = numbers(inner)?.as_slice() else {
        return None;
    };
    Some(Event::Reply(Reply::Mode { number, state }))
}

fn sequence_key(parameters: &[u8], last: u8) -> Option<Event> {
    let numbers = numbers(parameters)?;
    let modifiers = modifiers(numbers.get(1).copied().unwrap_or(1));
    let code = match (last, numbers.first()) {
        (b'Z', _) => return Some(key(KeyCode::BackTab, modifiers | KeyModifiers::SHIFT)),
        (b'~', Some(&number)) => numbered_key(number)?,
        // With another number it is a report, such as the cursor position.
        (_, None | Some(1)) => function_key(last)?,
        _ => return None,
    };
    Some(key(code, modifiers))
}

fn function_key(last: u8) -> Option<KeyCode> {
    Some(match last {
        b'A' => KeyCode::Up,
        b'B' => KeyCode::Down,
        b'C' => KeyCode::Right,
        b'D' => KeyCode::Left,
        b'F' => KeyCode::End,
        b'H' => KeyCode::Home,
        b'M' => KeyCode::Enter,
        b'P'..=b'S' => KeyCode::F(last - b'P' + 1),
        _ => return None,
    })
}

fn numbered_key(number: u16) -> Option<KeyCode> {
    Some(match number {
        1 | 7 => KeyCode::Home,
        2 => KeyCode::Insert,
        3 => KeyCode::Delete,
        4 | 8 => KeyCode::End,
        5 => KeyCode::PageUp,
        6 => KeyCode::PageDown,
        // The numbers skip one after about every fifth function key.
        11..=15 => KeyCode::F(number as u8 - 10),
        17..=21 => KeyCode::F(number as u8 - 11),
        23..=26 => KeyCode::F(number as u8 - 12),
        28 | 29 => KeyCode::F(number as u8 - 13),
        31..=34 => KeyCode::F(number as u8 - 14),
        _ => return None,
    })
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
    let mut modifiers = KeyModifiers::NONE;
    modifiers.set(KeyModifiers::SHIFT, code & 4 != 0);
    modifiers.set(KeyModifiers::ALT, code & 8 != 0);
    modifiers.set(KeyModifiers::CONTROL, code & 16 != 0);
    let (column, row) = (column.checked_sub(1)?, row.checked_sub(1)?);
    Some(Event::Mouse(MouseEvent {
        kind,
        column,
        row,
        modifiers,
    }))
}

/// Decodes numbers separated by semicolons; an empty one is 1, xterm's default for keys.
fn numbers(parameters: &[u8]) -> Option<Vec<u16>> {
    if parameters.is_empty() {
        return Some(Vec::new());
    }
    let text = std::str::from_utf8(parameters).ok()?;
    text.split(';')
        .map(|part| {
            if part.is_empty() {
                Some(1)
            } else {
                part.parse().ok()
            }
        })
        .collect()
}

/// Decodes xterm's modifier parameter: 1 plus the sum of shift 1, alt 2 and control 4.
fn modifiers(parameter: u16) -> KeyModifiers {
    let bits = parameter.saturating_sub(1);
    let mut modifiers = KeyModifiers::NONE;
    modifiers.set(KeyModifiers::SHIFT, bits & 1 != 0);
    modifiers.set(KeyModifiers::ALT, bits & 2 != 0);
    modifiers.set(KeyModifiers::CONTROL, bits & 4 != 0);
    modifiers
}

fn character(character: char) -> Event {
    let shift = if character.is_uppercase() {
        KeyModifiers::SHIFT
    } else {
        KeyModifiers::NONE
    };
    key(KeyCode::Char(character), shift)
}

const fn key(code: KeyCode, modifiers: KeyModifiers) -> Event {
    Event::Key(KeyEvent::new(code, modifiers))
}

fn with_alt(event: Event) -> Event {
    match event {
        Event::Key(mut key) => {
            key.modifiers |= KeyModifiers::ALT;
            Event::Key(key)
        }
        other => other,
    }
}

/// Decodes pasted text; terminals send line ends as the byte of the Enter key.
fn pasted(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes)
        .replace("\r\n", "\n")
        .replace('\r', "\n")
}

fn find(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes
        .windows(wanted.len())
        .position(|window| window == wanted)
}

#[cfg(test)]
mod tests;
