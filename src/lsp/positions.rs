//! Offsets in a text as lines and characters, counted as the client counts.

use serde_json::{Value, json};
use text::{Edit, Span, line_end};

/// What a client counts as one character.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Encoding {
    /// Bytes.
    Utf8,
    /// Code units of UTF-16, what all clients know.
    #[default]
    Utf16,
    /// Characters.
    Utf32,
}

impl Encoding {
    /// Its name in the protocol.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Utf8 => "utf-8",
            Self::Utf16 => "utf-16",
            Self::Utf32 => "utf-32",
        }
    }

    /// The encoding to use with a client that knows these: bytes if possible.
    pub(crate) fn of_client(known: &Value) -> Self {
        let names = known.as_array().map_or(&[][..], Vec::as_slice);
        let knows = |encoding: &Self| names.iter().any(|name| name == encoding.name());
        let found = [Self::Utf8, Self::Utf32].into_iter().find(knows);
        found.unwrap_or_default()
    }

    /// The length of a text without line ends, in bytes of UTF-8, of which each character is counted at
    /// its first.
    pub(crate) fn length(self, text: &[u8]) -> usize {
        let begins = |byte: &&u8| **byte & 0xC0 != 0x80;
        let begins_pair = |byte: &&u8| 0xF0 <= **byte;
        match self {
            Self::Utf8 => text.len(),
            Self::Utf16 => {
                text.iter().filter(begins).count() + text.iter().filter(begins_pair).count()
            }
            Self::Utf32 => text.iter().filter(begins).count(),
        }
    }

    /// The offset of a character of a line; within a character, its start; its end beyond the last.
    fn offset(self, line: &str, character: usize) -> usize {
        let mut left = character;
        for (at, c) in line.char_indices() {
            let length = match self {
                Self::Utf8 => c.len_utf8(),
                Self::Utf16 => c.len_utf16(),
                Self::Utf32 => 1,
            };
            if left < length {
                return at;
            }
            left -= length;
        }
        line.len()
    }
}

/// The number of bytes whose characters are counted together, since lines may be long.
const BLOCK: usize = 1024;

/// Where the line behind that of an offset begins, if there is one.
fn next_line(text: &str, at: usize) -> Option<usize> {
    let end = line_end(text, at);
    let length = match &text.as_bytes()[end..] {
        [] => return None,
        [b'\r', b'\n', ..] => 2,
        _ => 1,
    };
    Some(end + length)
}

/// Where the lines of a text begin. CR LF, LF and CR end a line, as in the protocol.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lines {
    starts: Vec<u32>,
    /// Whether all characters are one byte, so that none need be counted.
    is_ascii: bool,
    /// The lengths in UTF-16 and UTF-32 of the text before each block, and of all of it; empty for ASCII.
    before: Vec<[u32; 2]>,
}

impl Lines {
    pub(crate) fn of(text: &str) -> Self {
        let mut starts = vec![0];
        let mut at = 0;
        let is_ascii = text.is_ascii();
        let mut before = Vec::new();
        let mut sums = [0; 2];
        for block in text.as_bytes().chunks(BLOCK).filter(|_| !is_ascii) {
            before.push(sums);
            let lengths = [Encoding::Utf16, Encoding::Utf32].map(|of| of.length(block) as u32);
            sums = [sums[0] + lengths[0], sums[1] + lengths[1]];
        }
        before.extend((!is_ascii).then_some(sums));
        while let Some(next) = next_line(text, at) {
            at = next;
            starts.push(at as u32);
        }
        Self {
            starts,
            is_ascii,
            before,
        }
    }

    /// Follows an edit, given the text after it: lines that it leaves as they are only move.
    pub(crate) fn follow(&mut self, text: &str, edit: &Edit) {
        if !self.is_ascii || !edit.text.is_ascii() {
            *self = Self::of(text);
            return;
        }
        // The edit may join or divide CR LF.
        let first = self.line(edit.span.start().saturating_sub(1));
        let moved = |start: &u32| start - edit.span.len() as u32 + edit.text.len() as u32;
        let behind = self.line(edit.span.end()) + 1;
        let mut rest = self.starts.split_off(behind).into_iter().peekable();
        self.starts.truncate(first + 1);
        let mut at = self.starts[first] as usize;
        while let Some(next) = next_line(text, at) {
            at = next;
            while rest.next_if(|start| (moved(start) as usize) < at).is_some() {}
            if rest.peek().is_some_and(|start| moved(start) as usize == at) {
                break;
            }
            self.starts.push(at as u32);
        }
        self.starts.extend(rest.map(|start| moved(&start)));
    }

    /// The number of the line that an offset is on, from 0.
    pub(crate) fn line(&self, at: usize) -> usize {
        self.starts.partition_point(|start| *start as usize <= at) - 1
    }

