//! The tree of a text with one record a line: tokens separated by white space, and comments.

use std::marker::PhantomData;
use std::ops::Range;

use super::Language;
use crate::words::{Words, after_key, skip_white_space, trim_end};
use crate::written::Parse;
use text::{Span, line_end};

/// The records of a text, in order. Their tokens are found in the text on demand.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lines<L> {
    /// The text of each record, from its first token to its last.
    pub(crate) records: Vec<Span>,
    /// The comments that begin with `render:`, in order.
    pub(super) renders: Vec<Span>,
    language: PhantomData<L>,
}

impl<L> Lines<L> {
    /// The tokens of a record, at least one; none for an index without a record.
    pub(crate) fn tokens<'t>(&self, text: &'t str, record: usize) -> Words<'t> {
        Words::new(text, self.span(record))
    }

    /// The text of a record, from its first token to its last.
    pub(crate) fn span(&self, record: usize) -> Span {
        self.records.get(record).copied().unwrap_or_default()
    }

    /// The indices of the records whose text touches `span`.
    pub(crate) fn at(&self, span: Span) -> Range<usize> {
        let begun = |record: &Span| record.end() < span.start();
        let first = self.records.partition_point(begun);
        let count = self.records[first..].partition_point(|record| record.start() <= span.end());
        first..first + count
    }
}

impl<L: Language> Parse for Lines<L> {
    /// Splits a text into records. A line ends at each line feed or carriage return, so that CR LF ends
    /// a further, empty line. The no-break space and the byte order mark are white space.
    fn parse(text: &str) -> Self {
        let mut lines = Self::default();
        for line in self::lines(text) {
            if !is_comment::<L>(line.of(text)) {
                lines.records.push(split::<L>(text, line).0);
            } else if render_comment(text, line).is_some() {
                lines.renders.push(line);
            }
        }
        lines
    }
}

/// Tokens and whole comments, in order.
pub(crate) fn leaves<L: Language>(text: &str) -> Vec<Span> {
    let mut leaves = Vec::new();
    for line in lines(text) {
        if is_comment::<L>(line.of(text)) {
            leaves.push(line);
        } else {
            let (record, comment) = split::<L>(text, line);
            leaves.extend(Words::new(text, record));
            leaves.extend(comment);
        }
    }
    leaves
}

/// Splits a record from the comment behind it, if the language has such.
fn split<L: Language>(text: &str, line: Span) -> (Span, Option<Span>) {
    if !L::COMMENTS_BEHIND || !line.of(text).contains(L::COMMENTS[0]) {
        return (line, None);
    }
    let mut words = Words::new(text, line).skip(1);
    let comment = words.find(|word| word.of(text).starts_with(L::COMMENTS[0]));
    match comment {
        Some(word) => {
            let before = Span::new(line.start(), word.start());
            (
                trim_end(text, before),
                Some(Span::new(word.start(), line.end())),
            )
        }
        None => (line, None),
    }
}

/// Whether a line is a comment.
pub(super) fn is_comment<L: Language>(line: &str) -> bool {
    L::COMMENTS.iter().any(|mark| line.starts_with(mark))
}

/// The part of a comment after `render:`; `None` for other comments.
pub(super) fn render_comment(text: &str, line: Span) -> Option<Span> {
    after_key(text, line, "#", "render:")
}

/// The lines of a text that are not blank, without surrounding white space.
fn lines(text: &str) -> impl Iterator<Item = Span> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = skip_white_space(text.as_bytes(), at);
        at = line_end(text, start);
        (start < at).then(|| trim_end(text, Span::new(start, at)))
    })
}
