//! Keys of the questions that must be answered first.

use crossterm::event::KeyCode;

use crate::app::room::Row;
use crate::app::{Shared, Whose, exports, files, select};
use crate::keymap::{Context, Key, Scope, c, key};
use crate::msg::Existing;

use KeyCode::{Enter, Esc};
use Scope::These;

const CONFLICT: Scope = These(&[Context::Conflict]);
const QUIT: Scope = These(&[Context::Quit]);
const DELETE: Scope = These(&[Context::Delete]);
const LEAVE: Scope = These(&[Context::Leave]);
const MOVED_VIEW: Scope = These(&[Context::MovedView]);
const WAIT: Scope = These(&[Context::Wait]);
const SAVE_FIRST: Scope = These(&[Context::SaveFirst]);
const OVERWRITE: Scope = These(&[Context::Overwrite]);
const RECOVER: Scope = These(&[Context::Recover]);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(CONFLICT, "mine", &[c('m')], "keep mine").does(|shared| files::decide(shared, Whose::Mine)),
    Key::new(CONFLICT, "theirs", &[c('t')], "take theirs").does(|shared| files::decide(shared, Whose::Theirs)),
    Key::new(CONFLICT, "accept", &[key(Enter)], "apply the merge").requests(files::adopt),
    Key::new(CONFLICT, "all-mine", &[c('M')], "keep mine everywhere").does(|shared| files::decide_all(shared, Whose::Mine)),
    Key::new(CONFLICT, "all-theirs", &[c('T')], "take theirs everywhere").does(|shared| files::decide_all(shared, Whose::Theirs)),
    Key::new(CONFLICT, "back", &[key(Esc)], "decide later").requests(files::put_off),
    Key::new(QUIT, "accept", &[c('y')], "quit anyway").requests(files::leave_anyway),
    Key::new(QUIT, "save", &[c('w')], "save and quit").requests(files::save_key),
    Key::new(QUIT, "write-view", &[c('S')], "write the moved view, save and quit").requests(files::save_view_key).when(Shared::is_view_unwritten),
    Key::new(QUIT, "back", &[c('n'), key(Esc)], "stay").requests(files::put_off),
    Key::new(DELETE, "accept", &[c('y')], "delete").does(select::delete_anyway),
    Key::new(DELETE, "back", &[c('n'), key(Esc)], "keep").does(|shared| shared.overlays.dialog = None),
    Key::new(LEAVE, "accept", &[c('y')], "discard unsaved changes").requests(files::leave_anyway),
    Key::new(LEAVE, "save", &[c('w')], "save first").requests(files::save_key),
    Key::new(LEAVE, "write-view", &[c('S')], "write the moved view and save first").requests(files::save_view_key).when(Shared::is_view_unwritten),
    Key::new(LEAVE, "back", &[c('n'), key(Esc)], "stay").requests(files::put_off),
    Key::new(MOVED_VIEW, "write-view", &[c('S')], "write the moved view and save first").requests(files::save_view_key),
    Key::new(MOVED_VIEW, "accept", &[c('y')], "leave without it").requests(files::leave_anyway),
    Key::new(MOVED_VIEW, "back", &[c('n'), key(Esc)], "stay").requests(files::put_off),
    Key::new(WAIT, "save", &[c('w')], "wait, then quit").requests(files::save_key),
    Key::new(WAIT, "accept", &[c('y')], "quit now and cancel it").requests(files::leave_anyway),
    Key::new(WAIT, "back", &[c('n'), key(Esc)], "stay").requests(files::put_off),
    Key::new(SAVE_FIRST, "save", &[c('y'), c('w')], "save and open the editor").requests(files::save_key),
    Key::new(SAVE_FIRST, "back", &[c('n'), key(Esc)], "stay").requests(files::put_off),
    Key::new(OVERWRITE, "accept", &[c('y')], "overwrite it").requests(|shared| exports::answer_taken(shared, Existing::Overwritten)),
    Key::new(OVERWRITE, "no", &[c('n')], "write a numbered file instead").requests(|shared| exports::answer_taken(shared, Existing::Numbered)),
    Key::new(OVERWRITE, "back", &[key(Esc)], "cancel the export").requests(files::put_off),
    Key::new(RECOVER, "accept", &[c('r')], "restore them").requests(files::restore),
    Key::new(RECOVER, "no", &[c('d')], "discard them").requests(files::decline),
    Key::new(RECOVER, "back", &[key(Esc)], "decide next time").requests(files::put_off),
];
