//! Keys of SEQUENCE, and those of other modes that need its track.

use crossterm::event::KeyCode;

use super::exporting::export_default;
use super::keying::{edit_track, key_value, take_key_back};
use super::playing::{
    accept, go_to_next_key, go_to_previous_key, keep_and_go, open_track, step_frames, toggle,
};
use super::state::Sequence;
use crate::app::room::Row;
use crate::app::{exports, text};
use crate::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{End, Enter, Esc, Home, Left, Right};
use Scope::These;

const SEQUENCE: Scope = These(&[In(Mode::Sequence)]);
/// Where a track can be played.
const PLAYED: Scope = These(&[
    In(Mode::Select),
    In(Mode::Edit),
    In(Mode::View),
    In(Mode::Fly),
]);
/// Where present values are keyed.
const KEYED: Scope = These(&[In(Mode::Edit), In(Mode::View), In(Mode::Fly)]);
const EDIT: &[Context] = &[In(Mode::Edit)];
const CAMERA: &[Context] = &[In(Mode::View), In(Mode::Fly)];

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row<Sequence>] = &[
    Key::new(SEQUENCE, "play", &[c(' ')], "play or stop").also("animation movie start run preview timeline playback loop stop").hint(0, "play").requests_in(toggle).hinting(|sequence, _| sequence.open.as_ref()?.is_playing.then_some("stop")),
    Key::new(SEQUENCE, "next-frame", &[c('l'), key(Right)], "next frame").also("step forward").hint(11, "frame").does_in(|sequence, shared| step_frames(sequence, shared, 1)),
    Key::new(SEQUENCE, "previous-frame", &[c('h'), key(Left)], "previous frame").also("step back rewind").hint(10, "frame").does_in(|sequence, shared| step_frames(sequence, shared, -1)),
    Key::new(SEQUENCE, "next-key", &[c(']')], "next key").also("keyframe").hint(21, "key").does_in(go_to_next_key),
    Key::new(SEQUENCE, "previous-key", &[c('[')], "previous key").also("keyframe").hint(20, "key").does_in(go_to_previous_key),
    Key::new(SEQUENCE, "edit", &[c('e')], "keep the frame and edit fields").hint(30, "edit").does_in(|sequence, shared| keep_and_go(sequence, shared, Mode::Edit)).when(|shared| !shared.cursor.fields().is_empty()),
    Key::new(SEQUENCE, "camera", &[c('v')], "keep the frame and go to VIEW").does_in(|sequence, shared| keep_and_go(sequence, shared, Mode::View)),
    Key::new(SEQUENCE, "accept", &[key(Enter)], "keep the frame in the text").hint(40, "keep").does_in(accept),
    Key::new(SEQUENCE, "back", &[key(Esc)], "back to the scene").hint(50, "back").does(text::leave_sequence),
    Key::new(SEQUENCE, "frames-forward", &[c('L'), shift(Right)], "ten frames forward").does_in(|sequence, shared| step_frames(sequence, shared, 10)),
    Key::new(SEQUENCE, "frames-back", &[c('H'), shift(Left)], "ten frames back").does_in(|sequence, shared| step_frames(sequence, shared, -10)),
    Key::in_turn(SEQUENCE, "first-frame", [c('g'), c('g')], "first frame").also("start beginning rewind").does_in(|sequence, shared| step_frames(sequence, shared, i32::MIN)),
    Key::new(SEQUENCE, "first-frame", &[key(Home)], "first frame").also("start beginning rewind").does_in(|sequence, shared| step_frames(sequence, shared, i32::MIN)),
    Key::new(SEQUENCE, "last-frame", &[c('G'), key(End)], "last frame").also("end").does_in(|sequence, shared| step_frames(sequence, shared, i32::MAX)),
    Key::new(SEQUENCE, "export", &[c('b')], "export all frames").also("movie video gif animation save mp4").hint(120, "export").requests_in(export_default),
    Key::new(SEQUENCE, "stop", &[c('x')], "cancel the export").requests(exports::cancel_export),
    Key::new(SEQUENCE, "undo-key", &[c('u')], "undo the last key").also("keyframe revert").requests_in(take_key_back),
    Key::new(SEQUENCE, "edit-track", &[c('E')], "open the editor on the track").also("file text").requests_in(edit_track),
];

/// Keys in other modes that need the track.
#[rustfmt::skip]
pub(crate) const ENTRIES: &[Row<Sequence>] = &[
    Key::new(PLAYED, "track", &[c('T')], "play the track").also("animation movie video timeline turntable sequence frames loop clip play playback film").requests_in(|sequence, shared| open_track(sequence, shared, None)),
    Key::new(KEYED, "key", &[c('I')], "key the value, or in VIEW the camera, in the track").also("keyframe animate animation record set").hint_in(EDIT, 40, "key it").hint_in(CAMERA, 50, "key it").requests_in(key_value).when_in(|sequence, _| sequence.open.is_some()),
];
