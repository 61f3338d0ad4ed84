//! Reading the scene's file, in the order in which it happens: the file is watched; when it changes, it is
//! read and compared with the text in the background; the result is taken, merged or kept apart; then the
//! change is shown and reported.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use ::text::{Findings, Position, Severity, counted};
use document::{Difference, Numbers, Past, StepName};
use file::ReadError;
use language::Lowered;

use super::outside;
use crate::app::shared::cursor::SavedCursor;
use crate::app::shared::disk::{Faulty, Requester, Settle};
use crate::app::shared::messages::About;

use crate::app::{MergeSource, OnDisk, Shared, text};
use crate::msg::Effect;
use crate::scene_reading::{Baseline, News, ReadBuffer, Reading};
use crate::text_width::file_name;

/// Many programs empty a file before writing it: errors must persist for this long.
const QUIET: Duration = Duration::from_millis(100);
/// A text in an editor's buffer must rest for this long before new errors are shown: most are unfinished
/// words.
const RESTING: Duration = Duration::from_millis(200);
/// Others move the old file away before the new one exists.
const GONE: Duration = Duration::from_millis(500);

/// The parts of a message about a text read from the file.
pub(crate) struct Wording {
    came: &'static str,
    /// Used instead of the changed place if only comments and spacing have changed.
    same: &'static str,
    /// Whether it ends with how to undo the merge.
    is_merge: bool,
}

const RELOADED: Wording = Wording {
    came: "reloaded",
    same: "the scene is unchanged",
    is_merge: false,
};
const MERGED: Wording = Wording {
    came: "merged the file's changes with your edits",
    same: "the picture is unchanged",
    is_merge: true,
};
pub(super) const ADOPTED: Wording = Wording {
    came: "merged",
    ..MERGED
};
const SAME_NOW: Wording = Wording {
    came: "the file now has the same changes",
    same: "nothing is unsaved",
    is_merge: false,
};

/// Watches the scene's file, and reads it once more in case it changed before the watch began.
pub(super) fn watch(shared: &Shared) -> Vec<Effect> {
    let own = || shared.disk.path.iter().cloned();
    let read = if is_being_saved(shared) {
        Vec::new()
    } else {
        shared.disk.read(baseline(shared))
    };
    let watch = own().map(Effect::Watch);
    let backups = own().map(Effect::FindBackups);
    watch.chain(read).chain(backups).collect()
}

/// Reads the file, which may have to settle; not while it is being saved.
pub(crate) fn read_again(shared: &mut Shared) -> Vec<Effect> {
    read_with(shared, Settle::Idle)
}

/// Reads a file that changed while there were unsaved edits, once there are none: nothing is left to
/// be decided.
pub(crate) fn catch_up(shared: &mut Shared) -> Vec<Effect> {
    if shared.disk.state == OnDisk::Changed && !shared.document.is_dirty() {
        read_again(shared)
    } else {
        Vec::new()
    }
}

/// Rereads the scene's file and the files that it names, for `:e`.
pub(super) fn reread(shared: &mut Shared) -> Vec<Effect> {
    let mut effects = if shared.disk.path.is_some() {
        shared.disk.requester = Requester::User;
        read_again(shared)
    } else {
        shared.fail("this scene has no file yet: use :w FILE to create one");
        Vec::new()
    };
    effects.extend(shared.assets.read());
    effects
}

/// Reads the file and accepts what it holds; not while it is being saved.
pub(crate) fn read_finally(shared: &mut Shared) -> Vec<Effect> {
    read_with(shared, Settle::Final)
}

/// Reads the file, which has settled so far, to be compared with the text without a transient edit.
fn read_with(shared: &mut Shared, settle: Settle) -> Vec<Effect> {
    if is_being_saved(shared) {
        return Vec::new();
    }
    text::revert_transient(shared);
    shared.disk.settle = settle;
    let effects = shared.disk.read(baseline(shared));
    shared.awaits_reading = !effects.is_empty();
    effects
}

/// Reads the file once it has had time to settle, and accepts what it holds.
pub(crate) fn settled(shared: &mut Shared) -> Vec<Effect> {
    if shared.disk.settle == Settle::Waiting {
        read_finally(shared)
    } else {
        Vec::new()
    }
}

