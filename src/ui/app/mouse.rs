//! The mouse.

use std::time::Duration;

use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::camera::{advanced, dollied, orbited, shifted, turned};
use super::pictures::drawing::Held;
use super::shared::Border;
use super::{
    App, PickerRow, Shared, camera, display, edit, inspect, list, panels, trace, transform,
};
use crate::render::{axes, pixel_width};
use crate::ui::keymap::{Context, Mode};
use crate::ui::layout::{
    contents, field_at, first_shown, list_row_at, picker_lines, share_at, swatch_cells,
};
use crate::ui::listing::ListLine;
use crate::ui::msg::{Effect, Timer};

/// Angles of orbit, in degrees, for dragging across a cell, which is twice as high as wide.
const DRAG: (f64, f64) = (2.0, 4.0);
/// A second click within this time counts as a double click.
const DOUBLE_CLICK: Duration = Duration::from_millis(400);

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
    pub(crate) fn pointer(&mut self, event: MouseEvent) -> Vec<Effect> {
        match point(&mut self.shared, event) {
            Pointed::Done(effects) => effects,
            Pointed::Press(at) => self.press_left(at),
            Pointed::Drag(at) => {
                let taken = self.drag(at);
                taken.unwrap_or_else(|| {
                    drag(&mut self.shared, at);
                    Vec::new()
                })
            }
        }
    }

    /// Ends typing and sliding and, outside the picture in MOVE, the motion; then presses what is under the
    /// pointer.
    fn press_left(&mut self, at: (u16, u16)) -> Vec<Effect> {
        let shared = &mut self.shared;
        shared.overlays.clear_message();
        shared.cursor.typing = None;
        edit::end_slide(shared);
        if shared.mode == Mode::Move && !shared.areas().picture.contains(at.into()) {
            transform::confirm(&mut self.moving, shared);
        }
        if press_border(shared, at) {
            return Vec::new();
        }
        let taken = self.press(at);
        taken.unwrap_or_else(|| press(&mut self.shared, at))
    }
}

/// Does what a mouse event does in all modes; nothing while a dialog or a line is open or the scene is
/// being read.
fn point(shared: &mut Shared, event: MouseEvent) -> Pointed {
    let at = (event.column, event.row);
    let waits = shared.overlays.dialog.is_some()
        || shared.overlays.prompt.is_some()
        || shared.disk.is_opening() && shared.overlays.page.is_none();
    match event.kind {
        _ if waits => {}
        MouseEventKind::ScrollUp | MouseEventKind::ScrollDown
            if shared.overlays.menu.is_some() || shared.overlays.picker.is_some() => {}
        MouseEventKind::ScrollUp | MouseEventKind::ScrollDown
            if zooms(shared, at, event.modifiers) =>
        {
            let steps = if event.kind == MouseEventKind::ScrollUp {
                1
            } else {
                -1
            };
            display::magnify_at(shared, steps, at);
        }
        MouseEventKind::ScrollUp => wheel(shared, at, -1),
        MouseEventKind::ScrollDown => wheel(shared, at, 1),
        _ if shared.overlays.page.is_some() => {}
        MouseEventKind::Down(MouseButton::Left) if shared.overlays.picker.is_some() => {
            press_picker(shared, at);
        }
        MouseEventKind::Drag(MouseButton::Left) if shared.overlays.picker.is_some() => {
            drag_picker(shared, at.0);
        }
        MouseEventKind::Down(MouseButton::Left) if shared.overlays.menu.is_some() => {
            press_menu(shared, at);
        }
        MouseEventKind::Down(MouseButton::Left) => return Pointed::Press(at),
        MouseEventKind::Down(_) => press_to_pan(shared, at),
        MouseEventKind::Drag(MouseButton::Left)
            if !event.modifiers.contains(KeyModifiers::CONTROL) && !drag_border(shared, at) =>
        {
            return Pointed::Drag(at);
        }
        MouseEventKind::Drag(MouseButton::Left)
            if !event.modifiers.contains(KeyModifiers::CONTROL) => {}
        MouseEventKind::Drag(_) => drag_to_pan(shared, at),
        MouseEventKind::Up(_) if is_drawing_region(shared) => {
            return Pointed::Done(trace::confirm_region(shared));
        }
        MouseEventKind::Up(_) => {
            shared.pictures.drag = None;
            edit::end_slide(shared);
            if shared.resizing.take().is_some() {
                return Pointed::Done(panels::keep(shared));
            }
        }
        _ => {}
    }
    Pointed::Done(Vec::new())
}

/// Whether the wheel zooms the picture here.
fn zooms(shared: &Shared, at: (u16, u16), modifiers: KeyModifiers) -> bool {
    let asked = shared.mode == Mode::Trace || modifiers.contains(KeyModifiers::CONTROL);
    asked && shared.overlays.page.is_none() && shared.areas().picture.contains(at.into())
}

/// Whether the pointer is drawing a region.
fn is_drawing_region(shared: &Shared) -> bool {
    let drawing = shared.pictures.drawing;
    drawing.is_some_and(|drawing| drawing.held == Held::ByPointer)
}

