//! Playing a track: its frames are tried in the text of the scene, one after the other.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::dope_sheet::DopeSheet;
use super::state::{OpenTrack, Sequence, complaint};
use crate::app::shared::Shared;
use crate::app::shared::messages::About;
use crate::app::{files, text};
use crate::keymap::Mode;
use crate::msg::{Effect, Timer};
use crate::text_width::file_name;
use ::text::Severity;
use document::StepName;
use file::ReadError;
use track::{Bound, Track};

/// Reads a track to play: this one, the open one, or that beside the scene.
pub(crate) fn open_track(
    sequence: &mut Sequence,
    shared: &mut Shared,
    file: Option<PathBuf>,
) -> Vec<Effect> {
    let open = sequence.open.as_ref().map(|open| open.path.clone());
    let scene = shared.disk.path.as_ref();
    let beside = || scene.map(|scene| scene.with_extension("toml"));
    let Some(path) = file.or(open).or_else(beside) else {
        shared.fail("this scene has no file: name a track, as in :track FILE");
        return Vec::new();
    };
    if path.extension().is_none_or(|extension| extension != "toml") {
        let name = path.display();
        shared.fail(format!("{name}: the name of a track ends in .toml"));
        return Vec::new();
    }
    if !has_sound_scene(shared) {
        return Vec::new();
    }
    sequence.asked = Some(path.clone());
    vec![Effect::ReadTrack(path)]
}

/// Whether there is a scene without errors; says so if there is not.
pub(super) fn has_sound_scene(shared: &mut Shared) -> bool {
    let is_sound = shared.scene.is_some() && shared.error_count() == 0;
    if !is_sound {
        shared.refuse_picture(Severity::Error, &shared.no_picture());
    }
    is_sound
}

/// Takes the text of a track file, `None` if there is no such file, and plays it if asked.
pub(crate) fn track_read(
    sequence: &mut Sequence,
    shared: &mut Shared,
    path: PathBuf,
    read: Result<Option<String>, ReadError>,
) -> Vec<Effect> {
    let is_open = sequence.open_at(&path).is_some();
    if is_open && sequence.writing.is_some() {
        // It may be half of what is being written, after which the file is read again.
        return Vec::new();
    }
    let is_asked = sequence.asked.take_if(|asked| *asked == path).is_some();
    let text = match read {
        Ok(text) if is_asked || is_open => {
            forgive(sequence, shared, &path, None);
            if text.is_none() && !is_asked {
                // Many programs move the old file away before the new one exists.
                return Vec::new();
            }
            text
        }
        Ok(text) => {
            forgive(sequence, shared, &path, text.as_deref());
            return Vec::new();
        }
        Err(error) => {
            complain(shared, &error.to_string());
            return refuse(sequence, shared, &path);
        }
    };
    if let Some(open) = sequence.open_at(&path)
        && open.held.as_deref() == text.as_ref()
    {
        open.is_refused = false;
        return if is_asked {
            enter(sequence, shared)
        } else {
            Vec::new()
        };
    }
    let said = text.as_deref().unwrap_or(track::BEGUN);
    let (track, findings) = track::read(said);
    if 0 < findings.errors() {
        complain(shared, &complaint(&file_name(&path), said, &findings));
        return refuse(sequence, shared, &path);
    }
    if is_asked && !has_sound_scene(shared) {
        return follow_open(sequence, &path);
    }
    text::revert_transient(shared);
    if shared.error_count() == 0 && bind(shared, &track, &file_name(&path), said).is_none() {
        resume(sequence, shared);
        return refuse(sequence, shared, &path);
    }
    let before = sequence.open.take_if(|open| open.path == path);
    let is_known = before.is_some();
    let last = track.frames.saturating_sub(1);
    sequence.open = Some(OpenTrack {
        path,
        held: text.map(Arc::new),
        is_refused: false,
        frame: before.as_ref().map_or(0, |open| open.frame.min(last)),
        is_playing: before.is_some_and(|open| open.is_playing),
        track,
        bound: None,
        before: Vec::new(),
    });
    if is_asked {
        return enter(sequence, shared);
    }
    resume(sequence, shared);
    if is_known && shared.mode == Mode::Sequence {
        shared.say("track reloaded");
    }
    Vec::new()
}

