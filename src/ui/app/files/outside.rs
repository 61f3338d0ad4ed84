//! The text of an editor's buffer taken instead of the file's, and places shown in that editor.

use std::sync::Arc;

use crate::app::Shared;
use crate::app::shared::buffer::Sent;
use crate::msg::Effect;
use crate::scene_reading::{ReadBuffer, Reading, SentText};
use link::ToEditor;
use text::Span;

/// Takes note that the saved text of the document is now that of this buffer, or of the file. The text of
/// an editor that is gone becomes unsaved edits of the file's.
pub(super) fn took(shared: &mut Shared, read: Option<ReadBuffer>) -> Vec<Effect> {
    let (Some(buffer), Some(read)) = (&mut shared.buffer, read) else {
        return Vec::new();
    };
    buffer.is_changed |= buffer.version.is_some_and(|before| before < read.version);
    buffer.version = Some(read.version);
    buffer.offered = None;
    let is_there = |sent: &mut Sent| sent.is_made && sent.base < read.version;
    buffer.sent.take_if(is_there);
    if !shared.document.is_dirty() {
        buffer.failures = 0;
    }
    let Some(in_file) = read.in_file else {
        return Vec::new();
    };
    let editor = std::mem::take(&mut buffer.editor);
    shared.buffer = None;
    shared.document.mark_saved(in_file);
    if shared.document.is_dirty() {
        let save = shared.key_for("save");
        shared.warn(format!(
            "{editor} ended without closing the scene: its text is kept here as unsaved edits; {save} saves them"
        ));
    } else {
        shared.say(format!("{editor} ended"));
    }
    vec![Effect::ForgetBuffer]
}

/// The text with the edits that the editor may have made.
pub(super) fn sent(shared: &Shared) -> Option<SentText> {
    let sent = shared.buffer.as_ref()?.sent.as_ref()?;
    Some(SentText {
        text: Arc::clone(&sent.text),
        is_made: sent.is_made,
    })
}

/// Whether a newer text may have edits that the editor has not answered for yet.
pub(super) fn awaits_answer(shared: &Shared, reading: &Reading) -> bool {
    let sent = shared
        .buffer
        .as_ref()
        .and_then(|buffer| buffer.sent.as_ref());
    // An editor that is gone gives none.
    let read = reading
        .buffer
        .as_ref()
        .filter(|read| read.in_file.is_none());
    let (Some(sent), Some(read)) = (sent, read) else {
        return false;
    };
    !sent.is_made && sent.base < read.version
}

/// Takes edits that were sent for saved: the editor has them.
pub(super) fn take_sent(shared: &mut Shared) {
    let sent = shared.buffer.as_mut().and_then(|buffer| buffer.sent.take());
    if let Some(sent) = sent {
        shared.document.mark_saved(sent.text);
    }
}

/// Brings the editor's cursor to a span of the text, and the focus if asked for.
pub(crate) fn show_in_editor(shared: &Shared, span: Span, takes_focus: bool) -> Option<Effect> {
    let buffer = shared.buffer.as_ref()?;
    let is_present = buffer.version.is_some() && !shared.document.is_dirty();
    let can_show = buffer.can.shows && is_present;
    can_show.then(|| Effect::Tell(ToEditor::Show { span, takes_focus }))
}
