//! VIEW and FLY: the working view, and the views saved in the text.

mod keys;
mod moves;
mod saved_views;

pub(crate) use keys::{KEYS, OF_PAGE};
pub(crate) use moves::{advanced, dollied, orbited, shifted, turned};
pub use saved_views::SavedViews;
pub(crate) use saved_views::{look_from_light, move_camera, save_view, save_view_named};
