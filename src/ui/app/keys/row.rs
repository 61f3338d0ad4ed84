//! A row of keys: what they do, and whether they would do something now.

use crate::ui::app::Shared;
use crate::ui::keymap::Key;
use crate::ui::msg::Effect;

/// A row of keys.
#[derive(Clone, Copy)]
pub(in crate::ui::app) struct Row {
    pub(in crate::ui::app) key: Key,
    step: Step,
    /// Whether its hint is shown.
    pub(in crate::ui::app) acts: fn(&Shared) -> bool,
}

/// A row of keys of a mode, whose step sees the mode's state and what all modes share.
pub(in crate::ui::app) struct ModeRow<S> {
    pub(in crate::ui::app) key: Key,
    pub(in crate::ui::app) step: ModeStep<S>,
    /// Whether its hint is shown.
    pub(in crate::ui::app) acts: fn(&S, &Shared) -> bool,
}

/// What keys of a mode do.
pub(in crate::ui::app) enum ModeStep<S> {
    /// Without effects.
    Moves(fn(&mut S, &mut Shared)),
    /// With effects.
    Steps(fn(&mut S, &mut Shared) -> Vec<Effect>),
}

impl<S> ModeRow<S> {
    /// Does what its keys do.
    pub(in crate::ui::app) fn act(&self, state: &mut S, shared: &mut Shared) -> Vec<Effect> {
        match self.step {
            ModeStep::Moves(step) => {
                step(state, shared);
                Vec::new()
            }
            ModeStep::Steps(step) => step(state, shared),
        }
    }

    /// Hints at it only while this holds.
    pub(in crate::ui::app) const fn when(mut self, acts: fn(&S, &Shared) -> bool) -> Self {
        self.acts = acts;
        self
    }
}

/// What keys do.
#[derive(Clone, Copy)]
enum Step {
    /// Without effects.
    Does(fn(&mut Shared)),
    /// With effects.
    Requests(fn(&mut Shared) -> Vec<Effect>),
}

impl Key {
    pub(super) const fn does(self, step: fn(&mut Shared)) -> Row {
        Row {
            key: self,
            step: Step::Does(step),
            acts: |_| true,
        }
    }

    pub(super) const fn requests(self, step: fn(&mut Shared) -> Vec<Effect>) -> Row {
        Row {
            key: self,
            step: Step::Requests(step),
            acts: |_| true,
        }
    }
}

impl Key {
    /// A row of a mode whose step has no effects.
    pub(in crate::ui::app) const fn moves<S>(self, step: fn(&mut S, &mut Shared)) -> ModeRow<S> {
        ModeRow {
            key: self,
            step: ModeStep::Moves(step),
            acts: |_, _| true,
        }
    }

    /// A row of a mode.
    pub(in crate::ui::app) const fn steps<S>(
        self,
        step: fn(&mut S, &mut Shared) -> Vec<Effect>,
    ) -> ModeRow<S> {
        ModeRow {
            key: self,
            step: ModeStep::Steps(step),
            acts: |_, _| true,
        }
    }
}

impl Row {
    /// Does what its keys do.
    pub(in crate::ui::app) fn act(&self, shared: &mut Shared) -> Vec<Effect> {
        match self.step {
            Step::Does(step) => {
                step(shared);
                Vec::new()
            }
            Step::Requests(step) => step(shared),
        }
    }

    /// Hints at it only while this holds.
    pub(super) const fn when(mut self, acts: fn(&Shared) -> bool) -> Self {
        self.acts = acts;
        self
    }
}
