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
    let nothing = match (found.as_slice(), &typed) {
        ([], None) => command::nothing_found(shared),
        _ => None,
    };
    let rows = found.len().min(SHOWN) + usize::from(typed.is_some() || nothing.is_some());
    // At least half of the screen stays visible.
    let rows = rows.min(usize::from(area.height / 2).saturating_sub(1));
    if rows == 0 {
        return;
    }
    let columns = Columns::of(found.iter().chain(&typed), usize::from(area.width));
    let width = match &nothing {
        Some(nothing) => nothing.width() + 2,
        None => columns.width(),
    };
    let (_, panel) = layout::split_bottom(area, rows as u16 + 1);
    let panel = Rect {
        width: panel.width.min(width as u16),
        ..panel
    };
    clear(panel, buffer);
    let chosen = shared.palette.chosen;
    let place = match found.len() {
        0 => String::new(),
        count => format!("{}/{count}", chosen.map_or(0, |at| at + 1)),
    };
    title("", &place, Focus::Elsewhere, panel, buffer);
    let mut lines = layout::contents(panel);
    if let Some(nothing) = nothing {
        Row::new(buffer, lines, 0).skip(1).put(&nothing, theme::DIM);
        return;
    }
    if let Some(command) = typed {
        entry(&command, &columns, theme::DIM, nth_line(lines, 0), buffer);
        lines = layout::contents(lines);
    }
    let rows = usize::from(lines.height);
    let top = layout::first_shown(0, chosen.unwrap_or(0), found.len(), rows);
    for (index, completion) in found.iter().enumerate().skip(top).take(rows) {
        let is_here = chosen == Some(index);
        let style = if is_here { theme::CURSOR } else { Style::new() };
        let line = nth_line(lines, (index - top) as u16);
        entry(completion, &columns, style, line, buffer);
    }
}

/// The widths of the columns: what is typed or pressed, what it does, and the key of a command.
struct Columns {
    typed: usize,
    words: usize,
    keys: usize,
}

impl Columns {
    /// The columns of some completions, on a screen of this width.
    fn of<'c>(all: impl Iterator<Item = &'c Completion>, room: usize) -> Self {
        let mut columns = Self {
            typed: 0,
            words: 0,
            keys: 0,
        };
        for completion in all {
            let (typed, words, keys) = texts(completion);
            columns.typed = columns.typed.max(typed.width());
            columns.words = columns.words.max(words.width());
            columns.keys = columns.keys.max(keys.width());
        }
        if 0 < columns.words {
            columns.typed = columns.typed.min(room * 2 / 5);
        }
        let others = Self {
            words: 0,
            ..columns
        }
        .width();
        columns.words = columns.words.min(room.saturating_sub(others));
        columns
    }

    fn width(&self) -> usize {
        let keys = if self.keys == 0 { 0 } else { self.keys + 2 };
        self.typed + self.words + keys + 4
    }
}

/// What is typed or pressed for a completion, what it does, and the key of a command.
fn texts(completion: &Completion) -> (&str, &str, &str) {
    let Completion {
        shown,
        words,
        keys,
        act,
        ..
    } = completion;
    match act {
        Some(_) => (keys, shown, ""),
        None => (shown, words, keys),
    }
}

/// Draws a completion in these columns.
fn entry(
    completion: &Completion,
    columns: &Columns,
    style: Style,
    line: Rect,
    buffer: &mut Buffer,
) {
    buffer.set_style(line, style);
    let (typed, words, keys) = texts(completion);
    let mut row = Row::new(buffer, line, 0);
    let look = match completion.act {
        Some(_) => style.patch(theme::ACCENT),
        None => style,
    };
    row.skip(1);
    row.put_in(typed, columns.typed, look);
    row.skip_to(line.x + columns.typed as u16 + 3);
    row.put_in(words, columns.words, style);
    row.skip_to(line.right().saturating_sub(keys.width() as u16 + 1));
    row.put(keys, style.patch(theme::ACCENT));
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