/// Shows the present frame of the track.
fn enter(sequence: &mut Sequence, shared: &mut Shared) -> Vec<Effect> {
    if !has_sound_scene(shared) {
        return Vec::new();
    }
    // Frames are never kept for recovery; edits before them are.
    let kept = files::keep_edits(shared);
    let before = std::mem::replace(&mut shared.mode, Mode::Sequence);
    resume(sequence, shared);
    let open = sequence.open.as_ref();
    let Some(open) = open.filter(|_| shared.transient.is_some()) else {
        shared.mode = before;
        return kept.into_iter().collect();
    };
    let moves = open.bound.as_ref().is_some_and(Bound::moves_camera);
    if moves && shared.pictures.view.is_some() {
        shared.pictures.reset_view();
    }
    if open.held.is_none() {
        shared.say(how_to_key(open, shared));
    }
    kept.into_iter().collect()
}

/// How the first value is keyed.
pub(super) fn how_to_key(open: &OpenTrack, shared: &Shared) -> String {
    let (edit, key) = (shared.key_for("edit"), shared.key_for("key"));
    let name = open.name();
    format!("{name} is new: {edit} edits at this frame, then {key} keys the value")
}

/// Relates a track to the present text; reports errors in it.
pub(super) fn bind(shared: &mut Shared, track: &Track, name: &str, text: &str) -> Option<Bound> {
    let camera = shared.scene.as_ref()?.camera;
    let (bound, findings) = track::bind(track, shared.source(), &camera);
    if 0 < findings.errors() {
        complain(shared, &complaint(name, text, &findings));
        return None;
    }
    Some(bound)
}

fn complain(shared: &mut Shared, words: &str) {
    shared
        .overlays
        .complain(About::Track, Severity::Error, words);
}

/// Puts the present frame into the text, unless one is there or a question or a reading waits for the
/// text without it.
pub(super) fn resume(sequence: &mut Sequence, shared: &mut Shared) {
    let waits = shared.overlays.dialog.is_some() || shared.awaits_reading;
    if shared.mode == Mode::Sequence && !waits && shared.transient.is_none() {
        let frame = sequence.open.as_ref().map_or(0, |open| open.frame);
        show(sequence, shared, frame);
    }
}

/// Puts a frame into the text in place of the one before.
fn show(sequence: &mut Sequence, shared: &mut Shared, frame: u32) {
    let Some(open) = &mut sequence.open else {
        return;
    };
    open.frame = frame.min(open.last());
    let frame = open.frame;
    let shown = if let Some(before) = shared.transient.take().zip(open.bound.take()) {
        (!text::leaves_live_edit(shared, &before.0.live_edit, "frame")).then_some(before)
    } else {
        let text = open.held.clone().unwrap_or_default();
        let bound = bind(shared, &open.track, &open.name(), &text);
        if bound.is_none() {
            sequence.wrong = Some(open.path.clone());
            sequence.judged = shared.document.revision();
        }
        bound.map(|bound| (text::begin_transient(shared), bound))
    };
    let Some((mut transient, bound)) = shown else {
        open.is_playing = false;
        shared.mode = Mode::Select;
        return;
    };
    let edits = |shared: &Shared| Ok(bound.edits(shared.source(), frame));
    match text::try_instead(shared, &mut transient.live_edit, edits) {
        Ok(()) if transient.live_edit.is_applied => {
            let name = format!("frame {frame} of {}", open.name());
            shared.document.name_step(StepName::done(name));
        }
        Ok(()) => {}
        Err(reason) => shared.fail(format!("frame {frame}: {reason}")),
    }
    open.bound = Some(bound);
    shared.transient = Some(transient);
}

/// Goes some frames on.
pub(super) fn step_frames(sequence: &mut Sequence, shared: &mut Shared, frames: i32) {
    if let Some(open) = &sequence.open {
        let frame = open.frame_after(frames);
        show(sequence, shared, frame);
    }
}

/// Goes to the next frame with a key.
pub(super) fn go_to_next_key(sequence: &mut Sequence, shared: &mut Shared) {
    match sequence.open.as_ref().and_then(OpenTrack::next_key) {
        Some(frame) => show(sequence, shared, frame),
        None => shared.say("there are no later keys"),
    }
}

/// Goes to the previous frame with a key.
pub(super) fn go_to_previous_key(sequence: &mut Sequence, shared: &mut Shared) {
    match sequence.open.as_ref().and_then(OpenTrack::previous_key) {
        Some(frame) => show(sequence, shared, frame),
        None => shared.say("there are no earlier keys"),
    }
}

/// Goes to the frame that is pointed at on the sheet; returns whether there is one.
pub(super) fn scrub_to(sequence: &mut Sequence, shared: &mut Shared, at: (u16, u16)) -> bool {
    let Some(open) = &mut sequence.open else {
        return false;
    };
    let sheet = DopeSheet::new(shared.areas().fields, open.last());
    let frame = sheet.frame(at.0);
    let is_there = sheet.frames.contains(at.into());
    if is_there {
        open.is_playing = false;
        show(sequence, shared, frame);
    }
    is_there
}

