//! Makes text fit and safe to show.

use std::borrow::Cow;
use std::path::Path;

use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

/// Breaks text into lines of at most `width` cells, between words where possible.
pub(crate) fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut columns = 0;
    for word in text.split_whitespace() {
        let wide = word.width();
        match lines.last_mut() {
            Some(line) if columns + 1 + wide <= width => {
                line.push(' ');
                line.push_str(word);
                columns += 1 + wide;
            }
            _ => {
                lines.extend(pieces(word, width));
                columns = lines.last().map_or(0, |line| line.width());
            }
        }
    }
    lines
}

/// Splits a word into pieces of at most `width` cells, but at least one character each.
fn pieces(word: &str, width: usize) -> Vec<String> {
    let mut pieces = vec![String::new()];
    let mut columns = 0;
    for c in word.chars() {
        let wide = c.width().unwrap_or(0);
        if 0 < columns && width < columns + wide {
            pieces.push(String::new());
            columns = 0;
        }
        if let Some(piece) = pieces.last_mut() {
            piece.push(c);
        }
        columns += wide;
    }
    pieces
}

/// The name of a file without its folder.
pub(crate) fn file_name(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    name.to_string_lossy().into_owned()
}

/// Replaces control characters and other invisible characters by visible symbols or escapes.
pub(crate) fn visible(text: &str) -> Cow<'_, str> {
    if !text.chars().any(is_invisible) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        match picture_of(c) {
            Some(symbol) => shown.push(symbol),
            None if is_invisible(c) => shown.extend(c.escape_unicode()),
            None => shown.push(c),
        }
    }
    Cow::Owned(shown)
}

/// Cuts text to at most `width` cells, ending in `…` if it is longer.
pub(crate) fn shorten(text: &str, width: usize) -> Cow<'_, str> {
    // A text of at most `width` bytes fits, and a much longer one need not be measured to its end.
    if text.len() <= width || (text.len() <= 4 * width + 64 && text.width() <= width) {
        return Cow::Borrowed(text);
    }
    let mut columns = 0;
    let mut kept = String::new();
    let mut cut = false;
    for c in text.chars() {
        let next = columns + c.width().unwrap_or(0);
        if width <= next {
            // The last cell is for the last character of the text, or for the ellipsis.
            cut = true;
            break;
        }
        columns = next;
        kept.push(c);
    }
    if cut && 0 < width {
        kept.push('…');
    }
    Cow::Owned(kept)
}

/// The Unicode symbol for a control character.
fn picture_of(c: char) -> Option<char> {
    match c {
        '\0'..='\x1f' => char::from_u32(0x2400 + c as u32),
        '\x7f' => Some('\u{2421}'),
        _ => None,
    }
}

/// Control characters, and characters without a cell of their own other than combining marks:
/// joiners, direction marks, tags.
fn is_invisible(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}'
            | '\u{e0000}'..='\u{e007f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_shown_and_never_sent() {
        let check = |text, shown: &str| assert_eq!(visible(text), shown);
        check("plain é", "plain é");
        check("\x1b[2J", "␛[2J");
        check("a\u{202e}b", "a\\u{202e}b");
        check("\u{9b}31m", "\\u{9b}31m");
        check("\x7f\r", "␡␍");
    }

    #[test]
    fn long_text_ends_in_an_ellipsis() {
        let check = |text: &str, width, short: &str| assert_eq!(shorten(text, width), short);
        check("abcdef", 6, "abcdef");
        check("abcdef", 5, "abcd…");
        check("界界界", 6, "界界界");
        check("界界界", 5, "界界…");
        check("界界界", 4, "界…");
        check("abc", 1, "…");
        check("abc", 0, "");
        check(&"x".repeat(1000), 3, "xx…");
    }

    #[test]
    fn lines_break_between_words() {
        for (text, width, lines) in [
            ("one two  three", 7, "one two|three"),
            ("an extraordinary 界界", 5, "an|extra|ordin|ary|界界"),
            ("界a", 1, "界|a"),
        ] {
            assert_eq!(wrap(text, width).join("|"), lines);
        }
        assert!(wrap(" ", 5).is_empty());
    }
}
