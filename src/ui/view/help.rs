//! The help page: the keys of the mode, everything by topic, and what a search finds.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::page;
use super::row::Row;
use crate::app::command::PartKind;
use crate::app::{Page, PageFocus, Shared, command};
use crate::theme;

/// Draws the help page over all of an area.
pub(super) fn render(shared: &Shared, page: &Page, area: Rect, buffer: &mut Buffer) {
    // Inside the frame.
    let rows = usize::from(area.height.saturating_sub(2));
    let lines = command::help_lines(shared, area.width, rows);
    let count = lines.len();
    let top = page.filter.at.min(count.saturating_sub(rows));
    let last = (top + rows).min(count);
    let place = if rows < count {
        format!(" {}–{last} of {count} ", top + 1)
    } else {
        String::new()
    };
    let inner = page::frame("Keys", &place, area, buffer);
    for (index, line) in (0..).zip(lines.iter().skip(top).take(rows)) {
        let mut parts = line.parts.iter().peekable();
        while let Some(part) = parts.next() {
            let mut row = Row::new(buffer, inner, index);
            row.skip(1 + part.at as u16);
            let next = parts.peek().map(|next| next.at - part.at);
            let room = next.map_or_else(|| row.room(), |room| room.saturating_sub(1));
            row.put_in(&part.text, room, look(part.kind));
        }
    }
    search(page, area, buffer);
}

fn look(kind: PartKind) -> Style {
    match kind {
        PartKind::Heading => theme::BOLD,
        PartKind::Keys => theme::ACCENT,
        PartKind::Words => Style::new(),
        PartKind::Note => theme::DIM,
    }
}

/// Draws the search in the lower edge of the frame.
fn search(page: &Page, area: Rect, buffer: &mut Buffer) {
    let typed = page.filter.input.value();
    if typed.is_empty() && page.focus != PageFocus::Search {
        return;
    }
    let edge = Rect {
        x: area.x + 2,
        width: area.width.saturating_sub(4),
        ..area
    };
    let mut row = Row::new(buffer, edge, area.height.saturating_sub(1));
    row.put(" ", Style::new());
    if !page::typed(page, &mut row) {
        row.put(&format!("/{typed} "), theme::DIM);
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::keymap::Context;
    use crate::view::tests::{app, check_shown, drawn, press};
    use tui_input::Input;

    /// The page after some keys and with a search.
    fn page(keys: &str, search: &str, width: u16, height: u16) -> Vec<String> {
        let mut page = Page::reading(Context::Help);
        page.filter.input = Input::from(search);
        let mut app = app();
        press(&mut app, keys);
        app.shared.overlays.open_page(page);
        let draw = |shared: &Shared, area: Rect, buffer: &mut Buffer| {
            let page = shared.overlays.page(Context::Help).expect("it is open");
            render(shared, page, area, buffer);
        };
        drawn(&app.shared, draw, width, height)
    }

    #[test]
    fn the_first_screen_has_the_keys_of_the_mode_in_columns_that_hold_their_place() {
        for (width, height) in [(60, 20), (80, 24), (120, 40), (200, 50)] {
            for keys in ["", "v", "i", "e", "r"] {
                let mut app = app();
                press(&mut app, keys);
                let rows = usize::from(height) - 4;
                let lines = command::help_lines(&app.shared, width, rows);
                let card = lines[1..rows].iter();
                let card = card.take_while(|line| !line.parts.is_empty());
                let words = card.flat_map(|line| &line.parts);
                let words = words.filter(|part| part.kind == PartKind::Words);
                let columns: BTreeSet<_> = words.map(|part| part.at).collect();
                assert!((1..=4).contains(&columns.len()), "{width}: {columns:?}");
                let drawn = page(keys, "", width, height - 2);
                assert!(drawn.iter().all(|line| !line.contains('…')), "{drawn:#?}");
            }
        }
    }

    #[test]
    fn the_page_fills_its_area() {
        for line in page("", "", 80, 22) {
            assert!(!line.starts_with(' ') && !line.ends_with(' '), "{line}");
        }
    }

    #[test]
    fn a_search_lists_what_answers_it_with_its_topic() {
        let lines = page("", "ORBIT", 80, 22);
        check_shown(&lines, &["orbit left/down/up/right", "VIEW", "/ORBIT"]);
        let lines = page("", "zzyx", 80, 22);
        check_shown(&lines, &["Nothing for `zzyx`"]);
        let lines = page("", "gamma", 80, 22);
        check_shown(&lines, &[":transfer srgb"]);
    }
}
