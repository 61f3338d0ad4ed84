//! Keying present values in the text of the open track, which is written at once.

use std::path::PathBuf;
use std::sync::Arc;

use super::playing::{bind, has_sound_scene, reread};
use super::state::{Sequence, complaint};
use crate::app::refusing::Refusable;
use crate::app::shared::Shared;
use crate::app::text;
use crate::msg::{Effect, Guard, SaveOutcome};
use ::text::apply;
use track::{Keyed, Track};

/// Keys the present value at the frame looked at last: in EDIT the field's, in VIEW the camera's.
pub(super) fn key_value(sequence: &mut Sequence, shared: &mut Shared) -> Vec<Effect> {
    let Some(open) = &sequence.open else {
        let track = shared.key_for("track");
        shared.fail(format!("no track is open: {track} opens or starts one"));
        return Vec::new();
    };
    if sequence.writing.is_some() {
        shared.warn("the previous key is still being written");
        return Vec::new();
    }
    let (frame, name, path) = (open.frame, open.name(), open.path.clone());
    let (held, track) = (open.held.clone(), open.track.clone());
    if !has_sound_scene(shared) {
        return Vec::new();
    }
    let before = held.as_ref().map_or(track::BEGUN, |held| held.as_str());
    let Some(keyed) = keyed(sequence, shared, &track, &name, before) else {
        return Vec::new();
    };
    let Some(Keyed { edits, what }) = keyed.or_fail(shared) else {
        return Vec::new();
    };
    let mut text = before.to_owned();
    apply(&mut text, &edits);
    let (track, findings) = track::read(&text);
    if 0 < findings.errors() {
        shared.fail(complaint(&name, &text, &findings));
        return Vec::new();
    }
    if bind(shared, &track, &name, &text).is_none() {
        return Vec::new();
    }
    if edits.is_empty() {
        shared.say(format!("{what} already has this key at frame {frame}"));
        return Vec::new();
    }
    let words = format!("{what} keyed at frame {frame} in {name}");
    // A file that has appeared meanwhile is read first.
    let guard = Guard::Holding(held.unwrap_or_default());
    write(sequence, (path, guard), Arc::new(text), words)
}

/// The key of the present value in the text of a track; `None` if the track has errors, which are
/// reported.
fn keyed(
    sequence: &Sequence,
    shared: &mut Shared,
    track: &Track,
    name: &str,
    text: &str,
) -> Option<Result<Keyed, track::Unkeyed>> {
    let frame = sequence.open.as_ref()?.frame;
    if shared.mode.moves_camera() {
        let cameras = [&shared.own_camera()?, &shared.camera()?];
        return Some(track::key_camera(text, track, cameras, frame));
    }
    let bound = bind(shared, track, name, text)?;
    let cursor = &shared.cursor;
    let place = (cursor.selected(), cursor.field, cursor.component);
    let track = (track, &bound);
    Some(track::key_field(text, track, shared.source(), place, frame))
}

/// Takes back the key that was written last.
pub(super) fn take_key_back(sequence: &mut Sequence, shared: &mut Shared) -> Vec<Effect> {
    let open = sequence.open.as_ref();
    let last = open.and_then(|open| Some((open, open.before.last()?)));
    let (Some((open, before)), None) = (last, &sequence.writing) else {
        shared.say("there is no key to undo");
        return Vec::new();
    };
    let guard = Guard::Holding(open.held.clone().unwrap_or_default());
    let words = format!("the last key was undone in {}", open.name());
    let (path, text) = (open.path.clone(), Arc::clone(before));
    write(sequence, (path, guard), text, words)
}

fn write(
    sequence: &mut Sequence,
    (path, guard): (PathBuf, Guard),
    text: Arc<String>,
    words: String,
) -> Vec<Effect> {
    sequence.writing = Some((Arc::clone(&text), words));
    vec![Effect::WriteTrack { path, text, guard }]
}

/// Takes the outcome of writing a track file.
pub(crate) fn written(
    sequence: &mut Sequence,
    shared: &mut Shared,
    outcome: SaveOutcome,
) -> Vec<Effect> {
    take_written(sequence, shared, outcome);
    // What was read of the file meanwhile was not taken.
    reread(sequence).into_iter().collect()
}

fn take_written(sequence: &mut Sequence, shared: &mut Shared, outcome: SaveOutcome) {
    let writing = sequence.writing.take();
    let Some(((text, words), open)) = writing.zip(sequence.open.as_mut()) else {
        return;
    };
    match outcome {
        // Another track may have been opened meanwhile.
        SaveOutcome::Saved { path, .. } if path != open.path => {}
        SaveOutcome::Saved { .. } => {
            (open.track, _) = track::read(&text);
            if open.before.last() == Some(&text) {
                open.before.pop();
            } else {
                let begun = || Arc::new(track::BEGUN.to_owned());
                open.before.push(open.held.take().unwrap_or_else(begun));
            }
            open.held = Some(text);
            shared.say(words);
            // The frame is shown anew.
            text::revert_transient(shared);
        }
        SaveOutcome::ChangedOnDisk => {
            let (name, key) = (open.name(), shared.key_for("key"));
            shared.warn(format!(
                "{name} has changed on disk and is being read again; then press {key} again"
            ));
        }
        SaveOutcome::NoFolder(reason) | SaveOutcome::Failed(reason) => {
            shared.fail(reason);
        }
    }
}

/// Opens the editor on the track file.
pub(super) fn edit_track(sequence: &mut Sequence, shared: &mut Shared) -> Vec<Effect> {
    let Some(open) = &sequence.open else {
        return Vec::new();
    };
    if open.held.is_none() {
        let name = open.name();
        shared.warn(format!(
            "{name} does not exist yet: the first key creates it"
        ));
        return Vec::new();
    }
    let path = open.path.clone();
    vec![Effect::OpenEditor { path, line: 1 }]
}
