//! The mouse.

use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::camera::{advanced, dollied, orbited, shifted, turned};
use super::drawing::Held;
use super::shared::Border;
use super::{App, PickerRow, Shared};
use crate::render::{axes, pixel_width};
use crate::ui::keymap::{Context, Mode};
use crate::ui::layout::{
    contents, field_at, first_shown, list_row_at, picker_lines, share_at, swatch_cells,
};
use crate::ui::listing::ListLine;
use crate::ui::msg::{Effect, Timer};

/// Angles of orbit, in degrees, for dragging across a cell, which is twice as high as wide.
const DRAG: (f64, f64) = (2.0, 4.0);
/// The number of lines that one notch of the wheel scrolls.
const WHEEL: isize = 3;

/// What is left of a mouse event after what is the same in all modes.
enum Pointed {
    /// Nothing.
    Done(Vec<Effect>),
    /// A press of the left button.
    Press((u16, u16)),
    /// Dragging with the left button.
    Drag((u16, u16)),
}

impl App {
    /// Handles a mouse event. Ignored while a dialog or a line is open or the scene is being read.
    pub(super) fn pointer(&mut self, event: MouseEvent) -> Vec<Effect> {
        match self.shared.point(event) {
            Pointed::Done(effects) => effects,
            Pointed::Press(at) => {
                let taken = self.press(at);
                taken.unwrap_or_else(|| self.shared.press(at))
            }
            Pointed::Drag(at) => {
                let taken = self.drag(at);
                taken.unwrap_or_else(|| {
                    self.shared.drag(at);
                    Vec::new()
                })
            }
        }
    }
}

impl Shared {
    /// Does what a mouse event does in all modes; nothing while a dialog or a line is open or the scene is
    /// being read.
    fn point(&mut self, event: MouseEvent) -> Pointed {
        let at = (event.column, event.row);
        let waits = self.overlays.dialog.is_some()
            || self.overlays.prompt.is_some()
            || self.overlays.page.is_some()
            || self.disk.is_opening() && self.overlays.help.is_none();
        match event.kind {
            _ if waits => {}
            MouseEventKind::ScrollUp | MouseEventKind::ScrollDown
                if self.overlays.menu.is_some() || self.overlays.picker.is_some() => {}
            MouseEventKind::ScrollUp | MouseEventKind::ScrollDown
                if self.zooms(at, event.modifiers) =>
            {
                let steps = if event.kind == MouseEventKind::ScrollUp {
                    1
                } else {
                    -1
                };
                self.magnify_at(steps, at);
            }
            MouseEventKind::ScrollUp => self.wheel(at, -1),
            MouseEventKind::ScrollDown => self.wheel(at, 1),
            _ if self.overlays.help.is_some() => {}
            MouseEventKind::Down(MouseButton::Left) if self.overlays.picker.is_some() => {
                self.press_picker(at);
            }
            MouseEventKind::Drag(MouseButton::Left) if self.overlays.picker.is_some() => {
                self.drag_picker(at.0);
            }
            MouseEventKind::Down(MouseButton::Left) if self.overlays.menu.is_some() => {
                self.press_menu(at);
            }
            MouseEventKind::Down(MouseButton::Left) if !self.begin_press(at) => {
                return Pointed::Press(at);
            }
            MouseEventKind::Down(MouseButton::Left) => {}
            MouseEventKind::Down(_) => self.press_to_pan(at),
            MouseEventKind::Drag(MouseButton::Left)
                if !event.modifiers.contains(KeyModifiers::CONTROL) && !self.drag_border(at) =>
            {
                return Pointed::Drag(at);
            }
            MouseEventKind::Drag(MouseButton::Left)
                if !event.modifiers.contains(KeyModifiers::CONTROL) => {}
            MouseEventKind::Drag(_) => self.drag_to_pan(at),
            MouseEventKind::Up(_) if self.is_drawing_region() => {
                return Pointed::Done(self.confirm_region());
            }
            MouseEventKind::Up(_) => {
                self.pictures.drag = None;
                self.resizing = None;
                self.end_slide();
            }
            _ => {}
        }
        Pointed::Done(Vec::new())
    }

    /// Whether the wheel zooms the picture here.
    fn zooms(&self, at: (u16, u16), modifiers: KeyModifiers) -> bool {
        let asked = self.mode == Mode::Trace || modifiers.contains(KeyModifiers::CONTROL);
        asked && self.overlays.help.is_none() && self.areas().picture.contains(at.into())
    }

    /// Whether the pointer is drawing a region.
    fn is_drawing_region(&self) -> bool {
        let drawing = self.pictures.drawing;
        drawing.is_some_and(|drawing| drawing.held == Held::ByPointer)
    }

