//! Saving, in the order in which it happens: the request, the reasons to refuse it, the write in the
//! background, and its outcome.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::reading::{
    is_being_saved, note_recent, read_again, read_finally, read_once_more, watch,
};
use super::recover::keep_the_rest;
use crate::app::shared::after_leaving::AfterLeaving;
use crate::app::shared::messages::About;
use crate::app::{Buffer, OnDisk, PromptKind, Shared, text};
use crate::msg::{Effect, Guard, SaveId, SaveOutcome};
use language::Language;

/// Whether the file is written even if it has changed meanwhile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Force {
    No,
    Yes,
}

/// Saves the text, to its own file if none is given.
pub(crate) fn write(shared: &mut Shared, file: Option<PathBuf>, force: Force) -> Vec<Effect> {
    let own = shared.document.language();
    if let Some(path) = &file
        && Language::of_path(path) != Ok(own)
    {
        let extension = own.extension();
        let name = path.with_extension(extension);
        shared
            .overlays
            .open_prompt_over(PromptKind::Command, &format!("w {}", name.display()));
        let shown = path.display();
        shared.fail(format!("{shown}: the name must end in .{extension}"));
        // The path may not even name a file.
        return vec![Effect::CheckPlace(path.clone())];
    }
    let path = file.or_else(|| shared.disk.path.clone());
    let is_own = path.as_ref().is_some_and(|path| shared.disk.is_own(path));
    if is_own && force == Force::Yes && is_saved_elsewhere(shared) {
        return Vec::new();
    }
    match (path, force) {
        (Some(path), Force::Yes) => save_to(shared, &path, Guard::Anything),
        (Some(path), Force::No) if !shared.disk.is_own(&path) => {
            if refuses_errors(shared, &path) {
                return Vec::new();
            }
            save_to(shared, &path, Guard::Absent)
        }
        (_, Force::No | Force::Yes) => save(shared),
    }
}

/// Whether an editor saves the scene, because it owns the text; says so.
fn is_saved_elsewhere(shared: &mut Shared) -> bool {
    let owner = shared.buffer.as_ref().and_then(Buffer::owner);
    let Some(words) = owner.map(|editor| format!("save in {editor}")) else {
        return false;
    };
    shared.jobs.next = None;
    shared.say(words);
    true
}

/// Saves to the scene's file, for `w` and `:w`.
pub(super) fn save(shared: &mut Shared) -> Vec<Effect> {
    let Some(path) = shared.disk.path.clone() else {
        shared.overlays.open_prompt(PromptKind::Command, "w ");
        shared.say("this scene has no file yet: enter a name");
        return Vec::new();
    };
    if shared.disk.state != OnDisk::Changed && is_saved_elsewhere(shared) {
        return Vec::new();
    }
    if !shared.document.is_dirty() && shared.disk.state == OnDisk::Known {
        let view = unwritten_view(shared);
        shared.say(format!("nothing to save{view}"));
        // In case a notification was missed.
        return read_once_more(shared);
    }
    if let OnDisk::Changed | OnDisk::Faulty(_) | OnDisk::Unreadable = shared.disk.state {
        // The question is asked again with what the file holds now; nothing is saved.
        shared.jobs.next = None;
        return read_once_more(shared);
    }
    if refuses_errors(shared, &path) {
        return Vec::new();
    }
    let guard = match shared.disk.state {
        OnDisk::New => Guard::Absent,
        _ => Guard::Holding(Arc::clone(shared.document.saved())),
    };
    save_to(shared, &path, guard)
}

/// Saves the text. If a save of the same file is running, the new one waits for it.
fn save_to(shared: &mut Shared, path: &Path, guard: Guard) -> Vec<Effect> {
    shared.document.end_step();
    let text = shared.document.shared_text();
    let effects = shared.jobs.save(path, text, guard);
    if effects.is_empty() {
        let path = path.display();
        shared.say(format!("{path} is still being written"));
    }
    effects
}

