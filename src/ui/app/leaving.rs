//! Leaving the scene, to quit or for another one: asks first if something would be lost, and waits
//! for work under way.

use super::{AfterLeaving, Dialog, Shared};
use crate::ui::msg::{Effect, Timer};

impl Shared {
    /// `w`, which in the question whether to leave saves and then leaves.
    pub(super) fn save_key(&mut self) -> Vec<Effect> {
        match self.take_question() {
            Some(next) => self.save_and(next),
            None => self.save(),
        }
    }

    /// `S`, which writes the moved view into the text, and in the question whether to leave then saves
    /// and leaves.
    pub(super) fn save_view_key(&mut self) -> Vec<Effect> {
        let is_moved = self.is_view_unwritten();
        self.save_view();
        if !is_moved || self.is_view_unwritten() {
            return Vec::new();
        }
        let next = self.take_question();
        next.map_or_else(Vec::new, |next| self.save_and(next))
    }

    pub(super) fn save_and_quit(&mut self) -> Vec<Effect> {
        self.save_and(AfterLeaving::Quit)
    }

    /// Saves if necessary, then leaves. A scene without a file first gets a name.
    fn save_and(&mut self, next: AfterLeaving) -> Vec<Effect> {
        self.jobs.next = Some(next);
        if self.is_saved() {
            return self.leave_when_done();
        }
        self.save()
    }

    pub(super) fn quit(&mut self) -> Vec<Effect> {
        self.leave_for(AfterLeaving::Quit)
    }

    /// Leaves the scene; asks first if something would be lost.
    pub(super) fn leave_for(&mut self, next: AfterLeaving) -> Vec<Effect> {
        self.leave_sequence();
        if self.losses_before(&next).is_some() {
            self.overlays.dialog = Some(Dialog::Leave(next));
            return Vec::new();
        }
        self.leave(next)
    }

    /// Leaves the scene as asked, regardless of losses.
    pub(super) fn leave_anyway(&mut self) -> Vec<Effect> {
        match self.take_question() {
            Some(AfterLeaving::Quit) => self.quit_anyway(),
            Some(next) => self.leave(next),
            None => Vec::new(),
        }
    }

    /// Quits regardless of losses. Edits that are being saved are kept in the journal, because the
    /// save may never end.
    pub(super) fn quit_anyway(&mut self) -> Vec<Effect> {
        if self.jobs.file_being_saved().is_some() {
            self.quit_keeping_edits()
        } else {
            self.leave(AfterLeaving::Quit)
        }
    }

    /// Leaves as planned once saves and, before quitting, the export are done and nothing would be
    /// lost.
    pub(super) fn leave_when_done(&mut self) -> Vec<Effect> {
        if self.jobs.next == Some(AfterLeaving::Quit) && self.jobs.export.is_some() {
            let words = match self.jobs.queued() {
                0 => {
                    let stop = self.key_for("stop");
                    format!("will quit once the export finishes; press {stop} to cancel it")
                }
                queued => format!("will quit once {} exports finish", queued + 1),
            };
            self.overlays.say(words);
            return Vec::new();
        }
        if let Some(Dialog::Overwrite(_)) = self.overlays.dialog {
            return Vec::new();
        }
        match self.jobs.next.take() {
            // A save does not keep the view.
            Some(next) if self.is_view_unwritten() => self.leave_for(next),
            Some(next) if !self.document.is_dirty() => self.leave(next),
            _ => Vec::new(),
        }
    }

    pub(super) fn interrupt(&mut self) -> Vec<Effect> {
        self.leave_sequence();
        if self.jobs.interrupt || self.losses().is_none() {
            return self.quit_keeping_edits();
        }
        self.jobs.interrupt = true;
        self.overlays.dialog = Some(Dialog::Leave(AfterLeaving::Quit));
        vec![Effect::Later(super::INTERRUPT_AGAIN, Timer::Interrupt)]
    }

    /// Quits with unsaved edits kept, written once more in case the journal was removed.
    pub(super) fn quit_keeping_edits(&mut self) -> Vec<Effect> {
        self.leave_sequence();
        let kept = self.keep_the_rest();
        kept.into_iter().chain([Effect::Quit]).collect()
    }

    fn leave(&mut self, next: AfterLeaving) -> Vec<Effect> {
        match next {
            AfterLeaving::Quit => {
                let forgotten = self.disk.journal.forget();
                forgotten.into_iter().chain([Effect::Quit]).collect()
            }
            AfterLeaving::Open(path) => self.request_scene(path),
            AfterLeaving::New(language) => self.start_scene(language),
        }
    }

    /// Closes the question whether to leave; returns what was to follow.
    fn take_question(&mut self) -> Option<AfterLeaving> {
        match self.overlays.dialog.take() {
            Some(Dialog::Leave(next)) => Some(next),
            other => {
                self.overlays.dialog = other;
                None
            }
        }
    }
}