/// The cell of the picture at this cell of the screen, or the nearest one.
fn cell_near(shared: &Shared, at: (u16, u16)) -> Option<(u16, u16)> {
    let (cells, _) = shared.raster()?;
    let near =
        |at: u16, from: u16, length: u16| at.saturating_sub(from).min(length.saturating_sub(1));
    Some((
        near(at.0, cells.x, cells.width),
        near(at.1, cells.y, cells.height),
    ))
}

/// Whether dragging pans the picture on screen.
fn pans(shared: &Shared) -> bool {
    !display::viewport(shared).is_fit() && !shared.mode.moves_camera() && shared.mode != Mode::Move
}

fn wheel(shared: &mut Shared, at: (u16, u16), down: isize) {
    if shared.overlays.page.is_some() {
        list::move_cursor(shared, WHEEL * down);
        return;
    }
    if shared.mode == Mode::Compare {
        return;
    }
    let (areas, mode) = (shared.areas(), shared.mode);
    let over = |area: ratatui::layout::Rect| area.contains(at.into());
    if shared
        .errors_panel(areas.errors)
        .is_some_and(|panel| over(panel.area))
    {
        if shared.overlays.errors.is_some() {
            list::move_cursor_in(shared, Context::Errors, down);
        }
    } else if shared.context() == Context::Rays {
        inspect::move_in_rays(shared, down);
    } else if over(areas.list) {
        list::move_cursor_in(shared, Context::In(Mode::Select), WHEEL * down);
    } else if over(areas.fields) && shared.cursor.typing.is_none() {
        list::move_cursor_in(shared, Context::In(Mode::Edit), down);
    } else if over(areas.picture) && shared.mode.moves_camera() {
        let steps = if down < 0 { 1 } else { -1 };
        camera::move_camera(shared, |now| match mode {
            Mode::Fly => advanced(now, steps),
            _ => dollied(now, steps),
        });
    }
}

/// Chooses in the menu; beside it, closes it.
fn press_menu(shared: &mut Shared, at: (u16, u16)) {
    let list = shared.areas().list;
    let lines = contents(contents(list));
    match &shared.overlays.menu {
        Some(menu) if lines.contains(at.into()) => {
            let rows = usize::from(lines.height);
            let top = first_shown(0, menu.filter.at, menu.shown().len(), rows);
            edit::click_menu(shared, top + usize::from(at.1 - lines.y));
        }
        _ if list.contains(at.into()) => {}
        _ => edit::close_menu(shared),
    }
}

/// Sets a bar of the colour picker or takes one of its colours; a click beside it confirms.
fn press_picker(shared: &mut Shared, at: (u16, u16)) {
    let list = shared.areas().list;
    let lines = picker_lines(list);
    let mut bars = PickerRow::BARS.into_iter().zip(lines.bars);
    if let Some((row, [_, bar])) = bars.find(|(_, [line, _])| line.contains(at.into())) {
        edit::place_colour(shared, row, share_at(bar, at.0));
    } else if lines.swatches.contains(at.into()) {
        let is_under = |index: &usize| {
            swatch_cells(lines.swatches, *index).is_some_and(|cells| cells.contains(at.into()))
        };
        if let Some(index) = (0..lines.swatches.area() as usize).find(is_under) {
            edit::take_swatch(shared, index);
        }
    } else if !list.contains(at.into()) {
        edit::confirm_colour(shared);
    }
}

/// Moves the marker of the bar that was pressed.
fn drag_picker(shared: &mut Shared, column: u16) {
    let bars = picker_lines(shared.areas().list).bars;
    let row = shared.overlays.picker.as_ref().map(|picker| picker.row);
    let mut bars = PickerRow::BARS.into_iter().zip(bars);
    if let Some((row, [_, bar])) = bars.find(|(bar, _)| Some(*bar) == row) {
        edit::place_colour(shared, row, share_at(bar, column));
    }
}

/// Takes hold of the border under the pointer; returns whether there is one.
fn press_border(shared: &mut Shared, at: (u16, u16)) -> bool {
    let areas = shared.areas();
    if areas.border.contains(at.into()) {
        shared.resizing = Some(Border::Panels);
    } else if areas.divider().contains(at.into()) {
        shared.resizing = Some(Border::List);
    }
    shared.resizing.is_some()
}

