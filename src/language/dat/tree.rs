//! The `.dat` language: one record a line, tokens separated by white space, comments that take
//! whole lines.

use crate::language::{trim_end, white_space};
use crate::text::Span;

/// Bytes of a token and of the space before it, or fewer.
const BYTES: usize = 4;

/// The records and comments of a text, each in order.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// The words and numbers of all records.
    pub tokens: Vec<Span>,
    /// Each record as the indices of its tokens: where they begin, and where they end.
    pub records: Vec<Record>,
    /// Comments, from their marker to before the line's end.
    pub comments: Vec<Span>,
}

/// A line with at least one token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record {
    first: u32,
    end: u32,
}

impl Tree {
    /// Tokens, and comments whole, in order.
    pub fn leaves(&self) -> Vec<Span> {
        let mut leaves: Vec<_> = self.tokens.iter().chain(&self.comments).copied().collect();
        leaves.sort_unstable();
        leaves
    }

    /// The tokens of a record; at least one. Of a record that is not there, none.
    pub fn tokens_of(&self, record: usize) -> &[Span] {
        self.records
            .get(record)
            .and_then(|record| self.tokens.get(record.first as usize..record.end as usize))
            .unwrap_or_default()
    }

    /// The text of a record, from its first token to its last.
    pub fn span_of(&self, record: usize) -> Span {
        match self.tokens_of(record) {
            [] => Span::at(0),
            [first, .., last] => first.to(*last),
            [only] => *only,
        }
    }

    /// The records whose text touches `span`, as a range of their indices.
    pub fn records_at(&self, span: Span) -> std::ops::Range<usize> {
        let start = |at: &Record| self.tokens[at.first as usize].start();
        let end = |at: &Record| self.tokens[at.end as usize - 1].end();
        let first = self
            .records
            .partition_point(|record| end(record) < span.start());
        let count = self.records[first..].partition_point(|record| start(record) <= span.end());
        first..first + count
    }
}

/// Reads records and comments. A line ends at a line feed or a carriage return: of several in a row
/// all but one end lines without a token. The no-break space and the byte order mark are white space.
pub(super) fn parse(text: &str) -> Tree {
    let mut tree = Tree::default();
    // A list that grows is copied, and both are there meanwhile. Memory that is not written to is none.
    let _ = tree.tokens.try_reserve(text.len() / BYTES);
    let mut start = 0;
    for line in text.split_inclusive(['\n', '\r']) {
        read_line(text, Span::new(start, start + line.len()), &mut tree);
        start += line.len();
    }
    tree.tokens.shrink_to_fit();
    tree
}

fn read_line(text: &str, line: Span, tree: &mut Tree) {
    let bytes = &text.as_bytes()[..line.end()];
    let first = tree.tokens.len();
    let mut at = line.start();
    while at < bytes.len() {
        if let Some(width) = white_space(&bytes[at..]) {
            at += width;
            continue;
        }
        let begins_line = tree.tokens.len() == first;
        if begins_line && matches!(bytes[at..], [b'#', ..] | [b'/', b'/', ..]) {
            tree.comments
                .push(trim_end(text, Span::new(at, line.end())));
            return;
        }
        let start = at;
        while at < bytes.len() && white_space(&bytes[at..]).is_none() {
            at += 1;
        }
        tree.tokens.push(Span::new(start, at));
    }
    if first < tree.tokens.len() {
        tree.records.push(Record {
            first: first as u32,
            end: tree.tokens.len() as u32,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn records(text: &str) -> Vec<Vec<&str>> {
        let tree = parse(text);
        let words = |at| {
            tree.tokens_of(at)
                .iter()
                .map(|span| span.of(text))
                .collect()
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
        let tree = parse(text);
        let said: Vec<_> = tree.comments.iter().map(|span| span.of(text)).collect();
        assert_eq!(said, ["# one", "//two"]);
    }

    #[test]
    fn records_are_found_by_place() {
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
        #[test]
        fn every_character_is_in_a_token_a_comment_or_white_space(text in "[ab/#\n\r \t\u{A0}\u{FEFF}é]{0,40}") {
            let tree = parse(&text);
            let mut covered = vec![false; text.len()];
            for span in tree.tokens.iter().chain(&tree.comments) {
                prop_assert!(!span.is_empty());
                for at in span.range() {
                    prop_assert!(!covered[at], "two leaves share a byte");
                    covered[at] = true;
                }
            }
            let rest: String = text.char_indices().filter(|&(at, _)| !covered[at]).map(|(_, c)| c).collect();
            let blank = |c: char| c.is_ascii_whitespace() || "\u{A0}\u{FEFF}".contains(c);
            prop_assert!(rest.chars().all(blank));
            let counted: usize = (0..tree.records.len()).map(|at| tree.tokens_of(at).len()).sum();
            prop_assert_eq!(counted, tree.tokens.len());
        }
    }
}
