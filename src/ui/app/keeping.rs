//! Unsaved edits that outlive the program: keeping them.

use std::time::Duration;

use super::App;
use super::model::Await;
use crate::text::without_codes;
use crate::ui::msg::{Effect, Timer};

/// How long an edit may go without being kept, and how often a held key is written down.
const KEPT_AFTER: Duration = Duration::from_secs(1);

/// The longest time between two tries to keep the same edits.
const PATIENCE: Duration = Duration::from_secs(30);

impl App {
    /// Sees to it that unsaved edits, or that there are none any more, are written down soon.
    pub(super) fn follow_edits(&mut self) -> Option<Effect> {
        let revision = self.document.revision();
        let waits = match self.pending.keeping.awaits {
            Await::Nothing => false,
            Await::Edits => true,
            // What is new is tried at once.
            Await::Retry(failed) => failed == revision && self.document.is_dirty(),
        };
        if waits || self.is_kept() {
            return None;
        }
        self.pending.keeping.awaits = Await::Edits;
        Some(Effect::Later(KEPT_AFTER, Timer::Keep))
    }

    /// Whether what is kept, or about to be, is what would be lost.
    fn is_kept(&self) -> bool {
        let keeping = &self.pending.keeping;
        match keeping.ordered.or(keeping.revision) {
            Some(kept) => kept == self.document.revision() && self.document.is_dirty(),
            None => !self.document.is_dirty(),
        }
    }

    /// Whether the journal holds the unsaved edits as they are.
    pub fn has_kept_edits(&self) -> bool {
        let kept = self.pending.keeping.revision;
        kept == Some(self.document.revision()) && self.document.is_dirty()
    }

    /// Whether unsaved edits would be lost with the program though they should be kept by now.
    pub fn fails_to_keep(&self) -> bool {
        self.pending.keeping.trouble.is_some() && self.document.is_dirty()
    }

    pub(super) fn keep_edits(&mut self) -> Vec<Effect> {
        if self.document.is_dirty() && self.is_kept() {
            self.pending.keeping.awaits = Await::Nothing;
            return Vec::new();
        }
        self.keep_the_rest()
    }

    /// Keeps edits that the journal does not hold, or holds as edits of a text that the file no
    /// longer says.
    pub(super) fn keep_the_rest(&mut self) -> Vec<Effect> {
        self.pending.keeping.awaits = Await::Nothing;
        if !self.document.is_dirty() {
            return self.forget_edits();
        }
        let revision = self.document.revision();
        self.pending.keeping.ordered = Some(revision);
        vec![Effect::WriteRecovery {
            scene: self.path.clone(),
            known: self.document.snapshot(),
            revision,
        }]
    }

    /// Has this run's journal removed, if there is one.
    fn forget_edits(&mut self) -> Vec<Effect> {
        let keeping = &mut self.pending.keeping;
        let (kept, ordered) = (keeping.revision.take(), keeping.ordered.take());
        keeping.trouble = None;
        let is_any = kept.or(ordered).is_some();
        is_any.then_some(Effect::DropRecovery).into_iter().collect()
    }

    /// Notes that a text is kept, or schedules another try at growing intervals and reports why once.
    pub(super) fn kept(&mut self, revision: u64, outcome: Result<(), String>) -> Vec<Effect> {
        let keeping = &mut self.pending.keeping;
        if keeping.ordered != Some(revision) {
            // Forgotten since, or another order is on its way.
            return Vec::new();
        }
        keeping.ordered = None;
        let before = keeping.trouble.take();
        let reason = match outcome {
            Ok(()) => {
                keeping.revision = Some(revision);
                let is_said = |said: &str| before.is_some_and(|(_, reason)| said == words(&reason));
                self.message.take_if(|message| is_said(&message.text));
                return Vec::new();
            }
            Err(reason) => reason,
        };
        let doubled = |(time, _): &(Duration, String)| (2 * *time).min(PATIENCE);
        let time = before.as_ref().map_or(KEPT_AFTER, doubled);
        keeping.awaits = Await::Retry(revision);
        keeping.trouble = Some((time, reason.clone()));
        if before.is_none_or(|(_, said)| said != reason) {
            self.fail(words(&reason));
        }
        vec![Effect::Later(time, Timer::Keep)]
    }

    /// Ends with nothing worth keeping.
    pub(super) fn leave(&mut self) -> Vec<Effect> {
        let mut effects = self.forget_edits();
        effects.push(Effect::Quit);
        effects
    }

    /// Ends with unsaved edits kept: written down once more, for the journal may have been removed.
    pub(super) fn quit_keeping_edits(&mut self) -> Vec<Effect> {
        let mut effects = self.keep_the_rest();
        effects.push(Effect::Quit);
        effects
    }
}

/// The message about edits that can't be kept.
fn words(reason: &str) -> String {
    let words = format!("unsaved edits can't be kept for recovery: {reason}");
    without_codes(&words).into_owned()
}
