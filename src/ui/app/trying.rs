//! Trying out changes of the text.

use super::App;
use super::cursor::Names;
use super::trial::{TakenBack, Trial};
use crate::document::{Document, Merged};
use crate::text::Edit;

impl App {
    /// Begins to try out changes of the present text.
    pub(super) fn begin_trial(&mut self) -> Trial {
        self.document.end_step();
        Trial {
            revision: self.document.revision(),
            is_applied: false,
            marks: self.cursor.marks.clone(),
            base: self.meaning(),
            back: None,
        }
    }

    /// Leaves a trial if something else has changed the text since the last attempt, which then
    /// stays, and says so by what was tried; returns whether it did.
    pub(super) fn leaves_trial(&mut self, trial: &Trial, tried: &str) -> bool {
        let is_overtaken = self.is_overtaken(trial);
        if is_overtaken {
            self.overlays.warn(format!(
                "the scene has changed on disk; the {tried} so far is kept"
            ));
        }
        is_overtaken
    }

    /// Replaces the last attempt by another one, whose edits are those of the text before the trial;
    /// without edits that is restored. On failure, with the reason, as well.
    pub(super) fn try_instead(
        &mut self,
        trial: &mut Trial,
        edits: impl FnOnce(&Self) -> Result<Vec<Edit>, String>,
    ) -> Result<(), String> {
        let was_applied = std::mem::take(&mut trial.is_applied);
        if was_applied {
            self.document.reject();
            self.cursor.renew(self.document.source(), Names::Changed);
            self.cursor.marks.clone_from(&trial.marks);
        }
        let outcome = edits(self).and_then(|edits| {
            trial.is_applied = !edits.is_empty();
            let made = if trial.is_applied {
                self.try_edits_after(trial.base.as_ref(), &edits)
            } else {
                Ok(())
            };
            made.map_err(|refused| refused.message)
        });
        trial.is_applied &= outcome.is_ok();
        if was_applied && !trial.is_applied {
            let lowered = self.lowered_after(trial.base.as_ref());
            self.install(lowered);
        }
        trial.revision = self.document.revision();
        outcome
    }

    /// Keeps the last attempt as one undo step.
    pub(super) fn keep_trial(&mut self) {
        self.document.end_step();
    }

    /// Puts the text back as it was before the trial. After a merge, that takes back the trial alone,
    /// unless both changed the same places.
    pub(super) fn end_trial(&mut self, mut trial: Trial) {
        if !self.is_overtaken(&trial) {
            let _ = self.try_instead(&mut trial, |_| Ok(Vec::new()));
        } else if trial.is_applied {
            let revision = self.document.revision();
            let back = trial.back.filter(|back| back.revision == revision);
            match back.map(|back| self.try_edits(&back.edits)) {
                Some(Ok(())) => self
                    .overlays
                    .say("cancelled; changes merged from the file are kept"),
                Some(Err(_)) | None => self.overlays.warn(
                    "the scene has changed on disk; the change so far is kept: u undoes the merge, then the change",
                ),
            }
        }
        self.document.end_step();
    }

    fn is_overtaken(&self, trial: &Trial) -> bool {
        trial.revision != self.document.revision()
    }

    /// Takes a merge with the file, after which trials can still be taken back; returns the old
    /// document.
    #[must_use = "freeing it may take long"]
    pub(super) fn take_merged(&mut self, merged: Merged) -> Document {
        let before = self.document.revision();
        let menu = self.overlays.menu.as_mut();
        let trials = [
            self.pictures.transform.as_mut().map(|own| &mut own.trial),
            self.overlays.picker.as_mut().map(|own| &mut own.trial),
            menu.and_then(|menu| menu.trial.as_mut()),
        ];
        let applied = trials.into_iter().flatten();
        let applied = applied.filter(|trial| trial.is_applied && trial.revision == before);
        for trial in applied {
            let edits = self.document.taken_back(&merged);
            trial.back = edits.map(|edits| TakenBack {
                // Taking the merge is one change.
                revision: before + 1,
                edits,
            });
        }
        self.document.take(merged)
    }
}
