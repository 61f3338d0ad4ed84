//! Menus of what can be added, of kinds to change to and of values.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::UnicodeWidthStr;

use super::fields::users;
use super::list::swatch;
use super::row::{Focus, Row, title};
use crate::app::{Entry, Purpose, Shared};
use crate::framing::clear;
use crate::{layout, theme};

/// Draws the open menu over the list, or over everything if there is no list.
pub(crate) fn render(shared: &Shared, list: Rect, body: Rect, buffer: &mut Buffer) {
    let Some(menu) = &shared.overlays.menu else {
        return;
    };
    let area = if list.is_empty() { body } else { list };
    clear(area, buffer);
    let name = match menu.purpose {
        Purpose::Add => "add",
        Purpose::Retype => "change to",
        Purpose::Value(key) => key,
        Purpose::Reference => "compare with",
    };
    let shown = menu.shown();
    let place = format!("{}/{}", (menu.filter.at + 1).min(shown.len()), shown.len());
    title(name, &place, Focus::Here, area, buffer);
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
    let dots = if shown.iter().any(|entry| entry.node.is_some()) {
        2
    } else {
        0
    };
    let columns = Columns { dots, names };
    for (index, entry) in shown.iter().enumerate().skip(top).take(rows) {
        let line = Rect {
            y: entries.y + (index - top) as u16,
            height: 1,
            ..entries
        };
        let look = if index == menu.filter.at {
            ("▸ ", theme::CURSOR)
        } else {
            ("  ", Style::new())
        };
        draw_entry(shared, entry, columns, look, line, buffer);
    }
    if shown.is_empty() {
        Row::new(buffer, entries, 0).put("  no match", theme::DIM);
    }
}

/// The columns of the entries.
#[derive(Clone, Copy)]
struct Columns {
    /// Width of the dots with a gap.
    dots: u16,
    /// Width of the names.
    names: usize,
}

/// Draws an entry: a dot in the colour of what it refers to, its name, and what it is.
fn draw_entry(
    shared: &Shared,
    entry: &Entry,
    columns: Columns,
    (sign, style): (&str, Style),
    line: Rect,
    buffer: &mut Buffer,
) {
    let mut row = Row::new(buffer, line, 0);
    let blank = " ".repeat(row.room());
    row.put(&blank, style);
    let mut row = Row::new(buffer, line, 0);
    row.put(sign, style);
    if let Some(colour) = entry.node.and_then(|node| swatch(shared, node)) {
        let ink = shared.theme.behind(style).swatch(colour);
        row.put("●", theme::within(style, ink));
    }
    row.skip_to(line.x + 2 + columns.dots);
    let words = line.x + 2 + columns.dots + columns.names as u16 + 2;
    row.put_in(&entry.name, columns.names, style.patch(theme::BOLD));
    row.skip_to(words);
    let users = entry.node.and_then(|node| users(shared, node));
    match &users {
        Some(users) if entry.words.is_empty() => row.put(users, theme::within(style, theme::DIM)),
        _ => row.put(&entry.words, theme::within(style, theme::DIM)),
    };
}