/// Reads the file once more, as far as it is known to have settled.
pub(super) fn read_once_more(shared: &mut Shared) -> Vec<Effect> {
    read_with(shared, shared.disk.settle)
}

/// The state that a reading of the file is compared with.
pub(crate) fn baseline(shared: &Shared) -> Baseline {
    Baseline {
        scene: shared.document.snapshot(),
        saves: shared.jobs.count_saves(),
        meshes: shared.assets.loaded.meshes.clone(),
        is_sound: shared.sound_scene().is_some(),
        sent: outside::sent(shared),
    }
}

/// Whether the scene's file may be being written: any save may do so, since a file has many names.
/// What is read of it meanwhile may be half of that, and is not taken: the end of the last save
/// requests another reading.
pub(super) fn is_being_saved(shared: &Shared) -> bool {
    shared.jobs.file_being_saved().is_some()
}

/// Takes a reading; one that was compared with another state is repeated.
pub(crate) fn was_read(shared: &mut Shared, read: Result<Reading, ReadError>) -> Vec<Effect> {
    if is_being_saved(shared) {
        return vec![Effect::Free(Arc::new(read))];
    }
    if let Ok(reading) = &read
        && outside::awaits_answer(shared, reading)
    {
        // The answer is followed by another reading.
        shared.awaits_reading = false;
        return vec![Effect::Free(Arc::new(read))];
    }
    if let Ok(reading) = &read
        && !is_known(shared, reading)
    {
        let mut effects = read_once_more(shared);
        effects.push(Effect::Free(Arc::new(read)));
        return effects;
    }
    let effects = take_read(shared, read);
    let reads = |effect: &Effect| matches!(effect, Effect::Read(..));
    shared.awaits_reading = effects.iter().any(reads);
    effects
}

/// Whether a reading was compared with the current state: no save since then and, if it brings
/// changes, neither an edit nor a mesh. With a million objects, changes arrive about a second
/// after the last edit.
fn is_known(shared: &Shared, reading: &Reading) -> bool {
    let baseline = &reading.baseline;
    if baseline.saves != shared.jobs.count_saves() || baseline.sent != outside::sent(shared) {
        return false;
    }
    if reading.news.is_none() {
        return Arc::ptr_eq(&baseline.scene.saved, shared.document.saved());
    }
    baseline.scene.is_of(&shared.document) && baseline.meshes == shared.assets.loaded.meshes
}

/// Takes the outcome of reading the file, which was compared with the present state.
fn take_read(shared: &mut Shared, read: Result<Reading, ReadError>) -> Vec<Effect> {
    let settle = std::mem::take(&mut shared.disk.settle);
    let is_missing = matches!(
        read,
        Err(ReadError::NotFound { .. } | ReadError::NoFolder { .. })
    );
    if shared.disk.state == OnDisk::New && is_missing {
        if std::mem::take(&mut shared.disk.requester) == Requester::User {
            announce_new(shared);
        }
        return Vec::new();
    }
    match read {
        Ok(reading) => {
            shared.overlays.end_complaint(About::Scene);
            take_reading(shared, reading, settle)
        }
        Err(_) if settle != Settle::Final => {
            shared.disk.wait(if is_missing { GONE } else { QUIET })
        }
        Err(error) => {
            let (state, hint) = match error {
                ReadError::NotFound { .. } => {
                    let save = shared.key_for("save");
                    (OnDisk::Missing, format!("; press {save} to write it again"))
                }
                ReadError::NoFolder { .. } => {
                    let elsewhere = "; save the scene elsewhere with :w FILE";
                    (OnDisk::Missing, elsewhere.to_owned())
                }
                _ => (OnDisk::Unreadable, String::new()),
            };
            shared.disk.state = state;
            shared.overlays.errors = None;
            shared.jobs.next = None;
            shared
                .overlays
                .complain(About::Scene, Severity::Error, &format!("{error}{hint}"));
            Vec::new()
        }
    }
}

