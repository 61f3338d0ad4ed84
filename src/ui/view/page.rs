//! A page with a list to choose from.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Block, BorderType, Clear, Widget};

use super::row::Row;
use crate::text::counted;
use crate::ui::app::{App, List, Page, PageFocus};
use crate::ui::{layout, theme};

/// Draws the page if one is open.
pub(crate) fn render(app: &App, area: Rect, buffer: &mut Buffer) {
    let Some(page) = &app.shared.overlays.page else {
        return;
    };
    let rows = page.rows();
    let (title, count) = match &page.list {
        List::Views(views, _) => (" Saved views ", views.len()),
        List::Recent(paths) => (" Recent scenes ", paths.len()),
        List::Steps(_) => return,
    };
    let height = u16::try_from(count).unwrap_or(u16::MAX).saturating_add(4);
    let place = layout::centred(area, Rect::new(0, 0, 76, height)).intersection(buffer.area);
    let block = Block::bordered()
        .border_type(BorderType::Rounded)
        .border_style(theme::DIM)
        .title(title);
    let inner = block.inner(place);
    Clear.render(place, buffer);
    block.render(place, buffer);
    let (body, foot) = layout::split_bottom(inner, 2);
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

/// Draws the filter of a page while it is typed, otherwise its keys.
pub(super) fn foot(app: &App, page: &Page, count: usize, area: Rect, buffer: &mut Buffer) {
    let mut row = Row::new(buffer, area, 1);
    row.skip(1);
    if page.focus == PageFocus::Search {
        row.put("/", theme::ACCENT);
        let room = row.room();
        row.put_input(&page.filter.input, room, Style::new(), theme::CURSOR);
        return;
    }
    if !page.filter.input.value().is_empty() {
        let words = format!(
            "{} with “{}”",
            counted(count, "line"),
            page.filter.input.value()
        );
        row.put(&words, theme::DIM).skip(2);
    }
    for (key, words) in app.hints() {
        row.put(&key, theme::ACCENT).put(" ", Style::new());
        row.put(words, theme::DIM).skip(2);
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use tui_input::Input;

    use crate::ui::app::{List, Page};
    use crate::ui::view::tests::{app, check_shown, drawn};

    #[test]
    fn the_rows_that_match_are_listed_with_the_keys() {
        let mut app = app();
        let paths = ["/a/one.ray", "/a/two.dat", "/b/three.xml"].map(PathBuf::from);
        let mut page = Page::new(List::Recent(paths.into()));
        page.filter.at = 1;
        app.shared.overlays.page = Some(page);
        let lines = drawn(&app, super::render, 80, 24);
        check_shown(&lines, &["Recent scenes", "Enter open", "Esc close"]);
        check_shown(&lines, &["  /a/one.ray", "▸ /a/two.dat"]);
        let page = app.shared.overlays.page.as_mut().expect("it is open");
        (page.filter.at, page.filter.input) = (0, Input::new("B/".to_owned()));
        let lines = drawn(&app, super::render, 80, 24);
        check_shown(&lines, &["▸ /b/three.xml", "1 line with “B/”"]);
        assert!(!lines.concat().contains("/a/"), "{lines:#?}");
    }
}
