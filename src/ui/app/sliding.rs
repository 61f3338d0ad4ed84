//! Sliders of numbers from 0 to 1, dragged with the mouse: one undo step a drag.

use ratatui::layout::Rect;

use super::cursor::Slide;
use super::{Shared, colours};
use crate::language::Node;
use crate::text::{Edit, parse_number, spell_like};
use crate::ui::keymap::Mode;
use crate::ui::layout::{field_rows, share_at, slider_cells};

impl Shared {
    /// The cells of a field's slider in its line; `None` for other fields, and if there is no room.
    pub fn slider(&self, field: usize, line: Rect) -> Option<Rect> {
        let row = self.field_row(field)?;
        let is_text = self.cursor.selected() != Node::View && row.field.is_share();
        slider_cells(line, row.literals.first()?).filter(|_| is_text)
    }

    /// Starts to drag the slider under a cell; returns whether there is one.
    pub(super) fn press_slider(&mut self, (column, row): (u16, u16)) -> bool {
        let lines = field_rows(self.areas().fields);
        if !lines.contains((column, row).into()) {
            return false;
        }
        let field = self.cursor.field_top + usize::from(row - lines.y);
        let line = Rect {
            y: row,
            height: 1,
            ..lines
        };
        let Some(bar) = self.slider(field, line) else {
            return false;
        };
        if !bar.contains((column, row).into()) {
            return false;
        }
        self.mode = Mode::Edit;
        self.focus_field(field, 0);
        let live_edit = self.begin_live_edit();
        self.cursor.slide = Some(Slide { bar, live_edit });
        self.slide_to(column);
        true
    }

    /// Moves the slider being dragged to a column; returns whether there is one.
    pub(super) fn slide_to(&mut self, column: u16) -> bool {
        let Some(mut slide) = self.cursor.slide.take() else {
            return false;
        };
        if self.leaves_live_edit(&slide.live_edit, "number") {
            return true;
        }
        // A hundredth is finer than a cell.
        let share = (100.0 * share_at(slide.bar, column)).round() / 100.0;
        let outcome = self.try_instead(&mut slide.live_edit, |shared| {
            Ok(shared.edits_sliding(share))
        });
        if let Err(reason) = outcome {
            self.overlays.fail(reason);
        }
        self.cursor.slide = Some(slide);
        true
    }

    /// Keeps the number of the slider being dragged.
    pub(super) fn end_slide(&mut self) {
        if self.cursor.slide.take().is_some() {
            self.keep_live_edit();
        }
    }

    /// The edits that set the current field to a number; none if it has that already.
    fn edits_sliding(&self, share: f64) -> Vec<Edit> {
        let Some(placed) = self.cursor.current() else {
            return Vec::new();
        };
        let present = colours::literals(self.source(), placed);
        let present = present.first().map_or("", |literal| literal.trim());
        if parse_number(present) == Ok(share) && !self.sets_marked() {
            return Vec::new();
        }
        let literal = match placed.default_of(0) {
            Some(_) => share.to_string(),
            None => spell_like(present, share),
        };
        self.edits_of(&[(placed, &[(0, literal)])])
    }
}