fn press(shared: &mut Shared, at: (u16, u16)) -> Vec<Effect> {
    let areas = shared.areas();
    if shared.context() == Context::Rays
        && let Some(panels) = inspect::ray_panels(shared)
        && (panels.tree.contains(at.into()) || panels.values.contains(at.into()))
    {
        inspect::click_ray(shared, &panels, at);
        return Vec::new();
    }
    if let Some(line) = list_row_at(areas.list, shared.cursor.list_top, at.0, at.1) {
        let line = shared.listing().get(line);
        if let Some(ListLine::Node(_, node)) = line {
            shared.select(node);
            shared.overlays.errors = None;
            shared.mode = Mode::Select;
        }
        return Vec::new();
    }
    if let Some(panel) = shared.errors_panel(areas.errors)
        && panel.area.contains(at.into())
    {
        let clicked = panel.diagnostic_at(at.1);
        shared.overlays.errors = clicked.or(shared.overlays.errors);
        if clicked.is_some() {
            list::go_to_error(shared);
        }
        return Vec::new();
    }
    if shared.mode != Mode::Inspect && edit::press_slider(shared, at) {
        return Vec::new();
    }
    let fields = shared.cursor.fields();
    let components = |field: usize| Some(fields.get(field)?.field.kind.components());
    if shared.mode != Mode::Inspect
        && let Some(clicked) = field_at(areas.fields, shared.cursor.field_top, components, at)
    {
        return press_field(shared, clicked);
    }
    let is_over = areas.picture.contains(at.into());
    if is_over && shared.context() == Context::Region {
        if let Some(cell) = cell_near(shared, at) {
            trace::press_region(shared, cell);
        }
        return Vec::new();
    }
    let drags = shared.mode.moves_camera()
        || shared.mode == Mode::Move
        || shared.mode == Mode::Trace && pans(shared);
    if drags && areas.picture.contains(at.into()) {
        shared.pictures.drag = Some(at);
    } else if let Some(cell) = picture_cell(shared, at) {
        if shared.mode == Mode::Inspect {
            inspect::place_cross(shared, cell);
        } else if !inspect::pick_symbol(shared, cell)
            && let Some(pixel) = display::pixel_at(shared, cell)
        {
            inspect::pick(shared, inspect::node_at(shared, pixel));
        }
    }
    Vec::new()
}

/// The cell of the picture under the pointer, from the picture's corner.
fn picture_cell(shared: &Shared, at: (u16, u16)) -> Option<(u16, u16)> {
    let (cells, _) = shared.raster()?;
    let is_inside = cells.contains(at.into());
    is_inside.then(|| (at.0 - cells.x, at.1 - cells.y))
}

/// The first click moves the cursor there, the second starts typing.
fn press_field(shared: &mut Shared, (field, component): (usize, usize)) -> Vec<Effect> {
    shared.mode = Mode::Edit;
    shared.focus_field(field, component);
    if shared.cursor.click((field, component)) {
        edit::enter_value(shared);
        return Vec::new();
    }
    vec![Effect::Later(DOUBLE_CLICK, Timer::Click)]
}

fn press_to_pan(shared: &mut Shared, at: (u16, u16)) {
    let drags = shared.mode.moves_camera() || pans(shared);
    if drags && shared.areas().picture.contains(at.into()) {
        shared.pictures.drag = Some(at);
    }
}

/// Pans so that what is at the distance of the target follows the pointer.
fn drag_to_pan(shared: &mut Shared, at: (u16, u16)) {
    let Some(from) = shared.pictures.drag else {
        return;
    };
    if pans(shared) {
        display::drag_picture(shared, from, at);
        shared.pictures.drag = Some(at);
        return;
    }
    if !shared.mode.moves_camera() {
        return;
    }
    let Some((camera, (_, size))) = shared.camera().zip(shared.raster()) else {
        return;
    };
    let unit = pixel_width(camera.target, &camera, size) / display::magnification(shared, size);
    let [right, up, _] = axes(&camera);
    let moved = |from: u16, to: u16| f64::from(to) - f64::from(from);
    // A cell shows two pixels, one above the other.
    let by = 2.0 * moved(from.1, at.1) * up - moved(from.0, at.0) * right;
    camera::move_camera(shared, |now| shifted(now, unit * by));
    shared.pictures.drag = Some(at);
}

/// Drags the border that was pressed; returns whether there is one.
fn drag_border(shared: &mut Shared, at: (u16, u16)) -> bool {
    let Some(border) = shared.resizing else {
        return false;
    };
    let cells = match border {
        Border::Panels => shared.areas().dragged(at),
        Border::List => shared.areas().divided_at(at),
    };
    panels::resize(shared, border, cells);
    true
}

fn drag(shared: &mut Shared, at: (u16, u16)) {
    if edit::slide_to(shared, at.0) {
        return;
    }
    if is_drawing_region(shared) {
        if let Some(cell) = cell_near(shared, at) {
            trace::drag_region(shared, cell);
        }
        return;
    }
    if shared.mode == Mode::Inspect {
        if let Some(cell) = picture_cell(shared, at) {
            inspect::place_cross(shared, cell);
        }
        return;
    }
    let Some(from) = shared.pictures.drag else {
        return;
    };
    if shared.mode == Mode::Trace {
        display::drag_picture(shared, from, at);
        shared.pictures.drag = Some(at);
        return;
    }
    let moved = |from: u16, to: u16| f64::from(to) - f64::from(from);
    if !shared.mode.moves_camera() {
        return;
    }
    // The scene follows the pointer, so the camera moves the opposite way.
    let (left, up) = (DRAG.0 * moved(from.0, at.0), DRAG.1 * moved(from.1, at.1));
    match shared.mode {
        // About the angle of a cell, so that the picture follows the pointer.
        Mode::Fly => camera::move_camera(shared, |now| turned(now, left / 4.0, up / 4.0)),
        _ => camera::move_camera(shared, |now| orbited(now, left, up)),
    }
    shared.pictures.drag = Some(at);
}
