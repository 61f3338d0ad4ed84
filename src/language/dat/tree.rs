//! The tree of a `.dat` text: one record per line, tokens separated by white space, comments on
//! lines of their own.

use std::ops::Range;

use crate::words::{Words, skip_white_space, trim_end};
use crate::written::Parse;
use text::{Span, line_end};

/// The records of a text, in order. Their tokens are found in the text on demand.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// The text of each record, from its first token to its last.
    pub records: Vec<Span>,
    /// The comments that begin with `render:`, in order.
    pub(super) renders: Vec<Span>,
}

impl Tree {
    /// The tokens of a record, at least one; none for an index without a record.
    pub(super) fn tokens_of<'t>(&self, text: &'t str, record: usize) -> Words<'t> {
        Words::new(text, self.span_of(record))
    }

    /// The text of a record, from its first token to its last.
    pub fn span_of(&self, record: usize) -> Span {
        let span = self.records.get(record);
        span.copied().unwrap_or_default()
    }

    /// The indices of the records whose text touches `span`.
    pub fn records_at(&self, span: Span) -> Range<usize> {
        let first = self
            .records
            .partition_point(|record| record.end() < span.start());
        let count = self.records[first..].partition_point(|record| record.start() <= span.end());
        first..first + count
    }
}

impl Parse for Tree {
    fn parse(text: &str) -> Self {
        parse(text)
    }
}

/// Splits a text into records. A line ends at each line feed or carriage return, so that CR LF ends
/// a further, empty line. The no-break space and the byte order mark are white space.
pub(super) fn parse(text: &str) -> Tree {
    let mut tree = Tree::default();
    for line in lines(text) {
        if !is_comment(line.of(text)) {
            tree.records.push(line);
        } else if render_comment(text, line).is_some() {
            tree.renders.push(line);
        }
    }
    tree
}

/// Tokens and whole comments, in order.
pub(super) fn leaves(text: &str) -> Vec<Span> {
    let mut leaves = Vec::new();
    for line in lines(text) {
        if is_comment(line.of(text)) {
            leaves.push(line);
        } else {
            leaves.extend(Words::new(text, line));
        }
    }
    leaves
}

/// Whether a line is a comment.
pub(super) fn is_comment(line: &str) -> bool {
    line.starts_with('#') || line.starts_with("//")
}

/// The part of a comment after `render:`; `None` for other comments.
pub(super) fn render_comment(text: &str, line: Span) -> Option<Span> {
    let bytes = line.of(text).as_bytes();
    let start = skip_white_space(bytes, bytes.strip_prefix(b"#").map(|_| 1)?);
    let body = bytes[start..].strip_prefix(b"render:")?;
    Some(Span::new(line.end() - body.len(), line.end()))
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn records(text: &str) -> Vec<Vec<&str>> {
        let tree = parse(text);
        let words = |at| {
            let tokens = tree.tokens_of(text, at);
            tokens.map(|span| span.of(text)).collect()
        };
        (0..tree.records.len()).map(words).collect()
    }

    #[test]
    fn a_record_is_a_line() {
        let cases: [(&str, &[&[&str]]); 6] = [
            ("a 1\tb\n\n  c", &[&["a", "1", "b"], &["c"]]),
            ("a\r\r\nb 1\r\r\n", &[&["a"], &["b", "1"]]),
            ("\u{FEFF}a\u{A0}b", &[&["a", "b"]]),
            ("# a\n  // b\na # b\n", &[&["a", "#", "b"]]),
            ("a\rb 1\r\rc", &[&["a"], &["b", "1"], &["c"]]),
            (" \n\t\n", &[]),
        ];
        for (text, expected) in cases {
            assert_eq!(records(text), expected, "{text:?}");
        }
    }

    #[test]
    fn comments_end_before_white_space() {
        let text = " # one \r\r\na\r//two\rb";
        let said: Vec<_> = leaves(text).iter().map(|span| span.of(text)).collect();
        assert_eq!(said, ["# one", "a", "//two", "b"]);
    }

    #[test]
    fn records_are_found_by_position() {
        let text = "ab 1\n\n# c\n  d 2\ne";
        let tree = parse(text);
        let at = |start, end| tree.records_at(Span::new(start, end));
        assert_eq!(at(0, 0), 0..1);
        assert_eq!(at(4, 4), 0..1);
        assert_eq!(at(5, 6), 1..1);
        assert_eq!(at(3, 13), 0..2);
        assert_eq!(at(15, 17), 1..3);
        assert_eq!(tree.span_of(1).of(text), "d 2");
        assert_eq!(tree.span_of(7), Span::at(0));
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn every_character_is_in_a_token_a_comment_or_white_space(text in "[ab/#\n\r \t\u{A0}\u{FEFF}é]{0,40}") {
            let mut covered = vec![false; text.len()];
            for span in leaves(&text) {
                prop_assert!(!span.is_empty());
                for at in span.range() {
                    prop_assert!(!covered[at], "two leaves share a byte");
                    covered[at] = true;
                }
            }
            let rest: String = text.char_indices().filter(|&(at, _)| !covered[at]).map(|(_, c)| c).collect();
            let blank = |c: char| c.is_ascii_whitespace() || "\u{A0}\u{FEFF}".contains(c);
            prop_assert!(rest.chars().all(blank));
        }
    }
}
