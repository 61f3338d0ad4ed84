//! Encodes cells as bytes.
//!
//! In a picture of half blocks nearly all bytes are colours, so each cell is sent in whichever
//! equivalent form changes fewer of them: `▀` or `▄` with the colours exchanged, a blank or `█` if
//! both halves are equal.
//!
//! Nothing in a cell can reach the terminal as a command: control characters are replaced, and a
//! cell shows one character with at most one combining mark, or a few that name a part of a picture.

use std::collections::BTreeSet;
use std::convert::Infallible;

use ratatui::backend::{Backend, ClearType, WindowSize};
use ratatui::buffer::{Cell, CellWidth};
use ratatui::layout::{Position, Size};
use ratatui::style::Modifier;
use unicode_width::UnicodeWidthChar;

use super::colour::{ColourDepth, Ink};
use super::graphics::{MARKS, PLACEHOLDER};
use super::pen::{Pen, Style, VISIBLE_ON_BLANK, push_number};

/// Synchronized output, DEC private mode 2026: the terminal shows a frame once it is complete.
const BEGIN: &[u8] = b"\x1b[?2026h";
const END: &[u8] = b"\x1b[?2026l";

/// Wraps lines at the last column, DEC private mode 7, which is off between cells.
const WRAP: &[u8] = b"\x1b[?7h";
const DO_NOT_WRAP: &[u8] = b"\x1b[?7l";

/// Encodes the cells of each frame into one buffer of bytes; performs no I/O itself.
///
/// Requires a terminal in raw mode that does not wrap lines.
#[derive(Debug)]
pub struct AnsiBackend {
    depth: ColourDepth,
    size: Size,
    /// The frame so far, including the sequence that begins it.
    out: Vec<u8>,
    pen: Pen,
    place: CursorPosition,
    /// Whether the cursor is shown, if that is known.
    is_shown: Option<bool>,
    /// Positions of wide characters on the screen: row, column.
    wide: BTreeSet<(u16, u16)>,
}

/// Position of the terminal's cursor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CursorPosition {
    Unknown,
    /// In this row at an unknown column: terminals differ after the last column and wide
    /// characters.
    Row(u16),
    At(Position),
}

impl AnsiBackend {
    /// Starts with a terminal in an unknown state.
    pub fn new(depth: ColourDepth, size: Size) -> Self {
        Self {
            depth,
            size,
            out: BEGIN.to_vec(),
            pen: Pen::UNKNOWN,
            place: CursorPosition::Unknown,
            is_shown: None,
            wide: BTreeSet::new(),
        }
    }

    /// Sets the size of the window, from the next frame on.
    pub fn fit(&mut self, size: Size) {
        self.size = size;
    }

    /// Sets the colour depth from now on.
    pub fn recolour(&mut self, depth: ColourDepth) {
        self.depth = depth;
    }

    /// Forgets the state of the terminal, for example after another program has used it.
    pub fn forget(&mut self) {
        self.pen = Pen::UNKNOWN;
        self.place = CursorPosition::Unknown;
        self.is_shown = None;
        self.wide.clear();
    }

    /// Passes the bytes of the frame to `write` at once, bracketed as synchronized output, and
    /// starts the next frame. An empty frame is not passed.
    pub fn finish<E>(&mut self, write: impl FnOnce(&[u8]) -> Result<(), E>) -> Result<usize, E> {
        if self.out.len() == BEGIN.len() {
            return Ok(0);
        }
        self.out.extend_from_slice(END);
        let bytes = self.out.len();
        let written = write(&self.out);
        self.out.truncate(BEGIN.len());
        written.map(|()| bytes)
    }

    /// Drops the frame so far. What the terminal shows is unknown until everything is drawn.
    pub(super) fn discard(&mut self) {
        self.out.truncate(BEGIN.len());
        self.forget();
    }

    /// Appends bytes that change neither the cursor nor the style.
    pub(super) fn append(&mut self, bytes: &[u8]) {
        self.out.extend_from_slice(bytes);
    }

    /// Puts bytes that change neither the cursor nor the style before the rest of the frame.
    pub(super) fn precede(&mut self, bytes: &[u8]) {
        let start = BEGIN.len();
        self.out.splice(start..start, bytes.iter().copied());
    }

    /// Appends a picture that begins at a cell. It may leave the cursor anywhere.
    pub(super) fn picture(&mut self, at: Position, bytes: &[u8]) {
        self.move_to(at);
        self.append(bytes);
        self.place = CursorPosition::Unknown;
    }

