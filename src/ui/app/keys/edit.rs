//! Keys of EDIT and of the colour picker.

use crossterm::event::KeyCode;

use super::row::Row;
use crate::ui::app::{Shared, Stride};
use crate::ui::keymap::{Context, Key, Mode, Scope, alt, c, key, shift};

use Context::In;
use KeyCode::{BackTab, Char, Enter, Esc, Left, Right, Tab};
use Scope::These;
use Stride::{Coarse, Fine, Plain};

const EDIT: Scope = These(&[In(Mode::Edit)]);
const COLOUR: Scope = These(&[Context::Colour]);

/// The most useful first.
#[rustfmt::skip]
pub(in crate::ui::app) const KEYS: &[Row] = &[
    Key::new(EDIT, "nudge-up", &[c('l'), key(Right)], "nudge up").hint(11, "nudge").does(|shared| shared.nudge(1, Plain)).when(Shared::has_steps),
    Key::new(EDIT, "nudge-down", &[c('h'), key(Left)], "nudge down").hint(10, "nudge").does(|shared| shared.nudge(-1, Plain)).when(Shared::has_steps),
    Key::new(EDIT, "choose", &[key(Enter)], "choose from a list, or type a number").hint(30, "type").does(Shared::enter_value),
    Key::new(EDIT, "type", &[c('i')], "type a value (or press a digit or #)").does(Shared::type_current),
    Key::new(EDIT, "pick-colour", &[c('c')], "pick a colour").also("color material").hint(50, "colour").does(Shared::open_picker).when(Shared::has_colour),
    Key::new(EDIT, "next-number", &[key(Tab)], "next number").hint(70, "next number").does(|shared| shared.next_component(1)).when(Shared::has_components),
    Key::new(EDIT, "nudge-up-coarse", &[c('L'), shift(Right)], "nudge up ten steps").does(|shared| shared.nudge(1, Coarse)),
    Key::new(EDIT, "nudge-down-coarse", &[c('H'), shift(Left)], "nudge down ten steps").does(|shared| shared.nudge(-1, Coarse)),
    Key::new(EDIT, "nudge-up-fine", &[alt(Char('l')), alt(Right)], "nudge up a tenth").does(|shared| shared.nudge(1, Fine)),
    Key::new(EDIT, "nudge-down-fine", &[alt(Char('h')), alt(Left)], "nudge down a tenth").does(|shared| shared.nudge(-1, Fine)),
    Key::new(EDIT, "smaller-steps", &[c(',')], "smaller steps").hint(20, "step").does(|shared| shared.overlays.say(shared.cursor.change_stride(-1))).when(Shared::has_number),
    Key::new(EDIT, "larger-steps", &[c(';')], "larger steps").hint(20, "step").does(|shared| shared.overlays.say(shared.cursor.change_stride(1))).when(Shared::has_number),
    Key::new(EDIT, "previous-number", &[key(BackTab)], "previous number").does(|shared| shared.next_component(-1)),
    Key::new(EDIT, "orthonormalise", &[c('O')], "orthonormalise the frame").hint(60, "orthonormalise").does(Shared::orthonormalise).when(Shared::has_oblique_frame),
    Key::new(EDIT, "camera", &[c('v')], "move the camera").requests(|shared| shared.go(Mode::View)),
    Key::new(COLOUR, "nudge-up", &[c('l'), key(Right)], "nudge up").hint(1, "change").does(|shared| shared.step_colour(1, Plain)),
    Key::new(COLOUR, "nudge-down", &[c('h'), key(Left)], "nudge down").hint(0, "change").does(|shared| shared.step_colour(-1, Plain)),
    Key::new(COLOUR, "nudge-up-coarse", &[c('L'), shift(Right)], "nudge up ten steps").does(|shared| shared.step_colour(1, Coarse)),
    Key::new(COLOUR, "nudge-down-coarse", &[c('H'), shift(Left)], "nudge down ten steps").does(|shared| shared.step_colour(-1, Coarse)),
    Key::new(COLOUR, "nudge-up-fine", &[alt(Char('l')), alt(Right)], "nudge up a tenth").does(|shared| shared.step_colour(1, Fine)),
    Key::new(COLOUR, "nudge-down-fine", &[alt(Char('h')), alt(Left)], "nudge down a tenth").does(|shared| shared.step_colour(-1, Fine)),
    Key::new(COLOUR, "smaller-steps", &[c(',')], "smaller steps").hint(20, "step").does(|shared| shared.overlays.say(shared.cursor.change_stride(-1))),
    Key::new(COLOUR, "larger-steps", &[c(';')], "larger steps").hint(20, "step").does(|shared| shared.overlays.say(shared.cursor.change_stride(1))),
    Key::new(COLOUR, "accept", &[key(Enter)], "confirm").hint(30, "confirm").does(Shared::confirm_colour),
    Key::new(COLOUR, "back", &[key(Esc)], "cancel").hint(40, "cancel").does(Shared::cancel_colour),
];
