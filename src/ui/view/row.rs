//! Writes one line of cells from left to right.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Style;
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use crate::layout::nth_line;
use crate::text_width::{shorten, visible};
use crate::theme;

/// A line that is written from left to right, clipped at its end.
#[derive(Debug)]
pub(crate) struct Row<'a> {
    buffer: &'a mut Buffer,
    left: Rect,
}

impl<'a> Row<'a> {
    /// The line at `index` below the top of `area`; a line outside of it takes no text.
    pub(crate) fn new(buffer: &'a mut Buffer, area: Rect, index: u16) -> Self {
        let left = nth_line(area, index).intersection(buffer.area);
        Self { buffer, left }
    }

    /// Number of cells left.
    pub(crate) fn room(&self) -> usize {
        if self.left.is_empty() {
            0
        } else {
            usize::from(self.left.width)
        }
    }

    /// Writes text, shortened to the remaining cells; control characters are shown, never sent.
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
            let Rect { x, y, .. } = self.left;
            let (end, _) = self.buffer.set_stringn(x, y, &text, width, style);
            self.skip(end - x);
        }
        self
    }

    /// Skips cells without changing them.
    pub(crate) fn skip(&mut self, cells: u16) -> &mut Self {
        let cells = cells.min(self.left.width);
        self.left.x += cells;
        self.left.width -= cells;
        self
    }

    /// Skips to a column of the screen, unless it has been passed.
    pub(crate) fn skip_to(&mut self, column: u16) -> &mut Self {
        self.skip(column.saturating_sub(self.left.x))
    }

    /// Writes a prompt's text into `width` cells, scrolled so that its cursor is visible.
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
        let before: Vec<char> = input.value().chars().take(at).collect();
        let fits = |c: &&char| {
            columns += c.width().unwrap_or(0);
            columns < width
        };
        let kept = before.iter().rev().take_while(fits).count();
        let before: String = before[before.len() - kept..].iter().collect();
        let mut rest = input.value().chars().skip(at);
        let under = rest.next().unwrap_or(' ').to_string();
        let after: String = rest.collect();
        let end = self.left.x.saturating_add(width as u16);
        for (text, style) in [(before, style), (under, cursor), (after, style)] {
            let room = usize::from(end.saturating_sub(self.left.x));
            self.put_in(&text, room, style);
        }
        self
    }
}

/// Writes a symbol into one cell, if there is such a cell.
pub(crate) fn put_at(at: impl Into<Position>, symbol: &str, style: Style, buffer: &mut Buffer) {
    if let Some(cell) = buffer.cell_mut(at) {
        cell.set_symbol(symbol).set_style(style);
    }
}

/// Whether keys go to a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Focus {
    /// They go to this one.
    Here,
    /// They go elsewhere.
    Elsewhere,
}

/// Draws the title line of a panel, with `right` at its end.
pub(crate) fn title(text: &str, right: &str, focus: Focus, area: Rect, buffer: &mut Buffer) {
    let style = match focus {
        Focus::Here => theme::BOLD.patch(theme::ACCENT),
        Focus::Elsewhere => theme::BOLD,
    };
    let mut row = Row::new(buffer, area, 0);
    row.put(text, style);
    row.put(" ", theme::DIM);
    let end = right.width() + usize::from(!right.is_empty());
    let rule = "─".repeat(row.room().saturating_sub(end));
    row.put(&rule, theme::DIM);
    row.skip(1).put(right, theme::DIM);
}

#[cfg(test)]
mod tests {
    use super::*;
    use tui_input::Input;

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