    fn move_to(&mut self, to: Position) {
        match self.place {
            CursorPosition::At(at) if at == to => return,
            CursorPosition::At(at) if at.y == to.y && at.x < to.x => self.forward(to.x - at.x),
            CursorPosition::At(Position { y, .. }) | CursorPosition::Row(y) if y == to.y => {
                if to.x == 0 {
                    self.out.push(b'\r');
                } else {
                    self.command(&[to.x + 1], b'G');
                }
            }
            CursorPosition::At(Position { y, .. }) | CursorPosition::Row(y) if y + 1 == to.y => {
                self.out.extend_from_slice(b"\r\n");
                self.forward(to.x);
            }
            _ => self.command(&[to.y + 1, to.x + 1], b'H'),
        }
        self.place = CursorPosition::At(to);
    }

    fn forward(&mut self, columns: u16) {
        match columns {
            0 => {}
            1 => self.command(&[], b'C'),
            _ => self.command(&[columns], b'C'),
        }
    }

    fn command(&mut self, parameters: &[u16], end: u8) {
        self.out.extend_from_slice(b"\x1b[");
        for (index, &parameter) in parameters.iter().enumerate() {
            if index != 0 {
                self.out.push(b';');
            }
            push_number(&mut self.out, parameter);
        }
        self.out.push(end);
    }

    /// Blanks both halves of a wide character before its first cell is overwritten: terminals paint
    /// the remaining half in the colours of the new character, and a cell that is blank before and
    /// after is not sent again.
    fn blank_wide(&mut self, at: Position) {
        if self.wide.remove(&(at.y, at.x)) {
            self.move_to(at);
            self.pen.reset(&mut self.out);
            self.out.extend_from_slice(b"  ");
            self.place = CursorPosition::Row(at.y);
        }
    }

    /// Writes the character of a cell; returns whether it takes one column for sure. tmux combines
    /// characters with the one before the cursor, which does not leave the last column unless lines
    /// are wrapped.
    fn put_character(&mut self, cell: &Cell, is_last: bool) -> bool {
        if !is_last || !cell.symbol().starts_with(PLACEHOLDER) {
            return push_character(&mut self.out, cell);
        }
        self.out.extend_from_slice(WRAP);
        let is_narrow = push_character(&mut self.out, cell);
        self.out.extend_from_slice(DO_NOT_WRAP);
        is_narrow
    }

    fn put(&mut self, at: Position, cell: &Cell) {
        let fg = self.depth.ink(cell.fg);
        let bg = self.depth.ink(cell.bg);
        let halves = Halves::of(cell, fg, bg);
        let is_last = at.x + 1 == self.size.width;
        self.blank_wide(at);
        if halves.is_none() && is_wide(cell) {
            self.blank_wide(Position { x: at.x + 1, ..at });
            self.wide.insert((at.y, at.x));
        }
        self.move_to(at);
        let is_narrow = if let Some(halves) = halves {
            let (glyph, style) = halves.cheapest(&self.pen);
            self.pen.apply(&style, &mut self.out);
            self.out.extend_from_slice(glyph.as_bytes());
            true
        } else {
            let style = Style::exactly(fg, bg, cell.modifier);
            self.pen.apply(&style, &mut self.out);
            self.put_character(cell, is_last)
        };
        self.place = if is_narrow && !is_last {
            CursorPosition::At(Position::new(at.x + 1, at.y))
        } else {
            CursorPosition::Row(at.y)
        };
    }
}

impl Backend for AnsiBackend {
    type Error = Infallible;

    fn draw<'a, I>(&mut self, content: I) -> Result<(), Infallible>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        for (x, y, cell) in content {
            self.put(Position { x, y }, cell);
        }
        Ok(())
    }

    fn hide_cursor(&mut self) -> Result<(), Infallible> {
        if self.is_shown.replace(false) != Some(false) {
            self.out.extend_from_slice(b"\x1b[?25l");
        }
        Ok(())
    }

    fn show_cursor(&mut self) -> Result<(), Infallible> {
        if self.is_shown.replace(true) != Some(true) {
            self.out.extend_from_slice(b"\x1b[?25h");
        }
        Ok(())
    }

    fn get_cursor_position(&mut self) -> Result<Position, Infallible> {
        Ok(match self.place {
            CursorPosition::At(at) => at,
            CursorPosition::Row(y) => Position { x: 0, y },
            CursorPosition::Unknown => Position::ORIGIN,
        })
    }

    fn set_cursor_position<P: Into<Position>>(&mut self, position: P) -> Result<(), Infallible> {
        self.move_to(position.into());
        Ok(())
    }

    fn clear(&mut self) -> Result<(), Infallible> {
        self.clear_region(ClearType::All)
    }

    fn clear_region(&mut self, region: ClearType) -> Result<(), Infallible> {
        // Cleared cells take the background of the pen.
        self.pen.reset(&mut self.out);
        self.out.extend_from_slice(match region {
            ClearType::All => b"\x1b[2J",
            ClearType::AfterCursor => b"\x1b[J",
            ClearType::BeforeCursor => b"\x1b[1J",
            ClearType::CurrentLine => b"\x1b[2K",
            ClearType::UntilNewLine => b"\x1b[K",
        });
        Ok(())
    }

    fn size(&self) -> Result<Size, Infallible> {
        Ok(self.size)
    }

    fn window_size(&mut self) -> Result<WindowSize, Infallible> {
        Ok(WindowSize {
            columns_rows: self.size,
            pixels: Size::default(),
        })
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// A cell that consists of a uniform upper and lower half.
#[derive(Clone, Copy, Debug)]
struct Halves {
    upper: Tone,
    lower: Tone,
    /// Whether the cell has no block character. It gets none: their width is ambiguous.
    is_blank: bool,
}

/// A visible colour, as the foreground or the background that shows it. The terminal's default
/// foreground and background are neither equal nor interchangeable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Tone {
    as_foreground: Option<Ink>,
    as_background: Option<Ink>,
}

