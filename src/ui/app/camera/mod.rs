//! VIEW and FLY: the working view, and the views saved in the text.

mod keys;
mod moves;
mod saved_views;

pub(crate) use keys::KEYS;
pub(crate) use moves::{advanced, dollied, orbited, shifted, turned};
pub(crate) use saved_views::{
    delete_view, follow_views, go_to_view, look_from_light, move_camera, save_view, save_view_named,
};
