//! Keys of MOVE.

use crossterm::event::KeyCode;

use super::state::{Moving, Tool};
use super::transforming::{cancel, confirm, is_movable, lock_axis, start, step, toggle_snap};
use crate::app::Stride;
use crate::app::room::Row;
use crate::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{Down, Enter, Esc, Left, Right, Up};
use Scope::These;
use Stride::{Coarse, Plain};

const SELECT: &[Context] = &[In(Mode::Select)];
const SELECT_AND_FIELDS: Scope = These(&[In(Mode::Select), In(Mode::Edit)]);
const MOVE: Scope = These(&[In(Mode::Move)]);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row<Moving>] = &[
    Key::new(MOVE, "step-left", &[c('h'), key(Left)], "left; less").hint(0, "step").does_in(|moving, shared| step(moving, shared, -1, 0, Plain)),
    Key::new(MOVE, "step-down", &[c('j'), key(Down)], "down; less").hint(0, "step").does_in(|moving, shared| step(moving, shared, 0, -1, Plain)),
    Key::new(MOVE, "step-up", &[c('k'), key(Up)], "up; more").hint(0, "step").does_in(|moving, shared| step(moving, shared, 0, 1, Plain)),
    Key::new(MOVE, "step-right", &[c('l'), key(Right)], "right; more").hint(0, "step").does_in(|moving, shared| step(moving, shared, 1, 0, Plain)),
    Key::new(MOVE, "step-left-far", &[c('H'), shift(Left)], "left ten steps").does_in(|moving, shared| step(moving, shared, -1, 0, Coarse)),
    Key::new(MOVE, "step-down-far", &[c('J'), shift(Down)], "down ten steps").does_in(|moving, shared| step(moving, shared, 0, -1, Coarse)),
    Key::new(MOVE, "step-up-far", &[c('K'), shift(Up)], "up ten steps").does_in(|moving, shared| step(moving, shared, 0, 1, Coarse)),
    Key::new(MOVE, "step-right-far", &[c('L'), shift(Right)], "right ten steps").does_in(|moving, shared| step(moving, shared, 1, 0, Coarse)),
    Key::new(MOVE, "lock-x", &[c('x')], "lock to x; again: its own x").also("axis constrain").hint(10, "axis").does_in(|moving, shared| lock_axis(moving, shared, 0)),
    Key::new(MOVE, "lock-y", &[c('y')], "lock to y; again: its own y").also("axis constrain").hint(10, "axis").does_in(|moving, shared| lock_axis(moving, shared, 1)),
    Key::new(MOVE, "lock-z", &[c('z')], "lock to z; again: its own z").also("axis constrain").hint(10, "axis").does_in(|moving, shared| lock_axis(moving, shared, 2)),
    Key::new(MOVE, "snap", &[c('g')], "snap to a grid").also("grid align round").hint(40, "grid").does_in(toggle_snap),
    Key::new(MOVE, "accept", &[key(Enter)], "confirm").also("apply ok done").hint(20, "confirm").does_in(confirm),
    Key::new(MOVE, "back", &[key(Esc)], "cancel").also("abort undo").hint(30, "cancel").does_in(cancel),
];

/// Keys in other modes that start this one.
#[rustfmt::skip]
pub(crate) const ENTRIES: &[Row<Moving>] = &[
    Key::new(SELECT_AND_FIELDS, "move", &[c('m')], "move").also("translate drag position shift place transform grab shift relocate offset coordinates up down").hint_in(SELECT, 30, "move it").does_in(|moving, shared| start(moving, shared, Tool::Move)).when(|shared| is_movable(shared, Tool::Move)),
    Key::new(SELECT_AND_FIELDS, "rotate", &[c('t')], "rotate").also("turn spin angle orientation transform tilt flip yaw pitch orient").does_in(|moving, shared| start(moving, shared, Tool::Rotate)),
    Key::new(SELECT_AND_FIELDS, "scale", &[c('s')], "scale").also("resize size bigger smaller stretch grow shrink transform enlarge shrink wider taller size").does_in(|moving, shared| start(moving, shared, Tool::Scale)),
];