    /// The cell of the picture at this cell of the screen, or the nearest one.
    fn cell_near(&self, at: (u16, u16)) -> Option<(u16, u16)> {
        let (cells, _) = self.raster()?;
        let near =
            |at: u16, from: u16, length: u16| at.saturating_sub(from).min(length.saturating_sub(1));
        Some((
            near(at.0, cells.x, cells.width),
            near(at.1, cells.y, cells.height),
        ))
    }

    /// Whether dragging pans the picture on screen.
    fn pans(&self) -> bool {
        !self.viewport().is_fit() && !self.mode.moves_camera() && self.mode != Mode::Move
    }

    fn wheel(&mut self, at: (u16, u16), down: isize) {
        if self.overlays.help.is_some() {
            self.move_cursor_in(Context::Help, WHEEL * down);
            return;
        }
        if self.mode == Mode::Compare {
            return;
        }
        let (areas, mode) = (self.areas(), self.mode);
        let over = |area: ratatui::layout::Rect| area.contains(at.into());
        if self
            .errors_panel(areas.errors)
            .is_some_and(|panel| over(panel.area))
        {
            if self.overlays.errors.is_some() {
                self.move_cursor_in(Context::Errors, down);
            }
        } else if self.context() == Context::Rays {
            self.move_in_rays(down);
        } else if over(areas.list) {
            self.move_cursor_in(Context::In(Mode::Select), WHEEL * down);
        } else if over(areas.fields) && self.cursor.typing.is_none() {
            self.move_cursor_in(Context::In(Mode::Edit), down);
        } else if over(areas.picture) && self.mode.moves_camera() {
            let steps = if down < 0 { 1 } else { -1 };
            self.move_camera(|now| match mode {
                Mode::Fly => advanced(now, steps),
                _ => dollied(now, steps),
            });
        }
    }

    /// Chooses in the menu; beside it, closes it.
    fn press_menu(&mut self, at: (u16, u16)) {
        let list = self.areas().list;
        let lines = contents(contents(list));
        match &self.overlays.menu {
            Some(menu) if lines.contains(at.into()) => {
                let rows = usize::from(lines.height);
                let top = first_shown(0, menu.filter.at, menu.shown().len(), rows);
                self.click_menu(top + usize::from(at.1 - lines.y));
            }
            _ if list.contains(at.into()) => {}
            _ => self.close_menu(),
        }
    }

    /// Sets a bar of the colour picker or takes one of its colours; a click beside it confirms.
    fn press_picker(&mut self, at: (u16, u16)) {
        let list = self.areas().list;
        let lines = picker_lines(list);
        let mut bars = PickerRow::BARS.into_iter().zip(lines.bars);
        if let Some((row, [_, bar])) = bars.find(|(_, [line, _])| line.contains(at.into())) {
            self.place_colour(row, share_at(bar, at.0));
        } else if lines.swatches.contains(at.into()) {
            let is_under = |index: &usize| {
                swatch_cells(lines.swatches, *index).is_some_and(|cells| cells.contains(at.into()))
            };
            if let Some(index) = (0..lines.swatches.area() as usize).find(is_under) {
                self.take_swatch(index);
            }
        } else if !list.contains(at.into()) {
            self.confirm_colour();
        }
    }

    /// Moves the marker of the bar that was pressed.
    fn drag_picker(&mut self, column: u16) {
        let bars = picker_lines(self.areas().list).bars;
        let row = self.overlays.picker.as_ref().map(|picker| picker.row);
        let mut bars = PickerRow::BARS.into_iter().zip(bars);
        if let Some((row, [_, bar])) = bars.find(|(bar, _)| Some(*bar) == row) {
            self.place_colour(row, share_at(bar, column));
        }
    }

    /// Begins a press of the left button; returns whether it took hold of a border.
    fn begin_press(&mut self, at: (u16, u16)) -> bool {
        self.overlays.clear_message();
        self.cursor.typing = None;
        self.end_slide();
        let areas = self.areas();
        if self.mode == Mode::Move && !areas.picture.contains(at.into()) {
            self.confirm_transform();
        }
        if areas.border.contains(at.into()) {
            self.resizing = Some(Border::Panels);
        } else if areas.divider().contains(at.into()) {
            self.resizing = Some(Border::List);
        }
        self.resizing.is_some()
    }

