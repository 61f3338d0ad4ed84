//! What pictures show, and which part of them.

mod light;
pub(crate) mod pictures;
mod rendering;
mod suggestions;
mod symbols;
mod wireframe;
mod zooming;

use super::*;
