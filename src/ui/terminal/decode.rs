//! Decodes bytes from the keyboard: a pure state machine from bytes and times to events.
//!
//! The grammar is that of ECMA-48 and of xterm's control sequences (`ctlseqs`). The answers of the
//! terminal arrive among the keys, also late and to questions of other programs: whatever their kind
//! and length, no byte of one is a key. Each byte moves the machine on, so that it does not matter
//! how bytes are cut into pieces; only the times between them count.
//!
//! `ESC` is the Esc key, begins Alt with another key, or introduces a sequence: more bytes within
//! [`PATIENCE`] decide. Alt with the character of an introducer is a key only if nothing follows it.

mod keys;
mod kitty;
mod sequence;

use std::mem;
use std::time::{Duration, Instant};

use crossterm::event::{KeyCode, KeyModifiers};

use super::{Event, query};
use keys::{key, with_alt};
use sequence::Meaning;

/// Maximum time for the rest of what may be a key: longer than the gaps caused by networks, and too
/// short to be noticed on the Esc key.
pub(super) const PATIENCE: Duration = Duration::from_millis(25);

/// Maximum pause within an answer of the terminal, whose rest would be taken for typed text.
const ANSWER_PATIENCE: Duration = Duration::from_secs(2);

/// Maximum pause within a paste before it is accepted as it is: then its end was lost, and the rest
/// would be taken for typed text.
const PASTE_PATIENCE: Duration = Duration::from_secs(10);

/// Maximum number of bytes before the final byte of a sequence that means anything.
const LONGEST: usize = 64;

/// Maximum length of a control string that means anything, in bytes.
const LONGEST_STRING: usize = 4096;

/// Maximum length of a paste in bytes. It is held in memory and inserted in one step.
pub(super) const LONGEST_PASTE: usize = 1 << 20;

const PASTE_END: &[u8] = b"\x1b[201~";

/// Decodes bytes to events. Holds at most a little more than the longest paste.
#[derive(Debug, Default)]
pub struct Decoder {
    state: State,
    /// The bytes of the state that may have a meaning; one more than the longest if there were more.
    held: Vec<u8>,
    /// The key that the bytes so far are if no more follow.
    key: Option<Event>,
    /// Time of the last bytes.
    fed: Option<Instant>,
}

/// What the next byte belongs to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    #[default]
    Ground,
    /// Follows `ESC`.
    Escape,
    /// In a UTF-8 character, typed with these modifiers: Alt after `ESC`.
    Character(KeyModifiers),
    /// In a control sequence, whose parameters are held.
    Sequence,
    /// In a function key `ESC O`, whose parameters are held.
    Function,
    /// The last byte of a function key of the Linux console, `ESC [ [`.
    Console,
    /// In a mouse report of the old format: so many more bytes that are not keys.
    OldMouse(u8),
    /// In a control string.
    Text(Kind, Within),
    /// Within a bracketed paste, of whose end so many bytes have arrived.
    Paste { ended: usize },
}

/// What the next byte of a control string belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Within {
    /// Follows `ESC`.
    Escape,
    /// In a UTF-8 character that lacks so many bytes, which may be like the eight-bit terminator.
    Character(u8),
}

/// The kinds of control strings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Device control string: `ESC P`.
    Device,
    /// Operating system command: `ESC ]`.
    System,
    /// Application program command: `ESC _`.
    Application,
    /// Privacy message and start of string: `ESC ^` and `ESC X`.
    Other,
}

impl Decoder {
    /// Decodes bytes and emits the events that they complete.
    pub fn feed(&mut self, bytes: &[u8], now: Instant, mut emit: impl FnMut(Event)) {
        if !bytes.is_empty() {
            self.fed = Some(now);
        }
        for &byte in bytes {
            self.take(byte, &mut emit);
        }
    }

    /// Returns when [`Decoder::expire`] is due, `None` if no bytes are held.
    pub fn deadline(&self) -> Option<Instant> {
        let patience = match self.state {
            State::Ground => return None,
            State::Paste { .. } => PASTE_PATIENCE,
            State::Escape => PATIENCE,
            // An answer may pause after its introducer.
            _ => ANSWER_PATIENCE,
        };
        self.fed.map(|fed| fed + patience)
    }

