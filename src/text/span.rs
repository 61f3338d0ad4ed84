//! Byte ranges of a text, and lines and columns.

use std::ops::Range;

use super::lines::{ends_before, line_start};

/// A half-open range of bytes in a text. Scene files are smaller than 4 GiB, so that a span takes
/// eight bytes, which matters in scenes of a million objects.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    start: u32,
    end: u32,
}

impl Span {
    /// The span `start..end`, in bytes; `end` must not be less than `start`.
    pub fn new(start: usize, end: usize) -> Self {
        debug_assert!(start <= end, "a span ends at or after its start");
        Self {
            start: start as u32,
            end: end as u32,
        }
    }

    /// The empty span at an offset, where something is missing.
    pub fn at(offset: usize) -> Self {
        Self::new(offset, offset)
    }

    /// Moves the span by a number of bytes towards the end.
    #[must_use]
    pub fn shifted(self, bytes: usize) -> Self {
        Self::new(self.start() + bytes, self.end() + bytes)
    }

    /// The offset of the first byte.
    pub fn start(self) -> usize {
        self.start as usize
    }

    /// The offset after the last byte.
    pub fn end(self) -> usize {
        self.end as usize
    }

    /// The length in bytes.
    pub fn len(self) -> usize {
        self.end() - self.start()
    }

    /// Whether the span is empty.
    pub fn is_empty(self) -> bool {
        self.start == self.end
    }

    /// The span as a range of indices.
    pub fn range(self) -> Range<usize> {
        self.start()..self.end()
    }

    /// The part of `text` in the span, which must have been made for that text.
    pub fn of(self, text: &str) -> &str {
        &text[self.range()]
    }

    /// The smallest span that covers both spans.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// Whether the spans overlap or are adjacent.
    pub fn touches(self, other: Self) -> bool {
        self.start <= other.end && other.start <= self.end
    }
}

/// A human-readable position: line and column, both from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1. Lines end at `\n`, with all `\r` directly before it, or at any other `\r`.
    pub line: usize,
    /// Column, from 1, in characters (`char`s); a byte order mark does not count.
    pub column: usize,
}

impl Position {
    /// The position of a byte offset; offsets past the end are clamped. Reads the text up to the
    /// offset.
    pub fn of(text: &str, offset: usize) -> Self {
        let before = &text.as_bytes()[..offset.min(text.len())];
        let line_start = line_start(text, before.len());
        let line_start = line_start.max(mark_len(text).min(before.len()));
        let line = ends_before(text.as_bytes(), before.len()) + 1;
        // UTF-8 continuation bytes start no character.
        let column = before[line_start..]
            .iter()
            .filter(|&&b| b & 0xC0 != 0x80)
            .count()
            + 1;
        Self { line, column }
    }
}

/// The length in bytes of the byte order mark at the start of a text; 0 if there is none.
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
    fn a_byte_order_mark_does_not_count_as_a_column() {
        let text = "\u{FEFF}ab\n\u{FEFF}c";
        let columns = [0, 3, 4, 5, 9].map(|offset| Position::of(text, offset).column);
        assert_eq!(columns, [1, 1, 2, 3, 2]);
    }
}
