//! Trying out changes of the text.

use super::edit::{install, lowered_after, try_edits, try_edits_after};
use crate::app::Shared;
use crate::app::shared::cursor::Names;
use crate::app::shared::live_edit::{LiveEdit, TakenBack};
use document::{Document, Merged, Past};
use text::Edit;

/// Begins to try out changes of the present text.
pub(crate) fn begin_live_edit(shared: &mut Shared) -> LiveEdit {
    shared.document.end_step();
    LiveEdit {
        revision: shared.document.revision(),
        is_applied: false,
        marks: shared.cursor.marks.clone(),
        base: shared.meaning(),
        back: None,
    }
}

/// Leaves a live edit if something else has changed the text since the last attempt, which then
/// stays, and says so by what was tried; returns whether it did.
pub(crate) fn leaves_live_edit(shared: &mut Shared, live_edit: &LiveEdit, tried: &str) -> bool {
    let is_overtaken = is_overtaken(shared, live_edit);
    if is_overtaken {
        let words = format!("the scene has changed on disk; the {tried} so far is kept");
        shared.warn(words);
    }
    is_overtaken
}

/// Replaces the last attempt by another one, whose edits are those of the text before the live edit;
/// without edits that is restored. On failure, with the reason, as well.
pub(crate) fn try_instead(
    shared: &mut Shared,
    live_edit: &mut LiveEdit,
    edits: impl FnOnce(&Shared) -> Result<Vec<Edit>, String>,
) -> Result<(), String> {
    let was_applied = std::mem::take(&mut live_edit.is_applied);
    if was_applied {
        shared.document.reject();
        shared
            .cursor
            .renew(shared.document.source(), Names::Changed);
        shared.cursor.marks.clone_from(&live_edit.marks);
    }
    let outcome = edits(shared).and_then(|edits| {
        if edits.is_empty() {
            return Ok(false);
        }
        let made = try_edits_after(shared, live_edit.base.as_ref(), &edits);
        made.map_or_else(|refused| Err(refused.message), |()| Ok(true))
    });
    live_edit.is_applied = outcome == Ok(true);
    if was_applied && !live_edit.is_applied {
        let lowered = lowered_after(shared, live_edit.base.as_ref());
        install(shared, lowered);
    }
    live_edit.revision = shared.document.revision();
    outcome.map(|_| ())
}

/// As [`try_instead`], but shows the reason of a failure; returns whether there was none.
pub(crate) fn try_or_fail(
    shared: &mut Shared,
    live_edit: &mut LiveEdit,
    edits: impl FnOnce(&Shared) -> Result<Vec<Edit>, String>,
) -> bool {
    let outcome = try_instead(shared, live_edit, edits);
    outcome.map_err(|reason| shared.fail(reason)).is_ok()
}

/// Keeps the last attempt as one undo step.
pub(crate) fn keep_live_edit(shared: &mut Shared) {
    shared.document.end_step();
}

/// Puts the text back as it was before the live edit. After a merge, that takes back the live edit alone,
/// unless both changed the same places.
pub(crate) fn end_live_edit(shared: &mut Shared, mut live_edit: LiveEdit) {
    if !is_overtaken(shared, &live_edit) {
        let _ = try_instead(shared, &mut live_edit, |_| Ok(Vec::new()));
    } else if live_edit.is_applied {
        let revision = shared.document.revision();
        let back = live_edit.back.filter(|back| back.revision == revision);
        if let Some(Ok(())) = back.map(|back| try_edits(shared, &back.edits)) {
            shared.say("cancelled; changes merged from the file are kept");
        } else {
            let undo = shared.key_for("undo");
            shared.warn(format!(
                "the scene has changed on disk; the change so far is kept: {undo} undoes the merge, then the change"
            ));
        }
    }
    shared.document.end_step();
}

fn is_overtaken(shared: &Shared, live_edit: &LiveEdit) -> bool {
    live_edit.revision != shared.document.revision()
}

/// Takes a merge with the text from outside, after which live edits can still be taken back; returns the old
/// document.
#[must_use = "freeing it may take long"]
pub(crate) fn take_merged(shared: &mut Shared, merged: Merged, past: Past) -> Document {
    let before = shared.document.revision();
    let (menu, picker) = (&mut shared.overlays.menu, &mut shared.overlays.picker);
    let live_edits = [
        shared.motion.as_mut(),
        picker.as_mut().map(|picker| &mut picker.live_edit),
        menu.as_mut().and_then(|menu| menu.live_edit.as_mut()),
    ];
    let applied = live_edits.into_iter().flatten();
    let applied = applied.filter(|live_edit| live_edit.is_applied && live_edit.revision == before);
    for live_edit in applied {
        let edits = shared.document.taken_back(&merged);
        live_edit.back = edits.map(|edits| TakenBack {
            // Taking the merge is one change.
            revision: before + 1,
            edits,
        });
    }
    match past {
        Past::Cleared => shared.document.take(merged),
        Past::Rebased => shared.document.follow(merged),
    }
}
