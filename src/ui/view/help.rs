//! The help page: the table of keys, with search.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::UnicodeWidthStr;

use super::page;
use super::row::Row;
use crate::app::{Page, Shared, command};
use crate::keymap::HelpLine;
use crate::{layout, theme};

/// Draws the help page.
pub(super) fn render(shared: &Shared, page: &Page, area: Rect, buffer: &mut Buffer) {
    let columns = command::help_columns(shared, area.width);
    let count = columns.len() as u16;
    let width = if count == 1 { 76 } else { area.width };
    let place = layout::centred(area, Rect::new(0, 0, width, area.height));
    // Inside the frame, and above the search.
    let rows = usize::from(place.height.saturating_sub(3));
    let longest = columns.iter().map(Vec::len).max().unwrap_or(0);
    let top = page.filter.at.min(longest.saturating_sub(rows));
    let last = (top + rows).min(longest);
    let lines = if top < last {
        format!(" {}–{last} of {longest} ", top + 1)
    } else {
        String::new()
    };
    let inner = page::frame("Keys", &lines, place, buffer);
    let (body, search) = layout::split_bottom(inner, 1);
    let width = body.width / count;
    for (at, lines) in (0..).zip(&columns) {
        let column = Rect {
            x: body.x + at * width,
            width,
            ..body
        };
        for (index, line) in lines.iter().skip(top).take(rows).enumerate() {
            help_line(line, Row::new(buffer, column, index as u16));
        }
    }
    let mut row = Row::new(buffer, search, 0);
    row.skip(1);
    if page::typed(page, &mut row) {
        return;
    }
    let is_entry = |line: &&HelpLine| matches!(line, HelpLine::Entry { .. });
    let count = columns.iter().flatten().filter(is_entry).count();
    let found = if page.filter.input.value().is_empty() {
        let (search, close) = (shared.key_for("search"), shared.key_for("back"));
        format!("{search} search  {close} close")
    } else {
        page::found(page, count)
    };
    row.put(&found, theme::DIM);
}

/// Draws a line of help: a heading, or keys and their description side by side.
fn help_line(line: &HelpLine, mut row: Row) {
    row.skip(1);
    match line {
        HelpLine::Heading(heading) => {
            row.put(heading, theme::BOLD);
        }
        HelpLine::Entry { keys, words } => {
            let width = row.room();
            // A long description starts farther left, as far as its keys leave room.
            let least = (keys.width() + 3).min(width * 2 / 5);
            let most = width.saturating_sub(words.width() + 1);
            let keys_width = most.clamp(least, width * 2 / 5);
            row.skip(2)
                .put_in(keys, keys_width.saturating_sub(3), theme::ACCENT);
            let used = width - row.room();
            row.skip(keys_width.saturating_sub(used) as u16);
            row.put_in(words, row.room().saturating_sub(1), Style::new());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keymap::Context;
    use crate::view::tests::{app, drawn, lines};
    use tui_input::Input;

    /// The page with a search.
    fn page(search: &str, width: u16, height: u16) -> Vec<String> {
        let mut page = Page::reading(Context::Help);
        page.filter.input = Input::from(search);
        let mut app = app();
        app.shared.overlays.open_page(page);
        let draw = |shared: &Shared, area: Rect, buffer: &mut Buffer| {
            let page = shared.overlays.page(Context::Help).expect("it is open");
            render(shared, page, area, buffer);
        };
        drawn(&app.shared, draw, width, height)
    }

    #[test]
    fn a_wide_page_has_columns_and_starts_with_the_present_mode() {
        let wide = &page("", 120, 30)[1];
        assert!(wide.starts_with("│ SELECT"), "{wide}");
        assert_eq!(wide.matches("anywhere").count(), 1, "{wide}");
        assert!(!page("", 80, 30)[1].contains("anywhere"));
    }

    #[test]
    fn long_words_begin_beside_short_keys() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 40, 1));
        let (keys, words) = ("i".into(), "explain the pixel pointed at");
        let row = Row::new(&mut buffer, Rect::new(0, 0, 40, 1), 0);
        help_line(&HelpLine::Entry { keys, words }, row);
        let shown = lines(&buffer).concat();
        assert!(shown.contains(words), "{shown}");
    }

    #[test]
    fn only_matching_lines_are_shown() {
        let lines = page("ORBIT", 80, 24);
        let found = lines.iter().filter(|line| line.contains("orbit")).count();
        // Four keys and the mouse, under two headings.
        assert_eq!(found, 5, "{lines:#?}");
        for (at, part) in [
            (0, "1–7 of 7"),
            (1, "VIEW"),
            (2, "h ←"),
            (22, "5 lines with “ORBIT”"),
        ] {
            assert!(lines[at].contains(part), "{part} in {}", lines[at]);
        }
    }
}
