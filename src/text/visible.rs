//! Escapes untrusted text for printing.

use std::borrow::Cow;

use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

/// Escapes invisible characters, so that neither a scene nor a file name can control the terminal.
/// Control characters, line breaks, bidirectional formatting characters and others without a glyph
/// become escapes such as `\u{1b}`, as do combining marks after the first one on a character.
/// Everything else is unchanged.
pub fn visible(text: &str) -> Cow<'_, str> {
    if text.bytes().all(|b| matches!(b, b' '..=b'~')) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut may_combine = false;
    for c in text.chars() {
        let combines = c.width() == Some(0);
        let plain = matches!(c, ' '..='~') || has_glyph(c) && (may_combine || !combines);
        if plain {
            shown.push(c);
        } else {
            shown.extend(c.escape_default());
        }
        may_combine = plain && !combines;
    }
    Cow::Owned(shown)
}

/// The number of columns that a text takes on a terminal.
pub fn columns(text: &str) -> usize {
    text.width()
}

/// Whether a character is visible, on its own or on the character before it.
fn has_glyph(c: char) -> bool {
    // `escape_debug` escapes characters without a glyph. At the start of a string it also escapes
    // combining marks, hence the letter in front.
    let mut buffer = [b'a', 0, 0, 0, 0];
    let end = 1 + c.encode_utf8(&mut buffer[1..]).len();
    std::str::from_utf8(&buffer[..end]).is_ok_and(|text| text.escape_debug().count() == 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_characters_that_control_the_terminal_are_escaped() {
        let cases = [
            ("plain 'text' \"C:\\x\"", "plain 'text' \"C:\\x\""),
            ("\u{1b}]52;c;eA\u{7}", "\\u{1b}]52;c;eA\\u{7}"),
            ("a\rb\nc\td\u{7f}", "a\\rb\\nc\\td\\u{7f}"),
            ("\u{9b}31m", "\\u{9b}31m"),
            ("\u{202e}yar.\u{2066}", "\\u{202e}yar.\\u{2066}"),
            (
                "\u{200b}\u{200d}\u{feff}\u{e0041}",
                "\\u{200b}\\u{200d}\\u{feff}\\u{e0041}",
            ),
            ("scène çéß 場面", "scène çéß 場面"),
            ("e\u{301}\u{301}", "e\u{301}\\u{301}"),
            ("\u{301}a", "\\u{301}a"),
        ];
        for (text, shown) in cases {
            assert_eq!(visible(text), shown);
        }
    }
}
