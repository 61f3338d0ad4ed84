//! The sizes of the panels, and who receives mouse events.

use super::Shared;
use super::shared::Border;
use crate::arrange::{Zoom, divided, resized};
use crate::msg::Effect;
use crate::terminal::Mouse;

/// Shows the panels beside the picture, or the picture alone.
pub(crate) fn toggle_zoom(shared: &mut Shared) {
    shared.zoom = match shared.zoom {
        Zoom::Panels => Zoom::Picture,
        Zoom::Picture => Zoom::Panels,
    };
}

/// Moves a border by some cells: that of the panels towards the picture if positive, that of the list
/// towards the fields.
pub(crate) fn resize(shared: &mut Shared, border: Border, cells: i32) {
    let (areas, shape) = (shared.areas(), shared.shape(shared.zoom_now()));
    let panels = match border {
        Border::Panels => resized(&areas, &shape, cells),
        Border::List => divided(&areas, &shape, cells),
    };
    match panels {
        Some(panels) => shared.panels = panels,
        None => shared.say("there are no panels to resize here"),
    }
}

/// Moves a border as [`resize`] does, and keeps the sizes.
pub(crate) fn resize_by_key(shared: &mut Shared, border: Border, cells: i32) -> Vec<Effect> {
    resize(shared, border, cells);
    keep(shared)
}

/// Keeps new sizes of the panels for other sessions.
pub(crate) fn keep(shared: &mut Shared) -> Vec<Effect> {
    let before = std::mem::replace(&mut shared.kept_panels, shared.panels);
    let is_new = before != shared.panels;
    let effect = is_new.then_some(Effect::KeepPanels(shared.panels));
    effect.into_iter().collect()
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
