//! The line of key hints, or of a prompt.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::UnicodeWidthStr;

use crate::app::{App, Prompt, PromptKind, ranked_hints};
use crate::keymap::RankedHint;
use crate::view::row::Row;
use crate::{keymap, theme};

/// Draws the prompt, or as many of the current key hints as fit.
pub(crate) fn render_hint(app: &App, area: Rect, buffer: &mut Buffer) {
    let shared = &app.shared;
    if let Some(prompt) = &shared.overlays.prompt {
        render_prompt(prompt, area, buffer);
        return;
    }
    let (hints, lasting) = if let Some(line) = shared.typed_line() {
        let hints = keymap::line_hints(line).iter();
        let hints = hints.map(|&(key, words)| RankedHint {
            entry: (key.to_owned(), words),
            stays: false,
        });
        (hints.collect(), Vec::new())
    } else {
        let lasting = shared.keymap.lasting_hints(shared.context());
        (ranked_hints(app), lasting)
    };
    let mut row = Row::new(buffer, area, 0);
    row.skip(1);
    // The gap after the last one may be cut.
    let room = row.room() + 1;
    let needed = hints.iter().filter(|hint| hint.stays);
    let needed: usize = needed.map(|hint| room_for(&hint.entry)).sum();
    let lasting = shortened(lasting, room, needed);
    let last = lasting.iter().map(room_for).sum();
    for hint in fitting(&hints, room.saturating_sub(last)) {
        put_hint(&mut row, hint);
    }
    row.skip((row.room() + 1).saturating_sub(last) as u16);
    for hint in &lasting {
        put_hint(&mut row, hint);
    }
}

/// A key and its description in a word or two.
type Hint = (String, &'static str);

/// The hints that are never omitted, without their descriptions but the first where others that stay need
/// the room, and without any where there is none.
fn shortened(lasting: Vec<Hint>, room: usize, needed: usize) -> Vec<Hint> {
    let with_words = |count: usize| {
        let hints = lasting.iter().enumerate();
        let hints = hints.map(|(at, (key, words))| {
            let words = if at < count { *words } else { "" };
            (key.clone(), words)
        });
        hints.collect::<Vec<_>>()
    };
    let cells = |hints: &[Hint]| hints.iter().map(room_for).sum::<usize>();
    let first = with_words(1);
    if needed + cells(&lasting) <= room {
        lasting
    } else if cells(&first) <= room {
        first
    } else {
        with_words(0)
    }
}

/// The hints that fit into so many cells: first those that stay, then the most useful of the others.
fn fitting(hints: &[RankedHint], mut room: usize) -> impl Iterator<Item = &Hint> {
    let mut shown = vec![false; hints.len()];
    for stays in [true, false] {
        for (at, hint) in hints
            .iter()
            .enumerate()
            .filter(|(_, hint)| hint.stays == stays)
        {
            if let Some(left) = room.checked_sub(room_for(&hint.entry)) {
                room = left;
                shown[at] = true;
            }
        }
    }
    let hints = hints.iter().zip(shown);
    hints.filter_map(|(hint, shown)| shown.then_some(&hint.entry))
}

/// The cells that a hint takes, with a gap after it.
fn room_for((key, words): &Hint) -> usize {
    match words.width() {
        0 => key.width() + 1,
        words => key.width() + words + 3,
    }
}

fn put_hint(row: &mut Row, (key, words): &Hint) {
    row.put(key, theme::ACCENT).skip(1);
    if !words.is_empty() {
        row.put(words, theme::DIM).skip(2);
    }
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
