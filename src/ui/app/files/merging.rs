//! Resolving what the file and the text changed in the same places.

use super::reading::{self, show_reload};
use super::recover::restore_merged;
use crate::app::{Dialog, MergeSource, OnDisk, Shared, Whose, text};
use crate::msg::Effect;
use ::text::counted;
use document::{Adopted, Difference};

/// Resolves the conflict under the cursor and goes on to the next one that is not.
pub(crate) fn decide(shared: &mut Shared, whose: Whose) {
    if let Some((merge, at, from)) = shared.overlays.conflict()
        && let Some(conflict) = merge.conflicts.get_mut(*at)
    {
        conflict.decision = Some(from.side(whose));
        let is_open = |at: &usize| merge.conflicts[*at].decision.is_none();
        let count = merge.conflicts.len();
        let next = (*at + 1..count).chain(0..*at).find(is_open);
        *at = next.unwrap_or_else(|| (*at + 1).min(count - 1));
    }
}

/// Resolves all conflicts.
pub(crate) fn decide_all(shared: &mut Shared, whose: Whose) {
    if let Some((merge, _, from)) = shared.overlays.conflict() {
        for conflict in &mut merge.conflicts {
            conflict.decision = Some(from.side(whose));
        }
    }
}

/// Applies a merge once every conflict is decided.
pub(crate) fn adopt(shared: &mut Shared) -> Vec<Effect> {
    let Some((merge, at, _)) = shared.overlays.conflict() else {
        return Vec::new();
    };
    if let Some(open) = merge.conflicts.iter().position(|c| c.decision.is_none()) {
        *at = open;
        let left = merge
            .conflicts
            .iter()
            .filter(|c| c.decision.is_none())
            .count();
        let [mine, theirs] = ["mine", "theirs"].map(|name| shared.key_for(name));
        let [all_mine, all_theirs] = ["all-mine", "all-theirs"].map(|name| shared.key_for(name));
        shared.warn(format!(
            "{} left: {mine} mine, {theirs} theirs, {all_mine} and {all_theirs} for all",
            counted(left, "conflict")
        ));
        return Vec::new();
    }
    let Some(Dialog::Conflict { merge, from, .. }) = shared.overlays.dialog.take() else {
        return Vec::new();
    };
    if let MergeSource::Kept(claim, since) = from {
        return restore_merged(shared, &merge, claim, since);
    }
    let held = shared.cursor.hold(shared.document.shared_text());
    match shared.document.adopt(merge) {
        Adopted::Conflict(merge) => {
            text::ask_conflict(shared, merge, from);
        }
        Adopted::Taken => {
            shared.disk.state = OnDisk::Known;
            if let Some(buffer) = &mut shared.buffer {
                buffer.version = buffer.offered.take();
            }
            let difference = Difference::of(&held.text, shared.document.text());
            let lowered = text::lowered(shared);
            show_reload(
                shared,
                &held,
                difference.as_ref(),
                lowered,
                Some(&reading::ADOPTED),
            );
            if shared.buffer.is_some() {
                // It may have changed since, or its editor may be gone.
                return reading::read_finally(shared);
            }
        }
        Adopted::OutOfDate => shared.warn("the file was saved meanwhile: nothing was merged"),
    }
    Vec::new()
}
