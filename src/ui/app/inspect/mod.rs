//! INSPECT: a cross over the picture, what is under it, and the rays that explain it.

mod explaining;
mod inspecting;
mod keys;
mod pixel;
mod room;

pub use explaining::RayPanels;
pub(crate) use explaining::{
    explain_at, explained, explanation, move_in_rays, node_in_focus, object_named, ray_line,
    ray_lines, ray_node, ray_panels, ray_path, sample_count, verdict_lines,
};
pub(crate) use inspecting::{
    cross, cross_cell, free_side, line_of, node_at, pick, pick_symbol, place_on_screen, start, stop,
};
pub(crate) use keys::KEYS;
pub use pixel::Pixel;
pub(crate) use pixel::pixel;
pub use room::Inspect;
