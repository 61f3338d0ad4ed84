//! The current field at the end of the status line, where there are no panels to show it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::UnicodeWidthStr;

use super::fields::typed;
use super::row::Row;
use crate::app::{FieldRow, Message, Shared};
use crate::arrange::Areas;
use crate::keymap::Mode;
use crate::layout::split_right;
use crate::theme;
use text::Severity;

/// The cells that are left for the mode.
const MODE: u16 = 7;

/// The cells for a value being typed, if there are as many.
const TYPED: usize = 16;

/// Draws the current field: its name and its numbers, and what is typed. Returns the cells that are
/// left of the status line.
pub(crate) fn render(shared: &Shared, areas: &Areas, buffer: &mut Buffer) -> Rect {
    let Some(field) = field(shared, areas) else {
        return areas.status;
    };
    let component = shared.cursor.component;
    let most = areas.status.width.saturating_sub(MODE);
    let value = field.literals.get(component).map_or("", String::as_str);
    let names = field.field.kind.component_names();
    let name = named(field.field.key, names, component);
    let whole = field.field.key.width() + 1 + width_of(&field.literals);
    let is_whole = shared.cursor.typing.is_none() && whole < usize::from(most);
    let alone = match &shared.cursor.typing {
        Some(typing) => (typing.input.value().width() + 1).max(TYPED),
        None => value.width(),
    };
    let cut = name.width() + 1 + alone;
    let wanted = if is_whole { whole } else { cut };
    let width = u16::try_from(wanted + 1).unwrap_or(u16::MAX).min(most);
    let (left, mut area) = split_right(areas.status, width);
    // The last cell keeps a gap to the border.
    area.width = area.width.saturating_sub(1);
    let mut row = Row::new(buffer, area, 0);
    if is_whole {
        row.put(field.field.key, theme::BOLD);
        for (at, literal) in field.literals.iter().enumerate() {
            let is_here = at == component;
            let style = if is_here { theme::CURSOR } else { Style::new() };
            row.skip(1).put(literal, style);
        }
        return left;
    }
    // The value is the last to be cut.
    let room = row.room().saturating_sub(alone + 1);
    row.put_in(&name, room, theme::BOLD);
    match &shared.cursor.typing {
        Some(typing) => {
            let room = row.skip(1).room() as u16;
            typed(typing, split_right(area, room).1, buffer);
        }
        None => {
            row.skip(1).put(value, theme::CURSOR);
        }
    }
    left
}

/// Why the value being typed was refused, where no panel says so.
pub(crate) fn refusal(shared: &Shared, areas: &Areas) -> Option<Message> {
    field(shared, areas)?;
    let refused = shared.cursor.typing.as_ref()?.refused.as_ref()?;
    Some(Message {
        severity: Some(Severity::Error),
        text: refused.message.clone(),
    })
}

/// The current field, if it is edited where there are no panels.
fn field(shared: &Shared, areas: &Areas) -> Option<FieldRow> {
    let is_blind = shared.mode == Mode::Edit && areas.fields.is_empty();
    let mut fields = shared.fields().into_iter();
    fields.nth(shared.cursor.field).filter(|_| is_blind)
}

/// The name of a field with that of its component: `centre x`.
fn named(key: &str, components: &[&str], component: usize) -> String {
    match components.get(component) {
        Some(&"") | None => key.to_owned(),
        Some(component) => format!("{key} {component}"),
    }
}

/// The cells of literals with a gap between them.
fn width_of(literals: &[String]) -> usize {
    let widths = literals.iter().map(|literal| literal.width() + 1);
    widths.sum::<usize>().saturating_sub(1)
}