/// Takes a reading; reports if the scene's folder was moved or replaced by another one.
fn take_reading(shared: &mut Shared, mut reading: Reading, settle: Settle) -> Vec<Effect> {
    let Some(place) = reading.place.take() else {
        return take_text(shared, reading, settle);
    };
    let before = shared.disk.place.replace(place.clone());
    let before = before.unwrap_or_else(|| place.clone());
    let is_moved = before.id != place.id || before.folder != place.folder;
    let earlier = shared.overlays.message.take_if(|_| is_moved);
    let effects = take_text(shared, reading, settle);
    let folder = place.folder.display();
    let news = if before.id != place.id {
        format!("{folder} is now a different folder")
    } else if before.folder != place.folder {
        format!("the scene's folder was moved to {folder}")
    } else {
        return effects;
    };
    let message = std::mem::replace(&mut shared.overlays.message, earlier);
    let message = message.map_or_else(String::new, |message| format!("; {}", message.text));
    shared.warn(format!("{news}{message}"));
    effects
}

fn take_text(shared: &mut Shared, reading: Reading, settle: Settle) -> Vec<Effect> {
    let requester = std::mem::take(&mut shared.disk.requester);
    if reading.has_sent {
        outside::take_sent(shared);
    }
    let Reading { news, buffer, .. } = reading;
    let is_buffer = buffer.is_some();
    // An undecided merge is obsolete, regardless of what the file holds now.
    if let Some((_, _, MergeSource::File)) = shared.overlays.conflict() {
        shared.overlays.dialog = None;
    }
    let Some(news) = news else {
        let effects = outside::took(shared, buffer);
        if shared.disk.state != OnDisk::Known {
            shared.disk.state = OnDisk::Known;
            if !is_buffer {
                shared.say("the file matches the saved text again");
            }
        } else if requester == Requester::User {
            shared.say(format!("{} has not changed", shared.disk.name()));
        }
        return effects;
    };
    let has_new_errors = |news: &News| {
        let shown = || shared.diagnostics.iter().map(|found| &found.message);
        !is_buffer
            || news
                .errors()
                .any(|error| shown().all(|known| *known != error.message))
    };
    if news.is_broken() && settle != Settle::Final && has_new_errors(&news) {
        let mut effects = shared.disk.wait(if is_buffer { RESTING } else { QUIET });
        effects.push(Effect::Free(Arc::new(news)));
        return effects;
    }
    let held = shared.cursor.hold(shared.document.shared_text());
    let saved = Arc::clone(shared.document.saved());
    let state = std::mem::replace(&mut shared.disk.state, OnDisk::Known);
    let past = past(is_buffer);
    let (document, meaning, words) = match *news {
        News::Numbers(numbers) => {
            let Some(mut effects) = take_numbers(shared, numbers, &held, is_buffer) else {
                shared.disk.state = state;
                return shared.disk.read(Baseline {
                    is_sound: false,
                    ..baseline(shared)
                });
            };
            text::note_before_input(shared, saved);
            effects.extend(outside::took(shared, buffer));
            return effects;
        }
        News::Text(document, meaning) => {
            let words = (!is_buffer).then_some(RELOADED);
            (shared.document.load(document, past), meaning, words)
        }
        News::Merged(merged, meaning) => {
            let is_dirty = merged.document.is_dirty();
            let words = (!is_buffer).then_some(if is_dirty { MERGED } else { SAME_NOW });
            (text::take_merged(shared, merged, past), meaning, words)
        }
        News::Conflict(merge) => {
            offer(shared, buffer.as_ref());
            shared.disk.state = OnDisk::Changed;
            text::ask_conflict(shared, merge, MergeSource::File);
            return Vec::new();
        }
        News::Broken(text, diagnostics) => {
            keep_apart(shared, text, diagnostics);
            return Vec::new();
        }
    };
    text::note_before_input(shared, saved);
    let former = (document, shared.scene.clone());
    let difference = meaning.difference.as_ref();
    show_reload(shared, &held, difference, meaning.lowered, words.as_ref());
    let mut effects = outside::took(shared, buffer);
    effects.push(Effect::Free(Arc::new(former)));
    effects
}

/// Records the version of the buffer that waits for a decision.
fn offer(shared: &mut Shared, read: Option<&ReadBuffer>) {
    if let (Some(buffer), Some(read)) = (&mut shared.buffer, read) {
        buffer.offered = Some(read.version);
    }
}

