//! Leaving the scene, to quit or for another one: asks first if something would be lost, and waits
//! for work under way.

use std::time::Duration;

use super::editor::open_editor;
use super::recover::keep_the_rest;
use super::replacing::{request_scene, start_carried, start_scene};
use super::saving::{end_save, save};
use crate::app::{AfterLeaving, Buffer, Dialog, OnDisk, Question, Shared, camera, text};
use crate::keymap::Mode;
use crate::msg::{Effect, SaveId, SaveOutcome, Timer};

/// The loss of the working view.
const LOST_VIEW: &str = "the moved view is not saved";

/// A second Ctrl-C within this time ends the program.
const INTERRUPT_AGAIN: Duration = Duration::from_secs(2);

/// `w`, which in the question whether to leave saves and then leaves.
pub(crate) fn save_key(shared: &mut Shared) -> Vec<Effect> {
    match take_question(shared) {
        Some(next) => save_and(shared, next),
        None => save(shared),
    }
}

/// `S`, which writes the moved view into the text, and in the question whether to leave then saves
/// and leaves.
pub(crate) fn save_view_key(shared: &mut Shared) -> Vec<Effect> {
    let is_moved = shared.is_view_unwritten();
    camera::save_view(shared);
    if !is_moved || shared.is_view_unwritten() {
        return Vec::new();
    }
    let next = take_question(shared);
    next.map_or_else(Vec::new, |next| save_and(shared, next))
}

/// Saves if necessary, then quits, for `:wq`.
pub(crate) fn save_and_quit(shared: &mut Shared) -> Vec<Effect> {
    save_and(shared, AfterLeaving::Quit)
}

/// Saves if necessary, then leaves. A scene without a file first gets a name.
fn save_and(shared: &mut Shared, next: AfterLeaving) -> Vec<Effect> {
    shared.jobs.next = Some(next);
    if shared.is_saved() {
        return leave_when_done(shared);
    }
    save(shared)
}

/// Quits; asks first if something would be lost.
pub(crate) fn quit(shared: &mut Shared) -> Vec<Effect> {
    leave_for(shared, AfterLeaving::Quit)
}

/// Leaves the scene; asks first if something would be lost.
pub(super) fn leave_for(shared: &mut Shared, next: AfterLeaving) -> Vec<Effect> {
    text::leave_sequence(shared);
    if is_being_pushed(shared) && shared.jobs.next.is_none() {
        let buffer = shared.buffer.as_ref();
        let editor = buffer.map_or("", |buffer| &*buffer.editor);
        let words = format!("will leave once {editor} has the last change; use :q! to quit now");
        shared.jobs.next = Some(next);
        shared.say(words);
        return Vec::new();
    }
    if losses_before(shared, &next).is_some() {
        shared.overlays.dialog = Some(Dialog::Leave(next));
        return Vec::new();
    }
    leave(shared, next)
}

/// Whether the unsaved edits are on their way to an editor's buffer.
fn is_being_pushed(shared: &Shared) -> bool {
    let is_on_the_way = |buffer: &Buffer| buffer.sent.is_some() || buffer.due.is_some();
    shared.document.is_dirty() && shared.buffer.as_ref().is_some_and(is_on_the_way)
}

/// Leaves as planned once an editor has the last change.
pub(crate) fn leave_once_pushed(shared: &mut Shared) -> Vec<Effect> {
    let owns = shared.buffer.as_ref().is_some_and(Buffer::takes_edits);
    let is_planned = owns && shared.jobs.next.is_some() && shared.jobs.export().is_none();
    if is_planned && !shared.document.is_dirty() && shared.jobs.file_being_saved().is_none() {
        leave_when_done(shared)
    } else {
        Vec::new()
    }
}

/// Leaves the scene as asked, regardless of losses.
pub(crate) fn leave_anyway(shared: &mut Shared) -> Vec<Effect> {
    match take_question(shared) {
        Some(AfterLeaving::Quit) => quit_anyway(shared),
        Some(next) => leave(shared, next),
        None => Vec::new(),
    }
}

/// Quits regardless of losses. Edits that are being saved are kept in the journal, because the
/// save may never end.
pub(crate) fn quit_anyway(shared: &mut Shared) -> Vec<Effect> {
    if shared.jobs.file_being_saved().is_some() {
        quit_keeping_edits(shared)
    } else {
        leave(shared, AfterLeaving::Quit)
    }
}

/// Leaves as planned once saves and, before quitting, the export are done and nothing would be
/// lost.
pub(crate) fn leave_when_done(shared: &mut Shared) -> Vec<Effect> {
    if shared.jobs.next == Some(AfterLeaving::Quit) && shared.jobs.export().is_some() {
        let words = match shared.jobs.queued() {
            0 => {
                let stop = shared.key_for("stop");
                format!("will quit once the export finishes; press {stop} to cancel it")
            }
            queued => format!("will quit once {} exports finish", queued + 1),
        };
        shared.say(words);
        return Vec::new();
    }
    if let Some(Dialog::Overwrite(_)) = shared.overlays.dialog {
        return Vec::new();
    }
    match shared.jobs.next.take() {
        // A save does not keep the view.
        Some(next) if next != AfterLeaving::Editor && shared.is_view_unwritten() => {
            leave_for(shared, next)
        }
        Some(next) if !shared.document.is_dirty() => leave(shared, next),
        _ => Vec::new(),
    }
}

