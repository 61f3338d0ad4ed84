//! Keys of EDIT and of the colour picker.

use crossterm::event::KeyCode;

use super::choosing::enter_value;
use super::colouring::{cancel_colour, confirm_colour, open_picker, step_colour};
use super::nudging::{change_stride, next_component, nudge};
use super::typing::type_current;
use crate::app::room::Row;
use crate::app::{Shared, Stride, select};
use crate::keymap::{Context, Key, Mode, Scope, alt, c, key, shift};
use language::schema::Kind;

use Context::In;
use KeyCode::{BackTab, Char, Enter, Esc, Left, Right, Tab};
use Scope::These;
use Stride::{Coarse, Fine, Plain};

const EDIT: Scope = These(&[In(Mode::Edit)]);
const COLOUR: Scope = These(&[Context::Colour]);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(EDIT, "nudge-up", &[c('l'), key(Right)], "nudge up").also("increase raise more increment bigger value number").hint(11, "nudge").does(|shared| nudge(shared, 1, Plain)).when(has_steps),
    Key::new(EDIT, "nudge-down", &[c('h'), key(Left)], "nudge down").also("decrease lower less decrement smaller value number").hint(10, "nudge").does(|shared| nudge(shared, -1, Plain)).when(has_steps),
    Key::new(EDIT, "choose", &[key(Enter)], "choose from a list, or type a number").also("select option dropdown value number").hint(30, "type").does(enter_value),
    Key::new(EDIT, "type", &[c('i')], "type a value (or press a digit or #)").also("enter number value input exact").does(type_current),
    Key::new(EDIT, "pick-colour", &[c('c')], "pick a colour").also("color paint hue rgb hsv material palette diffuse tint recolor swatch red green blue saturation tone shade").hint(50, "colour").does(open_picker).when(has_colour),
    Key::new(EDIT, "next-number", &[key(Tab)], "next number").also("component field jump").hint(70, "next number").does(|shared| next_component(shared, 1)).when(has_components),
    Key::new(EDIT, "nudge-up-coarse", &[c('L'), shift(Right)], "nudge up ten steps").does(|shared| nudge(shared, 1, Coarse)),
    Key::new(EDIT, "nudge-down-coarse", &[c('H'), shift(Left)], "nudge down ten steps").does(|shared| nudge(shared, -1, Coarse)),
    Key::new(EDIT, "nudge-up-fine", &[alt(Char('l')), alt(Right)], "nudge up a tenth").does(|shared| nudge(shared, 1, Fine)),
    Key::new(EDIT, "nudge-down-fine", &[alt(Char('h')), alt(Left)], "nudge down a tenth").does(|shared| nudge(shared, -1, Fine)),
    Key::new(EDIT, "smaller-steps", &[c(',')], "smaller steps").also("step precision fine increment").hint(20, "step").does(|shared| change_stride(shared, -1)).when(has_number),
    Key::new(EDIT, "larger-steps", &[c(';')], "larger steps").also("step coarse increment").hint(20, "step").does(|shared| change_stride(shared, 1)).when(has_number),
    Key::new(EDIT, "previous-number", &[key(BackTab)], "previous number").does(|shared| next_component(shared, -1)),
    Key::new(EDIT, "orthonormalise", &[c('O')], "orthonormalise the frame").also("rotation matrix perpendicular axes fix").hint(60, "orthonormalise").does(select::orthonormalise).when(has_oblique_frame),
    Key::new(EDIT, "camera", &[c('v')], "move the camera").also("view orbit").does(|shared| shared.enter(Mode::View)),
    Key::new(COLOUR, "nudge-up", &[c('l'), key(Right)], "nudge up").also("increase raise more increment bigger value number").hint(1, "change").does(|shared| step_colour(shared, 1, Plain)),
    Key::new(COLOUR, "nudge-down", &[c('h'), key(Left)], "nudge down").also("decrease lower less decrement smaller value number").hint(0, "change").does(|shared| step_colour(shared, -1, Plain)),
    Key::new(COLOUR, "nudge-up-coarse", &[c('L'), shift(Right)], "nudge up ten steps").does(|shared| step_colour(shared, 1, Coarse)),
    Key::new(COLOUR, "nudge-down-coarse", &[c('H'), shift(Left)], "nudge down ten steps").does(|shared| step_colour(shared, -1, Coarse)),
    Key::new(COLOUR, "nudge-up-fine", &[alt(Char('l')), alt(Right)], "nudge up a tenth").does(|shared| step_colour(shared, 1, Fine)),
    Key::new(COLOUR, "nudge-down-fine", &[alt(Char('h')), alt(Left)], "nudge down a tenth").does(|shared| step_colour(shared, -1, Fine)),
    Key::new(COLOUR, "smaller-steps", &[c(',')], "smaller steps").also("step precision fine increment").hint(20, "step").does(|shared| change_stride(shared, -1)),
    Key::new(COLOUR, "larger-steps", &[c(';')], "larger steps").also("step coarse increment").hint(20, "step").does(|shared| change_stride(shared, 1)),
    Key::new(COLOUR, "accept", &[key(Enter)], "confirm").hint(30, "confirm").does(confirm_colour),
    Key::new(COLOUR, "back", &[key(Esc)], "cancel").hint(40, "cancel").does(cancel_colour),
];

/// Whether the field under the cursor is a colour.
fn has_colour(shared: &Shared) -> bool {
    let row = shared.field_row(shared.cursor.field);
    row.is_some_and(|row| row.colour().is_some())
}

/// Whether it is changed by steps of some size.
fn has_number(shared: &Shared) -> bool {
    let row = shared.field_row(shared.cursor.field);
    row.is_some_and(|row| row.field.kind.is_numeric())
}

/// Whether it is changed by steps.
fn has_steps(shared: &Shared) -> bool {
    let row = shared.field_row(shared.cursor.field);
    row.is_some_and(|row| row.field.kind != Kind::Word)
}

/// Whether the selected node has several components.
fn has_components(shared: &Shared) -> bool {
    let fields = shared.cursor.fields().iter();
    let components = fields.map(|placed| placed.field.kind.components());
    1 < components.sum::<usize>()
}

/// Whether it has a frame whose directions are not orthonormal.
fn has_oblique_frame(shared: &Shared) -> bool {
    let edits = shared.source().orthonormalised(shared.cursor.selected());
    edits.is_ok_and(|edits| !edits.is_empty())
}
