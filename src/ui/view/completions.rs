//! The palette above the command line: the command being typed, and the ways to complete it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::UnicodeWidthStr;

use super::row::{Focus, Row, title};
use crate::app::{Completion, Shared, command};
use crate::framing::clear;
use crate::layout::nth_line;
use crate::{layout, theme};

/// Maximum number of completions shown.
const SHOWN: usize = 12;

/// Draws the palette at the bottom of `area` while a command is typed.
pub(crate) fn render(shared: &Shared, area: Rect, buffer: &mut Buffer) {
    let found = command::completions(shared);
    let typed = command::command_typed(shared);
    let rows = found.len().min(SHOWN) + usize::from(typed.is_some());
    // At least half of the screen stays visible.
    let rows = rows.min(usize::from(area.height / 2).saturating_sub(1));
    if rows == 0 {
        return;
    }
    let (_, panel) = layout::split_bottom(area, rows as u16 + 1);
    clear(panel, buffer);
    let chosen = shared.palette.chosen;
    let place = match found.len() {
        0 => String::new(),
        count => format!("{}/{count}", chosen.map_or(0, |at| at + 1)),
    };
    title("", &place, Focus::Elsewhere, panel, buffer);
    let mut lines = layout::contents(panel);
    if let Some(command) = typed {
        entry(&command, theme::DIM, nth_line(lines, 0), buffer);
        lines = layout::contents(lines);
    }
    let rows = usize::from(lines.height);
    let top = layout::first_shown(0, chosen.unwrap_or(0), found.len(), rows);
    for (index, completion) in found.iter().enumerate().skip(top).take(rows) {
        let is_here = chosen == Some(index);
        let style = if is_here { theme::CURSOR } else { Style::new() };
        let line = nth_line(lines, (index - top) as u16);
        entry(completion, style, line, buffer);
    }
}

/// Draws a completion: its text, its description, and its key at the end.
fn entry(completion: &Completion, style: Style, line: Rect, buffer: &mut Buffer) {
    buffer.set_style(line, style);
    let mut row = Row::new(buffer, line, 0);
    let keys = completion.keys.width();
    let room = row.room().saturating_sub(keys + 3);
    let column = match completion.words {
        "" => room,
        _ => room * 2 / 5,
    };
    row.skip(1);
    row.put_in(&completion.shown, column.saturating_sub(1), style);
    if !completion.words.is_empty() {
        row.skip_to(line.x + 1 + column as u16);
        row.put_in(completion.words, room - column, style.patch(theme::DIM));
    }
    row.skip_to((line.right()).saturating_sub(keys as u16 + 1));
    row.put(&completion.keys, style.patch(theme::ACCENT));
}

#[cfg(test)]
mod tests {
    use crate::app::PromptKind;
    use crate::view::tests::{app, drawn, press};

    #[test]
    fn commands_are_shown_with_their_help_and_key() {
        let mut app = app();
        press(&mut app, ":vie");
        let prompt = app.shared.overlays.prompt.as_ref();
        assert!(prompt.is_some_and(|prompt| prompt.kind == PromptKind::Command));
        let lines = drawn(&app.shared, super::render, 70, 24);
        let line = lines.iter().find(|line| line.contains(":view save"));
        let line = line.expect("it is offered");
        assert!(line.contains("write the view into the scene"), "{line}");
        assert!(line.ends_with('S'), "{line}");
    }

    #[test]
    fn the_arguments_of_a_command_are_shown_while_they_are_typed() {
        let mut app = app();
        press(&mut app, ":size 8");
        let lines = drawn(&app.shared, super::render, 70, 24);
        assert!(lines[23].contains(":size WxH"), "{lines:#?}");
    }
}
