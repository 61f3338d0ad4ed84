//! Inputs that were opened before the file was read: what is typed there is meant as a change of what
//! they were opened with.

use std::sync::Arc;

use super::{MergeSource, OnDisk, Shared};
use crate::document::Adopted;

impl Shared {
    /// Whether keys are typed into a line, or choose from a menu.
    pub(super) fn has_input(&self) -> bool {
        self.cursor.typing.is_some() || self.overlays.has_line()
    }

    /// Records the saved text before one was taken from the file, if an input is open.
    pub(super) fn note_before_input(&mut self, saved: Arc<String>) {
        if self.has_input() {
            self.disk.before_input.get_or_insert(saved);
        }
    }

    /// Asks about what an input has changed if the file has changed it too since the input was opened.
    pub(super) fn merge_input(&mut self) {
        let Some(before) = self.disk.before_input.take() else {
            return;
        };
        let revision = self.document.revision();
        match self.document.merge_again(before) {
            Adopted::Conflict(merge) => {
                self.disk.state = OnDisk::Changed;
                self.overlays.ask_conflict(merge, MergeSource::File);
            }
            Adopted::Taken if revision != self.document.revision() => self.relower(),
            Adopted::Taken | Adopted::OutOfDate => {}
        }
    }

    /// Forgets the text before the input once that is closed.
    pub(super) fn follow_input(&mut self) {
        if !self.has_input() {
            self.disk.before_input = None;
        }
    }
}
