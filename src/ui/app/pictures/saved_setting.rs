//! Render settings that were written into the text, and what took precedence over them.

use document::StateId;
use scene::{RenderKey, Rendering};

/// A setting that was written into the text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SavedSetting {
    /// The text after that.
    pub(crate) state: StateId,
    pub(crate) key: RenderKey,
    /// What takes precedence over it on the other side of that step, at first before it.
    pub(crate) over: Rendering,
}

impl SavedSetting {
    /// The user's render settings on the other side of the step; remembers those on this one.
    pub(crate) fn cross(&mut self, rendering: &Rendering) -> Rendering {
        let own = self.key.alone(rendering);
        let others = self.key.cleared(rendering);
        others.or(std::mem::replace(&mut self.over, own))
    }
}
