//! Splits `.obj` and `.mtl` files into statements and words.

use std::borrow::Cow;
use std::ops::Range;
use std::str;

use text::{NumberError, parse_number, visible};

/// The greatest magnitude of a coordinate: boxes around such points have finite sizes.
pub(super) const MOST: f64 = f64::MAX / 4.0;

/// A statement: a line, or several lines of which all except the last end in `\`.
#[derive(Clone, Debug)]
pub(super) struct Statement<'t> {
    text: Cow<'t, [u8]>,
    /// Where it begins.
    start: Place,
    /// The number of its further lines.
    joints: usize,
}

/// A place in a file.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Place {
    /// The line, from 1.
    pub(super) line: usize,
    /// The offset in bytes.
    pub(super) at: usize,
}

/// A place in a statement. Its line is only looked for when it is asked for: a list of all lines would
/// take several times the memory of a statement of millions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// Where the statement begins, and the number of its further lines.
    start: Place,
    joints: usize,
    /// The offset in its text.
    offset: usize,
}

/// A word of a statement, or the empty place of one that is missing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'s> {
    pub(super) text: &'s [u8],
    /// The place of the first byte.
    pub(super) place: Spot,
}

/// The lines of a text. They end at a line feed, including all carriage returns directly before it,
/// or at any other carriage return.
pub(super) struct Lines<'t> {
    bytes: &'t [u8],
    /// Where the next line begins.
    next: Place,
    end: usize,
}

impl<'t> Lines<'t> {
    /// The lines of a text from a place on.
    pub(super) fn new(bytes: &'t [u8], next: Place) -> Self {
        let end = bytes.len();
        Self { bytes, next, end }
    }

    /// The number of bytes that are left.
    pub(super) fn rest(&self) -> usize {
        self.end.saturating_sub(self.next.at)
    }
}

/// The non-blank statements in a range of a file, whose first line has number `line`.
pub(super) fn statements(
    bytes: &[u8],
    range: Range<usize>,
    line: usize,
) -> impl Iterator<Item = Statement<'_>> {
    let mut lines = Lines {
        bytes,
        next: Place {
            line,
            at: range.start,
        },
        end: range.end,
    };
    std::iter::from_fn(move || {
        let (start, first) = lines.next()?;
        let mut text = Cow::Borrowed(first);
        let mut joints = 0;
        let mut scanned = 0;
        while text.ends_with(b"\\") && !has_comment(&text, scanned) {
            scanned = text.len() - 1;
            let whole = text.to_mut();
            whole.pop();
            // Blank lines are not returned, but end a statement.
            if start.line + joints + 1 != lines.next.line {
                break;
            }
            let Some((_, next)) = lines.next() else {
                break;
            };
            joints += 1;
            whole.extend_from_slice(next);
        }
        Some(Statement {
            text,
            start,
            joints,
        })
    })
    .filter(|statement| !statement.text.is_empty())
}

/// The number of line ends in a text.
pub(super) fn line_ends(bytes: &[u8]) -> usize {
    let mut lines = Lines::new(bytes, Place::default());
    lines.by_ref().for_each(drop);
    lines.next.line
}

/// Whether a comment begins in a text, not before `from`.
fn has_comment(text: &[u8], from: usize) -> bool {
    let is_start = |at: usize| {
        let before = at.checked_sub(1).map(|before| text[before]);
        text[at] == b'#' && before.is_none_or(|before| before.is_ascii_whitespace())
    };
    (from..text.len()).any(is_start)
}

