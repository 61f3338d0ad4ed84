//! The mouse.

use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};
use tui_input::Input;

use super::{App, Mode};
use crate::ui::keymap::Context;
use crate::ui::msg::{Effect, Timer};
use crate::ui::view::errors;
use crate::ui::view::layout::{field_at, list_row_at, pixel_at};

/// How far dragging across a cell orbits, in degrees: a cell is twice as high as wide.
const DRAG: (f64, f64) = (2.0, 4.0);
/// Lines that go by with one turn of the wheel.
const WHEEL: isize = 3;

impl App {
    /// Takes a mouse event. While a question or a line waits for an answer, the mouse does
    /// nothing.
    pub(super) fn pointer(&mut self, event: MouseEvent) -> Vec<Effect> {
        let at = (event.column, event.row);
        let waits = self.dialog.is_some()
            || self.prompt.is_some()
            || self.is_opening() && self.help.is_none();
        match event.kind {
            _ if waits => {}
            MouseEventKind::ScrollUp => self.wheel(at, -1),
            MouseEventKind::ScrollDown => self.wheel(at, 1),
            _ if self.help.is_some() => {}
            MouseEventKind::Down(MouseButton::Left) => return self.press(at),
            MouseEventKind::Drag(MouseButton::Left) => self.drag(at),
            MouseEventKind::Up(_) => self.pending.drag = None,
            _ => {}
        }
        Vec::new()
    }

    fn wheel(&mut self, at: (u16, u16), down: isize) {
        if self.help.is_some() {
            self.move_cursor(Context::Help, WHEEL * down);
            return;
        }
        let areas = self.areas();
        let over = |area: ratatui::layout::Rect| area.contains(at.into());
        if errors::panel(self, areas.errors).is_some_and(|panel| over(panel.area)) {
            if self.errors.is_some() {
                self.move_cursor(Context::Errors, down);
            }
        } else if over(areas.list) {
            self.move_cursor(Context::In(Mode::Select), WHEEL * down);
        } else if over(areas.fields) && self.typing.is_none() {
            self.move_cursor(Context::In(Mode::Edit), down);
        } else if over(areas.picture) && self.mode == Mode::View {
            self.dolly(if down < 0 { 1 } else { -1 });
        }
    }

    fn press(&mut self, at: (u16, u16)) -> Vec<Effect> {
        self.clear_message();
        self.typing = None;
        let areas = self.areas();
        if let Some(row) = list_row_at(areas.list, self.list_top, at.0, at.1) {
            if let Some(node) = self.nodes().get(row) {
                self.select(node);
                self.errors = None;
                self.mode = Mode::Select;
            }
            return Vec::new();
        }
        // It lies over the picture: what is below it is not meant.
        if let Some(panel) = errors::panel(self, areas.errors)
            && panel.area.contains(at.into())
        {
            let clicked = panel.diagnostic_at(at.1);
            self.errors = clicked.or(self.errors);
            if clicked.is_some() {
                self.go_to_error();
            }
            return Vec::new();
        }
        let placed = self.placed();
        let components = |field: usize| Some(placed.get(field)?.field.kind.components());
        if let Some(clicked) = field_at(areas.fields, self.field_top, components, at) {
            return self.press_field(clicked);
        }
        if self.mode == Mode::View && areas.picture.contains(at.into()) {
            self.pending.drag = Some(at);
        } else if let Some(raster) = self.raster() {
            let size = self.picture().shown.size;
            if let Some((x, y)) = pixel_at(raster, size, at.0, at.1) {
                self.pick(x, y);
            }
        }
        Vec::new()
    }

    /// One click puts the cursor there, a second one types.
    fn press_field(&mut self, (field, component): (usize, usize)) -> Vec<Effect> {
        self.mode = Mode::Edit;
        self.focus_field(field, component);
        if self.pending.click.take() == Some((field, component)) {
            let row = self.fields().into_iter().nth(field);
            let literal = row.and_then(|row| row.literals.get(component).cloned());
            self.type_value(Input::from(literal.unwrap_or_default()));
            return Vec::new();
        }
        self.pending.click = Some((field, component));
        vec![Effect::Later(super::DOUBLE_CLICK, Timer::Click)]
    }

    fn drag(&mut self, at: (u16, u16)) {
        let Some(from) = self.pending.drag.filter(|_| self.mode == Mode::View) else {
            return;
        };
        let moved = |from: u16, to: u16| f64::from(to) - f64::from(from);
        // The scene follows the pointer, so the camera goes the other way.
        self.orbit(DRAG.0 * moved(from.0, at.0), DRAG.1 * moved(from.1, at.1));
        self.pending.drag = Some(at);
    }
}
