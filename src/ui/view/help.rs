//! The help page: the table of keys, with search.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Line;
use ratatui::widgets::{Block, BorderType, Clear, Widget};

use super::row::Row;
use crate::text::counted;
use crate::ui::app::{App, PageFocus};
use crate::ui::keymap::HelpLine;
use crate::ui::layout;
use crate::ui::theme;

/// Draws the help page if it is open.
pub(crate) fn render(app: &App, area: Rect, buffer: &mut Buffer) {
    let Some(help) = &app.overlays.help else {
        return;
    };
    let lines = app.help_lines();
    let page = layout::centred(area, Rect::new(0, 0, 76, area.height));
    let mut block = Block::bordered()
        .border_type(BorderType::Rounded)
        .border_style(theme::DIM);
    let inner = block.inner(page);
    let (body, search) = layout::split_bottom(inner, 1);
    let rows = usize::from(body.height);
    let top = help.top.min(lines.len().saturating_sub(rows));
    let last = (top + rows).min(lines.len());
    if top < last {
        let place = format!(" {}–{last} of {} ", top + 1, lines.len());
        block = block.title_top(Line::from(place).right_aligned());
    }
    Clear.render(page.intersection(buffer.area), buffer);
    block
        .title(" Keys ")
        .render(page.intersection(buffer.area), buffer);
    for (index, line) in lines[top..last].iter().enumerate() {
        let mut row = Row::new(buffer, body, index as u16);
        row.skip(1);
        match line {
            HelpLine::Heading(heading) => {
                row.put(heading, theme::BOLD);
            }
            HelpLine::Entry { keys, words } => {
                let width = row.room() * 2 / 5;
                row.skip(2)
                    .put_in(keys, width.saturating_sub(3), theme::ACCENT);
                row.skip_to(body.x + 1 + width as u16);
                row.put(words, Style::new());
            }
        }
    }
    let mut row = Row::new(buffer, search, 0);
    row.skip(1);
    if help.focus == PageFocus::Search {
        row.put("/", theme::ACCENT);
        let room = row.room();
        row.put_input(&help.search, room, Style::new(), theme::CURSOR);
        return;
    }
    let is_entry = |line: &&HelpLine| matches!(line, HelpLine::Entry { .. });
    let count = lines.iter().filter(is_entry).count();
    let found = match help.search.value() {
        "" => "/ search  Esc close".to_owned(),
        search => format!("{} with “{search}”", counted(count, "line")),
    };
    row.put(&found, theme::DIM);
}

#[cfg(test)]
mod tests {
    use crate::ui::app::Help;
    use crate::ui::view::tests::{app, drawn};
    use tui_input::Input;

    #[test]
    fn only_matching_lines_are_shown() {
        let mut app = app();
        app.overlays.help = Some(Help {
            search: Input::new("ORBIT".to_owned()),
            ..Help::default()
        });
        let lines = drawn(&app, super::render, 80, 24);
        let found = lines.iter().filter(|line| line.contains("orbit")).count();
        // Four keys and the mouse, under two headings.
        assert!(lines[0].contains("1–7 of 7"), "{}", lines[0]);
        assert_eq!(found, 5, "{lines:#?}");
        assert!(
            lines[1].contains("VIEW") && lines[2].contains("h ←"),
            "{lines:#?}"
        );
        assert!(lines[22].contains("5 lines with “ORBIT”"), "{}", lines[22]);
    }
}
