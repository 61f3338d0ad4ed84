//! Sliders of numbers from 0 to 1, dragged with the mouse: one undo step a drag.

use ratatui::layout::Rect;

use super::repeating::note_set;
use crate::app::shared::cursor::Slide;
use crate::app::values::colours;
use crate::app::{Shared, text};
use crate::keymap::Mode;
use crate::layout::{field_rows, share_at, slider_cells};
use ::text::{Edit, parse_number, spell_like};
use language::Node;

/// The cells of a field's slider in its line; `None` for other fields, and if there is no room.
pub(crate) fn slider(shared: &Shared, field: usize, line: Rect) -> Option<Rect> {
    let row = shared.field_row(field)?;
    let is_text = shared.cursor.selected() != Node::View && row.field.is_share();
    slider_cells(line, row.literals.first()?).filter(|_| is_text)
}

/// Starts to drag the slider under a cell; returns whether there is one.
pub(crate) fn press_slider(shared: &mut Shared, (column, row): (u16, u16)) -> bool {
    let areas = shared.areas();
    let lines = field_rows(areas.fields, areas.explains);
    if !lines.contains((column, row).into()) {
        return false;
    }
    let field = shared.cursor.field_top + usize::from(row - lines.y);
    let line = Rect {
        y: row,
        height: 1,
        ..lines
    };
    let bar = slider(shared, field, line);
    let Some(bar) = bar.filter(|bar| bar.contains((column, row).into())) else {
        return false;
    };
    shared.mode = Mode::Edit;
    shared.focus_field(field, 0);
    let live_edit = text::begin_live_edit(shared);
    shared.cursor.slide = Some(Slide { bar, live_edit });
    slide_to(shared, column);
    true
}

/// Moves the slider being dragged to a column; returns whether there is one.
pub(crate) fn slide_to(shared: &mut Shared, column: u16) -> bool {
    let Some(mut slide) = shared.cursor.slide.take() else {
        return false;
    };
    if text::leaves_live_edit(shared, &slide.live_edit, "number") {
        return true;
    }
    // A hundredth is finer than a cell.
    let share = (100.0 * share_at(slide.bar, column)).round() / 100.0;
    text::try_or_fail(shared, &mut slide.live_edit, |shared| {
        Ok(edits_sliding(shared, share))
    });
    shared.cursor.slide = Some(slide);
    true
}

/// Keeps the number of the slider being dragged.
pub(crate) fn end_slide(shared: &mut Shared) {
    if let Some(slide) = shared.cursor.slide.take() {
        text::keep_live_edit(shared);
        if slide.live_edit.is_applied {
            note_set(shared);
            text::say_marked(shared);
        }
    }
}

/// The edits that set the current field to a number; none if it has that already.
fn edits_sliding(shared: &Shared, share: f64) -> Vec<Edit> {
    let Some(placed) = shared.cursor.current() else {
        return Vec::new();
    };
    let present = colours::literals(shared.source(), placed);
    let present = present.first().map_or("", |literal| literal.trim());
    if parse_number(present) == Ok(share) && !text::sets_marked(shared) {
        return Vec::new();
    }
    let literal = match placed.default_of(0) {
        Some(_) => share.to_string(),
        None => spell_like(present, share),
    };
    text::edits_of(shared, &[(placed, vec![(0, literal)])])
}
