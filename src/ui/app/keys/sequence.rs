//! Keys of SEQUENCE.

use crossterm::event::KeyCode;

use super::row::Row;
use crate::ui::app::App;
use crate::ui::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{End, Enter, Esc, Home, Left, Right};
use Scope::These;

const SEQUENCE: Scope = These(&[In(Mode::Sequence)]);

/// The most useful first.
#[rustfmt::skip]
pub(super) const KEYS: &[Row] = &[
    Key::new(SEQUENCE, "play", &[c(' ')], "play or stop").hint(0, "play").requests(App::toggle_playing),
    Key::new(SEQUENCE, "next-frame", &[c('l'), key(Right)], "next frame").hint(11, "frame").does(|app| app.step_frames(1)),
    Key::new(SEQUENCE, "previous-frame", &[c('h'), key(Left)], "previous frame").hint(10, "frame").does(|app| app.step_frames(-1)),
    Key::new(SEQUENCE, "next-key", &[c(']')], "next key").hint(21, "key").does(|app| app.step_keys(true)),
    Key::new(SEQUENCE, "previous-key", &[c('[')], "previous key").hint(20, "key").does(|app| app.step_keys(false)),
    Key::new(SEQUENCE, "edit", &[c('e')], "keep the frame and edit fields").hint(30, "edit").requests(|app| app.go(Mode::Edit)).when(|app| !app.cursor.fields().is_empty()),
    Key::new(SEQUENCE, "camera", &[c('v')], "keep the frame and go to VIEW").requests(|app| app.go(Mode::View)),
    Key::new(SEQUENCE, "accept", &[key(Enter)], "keep the frame in the text").hint(40, "keep").does(App::keep_frame),
    Key::new(SEQUENCE, "back", &[key(Esc)], "back to the scene").hint(50, "back").does(|app| _ = app.leave_sequence()),
    Key::new(SEQUENCE, "frames-forward", &[c('L'), shift(Right)], "ten frames forward").does(|app| app.step_frames(10)),
    Key::new(SEQUENCE, "frames-back", &[c('H'), shift(Left)], "ten frames back").does(|app| app.step_frames(-10)),
    Key::in_turn(SEQUENCE, "first-frame", &[c('g'), c('g')], "first frame").does(|app| app.step_frames(i32::MIN)),
    Key::new(SEQUENCE, "first-frame", &[key(Home)], "first frame").does(|app| app.step_frames(i32::MIN)),
    Key::new(SEQUENCE, "last-frame", &[c('G'), key(End)], "last frame").does(|app| app.step_frames(i32::MAX)),
    Key::new(SEQUENCE, "export", &[c('b')], "export all frames").hint(120, "export").requests(App::export_default),
    Key::new(SEQUENCE, "stop", &[c('x')], "cancel the export").requests(App::stop),
    Key::new(SEQUENCE, "undo-key", &[c('u')], "undo the last key").requests(App::take_key_back),
    Key::new(SEQUENCE, "edit-track", &[c('E')], "open the editor on the track").requests(App::edit_track),
];
