//! Unsaved edits: keeping them for the next run, and offering, restoring and merging those of
//! earlier runs.

use std::sync::Arc;

use super::journal::Outcome;
use super::{Dialog, MergeSource, Shared};
use crate::document::{Adopted, Merge, StepName};
use crate::ui::msg::Effect;
use crate::ui::recovery::{Claim, Found, Offer, Since, Way};

impl Shared {
    /// Looks for undecided edits that earlier runs kept.
    pub(super) fn look_for_kept(&self) -> Effect {
        let scene = self.disk.path.clone();
        self.disk.journal.look(&self.document, scene)
    }

    pub(super) fn found_kept(&mut self, found: Found) {
        if let Some(complaint) = self.disk.journal.found(found) {
            self.overlays.warn(complaint);
        }
    }

    /// Whether the journal holds the unsaved edits as they are.
    pub fn has_kept_edits(&self) -> bool {
        self.disk.journal.holds(&self.document)
    }

    /// Whether unsaved edits that should be kept by now would be lost with the program.
    pub fn fails_to_keep(&self) -> bool {
        self.disk.journal.fails(&self.document)
    }

    pub(super) fn keep_edits(&mut self) -> Option<Effect> {
        let scene = self.disk.path.clone();
        self.disk.journal.keep(&self.document, scene)
    }

    pub(super) fn keep_the_rest(&mut self) -> Option<Effect> {
        let scene = self.disk.path.clone();
        self.disk.journal.keep_the_rest(&self.document, scene)
    }

    /// Takes the outcome of an attempt to keep edits.
    pub(super) fn kept(&mut self, revision: u64, outcome: Result<(), String>) -> Option<Effect> {
        match self.disk.journal.kept(revision, outcome) {
            Outcome::OutOfDate => None,
            Outcome::Kept(trouble) => {
                if let Some(trouble) = trouble {
                    self.overlays.withdraw(&trouble);
                }
                None
            }
            Outcome::Failed(trouble, again) => {
                if let Some(trouble) = trouble {
                    self.overlays.fail(trouble);
                }
                Some(*again)
            }
        }
    }

    /// Offers kept edits once no other question is open; examines them again if the text that they
    /// would be restored into has changed.
    pub(super) fn follow_kept(&mut self) -> Option<Effect> {
        let text = self.document.shared_text();
        let is_other = match &self.overlays.dialog {
            Some(Dialog::Recover(offer)) => !Arc::ptr_eq(&offer.text, &text),
            Some(Dialog::Conflict { merge, from, .. }) => {
                matches!(from, MergeSource::Kept(..)) && !merge.is_of(&self.document)
            }
            Some(Dialog::Leave(_) | Dialog::Delete(_) | Dialog::Overwrite(_)) => false,
            None => {
                let offer = self.disk.journal.offer.take()?;
                self.overlays.dialog = Some(Dialog::Recover(offer));
                return self.follow_kept();
            }
        };
        is_other.then(|| {
            self.overlays.dialog = None;
            self.look_for_kept()
        })
    }

    /// Restores the edits of an earlier run as an ordinary edit; asks first where the text has
    /// changed in the same places since.
    pub(super) fn restore(&mut self) -> Vec<Effect> {
        let Some(Dialog::Recover(offer)) = self.overlays.dialog.take() else {
            return Vec::new();
        };
        let Offer {
            claim, way, since, ..
        } = *offer;
        match way {
            Way::Edit(edit) => {
                self.document.edit(&[edit]);
                self.restored(claim, since)
            }
            Way::Merge(merge) if merge.conflicts.is_empty() => {
                self.restore_merged(&merge, claim, since)
            }
            Way::Merge(merge) => {
                let from = MergeSource::Kept(claim, since);
                self.overlays.ask_conflict(merge, from);
                Vec::new()
            }
        }
    }

    /// Restores kept edits after their conflicts with the text have been decided.
    pub(super) fn restore_merged(
        &mut self,
        merge: &Merge,
        claim: Arc<Claim>,
        since: Since,
    ) -> Vec<Effect> {
        match self.document.restore(merge) {
            Adopted::Taken => self.restored(claim, since),
            // The text has changed: the edits are examined again.
            Adopted::Conflict(_) | Adopted::OutOfDate => vec![self.look_for_kept()],
        }
    }

    fn restored(&mut self, claim: Arc<Claim>, since: Since) -> Vec<Effect> {
        self.document
            .name_step(StepName::done("restored unsaved edits"));
        self.relower();
        let done = match since {
            Since::Same => "restored",
            Since::Changed => "restored and merged with what has changed since",
        };
        let undo = self.key_for("undo");
        self.overlays.say(format!("{done}; {undo} undoes it"));
        // The other journal is removed only once this run's journal holds the edits.
        let mut effects = if self.document.is_dirty() {
            vec![Effect::AdoptKept(claim)]
        } else {
            vec![Effect::DropKept(claim)]
        };
        effects.extend(self.keep_edits());
        effects.push(self.look_for_kept());
        effects
    }

    /// Discards the edits of an earlier run.
    pub(super) fn decline(&mut self) -> Vec<Effect> {
        match self.overlays.dialog.take() {
            Some(Dialog::Recover(offer)) => {
                vec![Effect::DropKept(offer.claim), self.look_for_kept()]
            }
            _ => Vec::new(),
        }
    }

    /// Closes a question that may be asked again: about kept edits, in the next run.
    pub(super) fn put_off(&mut self) -> Vec<Effect> {
        self.jobs.next = None;
        let claim = match self.overlays.dialog.take() {
            Some(Dialog::Recover(offer)) => offer.claim,
            Some(Dialog::Conflict {
                from: MergeSource::Kept(claim, _),
                ..
            }) => claim,
            _ => return Vec::new(),
        };
        self.disk.journal.put_off(&claim);
        vec![self.look_for_kept()]
    }
}