    /// Ends what is incomplete once its time is up: emits the Esc key, Alt with a key, or a paste
    /// whose end was lost, and drops the rest.
    pub fn expire(&mut self, now: Instant, mut emit: impl FnMut(Event)) {
        if self.deadline().is_none_or(|deadline| now < deadline) {
            return;
        }
        if matches!(self.state, State::Paste { .. }) {
            self.end_paste(&mut emit);
        }
        self.abandon(&mut emit);
    }

    fn take(&mut self, byte: u8, emit: &mut impl FnMut(Event)) {
        match self.state {
            State::Ground => self.begin(byte, emit),
            State::Escape => self.after_escape(byte, emit),
            State::Character(modifiers) => self.in_character(byte, modifiers, emit),
            State::Text(kind, within) => self.in_text(kind, within, byte, emit),
            State::Paste { ended } => self.in_paste(ended, byte, emit),
            State::OldMouse(left) => {
                self.state = match left {
                    0 | 1 => State::Ground,
                    _ => State::OldMouse(left - 1),
                }
            }
            State::Sequence | State::Function | State::Console => self.in_sequence(byte, emit),
        }
    }

    /// Takes the first byte of a key or an answer.
    fn begin(&mut self, byte: u8, emit: &mut impl FnMut(Event)) {
        self.key = None;
        self.held.clear();
        self.state = State::Ground;
        match byte {
            0x1b => {
                self.key = Some(key(KeyCode::Esc, KeyModifiers::NONE));
                self.state = State::Escape;
            }
            0xc2..=0xf4 => {
                self.held.push(byte);
                self.state = State::Character(KeyModifiers::NONE);
            }
            ..=0x7f => emit(keys::plain(byte)),
            // The eight-bit form of `ESC` with another byte.
            0x80..=0x9f => self.state = introduced(byte - 0x40).unwrap_or_default(),
            _ => {}
        }
    }

    fn after_escape(&mut self, byte: u8, emit: &mut impl FnMut(Event)) {
        match byte {
            0x1b | 0x80..=0x9f => {
                self.emit_key(emit);
                self.begin(byte, emit);
            }
            0xc2..=0xf4 => {
                self.begin(byte, emit);
                self.state = State::Character(KeyModifiers::ALT);
            }
            ..=0x7f => match introduced(byte) {
                None => {
                    self.state = State::Ground;
                    emit(with_alt(keys::plain(byte)));
                }
                Some(state) => {
                    self.key = Some(with_alt(keys::plain(byte)));
                    self.state = state;
                }
            },
            _ => self.state = State::Ground,
        }
    }

    fn in_character(&mut self, byte: u8, modifiers: KeyModifiers, emit: &mut impl FnMut(Event)) {
        self.held.push(byte);
        match std::str::from_utf8(&self.held).map(|text| text.chars().next()) {
            Ok(character) => {
                self.state = State::Ground;
                let typed = character.filter(|character| !character.is_control());
                match typed.map(keys::character) {
                    Some(event) if modifiers == KeyModifiers::ALT => emit(with_alt(event)),
                    Some(event) => emit(event),
                    None => {}
                }
            }
            Err(error) if error.error_len().is_none() => {}
            // What continues a character begins nothing, even if that is malformed.
            Err(_) if matches!(byte, 0x80..=0xbf) => self.state = State::Ground,
            Err(_) => self.begin(byte, emit),
        }
    }

    /// Takes a byte of a control sequence (ECMA-48, 5.4), or of a function key.
    fn in_sequence(&mut self, byte: u8, emit: &mut impl FnMut(Event)) {
        let alone = self.key.take();
        match (self.state, byte) {
            // Cancels the sequence.
            (_, 0x18 | 0x1a) => self.state = State::Ground,
            (_, ..0x20 | 0x7f..) => self.begin(byte, emit),
            (State::Sequence, b'[') if self.held.is_empty() && alone.is_some() => {
                self.state = State::Console;
            }
            (State::Sequence | State::Function, ..0x40) => self.hold(byte, LONGEST),
            (state, last) => {
                self.state = State::Ground;
                let parameters = &self.held[..];
                let meaning = match state {
                    _ if LONGEST < parameters.len() => Meaning::Nothing,
                    State::Sequence => sequence::meaning(parameters, last),
                    State::Function => sequence::function(parameters, last),
                    _ => sequence::console(last),
                };
                match meaning {
                    Meaning::Event(event) => emit(event),
                    Meaning::OldMouse => self.state = State::OldMouse(3),
                    Meaning::Paste => self.state = State::Paste { ended: 0 },
                    Meaning::Nothing => {}
                }
                self.held.clear();
            }
        }
    }

