//! The mouse: what it does in all modes; the rest is offered to the rooms.

use std::time::Duration;

use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::shared::Border;
use super::{
    App, PickerRow, Shared, camera, display, edit, files, inspect, list, panels, transform,
};
use crate::keymap::{Context, Mode};
use crate::layout::{
    contents, field_at, first_shown, list_row_at, picker_lines, share_at, swatch_cells,
};
use crate::listing::ListLine;
use crate::msg::{Effect, Timer};

/// A second click within this time counts as a double click.
const DOUBLE_CLICK: Duration = Duration::from_millis(400);

/// The number of lines that one notch of the wheel scrolls.
const WHEEL: isize = 3;

impl App {
    /// Handles a mouse event. Ignored while a dialog or a line is open or the scene is being read.
    pub(crate) fn pointer(&mut self, event: MouseEvent) -> Vec<Effect> {
        let shared = &mut self.shared;
        let at = (event.column, event.row);
        let controls = event.modifiers.contains(KeyModifiers::CONTROL);
        let waits = shared.overlays.dialog.is_some()
            || shared.overlays.prompt.is_some()
            || shared.disk.is_opening() && shared.overlays.page.is_none();
        match event.kind {
            _ if waits => {}
            MouseEventKind::ScrollUp => wheel(shared, at, -1, event.modifiers),
            MouseEventKind::ScrollDown => wheel(shared, at, 1, event.modifiers),
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
            MouseEventKind::Down(MouseButton::Left) => {
                let mut effects = self.press_left(at);
                effects.extend(show_pressed(&self.shared, at));
                return effects;
            }
            MouseEventKind::Down(_) => press_to_pan(shared, at),
            MouseEventKind::Drag(MouseButton::Left) if !controls => return drag_left(self, at),
            MouseEventKind::Drag(_) => drag_to_pan(shared, at),
            MouseEventKind::Up(_) => {
                let taken = self.release();
                return taken.unwrap_or_else(|| release(&mut self.shared));
            }
            _ => {}
        }
        Vec::new()
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

/// Shows what was pressed in the picture to the editor that has the scene open, which keeps the focus where
/// it is.
fn show_pressed(shared: &Shared, at: (u16, u16)) -> Option<Effect> {
    let selects = !shared.mode.moves_camera() && shared.motion.is_none();
    let is_pressed = selects && shared.areas().picture.contains(at.into());
    let span = shared.source().span(inspect::node_in_focus(shared));
    let show = || files::show_in_editor(shared, span, false);
    is_pressed.then(show).flatten()
}

/// Whether dragging pans the picture on screen.
fn pans(shared: &Shared) -> bool {
    !display::viewport(shared).is_fit() && !shared.mode.moves_camera() && shared.mode != Mode::Move
}

/// Scrolls what is under the pointer; in TRACE and with Ctrl, zooms the picture.
fn wheel(shared: &mut Shared, at: (u16, u16), down: isize, modifiers: KeyModifiers) {
    if shared.overlays.menu.is_some() || shared.overlays.picker.is_some() {
        return;
    }
    if shared.overlays.page.is_some() {
        list::move_cursor(shared, WHEEL * down);
        return;
    }
    let areas = shared.areas();
    let over = |area: ratatui::layout::Rect| area.contains(at.into());
    let steps = if down < 0 { 1 } else { -1 };
    let zooms = shared.mode == Mode::Trace || modifiers.contains(KeyModifiers::CONTROL);
    if zooms && over(areas.picture) {
        display::magnify_at(shared, steps, at);
        return;
    }
    if shared.mode == Mode::Compare {
        return;
    }
    let errors = shared.errors_panel(areas.errors);
    if errors.is_some_and(|panel| over(panel.area)) {
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
        camera::wheel(shared, steps);
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
        && let Some(clicked) = field_at(
            (areas.fields, areas.explains),
            shared.cursor.field_top,
            components,
            at,
        )
    {
        return press_field(shared, clicked);
    }
    if let Some(cell) = display::picture_cell(shared, at)
        && !inspect::pick_symbol(shared, cell)
        && let Some(pixel) = display::pixel_at(shared, cell)
    {
        inspect::pick(shared, inspect::node_at(shared, pixel));
    }
    Vec::new()
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
    } else if shared.mode.moves_camera() {
        camera::drag_to_pan(shared, from, at);
    } else {
        return;
    }
    shared.pictures.drag = Some(at);
}

fn release(shared: &mut Shared) -> Vec<Effect> {
    shared.pictures.drag = None;
    edit::end_slide(shared);
    match shared.resizing.take() {
        Some(_) => panels::keep(shared),
        None => Vec::new(),
    }
}

/// Drags the border that was pressed, otherwise what is under the pointer.
fn drag_left(app: &mut App, at: (u16, u16)) -> Vec<Effect> {
    if drag_border(&mut app.shared, at) {
        return Vec::new();
    }
    let taken = app.drag(at);
    taken.unwrap_or_else(|| {
        edit::slide_to(&mut app.shared, at.0);
        Vec::new()
    })
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
