//! VIEW and FLY: the working view, and the views saved in the text.

mod keys;
mod moves;
mod room;
mod saved_views;
mod state;
mod working_view;

pub(crate) use keys::{KEYS, OF_PAGE};
pub(crate) use room::{drag_to_pan, wheel};
pub(crate) use saved_views::save_view_named;
pub use state::View;
pub(crate) use working_view::{look_from_light, save_view};
