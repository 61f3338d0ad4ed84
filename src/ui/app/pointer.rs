//! The mouse.

use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};

use super::App;
use super::camera::{advanced, dollied, orbited, turned};
use super::model::Border;
use crate::ui::keymap::{Context, Mode};
use crate::ui::layout::{field_at, list_row_at, pixel_at};
use crate::ui::listing::{ListLine, Listing};
use crate::ui::msg::{Effect, Timer};

/// Angles of orbit, in degrees, for dragging across a cell, which is twice as high as wide.
const DRAG: (f64, f64) = (2.0, 4.0);
/// The number of lines that one notch of the wheel scrolls.
const WHEEL: isize = 3;

impl App {
    /// Handles a mouse event. Ignored while a dialog or a line is open or the scene is being read.
    pub(super) fn pointer(&mut self, event: MouseEvent) -> Vec<Effect> {
        let at = (event.column, event.row);
        let waits = self.overlays.dialog.is_some()
            || self.overlays.prompt.is_some()
            || self.overlays.page.is_some()
            || self.disk.is_opening() && self.overlays.help.is_none();
        match event.kind {
            _ if waits => {}
            MouseEventKind::ScrollUp => self.wheel(at, -1),
            MouseEventKind::ScrollDown => self.wheel(at, 1),
            _ if self.overlays.help.is_some() => {}
            MouseEventKind::Down(MouseButton::Left) => return self.press(at),
            MouseEventKind::Drag(MouseButton::Left) => self.drag(at),
            MouseEventKind::Up(_) => {
                self.pictures.drag = None;
                self.resizing = None;
            }
            _ => {}
        }
        Vec::new()
    }

    fn wheel(&mut self, at: (u16, u16), down: isize) {
        if self.overlays.help.is_some() {
            self.move_cursor(Context::Help, WHEEL * down);
            return;
        }
        let (areas, mode) = (self.areas(), self.mode);
        let over = |area: ratatui::layout::Rect| area.contains(at.into());
        if self
            .errors_panel(areas.errors)
            .is_some_and(|panel| over(panel.area))
        {
            if self.overlays.errors.is_some() {
                self.move_cursor(Context::Errors, down);
            }
        } else if over(areas.list) {
            self.move_cursor(Context::In(Mode::Select), WHEEL * down);
        } else if over(areas.fields) && self.cursor.typing.is_none() {
            self.move_cursor(Context::In(Mode::Edit), down);
        } else if over(areas.picture) && self.mode.moves_camera() {
            let steps = if down < 0 { 1 } else { -1 };
            self.move_camera(|now| match mode {
                Mode::Fly => advanced(now, steps),
                _ => dollied(now, steps),
            });
        }
    }

    fn press(&mut self, at: (u16, u16)) -> Vec<Effect> {
        self.overlays.clear_message();
        self.cursor.typing = None;
        let areas = self.areas();
        if self.mode == Mode::Move && !areas.picture.contains(at.into()) {
            self.confirm_transform();
        }
        if areas.border.contains(at.into()) {
            self.resizing = Some(Border::Panels);
            return Vec::new();
        }
        if areas.divider().contains(at.into()) {
            self.resizing = Some(Border::List);
            return Vec::new();
        }
        if let Some(line) = list_row_at(areas.list, self.cursor.list_top, at.0, at.1) {
            let line = Listing::new(self.nodes()).get(line);
            if let Some(ListLine::Node(_, node)) = line {
                self.select(node);
                self.overlays.errors = None;
                self.mode = Mode::Select;
            }
            return Vec::new();
        }
        if let Some(panel) = self.errors_panel(areas.errors)
            && panel.area.contains(at.into())
        {
            let clicked = panel.diagnostic_at(at.1);
            self.overlays.errors = clicked.or(self.overlays.errors);
            if clicked.is_some() {
                self.go_to_error();
            }
            return Vec::new();
        }
        let fields = self.cursor.fields();
        let components = |field: usize| Some(fields.get(field)?.field.kind.components());
        if let Some(clicked) = field_at(areas.fields, self.cursor.field_top, components, at) {
            return self.press_field(clicked);
        }
        let drags = self.mode.moves_camera() || self.mode == Mode::Move;
        if drags && areas.picture.contains(at.into()) {
            self.pictures.drag = Some(at);
        } else if let Some(raster) = self.raster() {
            let size = self.picture().shown.size;
            if let Some((x, y)) = pixel_at(raster, size, at.0, at.1) {
                self.pick(x, y);
            }
        }
        Vec::new()
    }

    /// The first click moves the cursor there, the second starts typing.
    fn press_field(&mut self, (field, component): (usize, usize)) -> Vec<Effect> {
        self.mode = Mode::Edit;
        self.focus_field(field, component);
        if self.cursor.click((field, component)) {
            self.type_current();
            return Vec::new();
        }
        vec![Effect::Later(super::DOUBLE_CLICK, Timer::Click)]
    }

    fn drag(&mut self, at: (u16, u16)) {
        match self.resizing {
            Some(Border::Panels) => return self.resize_panels(self.areas().dragged(at)),
            Some(Border::List) => return self.resize_list(self.areas().divided_at(at)),
            None => {}
        }
        let Some(from) = self.pictures.drag else {
            return;
        };
        let moved = |from: u16, to: u16| f64::from(to) - f64::from(from);
        if self.mode == Mode::Move {
            // A cell shows two pixels, one above the other.
            let (right, down) = (moved(from.0, at.0), 2.0 * moved(from.1, at.1));
            self.drag_transform(right, -down);
            self.pictures.drag = Some(at);
            return;
        }
        if !self.mode.moves_camera() {
            return;
        }
        // The scene follows the pointer, so the camera moves the opposite way.
        let (left, up) = (DRAG.0 * moved(from.0, at.0), DRAG.1 * moved(from.1, at.1));
        match self.mode {
            // About the angle of a cell, so that the picture follows the pointer.
            Mode::Fly => self.move_camera(|now| turned(now, left / 4.0, up / 4.0)),
            _ => self.move_camera(|now| orbited(now, left, up)),
        }
        self.pictures.drag = Some(at);
    }
}