impl Halves {
    fn of(cell: &Cell, fg: Ink, bg: Ink) -> Option<Self> {
        let fg = Tone {
            as_foreground: Some(fg),
            as_background: Some(fg).filter(|ink| *ink != Ink::Default),
        };
        let bg = Tone {
            as_foreground: Some(bg).filter(|ink| *ink != Ink::Default),
            as_background: Some(bg),
        };
        let (upper, lower, visible) = match cell.symbol() {
            " " => (bg, bg, VISIBLE_ON_BLANK),
            "▀" => (fg, bg, Modifier::all()),
            "▄" => (bg, fg, Modifier::all()),
            "█" => (fg, fg, Modifier::all()),
            _ => return None,
        };
        (!cell.modifier.intersects(visible)).then_some(Self {
            upper,
            lower,
            is_blank: cell.symbol() == " ",
        })
    }

    /// Returns the character and style that show these halves with the fewest bytes.
    fn cheapest(self, pen: &Pen) -> (&'static str, Style) {
        let (upper, lower) = (self.upper, self.lower);
        let candidates = if upper == lower {
            let solid = upper.as_foreground.filter(|_| !self.is_blank);
            [
                upper.as_background.map(|bg| (" ", Style::blank(bg))),
                solid.map(|fg| ("█", Style::solid(fg))),
            ]
        } else {
            [("▀", upper, lower), ("▄", lower, upper)].map(|(glyph, fg, bg)| {
                let (fg, bg) = (fg.as_foreground?, bg.as_background?);
                Some((glyph, Style::exactly(fg, bg, Modifier::empty())))
            })
        };
        let cost = |(glyph, style): &(&str, Style)| glyph.len() + pen.colour_cost(style);
        let cheapest = candidates.into_iter().flatten().min_by_key(cost);
        cheapest.expect("the form the cell came in is one of the candidates")
    }
}

/// Whether the character of a cell takes two columns.
fn is_wide(cell: &Cell) -> bool {
    let first = cell.symbol().chars().next();
    first.and_then(UnicodeWidthChar::width) == Some(2)
}

/// Writes the printable part of a cell, padded with blanks to its width. Returns whether that is one
/// column for sure: terminals differ on the width of other texts.
fn push_character(out: &mut Vec<u8>, cell: &Cell) -> bool {
    let symbol = cell.symbol();
    if let [byte @ b' '..=b'~'] = symbol.as_bytes() {
        out.push(*byte);
        return true;
    }
    let mut characters = symbol.chars();
    let base = match characters.next() {
        Some(character) if character.is_control() => '\u{fffd}',
        Some(character) if character.width().is_some_and(|width| width != 0) => character,
        _ => ' ',
    };
    let most = match base {
        '\u{fffd}' => 0,
        PLACEHOLDER => MARKS,
        _ => 1,
    };
    let mut push = |character: char| {
        out.extend_from_slice(character.encode_utf8(&mut [0; 4]).as_bytes());
    };
    push(base);
    let mut is_plain = true;
    for mark in characters.take(most).take_while(|&next| is_mark(next)) {
        push(mark);
        is_plain = base == PLACEHOLDER;
    }
    let width = base.width().map_or(1, |width| width as u16);
    // A lone control character has no defined width.
    let room = if symbol.len() < 2 {
        1
    } else {
        cell.cell_width().max(1)
    };
    for _ in width..room {
        out.push(b' ');
    }
    // Whoever shows placeholders agrees on their width.
    width == 1 && room == 1 && is_plain
}

/// Distinguishes accents and the like from invisible characters that join, direct or modify others.
fn is_mark(character: char) -> bool {
    let invisible = matches!(
        character,
        '\u{34f}' | '\u{61c}' | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{fe00}'..='\u{fe0f}'
            | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e0fff}'
    );
    character.width() == Some(0) && !character.is_control() && !invisible
}

#[cfg(test)]
mod tests;
