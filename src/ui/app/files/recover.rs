//! Unsaved edits: keeping them for the next run, and offering, restoring and merging those of
//! earlier runs.

use std::sync::Arc;

use crate::app::shared::journal::Outcome;
use crate::app::{Dialog, MergeSource, OnDisk, Question, Shared, text};
use crate::msg::Effect;
use crate::recovery::{Claim, Found, Offer, Since, Way};
use ::text::counted;
use document::{Adopted, Merge, StepName};

/// Looks for undecided edits that earlier runs kept.
pub(super) fn look_for_kept(shared: &Shared) -> Effect {
    let scene = shared.disk.path.clone();
    shared.disk.journal.look(&shared.document, scene)
}

/// Offers edits that an earlier run kept.
pub(crate) fn found_kept(shared: &mut Shared, found: Found) {
    if let Some(complaint) = shared.disk.journal.found(found) {
        shared.warn(complaint);
    }
}

/// Whether the journal holds the unsaved edits as they are.
pub(crate) fn has_kept_edits(shared: &Shared) -> bool {
    shared.disk.journal.holds(&shared.document)
}

/// Whether unsaved edits that should be kept by now would be lost with the program.
pub(crate) fn fails_to_keep(shared: &Shared) -> bool {
    shared.disk.journal.fails(&shared.document)
}

/// Keeps unsaved edits for the next run, unless they are kept already.
pub(crate) fn keep_edits(shared: &mut Shared) -> Option<Effect> {
    let scene = shared.disk.path.clone();
    shared.disk.journal.keep(&shared.document, scene)
}

/// Writes unsaved edits for the next run; if there are none, forgets those that were kept.
pub(super) fn keep_the_rest(shared: &mut Shared) -> Option<Effect> {
    let scene = shared.disk.path.clone();
    shared.disk.journal.keep_the_rest(&shared.document, scene)
}

/// Takes the outcome of an attempt to keep edits.
pub(crate) fn kept(
    shared: &mut Shared,
    revision: u64,
    outcome: Result<(), String>,
) -> Option<Effect> {
    match shared.disk.journal.kept(revision, outcome) {
        Outcome::OutOfDate | Outcome::Kept(None) => None,
        Outcome::Kept(Some(trouble)) => {
            shared.overlays.withdraw(&trouble);
            None
        }
        Outcome::Failed(trouble, again) => {
            if let Some(trouble) = trouble {
                shared.fail(trouble);
            }
            Some(*again)
        }
    }
}

/// Schedules keeping unsaved edits, and offers those of an earlier run.
pub(crate) fn follow_edits(shared: &mut Shared) -> Vec<Effect> {
    let journal = &mut shared.disk.journal;
    // The edit that will be reverted would be kept as well.
    let due = match shared.transient {
        None => journal.follow(&shared.document),
        Some(_) => None,
    };
    due.into_iter().chain(follow_kept(shared)).collect()
}

/// Offers kept edits once no other question is open; examines them again if the text that they
/// would be restored into has changed.
fn follow_kept(shared: &mut Shared) -> Option<Effect> {
    let text = shared.document.shared_text();
    let is_other = match &shared.overlays.dialog {
        Some(Dialog::Recover(offer)) => !Arc::ptr_eq(&offer.text, &text),
        Some(Dialog::Conflict { merge, from, .. }) => {
            matches!(from, MergeSource::Kept(..)) && !merge.is_of(&shared.document)
        }
        Some(Dialog::Leave(_) | Dialog::Delete(_) | Dialog::Overwrite(_)) => false,
        None => {
            let offer = shared.disk.journal.offer.take()?;
            shared.overlays.dialog = Some(Dialog::Recover(offer));
            return follow_kept(shared);
        }
    };
    is_other.then(|| {
        shared.overlays.dialog = None;
        look_for_kept(shared)
    })
}

