//! A row of keys: what they do, and whether they would do something now.

use crate::ui::app::App;
use crate::ui::keymap::Key;
use crate::ui::msg::Effect;

/// A row of keys.
#[derive(Clone, Copy)]
pub(super) struct Row {
    pub(super) key: Key,
    pub(super) step: Step,
    /// Whether its hint is shown.
    pub(super) acts: fn(&App) -> bool,
}

/// What keys do.
#[derive(Clone, Copy)]
pub(super) enum Step {
    /// Without effects.
    Does(fn(&mut App)),
    /// With effects.
    Requests(fn(&mut App) -> Vec<Effect>),
}

impl Key {
    pub(super) const fn does(self, step: fn(&mut App)) -> Row {
        Row::new(self, Step::Does(step))
    }

    pub(super) const fn requests(self, step: fn(&mut App) -> Vec<Effect>) -> Row {
        Row::new(self, Step::Requests(step))
    }
}

impl Row {
    const fn new(key: Key, step: Step) -> Self {
        Self {
            key,
            step,
            acts: |_| true,
        }
    }

    /// Hints at it only while this holds.
    pub(super) const fn when(mut self, acts: fn(&App) -> bool) -> Self {
        self.acts = acts;
        self
    }
}