/// Takes the outcome of a save, and leaves if that waited for it.
pub(crate) fn was_saved(shared: &mut Shared, id: SaveId, outcome: SaveOutcome) -> Vec<Effect> {
    let (mut effects, next) = end_save(shared, id, outcome);
    if next.is_some() {
        shared.jobs.next = next;
        effects.extend(leave_when_done(shared));
    }
    effects
}

/// Answers Ctrl-C: asks if something would be lost, and the second time quits with edits kept.
pub(crate) fn interrupt(shared: &mut Shared) -> Vec<Effect> {
    text::leave_sequence(shared);
    if shared.jobs.interrupt || losses(shared).is_none() {
        return quit_keeping_edits(shared);
    }
    shared.jobs.interrupt = true;
    shared.overlays.dialog = Some(Dialog::Leave(AfterLeaving::Quit));
    vec![Effect::Later(INTERRUPT_AGAIN, Timer::Interrupt)]
}

/// Quits with unsaved edits kept, written once more in case the journal was removed.
pub(crate) fn quit_keeping_edits(shared: &mut Shared) -> Vec<Effect> {
    text::leave_sequence(shared);
    let kept = keep_the_rest(shared);
    kept.into_iter().chain([Effect::Quit]).collect()
}

fn leave(shared: &mut Shared, next: AfterLeaving) -> Vec<Effect> {
    match next {
        AfterLeaving::Quit => {
            let forgotten = shared.disk.journal.forget();
            forgotten.into_iter().chain([Effect::Quit]).collect()
        }
        AfterLeaving::Open(path) => request_scene(shared, path),
        AfterLeaving::New(language) => start_scene(shared, language),
        AfterLeaving::Carried(carried) => start_carried(shared, carried),
        AfterLeaving::Editor => open_editor(shared),
    }
}

/// Closes the question whether to leave; returns what was to follow.
fn take_question(shared: &mut Shared) -> Option<AfterLeaving> {
    match shared.overlays.dialog.take() {
        Some(Dialog::Leave(next)) => Some(next),
        other => {
            shared.overlays.dialog = other;
            None
        }
    }
}

/// Describes what would be lost by quitting now; `None` if nothing.
pub(crate) fn losses(shared: &Shared) -> Option<String> {
    losses_before(shared, &AfterLeaving::Quit)
}

/// The question whether to leave the scene although something would be lost.
pub(crate) fn question_before(shared: &Shared, next: &AfterLeaving) -> Question {
    let losses = losses_before(shared, next).unwrap_or_default();
    let (title, question) = match next {
        AfterLeaving::Quit => (" Quit ", "Quit?".to_owned()),
        AfterLeaving::Open(path) => (" Open ", format!("Open {}?", path.display())),
        AfterLeaving::New(_) => (" New ", "Start a new scene?".to_owned()),
        AfterLeaving::Carried(carried) => (" Open ", format!("Open {}?", carried.name)),
        AfterLeaving::Editor => {
            let new = || format!("{} is not written yet", shared.disk.name());
            let text = lost_text(shared).unwrap_or_else(new);
            let text = format!("{text}. Save and open the editor?");
            return Question {
                title: " Editor ",
                text,
            };
        }
    };
    Question {
        title,
        text: format!("{losses}. {question}"),
    }
}

/// Describes what would be lost by leaving the scene now; `None` if nothing. Work under way ends
/// only with the program.
fn losses_before(shared: &Shared, next: &AfterLeaving) -> Option<String> {
    let view = shared.is_view_unwritten().then(|| LOST_VIEW.to_owned());
    let mut lost: Vec<_> = lost_text(shared).into_iter().chain(view).collect();
    if *next == AfterLeaving::Quit {
        lost.extend(lost_export(shared));
        if lost.is_empty() {
            lost.extend(lost_save(shared));
        }
    }
    let last = lost.pop()?;
    Some(match lost.len() {
        0 => last,
        1 => format!("{}, and {last}", lost[0]),
        _ => format!("{}, and {last}", lost.join(", ")),
    })
}

/// Why the text would be lost, if it would.
fn lost_text(shared: &Shared) -> Option<String> {
    let name = shared.disk.name();
    match &shared.disk.state {
        // An untouched template can be started again.
        OnDisk::New if !shared.document.is_dirty() => None,
        OnDisk::New if shared.disk.path.is_none() => Some("the new scene is not saved".to_owned()),
        OnDisk::New => Some(format!("{name} is new and not saved")),
        _ if shared.document.is_dirty() => Some(format!("{name} has unsaved edits")),
        OnDisk::Missing => Some(format!("{name} no longer exists")),
        _ => None,
    }
}

/// The export that would end too early.
fn lost_export(shared: &Shared) -> Option<String> {
    let export = shared.jobs.export()?;
    let name = export.destination.path.display();
    Some(match shared.jobs.queued() {
        0 => format!("{name} is still being exported"),
        queued => format!("{name} is still being exported, and {queued} more queued"),
    })
}

/// The save that would not be waited for.
fn lost_save(shared: &Shared) -> Option<String> {
    let path = shared.jobs.file_being_saved()?;
    Some(format!("{} is still being written", path.display()))
}

/// Quits, but not while something is moved.
pub(crate) fn quit_key(shared: &mut Shared) -> Vec<Effect> {
    if shared.mode == Mode::Move {
        shared.warn_of_transform();
        return Vec::new();
    }
    quit(shared)
}
