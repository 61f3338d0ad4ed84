//! How COMPARE reacts to steps, presses and drags.

use super::comparing::{follow, lend, press};
use super::referring::take_answer;
use super::state::Compare;
use crate::app::room::Room;
use crate::app::shared::Shared;
use crate::keymap::Mode;
use crate::msg::Effect;

impl Room for Compare {
    /// The reference stays, to be compared with another scene as well.
    fn renew(&mut self) {}

    fn settle(&mut self, shared: &mut Shared) {
        lend(self, shared);
    }

    fn follow(&mut self, shared: &mut Shared) -> Vec<Effect> {
        let mut effects = take_answer(self, shared);
        effects.extend(follow(self, shared));
        effects
    }

    fn press(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        if shared.mode != Mode::Compare {
            return None;
        }
        press(self, shared, at);
        Some(Vec::new())
    }

    fn drag(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        self.press(shared, at)
    }
}
