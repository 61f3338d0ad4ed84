//! Surroundings and output settings.

use super::{Rendering, Tinted};

/// The surroundings of a scene and the render settings its text asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setting {
    /// The background of camera rays, stretched over the whole picture.
    pub background: Tinted,
    /// The radiance of all other rays that hit nothing.
    pub environment: Tinted,
    /// The render settings asked for.
    pub rendering: Rendering,
}
