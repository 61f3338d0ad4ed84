//! Keys of MOVE.

use crossterm::event::KeyCode;

use super::transforming::{cancel, confirm, lock_axis, step, toggle_snap};
use crate::ui::app::Stride;
use crate::ui::app::room::Row;
use crate::ui::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{Down, Enter, Esc, Left, Right, Up};
use Scope::These;
use Stride::{Coarse, Plain};

const MOVE: Scope = These(&[In(Mode::Move)]);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(MOVE, "step-left", &[c('h'), key(Left)], "left; less").hint(0, "step").does(|shared| step(shared, -1, 0, Plain)),
    Key::new(MOVE, "step-down", &[c('j'), key(Down)], "down; less").hint(0, "step").does(|shared| step(shared, 0, -1, Plain)),
    Key::new(MOVE, "step-up", &[c('k'), key(Up)], "up; more").hint(0, "step").does(|shared| step(shared, 0, 1, Plain)),
    Key::new(MOVE, "step-right", &[c('l'), key(Right)], "right; more").hint(0, "step").does(|shared| step(shared, 1, 0, Plain)),
    Key::new(MOVE, "step-left-far", &[c('H'), shift(Left)], "left ten steps").does(|shared| step(shared, -1, 0, Coarse)),
    Key::new(MOVE, "step-down-far", &[c('J'), shift(Down)], "down ten steps").does(|shared| step(shared, 0, -1, Coarse)),
    Key::new(MOVE, "step-up-far", &[c('K'), shift(Up)], "up ten steps").does(|shared| step(shared, 0, 1, Coarse)),
    Key::new(MOVE, "step-right-far", &[c('L'), shift(Right)], "right ten steps").does(|shared| step(shared, 1, 0, Coarse)),
    Key::new(MOVE, "lock-x", &[c('x')], "lock to x; again: its own x").hint(10, "axis").does(|shared| lock_axis(shared, 0)),
    Key::new(MOVE, "lock-y", &[c('y')], "lock to y; again: its own y").hint(10, "axis").does(|shared| lock_axis(shared, 1)),
    Key::new(MOVE, "lock-z", &[c('z')], "lock to z; again: its own z").hint(10, "axis").does(|shared| lock_axis(shared, 2)),
    Key::new(MOVE, "snap", &[c('g')], "snap to a grid").hint(40, "grid").does(toggle_snap),
    Key::new(MOVE, "accept", &[key(Enter)], "confirm").hint(20, "confirm").does(confirm),
    Key::new(MOVE, "back", &[key(Esc)], "cancel").hint(30, "cancel").does(cancel),
];
