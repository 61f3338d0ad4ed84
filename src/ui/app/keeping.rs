//! Unsaved edits that outlive the program: keeping them, and taking those of an earlier run.

use std::time::Duration;

use super::{App, Dialog};
use crate::text::smallest_edit;
use crate::ui::msg::{Effect, Timer};

/// How long an edit may be lost with the program, and how seldom a held key is written down.
const KEPT_AFTER: Duration = Duration::from_secs(1);

impl App {
    /// Sees to it that unsaved edits, or that there are none any more, are written down soon.
    pub(super) fn follow_edits(&mut self) -> Option<Effect> {
        if self.pending.keeping.due || self.is_kept() {
            return None;
        }
        self.pending.keeping.due = true;
        Some(Effect::Later(KEPT_AFTER, Timer::Keep))
    }

    /// Whether what is kept is what would be lost.
    fn is_kept(&self) -> bool {
        match self.pending.keeping.revision {
            Some(kept) => kept == self.document.revision() && self.document.is_dirty(),
            None => !self.document.is_dirty(),
        }
    }

    pub(super) fn keep_edits(&mut self) -> Vec<Effect> {
        self.pending.keeping.due = false;
        if self.is_kept() {
            return Vec::new();
        }
        if !self.document.is_dirty() {
            self.pending.keeping.revision = None;
            return vec![Effect::DropRecovery];
        }
        let text = self.document.shared_text();
        self.pending.keeping.revision = Some(self.document.revision());
        let scene = self.path.clone();
        vec![Effect::WriteRecovery { scene, text }]
    }

    /// Ends with nothing worth keeping.
    pub(super) fn leave(&mut self) -> Vec<Effect> {
        let kept = self
            .pending
            .keeping
            .revision
            .take()
            .map(|_| Effect::DropRecovery);
        kept.into_iter().chain([Effect::Quit]).collect()
    }

    pub(super) fn quit_keeping_edits(&mut self) -> Vec<Effect> {
        let mut effects = self.keep_edits();
        effects.push(Effect::Quit);
        effects
    }

    /// Takes the edits of an earlier run, as an edit like any other.
    pub(super) fn restore(&mut self) -> Vec<Effect> {
        let Some(Dialog::Recover(kept)) = self.dialog.take() else {
            return Vec::new();
        };
        let edits: Vec<_> = smallest_edit(self.document.text(), &kept.text)
            .into_iter()
            .collect();
        self.document.edit(&edits);
        self.relower();
        self.say("restored; u undoes");
        self.pending.keeping.revision = Some(self.document.revision());
        vec![Effect::AdoptKept {
            scene: self.path.clone(),
            place: kept.place,
        }]
    }

    /// Throws the edits of an earlier run away.
    pub(super) fn decline(&mut self) -> Vec<Effect> {
        match self.dialog.take() {
            Some(Dialog::Recover(kept)) => vec![Effect::DropKept(kept.place)],
            _ => Vec::new(),
        }
    }
}