/// Refuses to write a text with errors unless forced; returns whether it has any.
fn refuses_errors(shared: &mut Shared, path: &Path) -> bool {
    let Some(errors) = text::error_place(shared) else {
        return false;
    };
    shared.jobs.next = None;
    let force = if shared.disk.is_own(path) {
        ":w!".to_owned()
    } else {
        format!(":w! {}", path.display())
    };
    shared.fail(format!("{errors}: use {force} to save anyway"));
    true
}

/// The addition to a message about a save that the text lacks the moved view, if it does.
fn unwritten_view(shared: &Shared) -> String {
    if !shared.is_view_unwritten() {
        return String::new();
    }
    let key = shared.key_for("write-view");
    let place = if shared.mode.moves_camera() {
        ""
    } else {
        " in VIEW"
    };
    format!("; the moved view is not saved: {key}{place} writes it")
}

/// Counts another second of running saves and exports.
pub(crate) fn tick(shared: &mut Shared) -> Vec<Effect> {
    if !shared.jobs.tick() {
        return Vec::new();
    }
    if let Some(next) = &shared.jobs.next
        && shared.jobs.still_writing().is_some()
    {
        let words = next.announcement();
        shared.overlays.suggest(format!(
            "{words} once the save finishes; use Ctrl-C or :q! to quit now"
        ));
    }
    shared.jobs.count_seconds()
}

/// Takes the outcome of a save, and starts the one that waited for it. Reads the file if it is no
/// longer being written. What was to follow the save is returned if the file was written.
pub(super) fn end_save(
    shared: &mut Shared,
    id: SaveId,
    outcome: SaveOutcome,
) -> (Vec<Effect>, Option<AfterLeaving>) {
    let ended = shared.jobs.end_save(id);
    // Leaving waits for the newest save.
    let next = shared.jobs.next.take_if(|_| ended.is_newest);
    let is_own = ended.path().is_some_and(|path| shared.disk.is_own(path));
    let is_changed = matches!(outcome, SaveOutcome::ChangedOnDisk);
    // What the file holds from now on.
    let mut written = None;
    let mut effects = Vec::new();
    match outcome {
        SaveOutcome::Saved { path, text } => {
            // Leaving asks about the view itself.
            let view = if next.is_some() {
                String::new()
            } else {
                unwritten_view(shared)
            };
            shared.overlays.end_complaint(About::Scene);
            shared.say(format!("wrote {}{view}", path.display()));
            written = Some(Arc::clone(&text));
            if !ended.is_late {
                effects = take_saved(shared, path, text);
            }
        }
        SaveOutcome::ChangedOnDisk => {
            shared.warn("the file has changed: nothing was written yet");
        }
        SaveOutcome::NoFolder(reason) => {
            shared.fail(format!("{reason}; save elsewhere with :w FILE"));
        }
        SaveOutcome::Failed(reason) => shared.fail(reason),
    }
    let is_written = written.is_some();
    effects.extend(shared.jobs.go_on(ended, written));
    if shared.disk.path.is_some() && !is_being_saved(shared) {
        effects.extend(if is_own && is_changed {
            read_finally(shared)
        } else {
            read_again(shared)
        });
    }
    (effects, next.filter(|_| is_written))
}

/// Makes a file that now holds `text` the scene's file.
fn take_saved(shared: &mut Shared, path: PathBuf, text: Arc<String>) -> Vec<Effect> {
    shared.document.mark_saved(text);
    let is_new = shared.disk.state == OnDisk::New || !shared.disk.is_own(&path);
    shared.disk.state = OnDisk::Known;
    let mut effects = Vec::new();
    if !shared.disk.is_own(&path) {
        shared.disk.path = Some(path);
        shared.disk.place = None;
        // It is that of the other file.
        shared.buffer = None;
        effects.extend(watch(shared));
        // The scene's files are now looked for in another folder.
        text::relower(shared);
    }
    effects.extend(note_recent(shared).filter(|_| is_new));
    effects.extend(keep_the_rest(shared));
    effects
}
