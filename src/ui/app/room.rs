//! What a mode or a page makes of what happens to the interface.

use super::shared::Shared;
use crate::ui::msg::Effect;

/// The state of a mode or a page. A step sees that state and what all modes share, and no other mode.
pub(super) trait Room: Default {
    /// Begins anew with another scene.
    fn renew(&mut self) {
        *self = Self::default();
    }

    /// Follows a step, whatever it was: brings what is shared in step with whether the mode is on.
    fn settle(&mut self, _shared: &mut Shared) {}

    /// Requests what it is to show, once everything shared has followed a step.
    fn follow(&mut self, _shared: &mut Shared) -> Vec<Effect> {
        Vec::new()
    }

    /// Takes a press of the left button at a cell of the screen; `None` leaves it to what all modes share.
    fn press(&mut self, _shared: &mut Shared, _at: (u16, u16)) -> Option<Vec<Effect>> {
        None
    }

    /// The same of dragging with the left button.
    fn drag(&mut self, _shared: &mut Shared, _at: (u16, u16)) -> Option<Vec<Effect>> {
        None
    }
}
