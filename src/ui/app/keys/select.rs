//! Keys of SELECT: the list, and what is done with the selected thing.

use crossterm::event::KeyCode;

use super::row::Row;
use crate::language::Neighbour;
use crate::ui::app::{Fold, Shared, Tool};
use crate::ui::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{BackTab, Enter, Left, Right, Tab};
use Scope::These;

const HERE: &[Context] = &[In(Mode::Select)];
const SELECT: Scope = These(HERE);
const SELECT_AND_FIELDS: Scope = These(&[In(Mode::Select), In(Mode::Edit)]);

/// The most useful first.
#[rustfmt::skip]
pub(in crate::ui::app) const KEYS: &[Row] = &[
    Key::new(SELECT, "edit", &[key(Enter), c('e')], "edit its fields").also("material color properties").hint(10, "edit").requests(|shared| shared.go(Mode::Edit)).when(|shared| !shared.cursor.fields().is_empty()),
    Key::new(SELECT, "camera", &[c('v')], "move the camera").also("viewpoint").hint(40, "camera").requests(|shared| shared.go(Mode::View)),
    Key::new(SELECT, "delete", &[c('d')], "delete").also("remove erase").does(Shared::delete),
    Key::new(SELECT, "duplicate", &[c('D')], "duplicate").also("clone").does(Shared::duplicate),
    Key::new(SELECT, "copy", &[c('y')], "copy the text").requests(Shared::copy),
    Key::new(SELECT, "paste", &[c('p')], "paste").does(Shared::insert_copied),
    Key::new(SELECT, "mark", &[c(' ')], "mark or unmark").does(Shared::toggle_mark),
    Key::new(SELECT, "rename", &[c('R')], "rename").does(Shared::start_renaming),
    Key::new(SELECT, "reorder-up", &[c('K')], "move up in the list").does(|shared| shared.reorder(Neighbour::Previous)),
    Key::new(SELECT, "reorder-down", &[c('J')], "move down in the list").does(|shared| shared.reorder(Neighbour::Next)),
    Key::new(SELECT, "add", &[c('a')], "add").also("create insert new").hint(20, "add").does(Shared::open_additions),
    Key::new(SELECT, "solo", &[c('l')], "show only this in the preview").also("isolate").does(Shared::toggle_solo),
    Key::new(SELECT, "change-type", &[c('c')], "change the type").does(Shared::open_kinds),
    Key::new(SELECT_AND_FIELDS, "move", &[c('m')], "move").hint_in(HERE, 30, "move it").does(|shared| shared.start_transform(Tool::Move)).when(|shared| shared.is_movable(Tool::Move)),
    Key::new(SELECT_AND_FIELDS, "rotate", &[c('t')], "rotate").does(|shared| shared.start_transform(Tool::Rotate)),
    Key::new(SELECT_AND_FIELDS, "scale", &[c('s')], "scale").does(|shared| shared.start_transform(Tool::Scale)),
    Key::new(SELECT, "next-item", &[key(Tab)], "next light or object").does(|shared| shared.cycle(1)),
    Key::new(SELECT, "visibility", &[c('h')], "show or hide the object").also("hide").does(Shared::toggle_visibility),
    Key::new(SELECT, "search", &[c('/')], "filter the list").hint(60, "filter").does(Shared::start_filter),
    Key::new(SELECT, "fold", &[key(Left)], "fold the group, or go to it").does(|shared| shared.fold(Fold::Selected)),
    Key::new(SELECT, "unfold", &[key(Right)], "unfold the group, or go into it").does(|shared| shared.fold(Fold::Unselected)),
    Key::new(SELECT, "fold-all", &[shift(Left)], "fold all groups").does(|shared| shared.fold(Fold::All)),
    Key::new(SELECT, "unfold-all", &[shift(Right)], "unfold all groups").does(|shared| shared.fold(Fold::None)),
    Key::new(SELECT, "outline", &[c('o')], "toggle the outline of the selection").does(|shared| shared.pictures.toggle_outline()),
    Key::new(SELECT, "symbols", &[c('O')], "show symbols of all lights, cameras and groups, or of the selected kind").does(Shared::toggle_symbols),
    Key::new(SELECT, "next-match", &[c('n')], "next match").does(|shared| shared.search(1)),
    Key::new(SELECT, "previous-match", &[c('N')], "previous match").does(|shared| shared.search(-1)),
    Key::new(SELECT, "previous-item", &[key(BackTab)], "previous light or object").does(|shared| shared.cycle(-1)),
    Key::new(SELECT, "stop", &[c('x')], "cancel the export").requests(Shared::stop),
];
