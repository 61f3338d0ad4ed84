//! Line boundaries. A line ends at a line feed, including all carriage returns directly before it,
//! or at any other carriage return, as on classic Mac OS.

use super::first_byte;

/// The start of the line that contains offset `at`.
pub fn line_start(text: &str, at: usize) -> usize {
    let bytes = text.as_bytes();
    let mut in_end = has_line_feed(&bytes[at..]);
    let is_end = |&byte: &u8| {
        in_end = byte == b'\n' || (byte == b'\r' && in_end);
        byte == b'\n' || (byte == b'\r' && !in_end)
    };
    let end = bytes[..at].iter().rposition(is_end);
    end.map_or(0, |end| end + 1)
}

/// The end of the line that contains offset `at`, without its terminator.
pub fn line_end(text: &str, at: usize) -> usize {
    let end = first_byte(&text.as_bytes()[at..], is_line_end);
    end.map_or(text.len(), |len| at + len)
}

/// The start of the line after the one that contains offset `at`, or the end of the text.
pub fn next_line(text: &str, at: usize) -> usize {
    let end = line_end(text, at);
    end + end_len(&text.as_bytes()[end..])
}

/// Whether a text is exactly one line terminator.
pub fn is_one_line_end(text: &str) -> bool {
    !text.is_empty() && end_len(text.as_bytes()) == text.len()
}

/// Whether a byte is, or is part of, a line terminator.
pub fn is_line_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

/// The number of lines that end before offset `at`.
pub(super) fn ends_before(bytes: &[u8], at: usize) -> usize {
    let before = &bytes[..at];
    let count = |wanted: u8| {
        before
            .iter()
            .map(|&b| usize::from(b == wanted))
            .sum::<usize>()
    };
    let feeds = count(b'\n');
    if count(b'\r') == 0 {
        return feeds;
    }
    let mut in_end = has_line_feed(&bytes[at..]);
    let mut ends = 0;
    for &byte in before.iter().rev() {
        let is_return = byte == b'\r';
        ends += usize::from(byte == b'\n' || (is_return && !in_end));
        in_end = byte == b'\n' || (is_return && in_end);
    }
    ends
}

/// The length of the line terminator at the start of `bytes`; 0 if there is none.
fn end_len(bytes: &[u8]) -> usize {
    let returns = bytes.iter().take_while(|&&byte| byte == b'\r').count();
    match bytes.get(returns) {
        Some(b'\n') => returns + 1,
        _ => returns.min(1),
    }
}

/// Whether `bytes` start with any number of carriage returns and a line feed.
fn has_line_feed(bytes: &[u8]) -> bool {
    let rest = bytes.iter().find(|&&byte| byte != b'\r');
    rest == Some(&b'\n')
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The lines of a text, each with its terminator.
    fn lines(text: &str) -> Vec<&str> {
        let mut lines = Vec::new();
        let mut at = 0;
        while at < text.len() {
            let next = next_line(text, at);
            lines.push(&text[at..next]);
            at = next;
        }
        lines
    }

    #[test]
    fn a_line_ends_at_a_line_feed_or_at_a_lone_carriage_return() {
        let cases: [(&str, &[&str]); 7] = [
            ("a\nb", &["a\n", "b"]),
            ("a\r\nb", &["a\r\n", "b"]),
            ("a\r\r\nb\r\r\n", &["a\r\r\n", "b\r\r\n"]),
            ("a\rb\r", &["a\r", "b\r"]),
            ("a\r\rb", &["a\r", "\r", "b"]),
            ("\n\r", &["\n", "\r"]),
            ("", &[]),
        ];
        for (text, expected) in cases {
            assert_eq!(lines(text), expected, "{text:?}");
        }
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn every_offset_is_in_one_line(text in "[ab\r\n]{0,20}") {
            let mut start = 0;
            for (number, line) in lines(&text).into_iter().enumerate() {
                prop_assert!(is_one_line_end(line.trim_start_matches(['a', 'b'])) || start + line.len() == text.len());
                for at in start..start + line.len() {
                    prop_assert_eq!(line_start(&text, at), start);
                    prop_assert_eq!(next_line(&text, at), start + line.len());
                    prop_assert_eq!(ends_before(text.as_bytes(), at), number);
                    let end = start + line.trim_end_matches(['\r', '\n']).len();
                    prop_assert_eq!(line_end(&text, at), end.max(at));
                }
                start += line.len();
            }
        }
    }
}
