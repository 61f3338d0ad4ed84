//! Words separated by white space: ASCII white space, the no-break space and the byte order mark.

use text::{Span, first_byte};

/// The words of part of a text, in order.
#[derive(Clone, Debug)]
pub(super) struct Words<'t> {
    bytes: &'t [u8],
    at: usize,
}

impl<'t> Words<'t> {
    /// The words in a span.
    pub(super) fn new(text: &'t str, span: Span) -> Self {
        Self {
            bytes: &text.as_bytes()[..span.end()],
            at: span.start(),
        }
    }
}

impl Iterator for Words<'_> {
    type Item = Span;

    fn next(&mut self) -> Option<Span> {
        let start = skip_white_space(self.bytes, self.at);
        self.at = start;
        if start == self.bytes.len() {
            return None;
        }
        loop {
            // All bytes that white space may begin with, in one comparison.
            let ends = |byte: u8| byte <= b' ' || !byte.is_ascii();
            let rest = &self.bytes[self.at..];
            self.at += first_byte(rest, ends).unwrap_or(rest.len());
            if self.at == self.bytes.len() || white_space(&self.bytes[self.at..]).is_some() {
                return Some(Span::new(start, self.at));
            }
            self.at += 1;
        }
    }
}

/// Returns the end of the white space at `at`.
pub(super) fn skip_white_space(bytes: &[u8], mut at: usize) -> usize {
    loop {
        let rest = &bytes[at..];
        at += first_byte(rest, |byte| !is_blank(byte)).unwrap_or(rest.len());
        match white_space(&bytes[at..]) {
            Some(width) => at += width,
            None => return at,
        }
    }
}

/// The length in bytes of the white-space character at the start of `bytes`.
pub(super) fn white_space(bytes: &[u8]) -> Option<usize> {
    match bytes {
        [byte, ..] if is_blank(*byte) => Some(1),
        [0xC2, 0xA0, ..] => Some(2),
        [0xEF, 0xBB, 0xBF, ..] => Some(3),
        _ => None,
    }
}

/// Whether a token with this first byte may be a word: a letter, or anything outside ASCII.
pub(super) fn may_begin_word(first: u8) -> bool {
    first.is_ascii_alphabetic() || !first.is_ascii()
}

/// The part of a comment after its mark, white space and a key; `None` for other comments.
pub(super) fn after_key(text: &str, comment: Span, mark: &str, key: &str) -> Option<Span> {
    let bytes = comment.of(text).as_bytes();
    let start = skip_white_space(
        bytes,
        bytes.starts_with(mark.as_bytes()).then_some(mark.len())?,
    );
    let body = bytes[start..].strip_prefix(key.as_bytes())?;
    Some(Span::new(comment.end() - body.len(), comment.end()))
}

/// The span without trailing white space.
pub(super) fn trim_end(text: &str, span: Span) -> Span {
    let mut kept = span.of(text).as_bytes();
    // Byte by byte: on a gigabyte of blanks, a pattern of characters takes several times as long.
    loop {
        kept = match kept {
            [rest @ .., byte] if is_blank(*byte) => rest,
            [rest @ .., 0xC2, 0xA0] | [rest @ .., 0xEF, 0xBB, 0xBF] => rest,
            _ => return Span::new(span.start(), span.start() + kept.len()),
        };
    }
}

/// Whether a byte alone is white space. A pattern would not be compiled to vector instructions.
fn is_blank(byte: u8) -> bool {
    byte == b' ' || byte.wrapping_sub(b'\t') < 5
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn words_and_white_space_cover_a_text(text in "([a\u{A0}\u{FEFF}é\u{80}ﻼ \t\n\x0B]{0,9}| {70}|a{70}){0,9}") {
            let is_white = |c: char| c.is_ascii_whitespace() || "\x0B\u{A0}\u{FEFF}".contains(c);
            let found = Words::new(&text, Span::new(0, text.len())).map(|word| word.of(&text));
            prop_assert!(found.eq(text.split(is_white).filter(|word| !word.is_empty())));
            let trimmed = trim_end(&text, Span::new(0, text.len())).of(&text);
            prop_assert_eq!(trimmed, text.trim_end_matches(is_white));
        }
    }
}
