//! The tree of a `.ray` text: tokens separated by white space. Comments are found in the text on
//! demand.

mod scan;
mod tokens;
mod window;

use crate::words::{after_key, trim_end};
use crate::written::{Parse, Replaced};
use text::{Span, line_end, next_line};

pub(super) use tokens::Tokens;
pub(super) use window::Window;

/// Splits a text into tokens. White space is ASCII's, the no-break space and the byte order mark.
pub(super) fn parse(text: &str) -> Tokens {
    scan::scan(text, scan::PIECE)
}

impl Tokens {
    /// Tokens and whole comments, in order.
    pub(crate) fn leaves(&self, text: &str) -> Vec<Span> {
        let mut leaves = self.range(0..self.len());
        leaves.extend(comments(text, Span::new(0, text.len())));
        leaves.sort_unstable();
        leaves
    }
}

impl Parse for Tokens {
    fn parse(text: &str) -> Self {
        parse(text)
    }

    /// Only the lines around the edits are read again.
    fn follow(&mut self, text: &str, edits: &[Replaced]) {
        let spans: Vec<_> = edits.iter().map(|edit| [edit.old, edit.new]).collect();
        scan::follow(self, text, &spans, scan::PIECE);
    }
}

/// The comment on the rest of a line from a place outside comments: from its marker, without
/// trailing white space.
pub(super) fn comment_of_line(text: &str, from: usize) -> Option<Span> {
    let line = Span::new(from, line_end(text, from));
    let mut pairs = line.of(text).as_bytes().windows(2);
    let start = from + pairs.position(begins_comment)?;
    Some(trim_end(text, Span::new(start, line.end())))
}

/// What begins the comment of the view.
pub(super) const VIEW: &str = "view:";

/// What begins the comment of the render settings.
pub(super) const RENDER: &str = "render:";

/// Whether a comment begins with a key.
fn has_key(text: &str, comment: Span) -> bool {
    let has = |key| after_key(text, comment, "//", key).is_some();
    "//view:".len() <= comment.len() && (has(VIEW) || has(RENDER))
}

/// Whether bytes outside a comment begin one.
pub(super) fn begins_comment(bytes: &[u8]) -> bool {
    bytes.starts_with(b"//") || bytes.starts_with(br"\\")
}

/// The comments behind the start of a span, outside comments, and behind each start of a line in it.
pub(super) fn comments(text: &str, span: Span) -> impl Iterator<Item = Span> {
    let mut at = span.start();
    let lines = std::iter::from_fn(move || {
        let start = (at < span.end()).then_some(at)?;
        at = next_line(text, at);
        Some(start)
    });
    lines.filter_map(|line| comment_of_line(text, line))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn tokens(text: &str) -> Vec<&str> {
        let tokens = parse(text);
        let spans = tokens.range(0..tokens.len());
        spans.iter().map(|span| span.of(text)).collect()
    }

    fn comments(text: &str) -> Vec<&str> {
        super::comments(text, Span::new(0, text.len()))
            .map(|span| span.of(text))
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
    fn comments_may_begin_with_a_key() {
        for (comment, key, body) in [
            ("// view: eye 1", VIEW, Some(" eye 1")),
            ("//\u{A0}\tview:up", VIEW, Some("up")),
            ("//view:", VIEW, Some("")),
            ("// render: spp 4", RENDER, Some(" spp 4")),
            ("// view: eye 1", RENDER, None),
            ("///view:", VIEW, None),
            ("// the view:", VIEW, None),
            (r"\\ view: eye 1", VIEW, None),
        ] {
            let whole = Span::new(0, comment.len());
            let found = after_key(comment, whole, "//", key);
            assert_eq!(found.map(|span| span.of(comment)), body, "{comment}");
            assert_eq!(
                has_key(comment, whole),
                body.is_some() || key == RENDER,
                "{comment}"
            );
        }
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn every_character_is_a_token_a_comment_or_white_space(text in "[01a/\\\\\n\r \u{A0}\u{FEFF}é]{0,40}") {
            let tree = parse(&text);
            let mut covered = vec![false; text.len()];
            for span in tree.leaves(&text) {
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
