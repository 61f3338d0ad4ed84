//! Pictures in the form in which they are sent to terminals.

use scene::Size;

/// A picture to send.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pixmap {
    /// Size in pixels.
    pub size: Size,
    /// RGB, row by row.
    pub pixels: Vec<[u8; 3]>,
}