impl<'t> Iterator for Lines<'t> {
    type Item = (Place, &'t [u8]);

    /// The next line without blanks at its end. Several carriage returns count as line ends, but the
    /// blank lines between them are not returned.
    fn next(&mut self) -> Option<Self::Item> {
        let Place { line, at } = self.next;
        let rest = self
            .bytes
            .get(at..self.end)
            .filter(|rest| !rest.is_empty())?;
        let is_end = |&byte: &u8| byte == b'\n' || byte == b'\r';
        let length = rest.iter().position(is_end).unwrap_or(rest.len());
        let (text, after) = rest.split_at(length);
        let returns = after.iter().take_while(|&&byte| byte == b'\r').count();
        let (ends, skipped) = match after.get(returns) {
            Some(b'\n') => (1, returns + 1),
            _ => (returns, returns),
        };
        self.next = Place {
            line: line + ends,
            at: at + length + skipped,
        };
        Some((Place { line, at }, text.trim_ascii_end()))
    }
}

impl Statement<'_> {
    /// The words, without a comment at the end.
    pub(super) fn words(&self) -> impl Iterator<Item = Word<'_>> {
        self.text
            .split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty())
            .take_while(|word| !word.starts_with(b"#"))
            .map(|text| self.word(text))
    }

    /// The first word; empty if there is none.
    pub(super) fn keyword(&self) -> Word<'_> {
        self.words().next().unwrap_or_else(|| self.end())
    }

    /// Everything after the first word up to a comment: a name may contain blanks.
    pub(super) fn rest(&self) -> Word<'_> {
        let text = self.text.trim_ascii_start();
        let keyword = text.iter().take_while(|byte| !byte.is_ascii_whitespace());
        let after = text[keyword.count()..].trim_ascii_start();
        let comment = after
            .windows(2)
            .position(|pair| pair[0].is_ascii_whitespace() && pair[1] == b'#');
        let end = match (after.first(), comment) {
            (Some(b'#'), _) => 0,
            (_, Some(blank)) => blank,
            _ => after.len(),
        };
        self.word(after[..end].trim_ascii_end())
    }

    /// Everything from the start of one word to the end of another.
    pub(super) fn between(&self, first: Word<'_>, last: Word<'_>) -> Word<'_> {
        let at = |word: Word<'_>| word.text.as_ptr() as usize - self.text.as_ptr() as usize;
        self.word(&self.text[at(first)..at(last) + last.text.len()])
    }

    /// The place after the end, for messages about missing words.
    pub(super) fn end(&self) -> Word<'_> {
        self.word(&self.text[self.text.len()..])
    }

    /// The number of its last line, from 1.
    pub(super) fn last_line(&self) -> usize {
        self.start.line + self.joints
    }

    /// A part of the text with its place in the file.
    fn word<'s>(&self, text: &'s [u8]) -> Word<'s> {
        let at = text.as_ptr() as usize - self.text.as_ptr() as usize;
        let place = Spot {
            start: self.start,
            joints: self.joints,
            offset: at,
        };
        Word { text, place }
    }
}

impl Spot {
    /// Its line and offset in the file with these bytes. Reads the lines of its statement.
    pub(super) fn place(self, bytes: &[u8]) -> Place {
        let mut lines = Lines::new(bytes, self.start);
        let mut line = self.start;
        let mut offset = self.offset;
        for _ in 0..self.joints {
            // A line that goes on gives all but its `\`.
            let length = lines.next().map_or(0, |(_, text)| text.len() - 1);
            if offset < length {
                break;
            }
            offset -= length;
            line = lines.next;
        }
        Place {
            line: line.line,
            at: line.at + offset,
        }
    }
}

impl From<Place> for Spot {
    fn from(start: Place) -> Self {
        Self {
            start,
            joints: 0,
            offset: 0,
        }
    }
}

impl Word<'_> {
    /// The text, shortened and escaped for printing.
    pub(super) fn shown(&self) -> String {
        let text = String::from_utf8_lossy(&self.text[..self.text.len().min(40)]);
        visible(&text).into_owned()
    }

    /// The text as a name.
    pub(super) fn name(&self) -> String {
        String::from_utf8_lossy(self.text).into_owned()
    }

    /// Whether this begins a comment as other languages write it.
    pub(super) fn begins_foreign_comment(&self) -> bool {
        self.text.starts_with(b"//")
    }

    /// Parses a number.
    pub(super) fn number(&self) -> Result<f64, Fault> {
        let number = str::from_utf8(self.text).map_err(|_| NumberError::NotANumber);
        match number.and_then(parse_number) {
            Ok(number) => Ok(number),
            Err(NumberError::NotANumber) => Err(self.no_number("is not a number")),
            Err(NumberError::Overflow) => Err(self.no_number("is too large")),
        }
    }

    /// Parses a number whose magnitude is at most [`MOST`].
    pub(super) fn coordinate(&self) -> Result<f64, Fault> {
        let number = self.number()?;
        if MOST < number.abs() {
            return Err(self.no_number("is too large"));
        }
        Ok(number)
    }

    fn no_number(&self, message: &str) -> Fault {
        let message = format!("`{}` {message}", self.shown());
        Fault::new(*self, message, "a number")
    }
}

/// What is wrong with a statement.
pub(super) struct Fault {
    /// The place of the offending word.
    pub(super) place: Spot,
    /// The length of the word in bytes.
    pub(super) length: usize,
    pub(super) message: String,
    /// What was expected instead.
    pub(super) expected: String,
    /// What it costs; may be empty.
    pub(super) cost: &'static str,
}

impl Fault {
    pub(super) fn new(
        word: Word<'_>,
        message: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self {
            place: word.place,
            length: word.text.len(),
            message: message.into(),
            expected: expected.into(),
            cost: "",
        }
    }

    /// A comment as other languages write it.
    pub(super) fn foreign_comment(word: Word<'_>) -> Self {
        let message = format!("`{}` is not a comment here", word.shown());
        Self::new(word, message, "comments begin with #").costing("the rest of the line is ignored")
    }

    /// Adds what it costs.
    pub(super) fn costing(self, cost: &'static str) -> Self {
        Self { cost, ..self }
    }

    /// Puts the keyword of the statement before the message.
    pub(super) fn in_statement(self, statement: &Statement<'_>) -> Self {
        let message = format!("{}: {}", statement.keyword().shown(), self.message);
        Self { message, ..self }
    }
}
