//! Trying out changes of the text.

use super::Shared;
use super::cursor::Names;
use super::live_edit::{LiveEdit, TakenBack, TransientEdit};
use crate::document::{Document, Merged};
use crate::text::Edit;

impl Shared {
    /// Begins to try out changes of the present text.
    pub(super) fn begin_live_edit(&mut self) -> LiveEdit {
        self.document.end_step();
        LiveEdit {
            revision: self.document.revision(),
            is_applied: false,
            marks: self.cursor.marks.clone(),
            base: self.meaning(),
            back: None,
        }
    }

    /// Leaves a live edit if something else has changed the text since the last attempt, which then
    /// stays, and says so by what was tried; returns whether it did.
    pub(super) fn leaves_live_edit(&mut self, live_edit: &LiveEdit, tried: &str) -> bool {
        let is_overtaken = self.is_overtaken(live_edit);
        if is_overtaken {
            self.overlays.warn(format!(
                "the scene has changed on disk; the {tried} so far is kept"
            ));
        }
        is_overtaken
    }

    /// Replaces the last attempt by another one, whose edits are those of the text before the live edit;
    /// without edits that is restored. On failure, with the reason, as well.
    pub(super) fn try_instead(
        &mut self,
        live_edit: &mut LiveEdit,
        edits: impl FnOnce(&Self) -> Result<Vec<Edit>, String>,
    ) -> Result<(), String> {
        let was_applied = std::mem::take(&mut live_edit.is_applied);
        if was_applied {
            self.document.reject();
            self.cursor.renew(self.document.source(), Names::Changed);
            self.cursor.marks.clone_from(&live_edit.marks);
        }
        let outcome = edits(self).and_then(|edits| {
            live_edit.is_applied = !edits.is_empty();
            let made = if live_edit.is_applied {
                self.try_edits_after(live_edit.base.as_ref(), &edits)
            } else {
                Ok(())
            };
            made.map_err(|refused| refused.message)
        });
        live_edit.is_applied &= outcome.is_ok();
        if was_applied && !live_edit.is_applied {
            let lowered = self.lowered_after(live_edit.base.as_ref());
            self.install(lowered);
        }
        live_edit.revision = self.document.revision();
        outcome
    }

    /// Keeps the last attempt as one undo step.
    pub(super) fn keep_live_edit(&mut self) {
        self.document.end_step();
    }

    /// Puts the text back as it was before the live edit. After a merge, that takes back the live edit alone,
    /// unless both changed the same places.
    pub(super) fn end_live_edit(&mut self, mut live_edit: LiveEdit) {
        if !self.is_overtaken(&live_edit) {
            let _ = self.try_instead(&mut live_edit, |_| Ok(Vec::new()));
        } else if live_edit.is_applied {
            let revision = self.document.revision();
            let back = live_edit.back.filter(|back| back.revision == revision);
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

    /// Begins an edit of the present text that will be reverted.
    pub(super) fn begin_transient(&mut self) -> TransientEdit {
        TransientEdit {
            live_edit: self.begin_live_edit(),
            was_dirty: self.document.is_dirty(),
        }
    }

    /// Restores the text from before the transient edit, if there is one.
    pub(super) fn revert_transient(&mut self) {
        if let Some(edit) = self.transient.take() {
            self.end_live_edit(edit.live_edit);
        }
    }

    /// Whether there are unsaved edits, apart from a transient one.
    pub fn has_edits(&self) -> bool {
        let transient = self.transient.as_ref();
        transient.map_or_else(|| self.document.is_dirty(), |edit| edit.was_dirty)
    }

    fn is_overtaken(&self, live_edit: &LiveEdit) -> bool {
        live_edit.revision != self.document.revision()
    }

    /// Takes a merge with the file, after which live edits can still be taken back; returns the old
    /// document.
    #[must_use = "freeing it may take long"]
    pub(super) fn take_merged(&mut self, merged: Merged) -> Document {
        let before = self.document.revision();
        let menu = self.overlays.menu.as_mut();
        let live_edits = [
            self.pictures
                .transform
                .as_mut()
                .map(|own| &mut own.live_edit),
            self.overlays.picker.as_mut().map(|own| &mut own.live_edit),
            menu.and_then(|menu| menu.live_edit.as_mut()),
        ];
        let applied = live_edits.into_iter().flatten();
        let applied =
            applied.filter(|live_edit| live_edit.is_applied && live_edit.revision == before);
        for live_edit in applied {
            let edits = self.document.taken_back(&merged);
            live_edit.back = edits.map(|edits| TakenBack {
                // Taking the merge is one change.
                revision: before + 1,
                edits,
            });
        }
        self.document.take(merged)
    }
}
