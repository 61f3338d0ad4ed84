//! Warnings about lines of a mesh and its libraries, up to a limit.

use super::lines::{Fault, Place};
use super::{Finding, MAX_FINDINGS};
use text::{Span, counted};

/// Bytes of a line quoted on either side of the start of a word; more than any report shows.
const REACH: usize = 256;

/// A file being read.
#[derive(Clone, Copy, Debug)]
pub(super) struct File<'t> {
    /// The library as named by the mesh; `None` for the mesh itself.
    pub(super) library: Option<&'t str>,
    pub(super) bytes: &'t [u8],
    /// Where it goes on with numbers instead of text, and has no more lines.
    pub(super) numbers: Option<usize>,
}

/// The warnings about a mesh, or about its libraries.
#[derive(Debug, Default)]
pub(super) struct Findings {
    kept: Vec<Finding>,
    /// How many of those kept are put first.
    first: usize,
    /// The number of further ones.
    more: usize,
}

impl Findings {
    /// Adds a warning. Those beyond [`MAX_FINDINGS`] are only counted.
    pub(super) fn warn(&mut self, file: File<'_>, fault: Fault) {
        if self.kept.len() < MAX_FINDINGS {
            self.kept.push(file.finding(fault));
        } else {
            self.more += 1;
        }
    }

    /// Adds a warning that is kept rather than any added by [`Self::warn`], and stands before these.
    pub(super) fn warn_first(&mut self, file: File<'_>, fault: Fault) {
        if self.first < MAX_FINDINGS {
            if self.kept.len() == MAX_FINDINGS {
                self.kept.pop();
                self.more += 1;
            }
            self.kept.insert(self.first, file.finding(fault));
            self.first += 1;
        } else {
            self.more += 1;
        }
    }

    /// The findings kept. If there are more, the last one says how many.
    pub(super) fn finish(mut self) -> Vec<Finding> {
        if let Some(last) = self.kept.last_mut().filter(|_| 0 < self.more) {
            let more = format!("{} not shown", counted(self.more, "more problem"));
            last.hint = Some(match last.hint.take() {
                Some(hint) => format!("{hint}; {more}"),
                None => more,
            });
        }
        self.kept
    }

    /// The findings kept, and last of all why the file cannot be used.
    pub(super) fn fail(self, file: File<'_>, fault: Fault) -> Vec<Finding> {
        let mut all = self.finish();
        all.push(file.finding(fault));
        all
    }
}

impl<'t> File<'t> {
    /// A mesh that is text.
    pub(super) fn text(bytes: &'t [u8]) -> Self {
        Self {
            library: None,
            bytes,
            numbers: None,
        }
    }

    fn finding(self, fault: Fault) -> Finding {
        let Place { line, at } = fault.place.place(self.bytes);
        if self.numbers.is_some_and(|numbers| numbers <= at) {
            return self.finding_in_numbers(fault, Place { line, at });
        }
        let is_end = |&byte: &u8| byte == b'\n' || byte == b'\r';
        let start = self.bytes[..at].iter().rposition(is_end);
        let start = start.map_or(0, |end| end + 1);
        let rest = &self.bytes[at..];
        let length = rest.iter().take(REACH).take_while(|byte| !is_end(byte));
        let end = at + length.count();
        let is_character = |byte: &&u8| **byte & 0xC0 != 0x80;
        let column = 1 + self.bytes[start..at].iter().filter(is_character).count();
        // Not within a character.
        let from = (start.max(at.saturating_sub(REACH))..at)
            .find(|&from| is_character(&&self.bytes[from]))
            .unwrap_or(at);
        let marked = end.min(at + fault.length);
        let mut excerpt = String::new();
        let mut push = |from: usize, to: usize| {
            excerpt.push_str(&String::from_utf8_lossy(&self.bytes[from..to]));
            excerpt.len()
        };
        let first = push(from, at);
        let last = push(at, marked);
        push(marked, end);
        Finding {
            library: self.library.map(str::to_owned),
            line,
            column,
            message: fault.message,
            expected: fault.expected,
            hint: (!fault.cost.is_empty()).then(|| fault.cost.to_owned()),
            marked: Span::new(first, last),
            excerpt,
        }
    }

    /// The excerpt of a number is its bytes.
    fn finding_in_numbers(self, fault: Fault, Place { line, at }: Place) -> Finding {
        let word = self.bytes.get(at..).unwrap_or_default();
        let word = &word[..word.len().min(fault.length)];
        let bytes: Vec<_> = word.iter().map(|byte| format!("{byte:02x}")).collect();
        let excerpt = bytes.join(" ");
        Finding {
            library: self.library.map(str::to_owned),
            line,
            column: 1,
            message: format!("{} (byte {at})", fault.message),
            expected: fault.expected,
            hint: (!fault.cost.is_empty()).then(|| fault.cost.to_owned()),
            marked: Span::new(0, excerpt.len()),
            excerpt,
        }
    }
}
