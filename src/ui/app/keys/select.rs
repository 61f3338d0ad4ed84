//! Keys of SELECT: the list, and what is done with the selected thing.

use crossterm::event::KeyCode;

use super::row::Row;
use crate::language::Neighbour;
use crate::ui::app::{App, Fold, Tool};
use crate::ui::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{BackTab, Enter, Left, Right, Tab};
use Scope::These;

const HERE: &[Context] = &[In(Mode::Select)];
const SELECT: Scope = These(HERE);
const SELECT_AND_FIELDS: Scope = These(&[In(Mode::Select), In(Mode::Edit)]);

/// The most useful first.
#[rustfmt::skip]
pub(super) const KEYS: &[Row] = &[
    Key::new(SELECT, "edit", &[key(Enter), c('e')], "edit its fields").hint(10, "edit").requests(|app| app.go(Mode::Edit)).when(|app| !app.cursor.fields().is_empty()),
    Key::new(SELECT, "camera", &[c('v')], "move the camera").hint(40, "camera").requests(|app| app.go(Mode::View)),
    Key::new(SELECT, "delete", &[c('d')], "delete").does(App::delete),
    Key::new(SELECT, "duplicate", &[c('D')], "duplicate").does(App::duplicate),
    Key::new(SELECT, "copy", &[c('y')], "copy the text").requests(App::copy),
    Key::new(SELECT, "paste", &[c('p')], "paste").does(App::insert_copied),
    Key::new(SELECT, "mark", &[c(' ')], "mark or unmark").does(App::toggle_mark),
    Key::new(SELECT, "rename", &[c('R')], "rename").does(App::start_renaming),
    Key::new(SELECT, "reorder-up", &[c('K')], "move up in the list").does(|app| app.reorder(Neighbour::Previous)),
    Key::new(SELECT, "reorder-down", &[c('J')], "move down in the list").does(|app| app.reorder(Neighbour::Next)),
    Key::new(SELECT, "add", &[c('a')], "add").hint(20, "add").does(App::open_additions),
    Key::new(SELECT, "solo", &[c('l')], "show only this in the preview").does(App::toggle_solo),
    Key::new(SELECT, "change-type", &[c('c')], "change the type").does(App::open_kinds),
    Key::new(SELECT_AND_FIELDS, "move", &[c('m')], "move").hint_in(HERE, 30, "move it").does(|app| app.start_transform(Tool::Move)).when(|app| app.is_movable(Tool::Move)),
    Key::new(SELECT_AND_FIELDS, "rotate", &[c('t')], "rotate").does(|app| app.start_transform(Tool::Rotate)),
    Key::new(SELECT_AND_FIELDS, "scale", &[c('s')], "scale").does(|app| app.start_transform(Tool::Scale)),
    Key::new(SELECT, "next-item", &[key(Tab)], "next light or object").does(|app| app.cycle(1)),
    Key::new(SELECT, "visibility", &[c('h')], "show or hide the object").does(App::toggle_visibility),
    Key::new(SELECT, "search", &[c('/')], "filter the list").hint(60, "filter").does(App::start_filter),
    Key::new(SELECT, "fold", &[key(Left)], "fold the group, or go to it").does(|app| app.fold(Fold::Selected)),
    Key::new(SELECT, "unfold", &[key(Right)], "unfold the group, or go into it").does(|app| app.fold(Fold::Unselected)),
    Key::new(SELECT, "fold-all", &[shift(Left)], "fold all groups").does(|app| app.fold(Fold::All)),
    Key::new(SELECT, "unfold-all", &[shift(Right)], "unfold all groups").does(|app| app.fold(Fold::None)),
    Key::new(SELECT, "outline", &[c('o')], "toggle the outline of the selection").does(|app| app.pictures.toggle_outline()),
    Key::new(SELECT, "symbols", &[c('O')], "show symbols of all lights, cameras and groups, or of the selected kind").does(App::toggle_symbols),
    Key::new(SELECT, "next-match", &[c('n')], "next match").does(|app| app.search(1)),
    Key::new(SELECT, "previous-match", &[c('N')], "previous match").does(|app| app.search(-1)),
    Key::new(SELECT, "previous-item", &[key(BackTab)], "previous light or object").does(|app| app.cycle(-1)),
    Key::new(SELECT, "stop", &[c('x')], "cancel the export").requests(App::stop),
];
