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
    Key::new(SELECT, "edit", &[key(Enter), c('e')], "edit its fields").also("material color colour properties change texture attributes settings position size reflection transparency glass mirror shiny radius parameter intensity opacity alpha ior refraction specular diffuse emission roughness metal strength plastic wood surface").hint(10, "edit").stays().does(|shared| shared.enter(Mode::Edit)).when(|shared| !shared.cursor.fields().is_empty()),
    Key::new(SELECT, "camera", &[c('v')], "move the camera").also("viewpoint view orbit angle look perspective navigate rotate").hint(40, "camera").does(|shared| shared.enter(Mode::View)),
    Key::new(SELECT, "delete", &[c('d')], "delete").also("remove erase trash kill cut destroy clear").does(delete),
    Key::new(SELECT, "duplicate", &[c('D')], "duplicate").also("clone copy another").does(duplicate),
    Key::new(SELECT, "copy", &[c('y')], "copy the text").also("yank clipboard duplicate text").requests(copy),
    Key::new(SELECT, "paste", &[c('p')], "paste").also("insert clipboard").does(insert_copied),
    Key::new(SELECT, "mark", &[c(' ')], "mark or unmark").also("multiple several select group selection all many batch both").does(toggle_mark),
    Key::new(SELECT, "rename", &[c('R')], "rename").also("name label title call").does(start_renaming),
    Key::new(SELECT, "reorder-up", &[c('K')], "move up in the list").also("order sort earlier").does(|shared| reorder(shared, Neighbour::Previous)),
    Key::new(SELECT, "reorder-down", &[c('J')], "move down in the list").also("order sort later").does(|shared| reorder(shared, Neighbour::Next)),
    Key::new(SELECT, "add", &[c('a')], "add").also("create insert new light sphere box object cube primitive shape lamp bulb sun torus cone cylinder plane triangle ellipsoid ball geometry primitives floor spotlight prism pyramid").hint(20, "add").does(open_additions),
    Key::new(SELECT, "solo", &[c('l')], "show only this in the preview").also("isolate alone hide others only").does(display::toggle_solo),
    Key::new(SELECT, "change-type", &[c('c')], "change the type").also("kind convert turn into shape replace").does(open_kinds),
];

/// The rest. The keys that start MOVE are listed between these and [`KEYS`].
#[rustfmt::skip]
pub(crate) const OTHERS: &[Row] = &[
    Key::new(SELECT, "next-item", &[key(Tab)], "next light or object").also("cycle jump").does(|shared| cycle(shared, 1)),
    Key::new(SELECT, "visibility", &[c('h')], "show or hide the object").also("hide invisible toggle disable eye hidden unhide appear vanish").does(toggle_visibility),
    Key::new(SELECT, "search", &[c('/')], "filter the list").also("find search look locate").hint(60, "filter").does(start_filter),
    Key::new(SELECT, "fold", &[key(Left)], "fold the group, or go to it").also("collapse close tree").does(|shared| fold(shared, Fold::Selected)),
    Key::new(SELECT, "unfold", &[key(Right)], "unfold the group, or go into it").also("expand open tree").does(|shared| fold(shared, Fold::Unselected)),
    Key::new(SELECT, "fold-all", &[shift(Left)], "fold all groups").does(|shared| fold(shared, Fold::All)),
    Key::new(SELECT, "unfold-all", &[shift(Right)], "unfold all groups").does(|shared| fold(shared, Fold::None)),
    Key::new(SELECT, "outline", &[c('o')], "toggle the outline of the selection").also("highlight border selection silhouette").does(|shared| shared.pictures.toggle_outline()),
    Key::new(SELECT, "symbols", &[c('O')], "show symbols of all lights, cameras and groups, or of the selected kind").also("icons gizmos lamps markers helpers show lights").does(display::toggle_symbols),
    Key::new(SELECT, "next-match", &[c('n')], "next match").also("find search").does(|shared| search(shared, 1)),
    Key::new(SELECT, "previous-match", &[c('N')], "previous match").also("find search").does(|shared| search(shared, -1)),
    Key::new(SELECT, "previous-item", &[key(BackTab)], "previous light or object").does(|shared| cycle(shared, -1)),
    Key::new(SELECT, "stop", &[c('x')], "cancel the export").also("abort").requests(exports::cancel_export),
];
