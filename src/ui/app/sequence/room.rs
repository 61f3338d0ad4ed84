//! How SEQUENCE reacts to steps, presses and drags.

use super::{Sequence, playing};
use crate::app::room::Room;
use crate::app::shared::Shared;
use crate::app::text;
use crate::keymap::Mode;
use crate::msg::Effect;

impl Room for Sequence {
    /// Keeps a frame in the text while the mode lasts, except under a question and while the scene's
    /// file is read.
    fn settle(&mut self, shared: &mut Shared) {
        if shared.mode == Mode::Sequence {
            playing::resume(self, shared);
        } else {
            if let Some(open) = &mut self.open {
                open.is_playing = false;
            }
            text::revert_transient(shared);
        }
    }

    fn follow(&mut self, shared: &mut Shared) -> Vec<Effect> {
        playing::judge_again(self, shared).into_iter().collect()
    }

    fn press(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        if shared.mode != Mode::Sequence {
            return None;
        }
        let is_taken =
            playing::scrub_to(self, shared, at) || shared.areas().picture.contains(at.into());
        if !is_taken {
            text::leave_sequence(shared);
        }
        is_taken.then(Vec::new)
    }

    fn drag(&mut self, shared: &mut Shared, at: (u16, u16)) -> Option<Vec<Effect>> {
        if shared.mode != Mode::Sequence {
            return None;
        }
        playing::scrub_to(self, shared, at);
        Some(Vec::new())
    }
}
