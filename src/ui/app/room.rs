//! What a mode makes of what happens to the interface.

use super::shared::Shared;
use crate::ui::msg::Effect;

/// The state of a mode. A step sees that state and what all modes share, and no other mode.
pub(super) trait Room: Default {
    /// Follows a step, whatever it was, before the screen is drawn: brings what is shared in step with
    /// whether the mode is on.
    fn settle(&mut self, shared: &mut Shared);

    /// Takes a press of the left button at a cell of the screen while the mode is on; `None` leaves it
    /// to what all modes share.
    fn press(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>>;

    /// The same of dragging with the left button.
    fn drag(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>>;
}
