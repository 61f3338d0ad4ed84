//! Foreign text made safe to print.

use std::borrow::Cow;

use unicode_width::UnicodeWidthChar;

/// Shows what can't be seen: control characters, line breaks, marks that turn the writing
/// direction and other characters without a form of their own become escapes such as `\u{1b}`, so
/// that neither a scene nor a file name can drive a terminal. One combining mark may stand on a
/// character; more become escapes. All else is kept as it is.
pub fn visible(text: &str) -> Cow<'_, str> {
    if text.bytes().all(|b| matches!(b, b' '..=b'~')) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut may_combine = false;
    for c in text.chars() {
        let combines = c.width() == Some(0);
        let plain = matches!(c, ' '..='~') || has_form(c) && (may_combine || !combines);
        if plain {
            shown.push(c);
        } else {
            shown.extend(c.escape_default());
        }
        may_combine = plain && !combines;
    }
    Cow::Owned(shown)
}

/// Whether a character can be seen on its own or on the character before it.
fn has_form(c: char) -> bool {
    // The standard library's debug form escapes what has no form. At the beginning of a string it
    // escapes combining marks as well, hence the letter in front.
    let mut buffer = [b'a', 0, 0, 0, 0];
    let end = 1 + c.encode_utf8(&mut buffer[1..]).len();
    std::str::from_utf8(&buffer[..end]).is_ok_and(|text| text.escape_debug().count() == 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_drives_a_terminal_is_escaped_and_nothing_else() {
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
