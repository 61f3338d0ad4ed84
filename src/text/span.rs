//! Byte ranges of a text and the line and column they stand at.

use std::ops::Range;

use super::lines::{ends_before, line_start};

/// A half-open range of bytes of one text. Scene files are under 4 GiB, so that a span of a
/// million-object scene costs eight bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    start: u32,
    end: u32,
}

impl Span {
    /// Covers `start..end`, in bytes. The end must not come before the start.
    pub fn new(start: usize, end: usize) -> Self {
        debug_assert!(start <= end, "a span ends at or after its start");
        Self {
            start: start as u32,
            end: end as u32,
        }
    }

    /// The empty span at one place: where something is missing.
    pub fn at(offset: usize) -> Self {
        Self::new(offset, offset)
    }

    /// The same bytes of a text that has so many more before them.
    #[must_use]
    pub fn later(self, bytes: usize) -> Self {
        Self::new(self.start() + bytes, self.end() + bytes)
    }

    /// The first byte.
    pub fn start(self) -> usize {
        self.start as usize
    }

    /// One past the last byte.
    pub fn end(self) -> usize {
        self.end as usize
    }

    /// Length in bytes.
    pub fn len(self) -> usize {
        self.end() - self.start()
    }

    /// Whether it covers no byte.
    pub fn is_empty(self) -> bool {
        self.start == self.end
    }

    /// The same range, to index a text with.
    pub fn range(self) -> Range<usize> {
        self.start()..self.end()
    }

    /// The covered part of `text`; the text must be the one the span was made for.
    pub fn of(self, text: &str) -> &str {
        &text[self.range()]
    }

    /// The smallest span that covers both.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// Whether the two share a byte, or one is empty and touches the other.
    pub fn touches(self, other: Self) -> bool {
        self.start <= other.end && other.start <= self.end
    }
}

/// A place as people count it: line and column from 1, the column in characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1. Lines end at `\n`, with all `\r` directly before it, or at any other `\r`.
    pub line: usize,
    /// Column, from 1, in characters (`char`s) of the line; a byte order mark is none of them.
    pub column: usize,
}

impl Position {
    /// The position of a byte offset; an offset past the end counts as the end. Reads the text up
    /// to the offset.
    pub fn of(text: &str, offset: usize) -> Self {
        let before = &text.as_bytes()[..offset.min(text.len())];
        let line_start = line_start(text, before.len());
        let line_start = line_start.max(mark_len(text).min(before.len()));
        let line = ends_before(text.as_bytes(), before.len()) + 1;
        // A UTF-8 continuation byte begins no character.
        let column = before[line_start..]
            .iter()
            .filter(|&&b| b & 0xC0 != 0x80)
            .count()
            + 1;
        Self { line, column }
    }
}

/// Length of the byte order mark that a text begins with, in bytes; 0 where it begins with none.
pub fn mark_len(text: &str) -> usize {
    const MARK: char = '\u{FEFF}';
    if text.starts_with(MARK) {
        MARK.len_utf8()
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_lines_and_characters_from_one() {
        let text = "ab\nçd\r\n";
        let positions: Vec<_> = [0, 2, 3, 5, 8, 99]
            .map(|offset| Position::of(text, offset))
            .iter()
            .map(|p| (p.line, p.column))
            .collect();
        assert_eq!(positions, [(1, 1), (1, 3), (2, 1), (2, 2), (3, 1), (3, 1)]);
    }

    #[test]
    fn a_byte_order_mark_is_not_a_character_of_its_line() {
        let text = "\u{FEFF}ab\n\u{FEFF}c";
        let columns = [0, 3, 4, 5, 9].map(|offset| Position::of(text, offset).column);
        assert_eq!(columns, [1, 1, 2, 3, 2]);
    }
}