    fn press(&mut self, at: (u16, u16)) -> Vec<Effect> {
        let areas = self.areas();
        if self.mode == Mode::Compare {
            self.press_comparison(at);
            return Vec::new();
        }
        if self.context() == Context::Rays
            && let Some(panels) = self.ray_panels()
            && (panels.tree.contains(at.into()) || panels.values.contains(at.into()))
        {
            self.click_ray(&panels, at);
            return Vec::new();
        }
        if let Some(line) = list_row_at(areas.list, self.cursor.list_top, at.0, at.1) {
            let line = self.listing().get(line);
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
        if self.mode != Mode::Inspect && self.press_slider(at) {
            return Vec::new();
        }
        let fields = self.cursor.fields();
        let components = |field: usize| Some(fields.get(field)?.field.kind.components());
        if self.mode != Mode::Inspect
            && let Some(clicked) = field_at(areas.fields, self.cursor.field_top, components, at)
        {
            return self.press_field(clicked);
        }
        let is_over = areas.picture.contains(at.into());
        if is_over && self.context() == Context::Region {
            if let Some(cell) = self.cell_near(at) {
                self.press_region(cell);
            }
            return Vec::new();
        }
        let drags = self.mode.moves_camera()
            || self.mode == Mode::Move
            || self.mode == Mode::Trace && self.pans();
        if drags && areas.picture.contains(at.into()) {
            self.pictures.drag = Some(at);
        } else if let Some(cell) = self.picture_cell(at) {
            if self.mode == Mode::Inspect {
                self.place_cross(cell);
            } else if !self.pick_symbol(cell)
                && let Some(pixel) = self.pixel_at(cell)
            {
                self.pick(self.node_at(pixel));
            }
        }
        Vec::new()
    }

    /// The cell of the picture under the pointer, from the picture's corner.
    fn picture_cell(&self, at: (u16, u16)) -> Option<(u16, u16)> {
        let (cells, _) = self.raster()?;
        let is_inside = cells.contains(at.into());
        is_inside.then(|| (at.0 - cells.x, at.1 - cells.y))
    }

    /// The first click moves the cursor there, the second starts typing.
    fn press_field(&mut self, (field, component): (usize, usize)) -> Vec<Effect> {
        self.mode = Mode::Edit;
        self.focus_field(field, component);
        if self.cursor.click((field, component)) {
            self.enter_value();
            return Vec::new();
        }
        vec![Effect::Later(super::DOUBLE_CLICK, Timer::Click)]
    }

    fn press_to_pan(&mut self, at: (u16, u16)) {
        let drags = self.mode.moves_camera() || self.pans();
        if drags && self.areas().picture.contains(at.into()) {
            self.pictures.drag = Some(at);
        }
    }

    /// Pans so that what is at the distance of the target follows the pointer.
    fn drag_to_pan(&mut self, at: (u16, u16)) {
        let Some(from) = self.pictures.drag else {
            return;
        };
        if self.pans() {
            self.drag_picture(from, at);
            self.pictures.drag = Some(at);
            return;
        }
        if !self.mode.moves_camera() {
            return;
        }
        let Some((camera, (_, size))) = self.camera().zip(self.raster()) else {
            return;
        };
        let magnification = self
            .frame_window()
            .map_or(1.0, |frame_window| frame_window.magnification(size));
        let unit = pixel_width(camera.target, &camera, size) / magnification;
        let [right, up, _] = axes(&camera);
        let moved = |from: u16, to: u16| f64::from(to) - f64::from(from);
        // A cell shows two pixels, one above the other.
        let by = 2.0 * moved(from.1, at.1) * up - moved(from.0, at.0) * right;
        self.move_camera(|now| shifted(now, unit * by));
        self.pictures.drag = Some(at);
    }

    /// Drags the border that was pressed; returns whether there is one.
    fn drag_border(&mut self, at: (u16, u16)) -> bool {
        match self.resizing {
            Some(Border::Panels) => self.resize_panels(self.areas().dragged(at)),
            Some(Border::List) => self.resize_list(self.areas().divided_at(at)),
            None => return false,
        }
        true
    }

    fn drag(&mut self, at: (u16, u16)) {
        if self.mode == Mode::Compare {
            return self.press_comparison(at);
        }
        if self.slide_to(at.0) {
            return;
        }
        if self.is_drawing_region() {
            if let Some(cell) = self.cell_near(at) {
                self.drag_region(cell);
            }
            return;
        }
        if self.mode == Mode::Inspect {
            if let Some(cell) = self.picture_cell(at) {
                self.place_cross(cell);
            }
            return;
        }
        let Some(from) = self.pictures.drag else {
            return;
        };
        if self.mode == Mode::Trace {
            self.drag_picture(from, at);
            self.pictures.drag = Some(at);
            return;
        }
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
