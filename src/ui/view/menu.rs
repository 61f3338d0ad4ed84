//! Menus of what can be added, of kinds to change to and of values.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Clear, Widget};
use unicode_width::UnicodeWidthStr;

use super::fields::users;
use super::row::{Row, title};
use crate::ui::app::{App, Entry, Purpose};
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
        Purpose::Value(key) => key,
    };
    let shown = menu.shown();
    let place = format!("{}/{}", (menu.filter.at + 1).min(shown.len()), shown.len());
    title(name, &place, Some(theme::ACCENT), area, buffer);
    let lines = layout::contents(area);
    let mut row = Row::new(buffer, lines, 0);
    row.put("/", theme::ACCENT);
    let room = row.room();
    row.put_input(&menu.filter.input, room, Style::new(), theme::CURSOR);
    let entries = layout::contents(lines);
    let rows = usize::from(entries.height);
    let top = layout::first_shown(0, menu.filter.at, shown.len(), rows);
    let widths = shown.iter().map(|entry| entry.name.width());
    let names = widths.max().unwrap_or(0).min(usize::from(area.width / 2));
    for (index, entry) in shown.iter().enumerate().skip(top).take(rows) {
        let line = Rect {
            y: entries.y + (index - top) as u16,
            height: 1,
            ..entries
        };
        let is_selected = index == menu.filter.at;
        draw_entry(app, entry, names, is_selected, (line, buffer));
    }
    if shown.is_empty() {
        Row::new(buffer, entries, 0).put("  no match", theme::DIM);
    }
}

/// Draws an entry: a dot in the colour of what it refers to, its name, and what it is.
fn draw_entry(
    app: &App,
    entry: &Entry,
    names: usize,
    is_selected: bool,
    (line, buffer): (Rect, &mut Buffer),
) {
    let style = if is_selected {
        theme::CURSOR
    } else {
        Style::new()
    };
    let mut row = Row::new(buffer, line, 0);
    row.put(if is_selected { "▸ " } else { "  " }, style);
    if entry.node.is_some() {
        match app.entry_colour(entry) {
            // Reversed, a dot would be a hole in its colour.
            Some(colour) => row.put("●", theme::swatch(colour)),
            None => row.put(" ", Style::new()),
        };
        row.put(" ", style);
    }
    let name = shorten(&entry.name, names.min(row.room()));
    let padding = names.saturating_sub(name.width());
    row.put(&format!("{name}{:padding$}", ""), style.patch(theme::BOLD));
    let room = row.room().saturating_sub(2);
    row.put("  ", style);
    let users = entry.node.and_then(|node| users(app, node));
    let words = match &users {
        Some(users) if entry.words.is_empty() => users,
        _ => &entry.words,
    };
    let words = shorten(words, room);
    let padding = room.saturating_sub(words.width());
    row.put(&format!("{words}{:padding$}", ""), style.patch(theme::DIM));
}
