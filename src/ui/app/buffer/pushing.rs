//! Edits of the interface on their way into the buffer. They are shown here at once; at most one message
//! with edits is under way, and those made meanwhile follow in the next.

use std::time::Duration;

use crate::app::shared::buffer::Sent;
use crate::app::{Buffer, OnDisk, Shared, files, text};
use crate::msg::{Effect, Timer};
use link::ToEditor;

/// How long after the last edit they are sent, so that a key held down is one undo step there.
const HELD: Duration = Duration::from_millis(100);

/// How long an answer is waited for, and then the change of the text.
const PATIENCE: Duration = Duration::from_secs(3);

/// How many times the same edits are sent before they are taken back.
const TRIES: u32 = 2;

/// Sends unsaved edits in a moment, if there are new ones.
pub(crate) fn follow_edits(shared: &mut Shared) -> Option<Effect> {
    let revision = shared.document.revision();
    let is_ready = is_ready(shared);
    let buffer = shared.buffer.as_mut()?;
    let due = is_ready.then_some(revision);
    if due == buffer.due {
        return None;
    }
    buffer.due = due;
    due.map(|_| Effect::Later(HELD, Timer::Push))
}

/// Whether there are edits to send, and nothing to wait for.
fn is_ready(shared: &Shared) -> bool {
    let can_take =
        |buffer: &Buffer| buffer.takes_edits() && buffer.version.is_some() && buffer.sent.is_none();
    shared.document.is_dirty()
        && shared.buffer.as_ref().is_some_and(can_take)
        && shared.disk.state == OnDisk::Known
        && shared.overlays.dialog.is_none()
        && !is_trying(shared)
}

/// Whether a change is being tried out that is taken back or replaced by the next key.
pub(super) fn is_trying(shared: &Shared) -> bool {
    let menu = shared.overlays.menu.as_ref();
    shared.transient.is_some()
        || shared.motion.is_some()
        || shared.cursor.slide.is_some()
        || shared.overlays.picker.is_some()
        || menu.is_some_and(|menu| menu.live_edit.is_some())
}

/// Sends unsaved edits to the editor, or gives up those that it did not answer for.
pub(crate) fn push(shared: &mut Shared) -> Vec<Effect> {
    let is_ready = is_ready(shared);
    let Some(buffer) = &mut shared.buffer else {
        return Vec::new();
    };
    if buffer.sent.take().is_some() {
        buffer.failures += 1;
        try_again(shared);
        // What was read meanwhile had to wait for the answer.
        return files::read_finally(shared);
    }
    let (true, Some(base)) = (is_ready, buffer.version) else {
        return Vec::new();
    };
    shared.document.end_step();
    buffer.due = None;
    buffer.sent = Some(Sent {
        base,
        text: shared.document.shared_text(),
        is_made: false,
    });
    let edit = ToEditor::Edit(base, shared.document.unsaved_edits());
    vec![Effect::Tell(edit), Effect::Later(PATIENCE, Timer::Push)]
}

/// Takes the editor's answer. The change of the text comes as any other.
pub(super) fn answered(shared: &mut Shared, base: u64, is_made: bool, version: u64) -> Vec<Effect> {
    let Some(buffer) = &mut shared.buffer else {
        return Vec::new();
    };
    let Some(sent) = buffer.sent.as_mut().filter(|sent| sent.base == base) else {
        return Vec::new();
    };
    if is_made {
        sent.is_made = true;
    } else {
        buffer.sent = None;
        // Edits of a former version were refused for that reason.
        buffer.failures += u32::from(version == base);
    }
    try_again(shared);
    // What was read meanwhile had to wait for the answer.
    files::read_finally(shared)
}

/// Takes edits back that were refused too often; otherwise they are sent again.
fn try_again(shared: &mut Shared) {
    let Some(buffer) = &mut shared.buffer else {
        return;
    };
    buffer.due = None;
    if buffer.failures < TRIES {
        return;
    }
    buffer.failures = 0;
    shared.jobs.next = None;
    let editor = buffer.editor.clone();
    let back = shared.document.edits_to_saved();
    if text::make_step(shared, &back, format!("taken back: not made in {editor}")) {
        let undo = shared.key_for("undo");
        shared.fail(format!(
            "{editor} did not take the change, so it was taken back; {undo} makes it again"
        ));
    }
}
