//! Keys of SELECT: the list, and what is done with the selected thing.

use crossterm::event::KeyCode;

use super::adding::{open_additions, open_kinds};
use super::filtering::{cycle, fold, search, start_filter};
use super::structure::{
    copy, delete, duplicate, insert_copied, reorder, start_renaming, toggle_mark, toggle_visibility,
};
use crate::app::room::Row;
use crate::app::{Fold, display, exports};
use crate::keymap::{Context, Key, Mode, Scope, c, key, shift};
use language::Neighbour;

use Context::In;
use KeyCode::{BackTab, Enter, Left, Right, Tab};
use Scope::These;

const HERE: &[Context] = &[In(Mode::Select)];
const SELECT: Scope = These(HERE);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(SELECT, "edit", &[key(Enter), c('e')], "edit its fields").also("material color properties").hint(10, "edit").does(|shared| shared.enter(Mode::Edit)).when(|shared| !shared.cursor.fields().is_empty()),
    Key::new(SELECT, "camera", &[c('v')], "move the camera").also("viewpoint").hint(40, "camera").does(|shared| shared.enter(Mode::View)),
    Key::new(SELECT, "delete", &[c('d')], "delete").also("remove erase").does(delete),
    Key::new(SELECT, "duplicate", &[c('D')], "duplicate").also("clone").does(duplicate),
    Key::new(SELECT, "copy", &[c('y')], "copy the text").requests(copy),
    Key::new(SELECT, "paste", &[c('p')], "paste").does(insert_copied),
    Key::new(SELECT, "mark", &[c(' ')], "mark or unmark").does(toggle_mark),
    Key::new(SELECT, "rename", &[c('R')], "rename").does(start_renaming),
    Key::new(SELECT, "reorder-up", &[c('K')], "move up in the list").does(|shared| reorder(shared, Neighbour::Previous)),
    Key::new(SELECT, "reorder-down", &[c('J')], "move down in the list").does(|shared| reorder(shared, Neighbour::Next)),
    Key::new(SELECT, "add", &[c('a')], "add").also("create insert new").hint(20, "add").does(open_additions),
    Key::new(SELECT, "solo", &[c('l')], "show only this in the preview").also("isolate").does(display::toggle_solo),
    Key::new(SELECT, "change-type", &[c('c')], "change the type").does(open_kinds),
];

/// The rest. The keys that start MOVE are listed between these and [`KEYS`].
#[rustfmt::skip]
pub(crate) const OTHERS: &[Row] = &[
    Key::new(SELECT, "next-item", &[key(Tab)], "next light or object").does(|shared| cycle(shared, 1)),
    Key::new(SELECT, "visibility", &[c('h')], "show or hide the object").also("hide").does(toggle_visibility),
    Key::new(SELECT, "search", &[c('/')], "filter the list").hint(60, "filter").does(start_filter),
    Key::new(SELECT, "fold", &[key(Left)], "fold the group, or go to it").does(|shared| fold(shared, Fold::Selected)),
    Key::new(SELECT, "unfold", &[key(Right)], "unfold the group, or go into it").does(|shared| fold(shared, Fold::Unselected)),
    Key::new(SELECT, "fold-all", &[shift(Left)], "fold all groups").does(|shared| fold(shared, Fold::All)),
    Key::new(SELECT, "unfold-all", &[shift(Right)], "unfold all groups").does(|shared| fold(shared, Fold::None)),
    Key::new(SELECT, "outline", &[c('o')], "toggle the outline of the selection").does(|shared| shared.pictures.toggle_outline()),
    Key::new(SELECT, "symbols", &[c('O')], "show symbols of all lights, cameras and groups, or of the selected kind").does(display::toggle_symbols),
    Key::new(SELECT, "next-match", &[c('n')], "next match").does(|shared| search(shared, 1)),
    Key::new(SELECT, "previous-match", &[c('N')], "previous match").does(|shared| search(shared, -1)),
    Key::new(SELECT, "previous-item", &[key(BackTab)], "previous light or object").does(|shared| cycle(shared, -1)),
    Key::new(SELECT, "stop", &[c('x')], "cancel the export").requests(exports::cancel_export),
];
