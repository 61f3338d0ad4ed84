//! A row of keys: what they do, and whether they would do something now.

use crate::app::Shared;
use crate::keymap::Key;
use crate::msg::Effect;

/// A row of keys. Its step sees what all modes share and, in the rows of a room, the room's state `S`.
pub(crate) struct Row<S = ()> {
    pub(crate) key: Key,
    step: Step<S>,
    acts: Acts<S>,
    hint: fn(&S, &Shared) -> Option<&'static str>,
}

/// What keys do, with or without the room's state and effects.
enum Step<S> {
    Does(fn(&mut Shared)),
    Requests(fn(&mut Shared) -> Vec<Effect>),
    DoesIn(fn(&mut S, &mut Shared)),
    RequestsIn(fn(&mut S, &mut Shared) -> Vec<Effect>),
}

/// When the hint of a row is shown.
enum Acts<S> {
    Always,
    When(fn(&Shared) -> bool),
    WhenIn(fn(&S, &Shared) -> bool),
}

impl Key {
    /// A row whose step needs no room's state and has no effects.
    pub(crate) const fn does<S>(self, step: fn(&mut Shared)) -> Row<S> {
        self.with_step(Step::Does(step))
    }

    /// A row whose step needs no room's state.
    pub(crate) const fn requests<S>(self, step: fn(&mut Shared) -> Vec<Effect>) -> Row<S> {
        self.with_step(Step::Requests(step))
    }

    /// A row of a room whose step has no effects.
    pub(crate) const fn does_in<S>(self, step: fn(&mut S, &mut Shared)) -> Row<S> {
        self.with_step(Step::DoesIn(step))
    }

    /// A row of a room.
    pub(crate) const fn requests_in<S>(
        self,
        step: fn(&mut S, &mut Shared) -> Vec<Effect>,
    ) -> Row<S> {
        self.with_step(Step::RequestsIn(step))
    }

    const fn with_step<S>(self, step: Step<S>) -> Row<S> {
        Row {
            key: self,
            step,
            acts: Acts::Always,
            hint: |_, _| None,
        }
    }
}

impl<S> Row<S> {
    /// Hints at it only while this holds.
    pub(crate) const fn when(mut self, acts: fn(&Shared) -> bool) -> Self {
        self.acts = Acts::When(acts);
        self
    }

    /// Hints at it only while this holds of the room's state.
    pub(crate) const fn when_in(mut self, acts: fn(&S, &Shared) -> bool) -> Self {
        self.acts = Acts::WhenIn(acts);
        self
    }

    /// Words its hint by what is true now; `None` leaves the words that it has.
    pub(crate) const fn hinting(mut self, hint: fn(&S, &Shared) -> Option<&'static str>) -> Self {
        self.hint = hint;
        self
    }

    /// Does what its keys do.
    pub(crate) fn act(&self, state: &mut S, shared: &mut Shared) -> Vec<Effect> {
        match self.step {
            Step::Does(step) => step(shared),
            Step::DoesIn(step) => step(state, shared),
            Step::Requests(step) => return step(shared),
            Step::RequestsIn(step) => return step(state, shared),
        }
        Vec::new()
    }

    /// Whether its keys would do something now, and the present words of its hint if they are not those
    /// that it always has.
    pub(crate) fn now(&self, state: &S, shared: &Shared) -> (bool, Option<&'static str>) {
        let acts = match self.acts {
            Acts::Always => true,
            Acts::When(acts) => acts(shared),
            Acts::WhenIn(acts) => acts(state, shared),
        };
        (acts, (self.hint)(state, shared))
    }
}
