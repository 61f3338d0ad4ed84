//! The lines of the header of a `.ply` file.

use super::super::lines::{Place, Spot, Word};

/// The lines of a header. All end as the first does: the values behind the last one may begin with any
/// bytes.
pub(super) struct Lines<'t> {
    bytes: &'t [u8],
    end: u8,
    /// Where the next line begins.
    pub(super) next: Place,
}

impl<'t> Lines<'t> {
    /// The lines of a file.
    pub(super) fn of(bytes: &'t [u8]) -> Self {
        let is_end = |byte: &&u8| matches!(**byte, b'\n' | b'\r');
        let first = bytes.iter().position(|byte| is_end(&byte));
        let end = first.map_or(b'\n', |at| match bytes[at..] {
            [b'\r', ref rest @ ..] if rest.first() != Some(&b'\n') => b'\r',
            _ => b'\n',
        });
        Self {
            bytes,
            end,
            next: Place { line: 1, at: 0 },
        }
    }
}

impl Lines<'_> {
    /// The number of the line that a byte is on, from 1.
    pub(super) fn line_of(&self, at: usize) -> usize {
        let lines = self.bytes[..at].split(|byte| *byte == self.end);
        lines.count()
    }
}

impl<'t> Iterator for Lines<'t> {
    type Item = (Place, &'t [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let start = self.next;
        let rest = self.bytes.get(start.at..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|&byte| byte == self.end);
        let length = length.unwrap_or(rest.len());
        self.next = Place {
            line: start.line + usize::from(length < rest.len()),
            at: self.bytes.len().min(start.at + length + 1),
        };
        Some((start, rest[..length].trim_ascii_end()))
    }
}

/// A line of a header.
pub(super) struct Line<'t> {
    start: Place,
    text: &'t [u8],
}

impl<'t> Line<'t> {
    pub(super) fn new(start: Place, text: &'t [u8]) -> Self {
        Self { start, text }
    }

    /// A word by its number; the empty place behind the line if there are fewer.
    pub(super) fn word(&self, number: usize) -> Word<'t> {
        let words = self.text.split(u8::is_ascii_whitespace);
        let mut words = words.filter(|word| !word.is_empty());
        let text = words.nth(number);
        let text = text.unwrap_or_else(|| &self.text[self.text.len()..]);
        let offset = text.as_ptr() as usize - self.text.as_ptr() as usize;
        Word {
            text,
            place: Spot::from(Place {
                at: self.start.at + offset,
                ..self.start
            }),
        }
    }
}
