//! The external editor.

use super::outside;
use super::reading::read_again;
use crate::app::{AfterLeaving, Dialog, OnDisk, Shared, inspect};
use crate::msg::Effect;
use text::Position;

/// Opens the user's editor at the cursor, or at what is inspected.
pub(crate) fn open_editor(shared: &mut Shared) -> Vec<Effect> {
    let Some(path) = shared.disk.path.clone() else {
        shared.fail("this scene has no file yet: use :w FILE to create one");
        return Vec::new();
    };
    if shared.buffer.is_some() {
        return show_in_running_editor(shared);
    }
    let is_unsaved = match shared.disk.state {
        OnDisk::New => true,
        // A file that was not taken must be corrected first.
        OnDisk::Faulty(_) | OnDisk::Unreadable => false,
        _ => shared.document.is_dirty(),
    };
    if is_unsaved {
        shared.overlays.dialog = Some(Dialog::Leave(AfterLeaving::Editor));
        return Vec::new();
    }
    let wrong = shared.wrong();
    let error = match wrong.at {
        Some(at) => wrong.findings.get(at),
        None if shared.is_disk_wrong() => wrong.findings.iter().find(|d| d.is_error()),
        None => None,
    };
    let cited = error.and_then(|error| error.cited.as_deref());
    let cited = cited.and_then(|cited| Some((shared.assets.file(&cited.file)?, cited.line)));
    if let Some((path, line)) = cited {
        return vec![Effect::OpenEditor { path, line }];
    }
    let span = error.map_or_else(
        || shared.source().span(inspect::node_in_focus(shared)),
        |d| d.span,
    );
    let line = Position::of(wrong.text, span.start()).line;
    vec![Effect::OpenEditor { path, line }]
}

/// Brings the cursor of the editor that has the scene open to what is selected or inspected.
fn show_in_running_editor(shared: &mut Shared) -> Vec<Effect> {
    let span = shared.source().span(inspect::node_in_focus(shared));
    if let Some(show) = outside::show_in_editor(shared, span, true) {
        return vec![show];
    }
    let line = Position::of(shared.document.text(), span.start()).line;
    let editor = shared.buffer.as_ref().map(|buffer| &*buffer.editor);
    let words = format!("line {line} in {}", editor.unwrap_or_default());
    shared.say(words);
    Vec::new()
}

/// Reports an editor that failed, and reads the file again.
pub(crate) fn editor_closed(shared: &mut Shared, outcome: Result<(), String>) -> Vec<Effect> {
    if let Err(reason) = outcome {
        shared.fail(reason);
    }
    read_again(shared)
}