    /// A line without its end.
    fn text<'t>(&self, text: &'t str, line: usize) -> (usize, &'t str) {
        let start = self.starts[line] as usize;
        let next = self.starts.get(line + 1);
        let end = next.map_or(text.len(), |next| *next as usize);
        (start, text[start..end].trim_end_matches(['\r', '\n']))
    }

    /// The offset of a position: the end of the line if that is shorter, the end of the text if it has
    /// fewer lines.
    pub(crate) fn offset(&self, text: &str, position: &Value, encoding: Encoding) -> Option<usize> {
        let number = |key: &str| position.get(key)?.as_u64();
        let (line, character) = (number("line")?, number("character")?);
        let Some(line) = usize::try_from(line)
            .ok()
            .filter(|line| *line < self.starts.len())
        else {
            return Some(text.len());
        };
        let (start, own) = self.text(text, line);
        let character = usize::try_from(character).unwrap_or(usize::MAX);
        let within = if self.is_ascii {
            character.min(own.len())
        } else {
            encoding.offset(own, character)
        };
        Some(start + within)
    }

    /// The position of an offset.
    pub(crate) fn position(&self, text: &str, at: usize, encoding: Encoding) -> Value {
        let line = self.line(at);
        let (start, own) = self.text(text, line);
        let end = at.min(start + own.len());
        let [end, start] = [end, start].map(|at| self.length(text, at, encoding));
        let character = end - start;
        json!({ "line": line, "character": character })
    }

    /// The length of a text up to an offset.
    fn length(&self, text: &str, at: usize, encoding: Encoding) -> usize {
        let column = match encoding {
            Encoding::Utf16 => 0,
            Encoding::Utf32 => 1,
            Encoding::Utf8 => return at,
        };
        let block = at / BLOCK;
        match self.before.get(block) {
            Some(before) => {
                let rest = &text.as_bytes()[block * BLOCK..at];
                before[column] as usize + encoding.length(rest)
            }
            None => at,
        }
    }

    /// The range of a span.
    pub(crate) fn range(&self, text: &str, span: Span, encoding: Encoding) -> Value {
        let [start, end] = [span.start(), span.end()].map(|at| self.position(text, at, encoding));
        json!({ "start": start, "end": end })
    }

    /// The span of a range.
    pub(crate) fn span(&self, text: &str, range: &Value, encoding: Encoding) -> Option<Span> {
        let at = |key: &str| self.offset(text, range.get(key)?, encoding);
        let (start, end) = (at("start")?, at("end")?);
        (start <= end).then(|| Span::new(start, end))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Encoding; 3] = [Encoding::Utf8, Encoding::Utf16, Encoding::Utf32];

    fn at(line: u64, character: u64) -> Value {
        json!({ "line": line, "character": character })
    }

    #[test]
    fn positions_are_counted_as_the_client_counts() {
        // A mark, a tab, a character of two code units, line ends of all kinds.
        let text = "\u{FEFF}a\té\u{1F600}b\r\nc\r\rd\n";
        let lines = Lines::of(text);
        let b = text.find('b').expect("it is there");
        for (encoding, line, character, offset) in [
            (Encoding::Utf8, 0, 11, b),
            (Encoding::Utf16, 0, 6, b),
            (Encoding::Utf32, 0, 5, b),
            // Within a character, and past the end of a line.
            (Encoding::Utf16, 0, 5, b - 4),
            (Encoding::Utf8, 0, 8, b - 4),
            (Encoding::Utf16, 0, 99, b + 1),
            (Encoding::Utf16, 1, 1, b + 4),
            (Encoding::Utf16, 2, 0, b + 5),
            (Encoding::Utf16, 3, 0, b + 6),
            (Encoding::Utf16, 4, 0, text.len()),
            (Encoding::Utf16, 99, 3, text.len()),
        ] {
            assert_eq!(
                lines.offset(text, &at(line, character), encoding),
                Some(offset),
                "{encoding:?} {line}:{character}"
            );
        }
        assert_eq!(
            lines.offset(text, &json!({ "line": 1 }), Encoding::Utf16),
            None
        );
        for encoding in ALL {
            for (offset, _) in text.char_indices().filter(|(_, c)| !"\r\n".contains(*c)) {
                let position = lines.position(text, offset, encoding);
                assert_eq!(lines.offset(text, &position, encoding), Some(offset));
            }
        }
    }

    #[test]
    fn positions_in_long_lines_are_those_of_their_characters() {
        // Some end where a block does, some blocks within a character.
        for count in [128, 147, 1000] {
            let text = "é\u{1F600}ab".repeat(count);
            let lines = Lines::of(&text);
            for encoding in ALL {
                for (at, _) in text.char_indices().chain([(text.len(), ' ')]) {
                    let characters = text[..at].chars();
                    let expected: usize = match encoding {
                        Encoding::Utf8 => at,
                        Encoding::Utf16 => characters.map(char::len_utf16).sum(),
                        Encoding::Utf32 => characters.count(),
                    };
                    let position = lines.position(&text, at, encoding);
                    assert_eq!(position["character"], expected, "{count} {at} {encoding:?}");
                }
            }
        }
    }

    #[test]
    fn the_best_encoding_that_the_client_knows_is_used() {
        for (known, expected) in [
            (json!(null), Encoding::Utf16),
            (json!(["utf-16"]), Encoding::Utf16),
            (json!(["utf-16", "utf-32"]), Encoding::Utf32),
            (json!(["utf-16", "utf-8"]), Encoding::Utf8),
            (json!([3, "ucs-2"]), Encoding::Utf16),
        ] {
            assert_eq!(Encoding::of_client(&known), expected, "{known}");
        }
    }
}
