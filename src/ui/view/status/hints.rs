//! The line of key hints, or of a prompt.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::UnicodeWidthStr;

use crate::app::{App, Prompt, PromptKind};
use crate::view::row::Row;
use crate::{keymap, theme};

/// Draws the prompt, or as many of the current key hints as fit.
pub(crate) fn render_hint(app: &App, area: Rect, buffer: &mut Buffer) {
    let shared = &app.shared;
    if let Some(prompt) = &shared.overlays.prompt {
        render_prompt(prompt, area, buffer);
        return;
    }
    let (hints, lasting) = match shared.typed_line() {
        Some(line) => {
            let hints = keymap::line_hints(line).iter();
            (
                hints.map(|&(key, words)| (key.to_owned(), words)).collect(),
                Vec::new(),
            )
        }
        None => (app.hints(), shared.keymap.lasting_hints(shared.context())),
    };
    let mut row = Row::new(buffer, area, 0);
    row.skip(1);
    let last = room_for(&lasting);
    for hint in &hints {
        if row.room() + 1 < room_for(std::slice::from_ref(hint)) + last {
            break;
        }
        put_hint(&mut row, hint);
    }
    // Their descriptions are the last to go.
    if row.room() + 2 < last {
        for (key, _) in &lasting {
            row.put(key, theme::ACCENT).skip(1);
        }
        return;
    }
    row.skip((row.room() + 2).saturating_sub(last + 1) as u16);
    for hint in &lasting {
        put_hint(&mut row, hint);
    }
}

/// A key and its description in a word or two.
type Hint = (String, &'static str);

/// The cells that hints take, with a gap after each.
fn room_for(hints: &[Hint]) -> usize {
    let widths = hints
        .iter()
        .map(|(key, words)| key.width() + words.width() + 3);
    widths.sum()
}

fn put_hint(row: &mut Row, (key, words): &Hint) {
    row.put(key, theme::ACCENT).put(" ", Style::new());
    row.put(words, theme::DIM).skip(2);
}

/// Draws a line being typed, with its cursor.
pub(crate) fn render_prompt(prompt: &Prompt, area: Rect, buffer: &mut Buffer) {
    let sign = match prompt.kind {
        PromptKind::Command => ":",
        PromptKind::Filter(_) => "/",
        PromptKind::Name => "name: ",
    };
    let blank = " ".repeat(usize::from(area.width));
    Row::new(buffer, area, 0).put(&blank, Style::reset());
    let mut row = Row::new(buffer, area, 0);
    row.put(sign, theme::ACCENT);
    let room = row.room();
    let style = if prompt.is_selected {
        theme::CURSOR
    } else {
        Style::new()
    };
    row.put_input(&prompt.input, room, style, theme::CURSOR);
}
