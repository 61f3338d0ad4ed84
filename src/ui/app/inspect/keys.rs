//! Keys of INSPECT and of the rays behind a pixel.

use crossterm::event::KeyCode;

use super::explaining::{
    change_sample, explained_node, explains_light, fold_ray, sample_count, select_explained,
    solo_explained, start_explaining,
};
use super::inspecting::{move_cross, select_crossed, start};
use crate::app::Fold;
use crate::app::room::Row;
use crate::keymap::{Context, Key, Mode, Scope, c, key, shift};

use Context::In;
use KeyCode::{Down, Enter, Left, Right, Up};
use Scope::These;

/// Where no letter is part of a value, and the cross has another key.
const INSPECTABLE: Scope = These(&[
    In(Mode::Select),
    In(Mode::View),
    In(Mode::Fly),
    In(Mode::Trace),
    In(Mode::Compare),
]);
const INSPECT: Scope = These(&[In(Mode::Inspect)]);
const RAYS: Scope = These(&[Context::Rays]);
const SELECT: &[Context] = &[In(Mode::Select)];
const TRACE: &[Context] = &[In(Mode::Trace)];

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(INSPECTABLE, "inspect", &[c('i')], "inspect a pixel of the picture").also("pixel probe pick color value eyedropper what why debug identify where click point hover coordinates rgb").hint_in(SELECT, 50, "inspect").stays().hint_in(TRACE, 60, "inspect").does(start),
    Key::new(INSPECT, "cross-left", &[c('h'), key(Left)], "left").hint(0, "move").does(|shared| move_cross(shared, -1, 0)),
    Key::new(INSPECT, "cross-down", &[c('j'), key(Down)], "down").hint(0, "move").does(|shared| move_cross(shared, 0, 1)),
    Key::new(INSPECT, "cross-up", &[c('k'), key(Up)], "up").hint(0, "move").does(|shared| move_cross(shared, 0, -1)),
    Key::new(INSPECT, "cross-right", &[c('l'), key(Right)], "right").hint(0, "move").does(|shared| move_cross(shared, 1, 0)),
    Key::new(INSPECT, "cross-left-far", &[c('H'), shift(Left)], "left 8 pixels").does(|shared| move_cross(shared, -8, 0)),
    Key::new(INSPECT, "cross-down-far", &[c('J'), shift(Down)], "down 8 pixels").does(|shared| move_cross(shared, 0, 8)),
    Key::new(INSPECT, "cross-up-far", &[c('K'), shift(Up)], "up 8 pixels").does(|shared| move_cross(shared, 0, -8)),
    Key::new(INSPECT, "cross-right-far", &[c('L'), shift(Right)], "right 8 pixels").does(|shared| move_cross(shared, 8, 0)),
    Key::new(INSPECT, "accept", &[key(Enter)], "select what is there").hint(20, "select").does(select_crossed),
    Key::new(INSPECT, "explain", &[c('e')], "explain the pixel").also("why shadow dark black reason cause wrong debug reflection missing invisible bounce ray noise bright").hint(10, "explain").does(start_explaining),
    Key::new(RAYS, "accept", &[key(Enter)], "select its object or light").hint(10, "select").does(select_explained).when(|shared| explained_node(shared).is_some()),
    Key::new(RAYS, "solo", &[c('l')], "show only its light in the preview").also("isolate light").hint(40, "solo light").does(solo_explained).when(explains_light),
    Key::new(RAYS, "fold", &[key(Left)], "fold it, or go to what it is in").does(|shared| fold_ray(shared, Fold::Selected)),
    Key::new(RAYS, "unfold", &[key(Right)], "unfold it, or go into it").does(|shared| fold_ray(shared, Fold::Unselected)),
    Key::new(RAYS, "previous-sample", &[c(',')], "previous sample").also("ray").hint(50, "sample").does(|shared| change_sample(shared, -1)).when(|shared| 1 < sample_count(shared)),
    Key::new(RAYS, "next-sample", &[c('.')], "next sample").also("ray").hint(50, "sample").does(|shared| change_sample(shared, 1)).when(|shared| 1 < sample_count(shared)),
];
