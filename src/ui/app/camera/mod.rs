//! VIEW and FLY: the working view, and the views saved in the text.

mod keys;
mod moves;
mod room;
mod saved_views;
mod state;

pub(crate) use keys::{KEYS, OF_PAGE};
pub(crate) use room::{drag_to_pan, wheel};
pub(crate) use saved_views::{look_from_light, save_view, save_view_named};
pub use state::View;
