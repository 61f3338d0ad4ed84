//! What is written to a picture file.

use std::sync::Arc;

use render::{Aov, Frame, Provenance};

/// A picture to write.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'p> {
    /// Its pixels.
    pub frame: &'p Frame,
    /// AOVs of the same size, with floating-point values, which EXR holds beside the light.
    pub layers: &'p [(Aov, Arc<Frame>)],
    /// What it is made from, which PNG and EXR say.
    pub provenance: Option<&'p Provenance>,
}

impl<'p> Picture<'p> {
    /// A picture without layers that does not say what it is made from.
    pub fn of(frame: &'p Frame) -> Self {
        Self {
            frame,
            layers: &[],
            provenance: None,
        }
    }
}
