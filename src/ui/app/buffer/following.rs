//! What is heard of the buffer.

use super::pushing::{answered, is_trying};
use crate::app::shared::buffer::Buffer;
use crate::app::{Shared, files};
use crate::msg::{BufferNews, Effect};
use link::Abilities;
use text::Span;

/// Takes what was heard.
pub(crate) fn heard(shared: &mut Shared, news: BufferNews) -> Vec<Effect> {
    match news {
        BufferNews::Opened {
            editor,
            can,
            is_followed,
            is_changed,
        } => {
            let mut buffer = Buffer::new(editor, can, is_followed);
            buffer.is_changed = is_changed;
            shared.buffer = Some(buffer);
        }
        BufferNews::Saved => {
            if let Some(buffer) = &mut shared.buffer {
                buffer.is_changed = false;
            }
        }
        BufferNews::Closed => shared.buffer = None,
        BufferNews::Left => {
            if let Some(buffer) = &mut shared.buffer {
                buffer.can = Abilities::default();
            }
            return files::read_finally(shared);
        }
        BufferNews::Cursor { at, version } => go_to(shared, at, version),
        BufferNews::Answered {
            base,
            is_made,
            version,
        } => return answered(shared, base, is_made, version),
    }
    Vec::new()
}

/// Selects what the editor's cursor is in, unless something else is under way.
fn go_to(shared: &mut Shared, at: usize, version: u64) {
    let is_present = shared
        .buffer
        .as_ref()
        .is_some_and(|buffer| buffer.version == Some(version));
    let is_free = !shared.mode.moves_camera()
        && shared.overlays.dialog.is_none()
        && shared.open_line().is_none()
        && !is_trying(shared);
    if !is_present || !is_free || shared.document.is_dirty() {
        return;
    }
    let node = shared.source().node_at(Span::at(at));
    if let Some(node) = node.filter(|node| *node != shared.cursor.selected()) {
        shared.select(node);
        shared.keep_mode();
    }
}