/// Plays the track, or stops.
pub(super) fn toggle(sequence: &mut Sequence, _: &mut Shared) -> Vec<Effect> {
    let Some(open) = &mut sequence.open else {
        return Vec::new();
    };
    open.is_playing = !open.is_playing;
    let timer = Effect::Later(open.period(), Timer::Frame);
    open.is_playing.then_some(timer).into_iter().collect()
}

/// Shows the next frame once something of the one before was seen: a scene that takes longer to
/// trace plays more slowly.
pub(crate) fn play_on(sequence: &mut Sequence, shared: &mut Shared) -> Vec<Effect> {
    let open = sequence.open.as_ref();
    let Some(open) = open.filter(|open| open.is_playing && shared.mode == Mode::Sequence) else {
        return Vec::new();
    };
    let timer = Effect::Later(open.period(), Timer::Frame);
    if shared.transient.is_some() && shared.pictures.preview.shows_wanted() {
        step_frames(sequence, shared, 1);
    }
    vec![timer]
}

/// Leaves SEQUENCE with the values of the frame in the text, as one undo step.
pub(super) fn accept(sequence: &mut Sequence, shared: &mut Shared) {
    keep_frame(sequence, shared);
    shared.mode = Mode::Select;
}

/// Goes to EDIT or VIEW with the values of the frame in the text. Stays if that mode cannot be entered.
pub(super) fn keep_and_go(sequence: &mut Sequence, shared: &mut Shared, mode: Mode) {
    shared.enter(mode);
    if shared.mode == mode {
        keep_frame(sequence, shared);
    }
}

/// Keeps the values of the frame in the text, as one undo step.
fn keep_frame(sequence: &mut Sequence, shared: &mut Shared) {
    let Some(open) = &mut sequence.open else {
        return;
    };
    open.is_playing = false;
    let shown = shared.transient.take();
    if shown.is_some_and(|shown| shown.live_edit.is_applied) {
        let words = format!("applied frame {} to the scene", open.frame);
        let undo = shared.key_for("undo");
        shared.say(format!("{words}; {undo} undoes that"));
    }
    text::keep_live_edit(shared);
}

/// Takes back what was said of a file that can be played again, or that no longer exists.
fn forgive(sequence: &mut Sequence, shared: &mut Shared, path: &Path, text: Option<&str>) {
    let is_wrong = sequence.wrong.as_deref() == Some(path);
    if is_wrong && text.is_none_or(|text| can_play(shared, text)) {
        sequence.wrong = None;
        shared.overlays.end_complaint(About::Track);
    }
}

/// Whether a text is a track of the present scene.
fn can_play(shared: &Shared, text: &str) -> bool {
    let (track, findings) = track::read(text);
    let Some(scene) = shared.scene.as_ref().filter(|_| findings.errors() == 0) else {
        return false;
    };
    let (_, findings) = track::bind(&track, shared.source(), &scene.camera);
    findings.errors() == 0
}

/// Reads a file that cannot be played again once the scene's text has changed, which may be why. What
/// was said of a file that no longer matters goes.
pub(super) fn judge_again(sequence: &mut Sequence, shared: &mut Shared) -> Option<Effect> {
    if sequence.wrong.is_none() && sequence.open.is_none() {
        shared.overlays.end_complaint(About::Track);
    }
    let wrong = sequence.wrong.clone()?;
    let revision = shared.document.revision();
    let is_due = shared.transient.is_none() && sequence.judged != revision;
    sequence.judged = revision;
    is_due.then(|| Effect::ReadTrack(wrong))
}

/// Goes on with the open track after a file was read that cannot be played, its own or another.
fn refuse(sequence: &mut Sequence, shared: &Shared, read: &Path) -> Vec<Effect> {
    sequence.wrong = Some(read.to_owned());
    sequence.judged = shared.document.revision();
    if let Some(open) = sequence.open_at(read) {
        open.is_refused = true;
    }
    follow_open(sequence, read)
}

/// Watches the open track again after another one was read in vain.
fn follow_open(sequence: &Sequence, read: &Path) -> Vec<Effect> {
    let again = reread(sequence);
    let is_other = |effect: &Effect| !matches!(effect, Effect::ReadTrack(path) if path == read);
    again.filter(is_other).into_iter().collect()
}

/// Reads the open track again, otherwise a file that could not be played, if there is one and it is not
/// being written.
pub(crate) fn reread(sequence: &Sequence) -> Option<Effect> {
    let open = sequence.open.as_ref().map(|open| &open.path);
    let path = open.or(sequence.wrong.as_ref())?;
    let is_idle = sequence.writing.is_none();
    is_idle.then(|| Effect::ReadTrack(path.clone()))
}
