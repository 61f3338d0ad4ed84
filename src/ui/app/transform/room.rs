//! How MOVE reacts to presses and drags.

use super::state::Moving;
use super::transforming::drag;
use crate::app::room::Room;
use crate::app::shared::Shared;
use crate::keymap::Mode;
use crate::msg::Effect;

impl Room for Moving {
    fn press(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        let is_over = shared.areas().picture.contains(at.into());
        (is_over && shared.mode == Mode::Move).then(|| {
            shared.pictures.drag = Some(at);
            Vec::new()
        })
    }

    fn drag(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        let from = shared.pictures.drag.filter(|_| shared.mode == Mode::Move)?;
        let moved = |from: u16, to: u16| f64::from(to) - f64::from(from);
        // A cell shows two pixels, one above the other.
        let (right, down) = (moved(from.0, at.0), 2.0 * moved(from.1, at.1));
        drag(self, shared, right, -down);
        shared.pictures.drag = Some(at);
        Some(Vec::new())
    }
}