    /// Takes a byte of a control string (ECMA-48, 5.6). Another sequence interrupts it.
    fn in_text(&mut self, kind: Kind, within: Within, byte: u8, emit: &mut impl FnMut(Event)) {
        match (byte, within) {
            (b'\\', Within::Escape) => self.end_text(kind, emit),
            // Doubled by a program that has passed it on.
            (0x1b, _) => self.state = State::Text(kind, Within::Escape),
            (_, Within::Escape) if introduced(byte).is_some() => {
                self.abandon(emit);
                self.begin(0x1b, emit);
                self.take(byte, emit);
            }
            (0x80..=0xbf, Within::Character(missing @ 1..)) => {
                self.hold_text(kind, byte);
                self.state = State::Text(kind, Within::Character(missing - 1));
            }
            (0x9c, _) => self.end_text(kind, emit),
            (0x07, _) if kind == Kind::System => self.end_text(kind, emit),
            (0x18 | 0x1a, _) => {
                self.key = None;
                self.abandon(emit);
            }
            _ => {
                self.hold_text(kind, byte);
                let missing = match byte {
                    0xc2..=0xdf => 1,
                    0xe0..=0xef => 2,
                    0xf0..=0xf4 => 3,
                    _ => 0,
                };
                self.state = State::Text(kind, Within::Character(missing));
            }
        }
    }

    fn end_text(&mut self, kind: Kind, emit: &mut impl FnMut(Event)) {
        let reply = match kind {
            _ if LONGEST_STRING < self.held.len() => None,
            Kind::Device => query::answer(&self.held),
            Kind::Application => query::command(&self.held),
            Kind::System | Kind::Other => None,
        };
        if let Some(reply) = reply {
            emit(Event::Reply(reply));
        }
        self.key = None;
        self.abandon(emit);
    }

    fn in_paste(&mut self, ended: usize, byte: u8, emit: &mut impl FnMut(Event)) {
        self.hold(byte, LONGEST_PASTE + PASTE_END.len());
        let ended = match byte {
            _ if PASTE_END[ended] == byte => ended + 1,
            0x1b => 1,
            _ => 0,
        };
        self.state = State::Paste { ended };
        if ended == PASTE_END.len() {
            if self.held.len() <= LONGEST_PASTE + ended {
                self.held.truncate(self.held.len() - ended);
            }
            self.end_paste(emit);
        }
    }

    fn end_paste(&mut self, emit: &mut impl FnMut(Event)) {
        let bytes = mem::take(&mut self.held);
        self.state = State::Ground;
        emit(if LONGEST_PASTE < bytes.len() {
            Event::LongPaste
        } else {
            Event::Paste(pasted(bytes))
        });
    }

    /// Holds a byte unless there are more than `longest` already.
    fn hold(&mut self, byte: u8, longest: usize) {
        if self.held.len() <= longest {
            self.held.push(byte);
        }
    }

    fn hold_text(&mut self, kind: Kind, byte: u8) {
        self.key = None;
        if matches!(kind, Kind::Device | Kind::Application) {
            self.hold(byte, LONGEST_STRING);
        }
    }

    /// Returns to the beginning; emits the key that the bytes so far are.
    fn abandon(&mut self, emit: &mut impl FnMut(Event)) {
        self.emit_key(emit);
        self.state = State::Ground;
        self.held.clear();
    }

    fn emit_key(&mut self, emit: &mut impl FnMut(Event)) {
        if let Some(event) = self.key.take() {
            emit(event);
        }
    }
}

/// What the character after `ESC` introduces, if anything.
fn introduced(byte: u8) -> Option<State> {
    let kind = match byte {
        b'[' => return Some(State::Sequence),
        b'O' => return Some(State::Function),
        b'P' => Kind::Device,
        b']' => Kind::System,
        b'_' => Kind::Application,
        b'^' | b'X' => Kind::Other,
        _ => return None,
    };
    Some(State::Text(kind, Within::Character(0)))
}

/// Decodes pasted text; terminals send line ends as the byte of the Enter key.
fn pasted(bytes: Vec<u8>) -> String {
    let text = String::from_utf8(bytes)
        .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned());
    text.replace("\r\n", "\n").replace('\r', "\n")
}

#[cfg(test)]
mod tests;
