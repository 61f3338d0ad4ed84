//! Leaving: asked first where something would be lost, later where something is under way.

use super::{App, Dialog};
use crate::ui::msg::{Effect, Timer};

impl App {
    /// `w`: also the answer that saves before it quits.
    pub(super) fn save_key(&mut self) -> Vec<Effect> {
        if let Some(Dialog::Quit) = self.dialog {
            self.dialog = None;
            self.pending.quit = true;
            if !self.document.is_dirty() {
                return self.quit_when_done();
            }
        }
        self.save()
    }

    /// Whether unsaved edits, an export or a save would be lost with the program.
    fn would_lose(&self) -> bool {
        self.document.is_dirty() || self.export.is_some() || self.file_being_saved().is_some()
    }

    pub(super) fn quit(&mut self) -> Vec<Effect> {
        if self.would_lose() {
            self.dialog = Some(Dialog::Quit);
            return Vec::new();
        }
        self.leave()
    }

    /// Quits whatever is lost. Edits that are being saved are kept in the journal: the save may
    /// never end.
    pub(super) fn quit_anyway(&mut self) -> Vec<Effect> {
        if self.file_being_saved().is_some() {
            self.quit_keeping_edits()
        } else {
            self.leave()
        }
    }

    /// Quits, once nothing is lost, as was asked for before a save or an export was done.
    pub(super) fn quit_when_done(&mut self) -> Vec<Effect> {
        if !self.pending.quit {
            return Vec::new();
        }
        if self.export.is_some() {
            self.say("quits when the export is written; x cancels it");
            return Vec::new();
        }
        self.pending.quit = false;
        if self.document.is_dirty() {
            return Vec::new();
        }
        self.leave()
    }

    pub(super) fn interrupt(&mut self) -> Vec<Effect> {
        if self.pending.interrupt || !self.would_lose() {
            return self.quit_keeping_edits();
        }
        self.pending.interrupt = true;
        self.dialog = Some(Dialog::Quit);
        vec![Effect::Later(super::INTERRUPT_AGAIN, Timer::Interrupt)]
    }
}