/// Takes a text in which numbers differ; `None` if it has to be read as a whole.
fn take_numbers(
    shared: &mut Shared,
    numbers: Numbers,
    held: &SavedCursor,
    is_buffer: bool,
) -> Option<Vec<Effect>> {
    let difference = numbers.difference();
    let before = shared.meaning()?;
    let past = past(is_buffer);
    let taken = shared.document.take_numbers(numbers, before.before(), past);
    let (texts, lowered) = taken?;
    let words = (!is_buffer).then_some(RELOADED);
    show_reload(shared, held, Some(&difference), lowered, words.as_ref());
    Some(vec![Effect::Free(Arc::new((texts, before.scene)))])
}

/// What becomes of the undo history: in a buffer that follows the text here, others' changes are undone
/// there.
fn past(is_buffer: bool) -> Past {
    if is_buffer {
        Past::Rebased
    } else {
        Past::Cleared
    }
}

/// Keeps a text with errors apart from unsaved edits.
fn keep_apart(shared: &mut Shared, text: Arc<String>, diagnostics: Findings) {
    let first = diagnostics.first_error();
    let line = first.map_or(1, |d| Position::of(&text, d.span.start()).line);
    shared.jobs.next = None;
    shared.disk.state = OnDisk::Faulty(Faulty { text, diagnostics });
    let editor = shared.key_for("editor");
    let words = format!(
        "line {line} of the file on disk has an error: press {editor} to edit it, or use :w! to overwrite it"
    );
    shared
        .overlays
        .complain(About::Scene, Severity::Error, &words);
}

/// Installs the new meaning of the text, keeps the cursor in place and reports the change;
/// `difference` is from the previous text to this one. Without words, nothing is reported.
pub(super) fn show_reload(
    shared: &mut Shared,
    held: &SavedCursor,
    difference: Option<&Difference>,
    lowered: Lowered,
    words: Option<&Wording>,
) {
    if words.is_some_and(|words| words.is_merge) {
        shared.document.name_step(StepName::done("merged the file"));
    }
    let (scene, sound) = (shared.scene.clone(), shared.error_count() == 0);
    text::install(shared, lowered);
    let edit = difference.map(|difference| &difference.edit);
    let lost = shared.cursor.follow(held, edit, shared.document.source());
    shared.keep_mode();
    if 0 < shared.error_count() {
        if sound {
            shared.disk.sound = Some(Arc::clone(&held.text));
        }
        let errors = counted(shared.error_count(), "error");
        if words.is_some() {
            shared.fail(format!("the scene has {errors}"));
        }
    } else if let Some(words) = words {
        let sound = shared.disk.sound.take();
        let from_sound = sound.map(|sound| Difference::of(&sound, shared.document.text()));
        let place = from_sound
            .as_ref()
            .map_or(difference, Option::as_ref)
            .and_then(|difference| text::name_of_places(shared.source(), &difference.places));
        let is_same = match (&scene, &shared.scene) {
            (Some(before), Some(after)) => Arc::ptr_eq(before, after),
            _ => false,
        };
        let (came, same, mut end) = (words.came, words.same, String::new());
        if words.is_merge {
            let undo = shared.key_for("undo");
            end = format!("; press {undo} to undo the merge");
            if let Some(place) = &place {
                let step = StepName::done(format!("merged the file: {place}"));
                shared.document.name_step(step);
            }
        }
        shared.say(match place {
            _ if is_same && !shared.assets.lack_meshes() => format!("{came}: {same}{end}"),
            Some(place) => format!("{came}: {place}{end}"),
            None => format!("{came}{end}"),
        });
    }
    if lost {
        shared.warn("typed value discarded: its field no longer exists");
    }
}

/// Says that the scene is new and how to write it.
pub(super) fn announce_new(shared: &mut Shared) {
    let save = shared.key_for("save");
    shared.say(match shared.disk.path.as_deref() {
        Some(path) => format!("{} is new: {save} writes it", file_name(path)),
        None => "a new scene: :w FILE writes it".to_owned(),
    });
}

/// Remembers the scene as the one used last, if its file exists.
pub(super) fn note_recent(shared: &Shared) -> Option<Effect> {
    let path = shared.disk.path.clone();
    let path = path.filter(|_| shared.disk.state == OnDisk::Known);
    path.map(Effect::NoteRecent)
}

/// Reports where an interrupted save left the scene's previous content.
pub(crate) fn backups_found(shared: &mut Shared, copies: &[PathBuf]) {
    if let Some(copy) = copies.last() {
        shared.warn(file::interruption(shared.disk.name(), copy));
    }
}
