//! The text of an editor's buffer taken instead of the file's, and places shown in that editor.

use crate::app::Shared;
use crate::app::shared::buffer::Sent;
use crate::msg::Effect;
use crate::scene_reading::ReadBuffer;
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

/// What to do about a conflict with edits that were sent to the editor.
pub(super) enum Sending {
    /// The editor has not answered yet; its answer is followed by another reading.
    Unanswered,
    /// It has made them in its own way, such as in another format: what it made of them is the text, and
    /// is to be read again.
    Made,
}

/// Whether a conflict with the buffer may be one with edits that were sent there.
pub(super) fn conflicts_with_sent(shared: &mut Shared) -> Option<Sending> {
    let buffer = shared.buffer.as_mut()?;
    let sent = buffer.sent.take_if(|sent| sent.is_made);
    let Some(sent) = sent else {
        return buffer.sent.as_ref().map(|_| Sending::Unanswered);
    };
    buffer.version = None;
    shared.document.mark_saved(sent.text);
    Some(Sending::Made)
}

/// Brings the editor's cursor to a span of the text, and the focus if asked for.
pub(crate) fn show_in_editor(shared: &Shared, span: Span, takes_focus: bool) -> Option<Effect> {
    let buffer = shared.buffer.as_ref()?;
    let is_present = buffer.version.is_some() && !shared.document.is_dirty();
    let can_show = buffer.can.shows && is_present;
    can_show.then(|| Effect::Tell(ToEditor::Show { span, takes_focus }))
}
