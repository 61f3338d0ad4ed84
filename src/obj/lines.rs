//! Splits `.obj` and `.mtl` files into statements and words.

use std::borrow::Cow;
use std::str;

use super::{Finding, MAX_FINDINGS};
use crate::text::{NumberError, parse_number, visible};

/// A statement: a line, or several lines of which all except the last end in `\`.
#[derive(Clone, Debug)]
pub(super) struct Statement<'t> {
    /// The number of the first line, from 1.
    pub(super) line: usize,
    text: Cow<'t, [u8]>,
}

/// A word of a statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'s> {
    pub(super) text: &'s [u8],
    /// The column of the first byte, in bytes from 1.
    pub(super) column: usize,
}

/// The non-blank statements of a text whose first line has number `line`.
pub(super) fn statements(bytes: &[u8], line: usize) -> impl Iterator<Item = Statement<'_>> {
    let mut lines = bytes.split(|&byte| byte == b'\n').zip(line..);
    std::iter::from_fn(move || {
        let (first, line) = lines.next()?;
        let mut text = Cow::Borrowed(first.trim_ascii_end());
        while text.ends_with(b"\\") {
            let whole = text.to_mut();
            whole.pop();
            match lines.next() {
                Some((next, _)) => whole.extend_from_slice(next.trim_ascii_end()),
                None => break,
            }
        }
        Some(Statement { line, text })
    })
    .filter(|statement| !statement.text.is_empty())
}

impl Statement<'_> {
    /// The words, without a comment at the end.
    pub(super) fn words(&self) -> impl Iterator<Item = Word<'_>> {
        let start = self.text.as_ptr() as usize;
        self.text
            .split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty())
            .take_while(|word| !word.starts_with(b"#"))
            .map(move |text| Word {
                text,
                column: 1 + (text.as_ptr() as usize - start),
            })
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
        Word {
            text: after[..end].trim_ascii_end(),
            column: 1 + self.text.len() - after.len(),
        }
    }

    /// The column after the end, for errors about missing words.
    pub(super) fn end(&self) -> usize {
        1 + self.text.len()
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

    /// Parses a number.
    pub(super) fn number(&self) -> Result<f64, Fault> {
        let number = str::from_utf8(self.text).map_err(|_| NumberError::NotANumber);
        match number.and_then(parse_number) {
            Ok(number) => Ok(number),
            Err(NumberError::NotANumber) => Err(self.fault("is not a number")),
            Err(NumberError::Overflow) => Err(self.fault("is too large")),
        }
    }

    /// An error in this word, which the message begins with.
    fn fault(&self, message: &str) -> Fault {
        Fault::new(self.column, format!("`{}` {message}", self.shown()))
    }
}

/// An error in a statement.
pub(super) struct Fault {
    /// The column, in bytes from 1.
    pub(super) column: usize,
    pub(super) message: String,
}

impl Fault {
    pub(super) fn new(column: usize, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { column, message }
    }
}

/// The errors and warnings of a text.
#[derive(Debug, Default)]
pub(super) struct Findings {
    /// The library being read; `None` for the mesh itself.
    pub(super) library: Option<String>,
    pub(super) errors: Vec<Finding>,
    pub(super) warnings: Vec<Finding>,
}

impl Findings {
    /// Adds an error; line and column count from 1.
    pub(super) fn error(&mut self, line: usize, column: usize, message: impl Into<String>) {
        let finding = self.finding(line, column, message.into());
        self.errors.push(finding);
    }

    /// Adds a warning, unless there are [`MAX_FINDINGS`] already.
    pub(super) fn warn(&mut self, line: usize, column: usize, message: impl Into<String>) {
        if self.warnings.len() < MAX_FINDINGS {
            let finding = self.finding(line, column, message.into());
            self.warnings.push(finding);
        }
    }

    /// Whether there are enough errors to stop reading.
    pub(super) fn is_full(&self) -> bool {
        MAX_FINDINGS <= self.errors.len()
    }

    fn finding(&self, line: usize, column: usize, message: String) -> Finding {
        Finding {
            library: self.library.clone(),
            line,
            column,
            message,
        }
    }
}
