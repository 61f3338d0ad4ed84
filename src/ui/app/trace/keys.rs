//! Keys of TRACE and of the drawing of a region.

use crossterm::event::KeyCode;

use super::regions::{confirm_region, move_corner, start_region, swap_corners};
use super::tracing::{stop, toggle_pause};
use crate::app::display;
use crate::app::room::Row;
use crate::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{Down, Enter, Esc, Left, Right, Tab, Up};
use Scope::These;

const TRACE: Scope = These(&[In(Mode::Trace)]);
const REGION: Scope = These(&[Context::Region]);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(TRACE, "scroll-left", &[c('h'), key(Left)], "pan left").also("move scroll").hint(10, "pan").does(|shared| display::scroll_picture(shared, -1, 0)).when(|shared| !display::viewport(shared).is_fit()),
    Key::new(TRACE, "scroll-down", &[c('j'), key(Down)], "pan down").also("move scroll").hint(10, "pan").does(|shared| display::scroll_picture(shared, 0, 1)).when(|shared| !display::viewport(shared).is_fit()),
    Key::new(TRACE, "scroll-up", &[c('k'), key(Up)], "pan up").also("move scroll").hint(10, "pan").does(|shared| display::scroll_picture(shared, 0, -1)).when(|shared| !display::viewport(shared).is_fit()),
    Key::new(TRACE, "scroll-right", &[c('l'), key(Right)], "pan right").also("move scroll").hint(10, "pan").does(|shared| display::scroll_picture(shared, 1, 0)).when(|shared| !display::viewport(shared).is_fit()),
    Key::new(TRACE, "zoom-in", &[c('+')], "zoom in").also("magnify enlarge closer bigger").hint(0, "zoom").does(|shared| display::magnify(shared, 1)),
    Key::new(TRACE, "zoom-out", &[c('-')], "zoom out").also("shrink smaller whole").hint(0, "zoom").does(|shared| display::magnify(shared, -1)),
    Key::new(TRACE, "one-to-one", &[c('z')], "zoom to 1:1, or fit the picture").also("actual size 100% pixels fit").hint(20, "1:1").does(display::toggle_scale),
    Key::new(TRACE, "pause", &[c(' ')], "pause or continue").also("resume hold wait").hint(30, "pause").requests(toggle_pause).when(|shared| shared.picture().is_awaited()).hinting(|(), shared| shared.picture().paused.then_some("continue")),
    Key::new(TRACE, "region", &[c('R')], "draw a region to trace alone").also("crop part area rectangle window").hint(40, "region").does(start_region),
    Key::new(TRACE, "stop", &[c('x')], "stop").also("cancel abort end").hint(50, "stop").requests(stop).when(|shared| shared.picture().is_awaited()),
    Key::new(REGION, "corner-left", &[c('h'), key(Left)], "corner left").hint(0, "move the corner").does(|shared| move_corner(shared, -1, 0)),
    Key::new(REGION, "corner-down", &[c('j'), key(Down)], "corner down").hint(0, "move the corner").does(|shared| move_corner(shared, 0, 1)),
    Key::new(REGION, "corner-up", &[c('k'), key(Up)], "corner up").hint(0, "move the corner").does(|shared| move_corner(shared, 0, -1)),
    Key::new(REGION, "corner-right", &[c('l'), key(Right)], "corner right").hint(0, "move the corner").does(|shared| move_corner(shared, 1, 0)),
    Key::new(REGION, "corner-left-far", &[c('H'), shift(Left)], "corner left 8 pixels").does(|shared| move_corner(shared, -8, 0)),
    Key::new(REGION, "corner-down-far", &[c('J'), shift(Down)], "corner down 8 pixels").does(|shared| move_corner(shared, 0, 8)),
    Key::new(REGION, "corner-up-far", &[c('K'), shift(Up)], "corner up 8 pixels").does(|shared| move_corner(shared, 0, -8)),
    Key::new(REGION, "corner-right-far", &[c('L'), shift(Right)], "corner right 8 pixels").does(|shared| move_corner(shared, 8, 0)),
    Key::new(REGION, "other-corner", &[key(Tab)], "other corner").hint(10, "other corner").does(swap_corners),
    Key::new(REGION, "accept", &[key(Enter)], "trace the region").hint(20, "trace it").requests(confirm_region),
    Key::new(REGION, "back", &[key(Esc)], "cancel").hint(30, "cancel").does(|shared| shared.pictures.drawing = None),
];
