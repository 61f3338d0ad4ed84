//! Inputs that were opened before the file was read: what is typed there is meant as a change of what
//! they were opened with.

use std::sync::Arc;

use super::conflicts::ask_conflict;
use super::edit::relower;
use crate::app::{MergeSource, OnDisk, Shared};
use document::Adopted;

/// Records the saved text before one was taken from the file, if an input is open.
pub(crate) fn note_before_input(shared: &mut Shared, saved: Arc<String>) {
    if shared.open_line().is_some() {
        shared.disk.before_input.get_or_insert(saved);
    }
}

/// Asks about what an input has changed if the file has changed it too since the input was opened.
pub(crate) fn merge_input(shared: &mut Shared) {
    let Some(before) = shared.disk.before_input.take() else {
        return;
    };
    let revision = shared.document.revision();
    match shared.document.merge_again(before) {
        Adopted::Conflict(merge) => {
            shared.disk.state = OnDisk::Changed;
            ask_conflict(shared, merge, MergeSource::File);
        }
        Adopted::Taken if revision != shared.document.revision() => relower(shared),
        Adopted::Taken | Adopted::OutOfDate => {}
    }
}

/// Forgets the text before the input once that is closed.
pub(crate) fn follow_input(shared: &mut Shared) {
    if shared.open_line().is_none() {
        shared.disk.before_input = None;
    }
}
