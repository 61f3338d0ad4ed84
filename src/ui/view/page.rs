//! Pages over the screen: a frame, the rows to choose from or the lines to read, and at the foot the filter or
//! the keys.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::row::Row;
use crate::app::{App, Page, PageFocus};
use crate::{framing, layout, theme};
use text::counted;

/// Draws a page of rows, as high as they need.
pub(super) fn render(app: &App, page: &Page, area: Rect, buffer: &mut Buffer) {
    let height = u16::try_from(page.rows.len()).unwrap_or(u16::MAX);
    let place = layout::centred(area, Rect::new(0, 0, 76, height.saturating_add(4)));
    let inner = frame(page.title, "", place, buffer);
    let (body, foot) = layout::split_bottom(inner, 2);
    let rows = page.shown();
    let visible = usize::from(body.height);
    let top = layout::first_shown(0, page.filter.at, rows.len(), visible);
    for (line, (_, words)) in rows.iter().skip(top).take(visible).enumerate() {
        let is_here = top + line == page.filter.at;
        let mut row = Row::new(buffer, body, line as u16);
        let style = if is_here { theme::BOLD } else { Style::new() };
        row.put(if is_here { "▸ " } else { "  " }, style);
        row.put(words, style);
    }
    self::foot(app, page, rows.len(), foot, buffer);
}

/// Clears and frames a page, with a title and what of it is shown; returns the area inside.
pub(super) fn frame(title: &str, shown: &str, place: Rect, buffer: &mut Buffer) -> Rect {
    framing::frame(&format!(" {title} "), shown, theme::DIM, place, buffer)
}

/// Draws the filter of a page while it is typed, otherwise its keys.
pub(super) fn foot(app: &App, page: &Page, count: usize, area: Rect, buffer: &mut Buffer) {
    let mut row = Row::new(buffer, area, 1);
    row.skip(1);
    if typed(page, &mut row) {
        return;
    }
    if !page.filter.input.value().is_empty() {
        row.put(&found(page, count), theme::DIM).skip(2);
    }
    for (key, words) in app.hints() {
        row.put(&key, theme::ACCENT).put(" ", Style::new());
        row.put(words, theme::DIM).skip(2);
    }
}

/// Draws the filter while keys are typed into it; returns whether they are.
pub(super) fn typed(page: &Page, row: &mut Row) -> bool {
    let is_typed = page.focus == PageFocus::Search;
    if is_typed {
        row.put("/", theme::ACCENT);
        let room = row.room();
        row.put_input(&page.filter.input, room, Style::new(), theme::CURSOR);
    }
    is_typed
}

/// How many lines the filter leaves.
pub(super) fn found(page: &Page, count: usize) -> String {
    let filter = page.filter.input.value();
    format!("{} with “{filter}”", counted(count, "line"))
}

#[cfg(test)]
mod tests {
    use ratatui::buffer::Buffer;
    use ratatui::layout::Rect;
    use tui_input::Input;

    use crate::app::{App, Page};
    use crate::keymap::Context;
    use crate::view::tests::{app, check_shown, drawn};

    #[test]
    fn the_rows_that_match_are_listed_with_the_keys() {
        let render = |app: &App, area: Rect, buffer: &mut Buffer| {
            let page = app
                .shared
                .overlays
                .page(Context::Recent)
                .expect("it is open");
            super::render(app, page, area, buffer);
        };
        let mut app = app();
        let paths = ["/a/one.ray", "/a/two.dat", "/b/three.xml"];
        let paths = paths.map(str::to_owned);
        let mut page = Page::of(Context::Recent, "Recent scenes", paths.into());
        page.filter.at = 1;
        app.shared.overlays.page = Some(page);
        let lines = drawn(&app, render, 80, 24);
        check_shown(&lines, &["Recent scenes", "Enter open", "Esc close"]);
        check_shown(&lines, &["  /a/one.ray", "▸ /a/two.dat"]);
        let page = app.shared.overlays.page.as_mut().expect("it is open");
        (page.filter.at, page.filter.input) = (0, Input::new("B/".to_owned()));
        let lines = drawn(&app, render, 80, 24);
        check_shown(&lines, &["▸ /b/three.xml", "1 line with “B/”"]);
        assert!(!lines.concat().contains("/a/"), "{lines:#?}");
    }
}
