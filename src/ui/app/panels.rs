//! The sizes of the panels, and who receives mouse events.

use super::Shared;
use crate::ui::arrange::{Zoom, divided, resized};
use crate::ui::msg::Effect;
use crate::ui::terminal::Mouse;

/// Shows the panels beside the picture, or the picture alone.
pub(crate) fn toggle_zoom(shared: &mut Shared) {
    shared.zoom = match shared.zoom {
        Zoom::Panels => Zoom::Picture,
        Zoom::Picture => Zoom::Panels,
    };
}

/// Moves the border between picture and panels by some cells, towards the picture if positive.
pub(crate) fn resize_panels(shared: &mut Shared, cells: i32) {
    let zoom = shared.zoom_now();
    match resized(&shared.areas(), &shared.shape(zoom), cells) {
        Some(panels) => shared.panels = panels,
        None => shared.say("there are no panels to resize here"),
    }
}

/// Moves the border between list and fields by some cells, towards the fields if positive.
pub(crate) fn resize_list(shared: &mut Shared, cells: i32) {
    let zoom = shared.zoom_now();
    match divided(&shared.areas(), &shared.shape(zoom), cells) {
        Some(panels) => shared.panels = panels,
        None => shared.say("there are no panels to resize here"),
    }
}

/// Keeps new sizes of the panels for other sessions, once they are not being dragged.
pub(crate) fn keep_panels(shared: &mut Shared) -> Option<Effect> {
    let is_new = shared.resizing.is_none() && shared.panels != shared.kept_panels;
    shared.kept_panels = if is_new {
        shared.panels
    } else {
        shared.kept_panels
    };
    is_new.then_some(Effect::KeepPanels(shared.panels))
}

/// Takes mouse events, or leaves them to the terminal.
pub(crate) fn toggle_mouse(shared: &mut Shared) -> Vec<Effect> {
    let (mouse, words) = match shared.mouse {
        Mouse::On => (Mouse::Off, "mouse off: the terminal selects text again"),
        Mouse::Off => (Mouse::On, "mouse on: hold Shift to select text"),
    };
    shared.mouse = mouse;
    shared.say(words);
    vec![Effect::SetMouse(mouse)]
}
