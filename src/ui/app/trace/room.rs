//! How TRACE reacts to presses and drags.

use super::regions::{confirm_region, drag_region, press_region};
use crate::app::pictures::region::Held;
use crate::app::room::Room;
use crate::app::{Shared, display};
use crate::keymap::{Context, Mode};
use crate::msg::Effect;

/// TRACE. It has no state of its own: the full-size trace continues in other modes.
#[derive(Debug, Default)]
pub struct Trace;

impl Room for Trace {
    /// Begins to draw the region, or takes hold of a magnified picture.
    fn press(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        let is_over = shared.areas().picture.contains(at.into());
        if !is_over || shared.mode != Mode::Trace {
            return None;
        }
        if shared.context() == Context::Region {
            if let Some(cell) = display::cell_near(shared, at) {
                press_region(shared, cell);
            }
        } else if display::viewport(shared).is_fit() {
            return None;
        } else {
            shared.pictures.drag = Some(at);
        }
        Some(Vec::new())
    }

    fn drag(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        if is_drawing(shared) {
            if let Some(cell) = display::cell_near(shared, at) {
                drag_region(shared, cell);
            }
            return Some(Vec::new());
        }
        let from = shared.pictures.drag;
        let from = from.filter(|_| shared.mode == Mode::Trace)?;
        display::drag_picture(shared, from, at);
        shared.pictures.drag = Some(at);
        Some(Vec::new())
    }

    fn release(&mut self, shared: &mut Shared) -> Option<Vec<Effect>> {
        is_drawing(shared).then(|| confirm_region(shared))
    }
}

/// Whether the pointer is drawing a region.
fn is_drawing(shared: &Shared) -> bool {
    let drawing = shared.pictures.drawing;
    drawing.is_some_and(|drawing| drawing.held == Held::ByPointer)
}
