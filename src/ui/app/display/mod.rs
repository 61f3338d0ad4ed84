//! What pictures show, how light is displayed, and which part of a picture is on screen.

mod jobs;
mod keys;
mod light;
mod previewing;
mod soloing;
mod symbols;
mod zooming;

pub(crate) use jobs::{final_job, retrace, shown_job, trace_job};
pub(crate) use keys::KEYS;
pub(crate) use light::{
    display_name, expose, is_light, legend, set_exposure, set_transfer, show, toggle_denoising,
    toggle_false_colours, toggle_histogram, view_name,
};
pub(crate) use previewing::{follow, follow_scene, follow_wires};
pub(crate) use soloing::{drawn_in, keep_solo, toggle_solo, toggle_solo_of};
pub use symbols::{Symbol, SymbolKind};
pub(crate) use symbols::{outlined_objects, symbol_at, symbols, toggle_symbols};
pub use zooming::frame_window;
pub(crate) use zooming::{
    ScaleOrder, cell_near, centre_on, drag_picture, magnification, magnify, magnify_about,
    magnify_at, order_scale, output_pixel_at, picture_cell, pixel_at, pixel_in_corner,
    preview_screen, scroll_picture, shift_window, toggle_scale, viewport,
};
