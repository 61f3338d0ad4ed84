//! Menus of what can be added and of kinds to change to.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Clear, Widget};
use unicode_width::UnicodeWidthStr;

use super::row::{Row, title};
use crate::ui::app::{App, Purpose};
use crate::ui::fit::shorten;
use crate::ui::layout;
use crate::ui::theme;

/// Draws the open menu over the list, or over everything if there is no list.
pub(crate) fn render(app: &App, list: Rect, body: Rect, buffer: &mut Buffer) {
    let Some(menu) = &app.overlays.menu else {
        return;
    };
    let area = if list.is_empty() { body } else { list };
    Clear.render(area, buffer);
    let name = match menu.purpose {
        Purpose::Add => "add",
        Purpose::Retype => "change to",
    };
    let shown = menu.shown();
    let place = format!("{}/{}", (menu.at + 1).min(shown.len()), shown.len());
    title(name, &place, Some(theme::ACCENT), area, buffer);
    let lines = layout::contents(area);
    let mut row = Row::new(buffer, lines, 0);
    row.put("/", theme::ACCENT);
    let room = row.room();
    row.put_input(&menu.filter, room, Style::new(), theme::CURSOR);
    let rows = usize::from(lines.height.saturating_sub(1));
    let top = layout::first_shown(0, menu.at, shown.len(), rows);
    for (index, (name, words)) in shown.iter().enumerate().skip(top).take(rows) {
        let is_selected = index == menu.at;
        let style = if is_selected {
            theme::CURSOR
        } else {
            Style::new()
        };
        let mut row = Row::new(buffer, lines, (index - top) as u16 + 1);
        row.put(if is_selected { "▸ " } else { "  " }, style);
        row.put(name, style.patch(theme::BOLD));
        let room = row.room().saturating_sub(2);
        row.put("  ", style);
        let words = shorten(words, room);
        let padding = room.saturating_sub(words.width());
        row.put(&format!("{words}{:padding$}", ""), style.patch(theme::DIM));
    }
    if shown.is_empty() {
        Row::new(buffer, lines, 1).put("  no match", theme::DIM);
    }
}
