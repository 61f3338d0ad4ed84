//! The `.ray` language: a stream of tokens separated by white space, with comments.

mod scan;
mod tokens;

use crate::language::white_space;
use crate::text::Span;

pub(super) use tokens::Tokens;

/// The tokens and comments of a text, each in order.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// Words and numbers.
    pub tokens: Tokens,
    /// Comments, from their marker to before the line's end.
    pub comments: Vec<Comment>,
}

/// A comment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Comment {
    /// The whole comment with its marker, without white space at its end.
    pub span: Span,
    /// How it begins.
    pub marker: Marker,
}

/// What a comment begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// `//`
    Slashes,
    /// `\\\\`
    Backslashes,
}

/// Reads tokens and comments. White space is ASCII's, the no-break space and the byte order mark.
pub(super) fn parse(text: &str) -> Tree {
    scan::scan(text, scan::PIECE)
}

impl Tree {
    /// Tokens, and comments whole, in order.
    pub fn leaves(&self) -> Vec<Span> {
        let comments = self.comments.iter().map(|comment| comment.span);
        let mut leaves: Vec<_> = self.tokens.all().into_iter().chain(comments).collect();
        leaves.sort_unstable();
        leaves
    }

    /// Becomes the tree of the text after an edit, of which `changed` is what it put in the place of
    /// the bytes `old`. Only the lines around it are read.
    pub fn follow(&mut self, text: &str, old: Span, changed: Span) {
        scan::follow(self, text, old, changed, scan::PIECE);
    }
}

/// The words inside `span` of `text`, separated by white space: how the inside of a comment is
/// read.
pub(super) fn words(text: &str, span: Span) -> Vec<Span> {
    let bytes = &text.as_bytes()[..span.end()];
    let mut words = Vec::new();
    let mut at = span.start();
    while at < bytes.len() {
        if let Some(width) = white_space(&bytes[at..]) {
            at += width;
            continue;
        }
        let start = at;
        while at < bytes.len() && white_space(&bytes[at..]).is_none() {
            at += 1;
        }
        words.push(Span::new(start, at));
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn tokens(text: &str) -> Vec<&str> {
        parse(text)
            .tokens
            .all()
            .iter()
            .map(|span| span.of(text))
            .collect()
    }

    fn comments(text: &str) -> Vec<&str> {
        parse(text)
            .comments
            .iter()
            .map(|comment| comment.span.of(text))
            .collect()
    }

    #[test]
    fn tokens_are_separated_by_white_space_and_comments() {
        let cases: [(&str, &[&str], &[&str]); 8] = [
            ("1 2\n3", &["1", "2", "3"], &[]),
            (
                "\u{FEFF}1\u{A0}\u{A0}2\r\r\n3\t4",
                &["1", "2", "3", "4"],
                &[],
            ),
            ("1// one\n2", &["1", "2"], &["// one"]),
            ("1 \\\\ one \r\n2", &["1", "2"], &["\\\\ one"]),
            (
                "1// one \r2\\\\two\r\r\n3",
                &["1", "2", "3"],
                &["// one", "\\\\two"],
            ),
            ("a/b \\x", &["a/b", "\\x"], &[]),
            ("// é // é", &[], &["// é // é"]),
            ("", &[], &[]),
        ];
        for (text, expected_tokens, expected_comments) in cases {
            assert_eq!(tokens(text), expected_tokens, "{text:?}");
            assert_eq!(comments(text), expected_comments, "{text:?}");
        }
    }

    #[test]
    fn words_of_a_comment() {
        let text = "// view: eye\u{A0}1";
        let words: Vec<_> = words(text, Span::new(2, text.len()))
            .iter()
            .map(|w| w.of(text))
            .collect();
        assert_eq!(words, ["view:", "eye", "1"]);
    }

    proptest! {
        #[test]
        fn every_character_is_a_token_a_comment_or_white_space(text in "[01a/\\\\\n\r \u{A0}\u{FEFF}é]{0,40}") {
            let tree = parse(&text);
            let mut covered = vec![false; text.len()];
            let spans = tree.tokens.all().into_iter().chain(tree.comments.iter().map(|c| c.span));
            for span in spans {
                prop_assert!(!span.is_empty());
                for at in span.range() {
                    prop_assert!(!covered[at], "two leaves share a byte");
                    covered[at] = true;
                }
            }
            let rest: String = text.char_indices().filter(|&(at, _)| !covered[at]).map(|(_, c)| c).collect();
            let blank = |c: char| c.is_ascii_whitespace() || "\u{A0}\u{FEFF}\x0B".contains(c);
            prop_assert!(rest.chars().all(blank));
        }
    }
}
