//! What a room is: how it reacts to steps, presses and drags, and its rows of keys.

mod row;

use crate::app::shared::Shared;
use crate::msg::Effect;

/// The state of a mode or a page. A step sees that state and what all modes share, and no other mode.
pub(crate) trait Room: Default {
    /// Starts afresh, for another scene.
    fn renew(&mut self) {
        *self = Self::default();
    }

    /// Reacts to a step, whatever it was, before anything is laid out: leaves what all modes share as the
    /// mode needs it, or as it was without the mode.
    fn settle(&mut self, _shared: &mut Shared) {}

    /// Requests what it shows, once everything shared is up to date.
    fn follow(&mut self, _shared: &mut Shared) -> Vec<Effect> {
        Vec::new()
    }

    /// Handles a press of the left button at a cell of the screen; `None` leaves it to the code that all
    /// modes share.
    fn press(&mut self, _shared: &mut Shared, _at: (u16, u16)) -> Option<Vec<Effect>> {
        None
    }

    /// Handles a drag with the left button, as [`Self::press`] does a press.
    fn drag(&mut self, _shared: &mut Shared, _at: (u16, u16)) -> Option<Vec<Effect>> {
        None
    }

    /// Handles the release of any button, as [`Self::press`] does a press.
    fn release(&mut self, _shared: &mut Shared) -> Option<Vec<Effect>> {
        None
    }
}

pub(crate) use row::Row;