/// The question about unsaved edits of an earlier run.
pub(crate) fn question_about_kept(shared: &Shared, offer: &Offer) -> Question {
    let places = counted(offer.places, "place");
    let differ = if offer.places == 1 {
        "differs"
    } else {
        "differ"
    };
    let text = text_name(shared);
    let since = match (offer.since, offer.conflicts()) {
        (Since::Same, _) => String::new(),
        (Since::Changed, 0) => format!(" The {text} has changed since; both will be merged."),
        (Since::Changed, count) => {
            let both = counted(count, "place");
            format!(
                " The {text} has changed since, {both} in both: you will be asked which to keep."
            )
        }
    };
    let damage = if offer.is_damaged() {
        " Part of their journal is damaged: these are the last intact edits. It is set aside, not \
         deleted."
    } else {
        ""
    };
    let name = shared.disk.name();
    let text = format!(
        "{name} has unsaved edits from an earlier run: {places} {differ} from the {text}.{since}{damage} \
         Restore them?"
    );
    Question {
        title: " Recover ",
        text,
    }
}

/// The name of the text that recovered edits are merged with.
pub(crate) fn text_name(shared: &Shared) -> &'static str {
    let is_own = matches!(shared.disk.state, OnDisk::Missing | OnDisk::New);
    if is_own || shared.document.is_dirty() {
        "text"
    } else {
        "file"
    }
}

/// Restores the edits of an earlier run as an ordinary edit; asks first where the text has
/// changed in the same places since.
pub(crate) fn restore(shared: &mut Shared) -> Vec<Effect> {
    let Some(Dialog::Recover(offer)) = shared.overlays.dialog.take() else {
        return Vec::new();
    };
    let Offer {
        claim, way, since, ..
    } = *offer;
    match way {
        Way::Edit(edit) => {
            shared.document.edit(&[edit]);
            restored(shared, claim, since)
        }
        Way::Merge(merge) if merge.conflicts.is_empty() => {
            restore_merged(shared, &merge, claim, since)
        }
        Way::Merge(merge) => {
            let from = MergeSource::Kept(claim, since);
            text::ask_conflict(shared, merge, from);
            Vec::new()
        }
    }
}

/// Restores kept edits after their conflicts with the text have been decided.
pub(super) fn restore_merged(
    shared: &mut Shared,
    merge: &Merge,
    claim: Arc<Claim>,
    since: Since,
) -> Vec<Effect> {
    match shared.document.restore(merge) {
        Adopted::Taken => restored(shared, claim, since),
        // The text has changed: the edits are examined again.
        Adopted::Conflict(_) | Adopted::OutOfDate => vec![look_for_kept(shared)],
    }
}

fn restored(shared: &mut Shared, claim: Arc<Claim>, since: Since) -> Vec<Effect> {
    let name = StepName::done("restored unsaved edits");
    shared.document.name_step(name);
    text::relower(shared);
    let done = match since {
        Since::Same => "restored",
        Since::Changed => "restored and merged with what has changed since",
    };
    let undo = shared.key_for("undo");
    shared.say(format!("{done}; {undo} undoes it"));
    // The other journal is removed only once this run's journal holds the edits.
    let mut effects = vec![if shared.document.is_dirty() {
        Effect::AdoptKept(claim)
    } else {
        Effect::DropKept(claim)
    }];
    effects.extend(keep_edits(shared));
    effects.push(look_for_kept(shared));
    effects
}

/// Discards the edits of an earlier run.
pub(crate) fn decline(shared: &mut Shared) -> Vec<Effect> {
    match shared.overlays.dialog.take() {
        Some(Dialog::Recover(offer)) => {
            vec![Effect::DropKept(offer.claim), look_for_kept(shared)]
        }
        _ => Vec::new(),
    }
}

/// Closes a question that may be asked again: about kept edits, in the next run.
pub(crate) fn put_off(shared: &mut Shared) -> Vec<Effect> {
    shared.jobs.next = None;
    let claim = match shared.overlays.dialog.take() {
        Some(Dialog::Recover(offer)) => offer.claim,
        Some(Dialog::Conflict {
            from: MergeSource::Kept(claim, _),
            ..
        }) => claim,
        _ => return Vec::new(),
    };
    shared.disk.journal.put_off(&claim);
    vec![look_for_kept(shared)]
}
