//! Writing one line of cells from left to right, and making text fit and safe to show.

use std::borrow::Cow;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use super::theme;

/// One line that is written from left to right and never over its end.
#[derive(Debug)]
pub(crate) struct Row<'a> {
    buffer: &'a mut Buffer,
    left: Rect,
}

impl<'a> Row<'a> {
    /// The line `index` lines below the top of `area`; lines outside of it take no text.
    pub(crate) fn new(buffer: &'a mut Buffer, area: Rect, index: u16) -> Self {
        let line = Rect {
            y: area.y.saturating_add(index),
            height: 1,
            ..area
        };
        let left = line.intersection(area).intersection(buffer.area);
        Self { buffer, left }
    }

    /// Cells left to write.
    pub(crate) fn room(&self) -> usize {
        if self.left.is_empty() {
            0
        } else {
            usize::from(self.left.width)
        }
    }

    /// Writes text, shortened to the room left; control characters are shown, never sent.
    pub(crate) fn put(&mut self, text: &str, style: Style) -> &mut Self {
        let room = self.room();
        self.put_in(text, room, style)
    }

    /// Writes text, shortened to `width` cells.
    pub(crate) fn put_in(&mut self, text: &str, width: usize, style: Style) -> &mut Self {
        let width = width.min(self.room());
        if 0 < width {
            let text = visible(text);
            let text = shorten(&text, width);
            let (x, _) = self
                .buffer
                .set_stringn(self.left.x, self.left.y, &text, width, style);
            self.skip(x - self.left.x);
        }
        self
    }

    /// Leaves cells as they are.
    pub(crate) fn skip(&mut self, cells: u16) -> &mut Self {
        let cells = cells.min(self.left.width);
        self.left.x += cells;
        self.left.width -= cells;
        self
    }

    /// Skips to a column of the screen, if it is not behind already.
    pub(crate) fn skip_to(&mut self, column: u16) -> &mut Self {
        self.skip(column.saturating_sub(self.left.x))
    }

    /// Writes a line being typed into `width` cells, scrolled so that its cursor is seen.
    pub(crate) fn put_input(
        &mut self,
        input: &tui_input::Input,
        width: usize,
        style: Style,
        cursor: Style,
    ) -> &mut Self {
        let width = width.min(self.room());
        let at = input.cursor();
        let mut columns = 0;
        let mut before: Vec<char> = input.value().chars().take(at).collect();
        let kept = before
            .iter()
            .rev()
            .take_while(|c| {
                columns += c.width().unwrap_or(0);
                columns < width
            })
            .count();
        before.drain(..before.len() - kept);
        let before: String = before.into_iter().collect();
        let rest: String = input.value().chars().skip(at).collect();
        let under = rest
            .chars()
            .next()
            .map_or(1, char::len_utf8)
            .min(rest.len());
        let (under, after) = rest.split_at(under);
        let under = if under.is_empty() { " " } else { under };
        let end = self.left.x.saturating_add(width as u16);
        for (text, style) in [(before.as_str(), style), (under, cursor), (after, style)] {
            let room = usize::from(end.saturating_sub(self.left.x));
            self.put_in(text, room, style);
        }
        self
    }
}

/// Draws the title line of a panel, with something at its right end; a style if the panel has the
/// keys.
pub(crate) fn title(text: &str, right: &str, keys: Option<Style>, area: Rect, buffer: &mut Buffer) {
    let mut row = Row::new(buffer, area, 0);
    row.put(text, theme::BOLD.patch(keys.unwrap_or_default()));
    row.put(" ", theme::DIM);
    let end = right.width() + usize::from(!right.is_empty());
    let rule = "─".repeat(row.room().saturating_sub(end));
    row.put(&rule, theme::DIM);
    row.skip(1).put(right, theme::DIM);
}

/// Breaks text into lines of at most `width` cells, between words where it can.
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

/// A word in pieces of at most `width` cells, but of one character at least.
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

/// The text with control and other invisible characters as visible escapes.
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

/// Text that takes at most `width` cells: cut and ended by `…` where it is longer.
pub(crate) fn shorten(text: &str, width: usize) -> Cow<'_, str> {
    // A byte takes at least no cell and a character at most two, so that long texts need not be
    // measured to their end.
    if text.len() <= width || (text.len() <= 4 * width + 64 && text.width() <= width) {
        return Cow::Borrowed(text);
    }
    let mut columns = 0;
    let mut kept = String::new();
    let mut cut = false;
    for c in text.chars() {
        let next = columns + c.width().unwrap_or(0);
        if width <= next {
            // The last cell is for the text's last character or for the sign that there is more.
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

/// The symbol Unicode has for a control character.
fn picture_of(c: char) -> Option<char> {
    match c {
        '\0'..='\x1f' => char::from_u32(0x2400 + c as u32),
        '\x7f' => Some('\u{2421}'),
        _ => None,
    }
}

/// Controls, and characters without a cell of their own other than combining marks: joiners,
/// direction marks, tags.
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
    use tui_input::Input;

    #[test]
    fn controls_are_shown_and_never_sent() {
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
        assert_eq!(
            wrap("one two  three", 7),
            ["one two".to_owned(), "three".to_owned()]
        );
        assert_eq!(
            wrap("an extraordinary 界界", 5),
            ["an", "extra", "ordin", "ary", "界界"]
        );
        assert_eq!(wrap("界a", 1), ["界", "a"]);
        assert!(wrap(" ", 5).is_empty());
    }

    #[test]
    fn typed_text_scrolls_with_its_cursor() {
        let check = |text: &str, cursor, shown: &str, under: u16| {
            let mut buffer = Buffer::empty(Rect::new(0, 0, 6, 1));
            let area = buffer.area;
            let input = Input::new(text.to_owned()).with_cursor(cursor);
            let reversed = theme::CURSOR;
            Row::new(&mut buffer, area, 0).put_input(&input, 6, Style::new(), reversed);
            let cells: String = (0..6).map(|x| buffer[(x, 0)].symbol().to_owned()).collect();
            assert_eq!(cells, shown);
            let at = (0..6).find(|&x| buffer[(x, 0)].modifier == reversed.add_modifier);
            assert_eq!(at, Some(under), "{text}");
        };
        check("", 0, "      ", 0);
        check("1.5", 3, "1.5   ", 3);
        check("1.5", 1, "1.5   ", 1);
        check("123456789", 9, "56789 ", 5);
        check("123456789", 0, "12345…", 0);
    }
}
