//! Quitting: asks first if something would be lost, and waits for work under way.

use super::{App, Dialog};
use crate::ui::msg::{Effect, Timer};

impl App {
    /// `w`, which in the quit dialog saves and then quits.
    pub(super) fn save_key(&mut self) -> Vec<Effect> {
        if let Some(Dialog::Quit) = self.overlays.dialog {
            self.overlays.dialog = None;
            return self.save_and_quit();
        }
        self.save()
    }

    /// Saves if necessary, then quits. A scene without a file first gets a name.
    pub(super) fn save_and_quit(&mut self) -> Vec<Effect> {
        self.jobs.quit = true;
        if self.is_saved() {
            return self.quit_when_done();
        }
        self.save()
    }

    pub(super) fn quit(&mut self) -> Vec<Effect> {
        if self.losses().is_some() {
            self.overlays.dialog = Some(Dialog::Quit);
            return Vec::new();
        }
        self.leave()
    }

    /// Quits regardless of losses. Edits that are being saved are kept in the journal, because the
    /// save may never end.
    pub(super) fn quit_anyway(&mut self) -> Vec<Effect> {
        if self.jobs.file_being_saved().is_some() {
            self.quit_keeping_edits()
        } else {
            self.leave()
        }
    }

    /// Performs a pending quit once saves and the export are done and nothing would be lost.
    pub(super) fn quit_when_done(&mut self) -> Vec<Effect> {
        if !self.jobs.quit {
            return Vec::new();
        }
        if self.jobs.export.is_some() {
            let words = match self.jobs.queued() {
                0 => "will quit once the export finishes; press x to cancel it".to_owned(),
                queued => format!("will quit once {} exports finish", queued + 1),
            };
            self.overlays.say(words);
            return Vec::new();
        }
        if let Some(Dialog::Overwrite(_)) = self.overlays.dialog {
            return Vec::new();
        }
        self.jobs.quit = false;
        if self.document.is_dirty() {
            return Vec::new();
        }
        self.leave()
    }

    pub(super) fn interrupt(&mut self) -> Vec<Effect> {
        if self.jobs.interrupt || self.losses().is_none() {
            return self.quit_keeping_edits();
        }
        self.jobs.interrupt = true;
        self.overlays.dialog = Some(Dialog::Quit);
        vec![Effect::Later(super::INTERRUPT_AGAIN, Timer::Interrupt)]
    }

    /// Quits and discards the journal.
    fn leave(&mut self) -> Vec<Effect> {
        let forgotten = self.disk.journal.forget();
        forgotten.into_iter().chain([Effect::Quit]).collect()
    }

    /// Quits with unsaved edits kept, written once more in case the journal was removed.
    pub(super) fn quit_keeping_edits(&mut self) -> Vec<Effect> {
        let kept = self.keep_the_rest();
        kept.into_iter().chain([Effect::Quit]).collect()
    }
}
