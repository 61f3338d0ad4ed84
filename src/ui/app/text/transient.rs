//! The transient edit: the frame that SEQUENCE shows in the text and takes back.

use super::live_editing::{begin_live_edit, end_live_edit};
use crate::app::Shared;
use crate::app::shared::live_edit::TransientEdit;
use crate::keymap::Mode;

/// Begins an edit of the present text that will be reverted.
pub(crate) fn begin_transient(shared: &mut Shared) -> TransientEdit {
    TransientEdit {
        live_edit: begin_live_edit(shared),
        was_dirty: shared.document.is_dirty(),
    }
}

/// Restores the text from before the transient edit, if there is one.
pub(crate) fn revert_transient(shared: &mut Shared) {
    if let Some(edit) = shared.transient.take() {
        end_live_edit(shared, edit.live_edit);
    }
}

/// Whether there are unsaved edits, apart from a transient one.
pub(crate) fn has_edits(shared: &Shared) -> bool {
    let transient = shared.transient.as_ref();
    transient.map_or_else(|| shared.document.is_dirty(), |edit| edit.was_dirty)
}

/// Leaves SEQUENCE, if that is the mode, with the text as it was before the frame.
pub(crate) fn leave_sequence(shared: &mut Shared) {
    revert_transient(shared);
    if shared.mode == Mode::Sequence {
        shared.mode = Mode::Select;
    }
}

/// Leaves SEQUENCE for something that is done outside of it; returns the mode before.
pub(crate) fn step_outside(shared: &mut Shared) -> Mode {
    let mode = shared.mode;
    leave_sequence(shared);
    mode
}

/// Returns to SEQUENCE if that was the mode and what was done outside of it failed.
pub(crate) fn return_if_failed(shared: &mut Shared, mode: Mode) {
    if mode == Mode::Sequence && shared.overlays.has_failed() {
        shared.mode = mode;
    }
}
