//! EDIT: the values of fields, nudged, typed, slid and picked.

mod choosing;
mod colouring;
mod keys;
mod nudging;
mod repeating;
mod sliding;
mod typing;

pub(crate) use choosing::{
    click_menu, close_menu, enter_value, follow_menu, menu_key, referred_to,
};
pub(crate) use colouring::{confirm_colour, move_picker, paste_colour, place_colour, take_swatch};
pub(crate) use keys::KEYS;
pub(crate) use repeating::repeat;
pub(crate) use sliding::{end_slide, press_slider, slide_to, slider};
pub(crate) use typing::{assign_whole, has_room, literals_of, typing_key};
