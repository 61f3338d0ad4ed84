//! The histogram of the picture on screen.

use std::sync::Weak;

use render::{Frame, Histogram};

/// A histogram on screen.
#[derive(Debug, Default)]
pub struct ShownHistogram {
    /// The frame counted and the exposure of the display, in half stops.
    pub(crate) of: (Weak<Frame>, i8),
    /// The counts; `None` without a picture of light or albedo.
    pub histogram: Option<Histogram>,
}

#[cfg(test)]
impl ShownHistogram {
    /// A histogram of no particular frame.
    pub(crate) fn of(histogram: Histogram) -> Self {
        Self {
            histogram: Some(histogram),
            ..Self::default()
        }
    }
}
