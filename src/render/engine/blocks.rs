//! The division of a picture into square blocks, each of which is decided on, traced and stored apart
//! from the others.

use crate::job::Region;
use scene::Size;

/// Edge length of blocks in pixels; blocks at the right and lower edges of a picture are cut.
pub const BLOCK: u32 = 32;

/// The division of a picture into blocks, numbered in rows from the top left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blocks {
    size: Size,
}

impl Blocks {
    /// Divides a picture of this size.
    pub fn of(size: Size) -> Self {
        Self { size }
    }

    /// The number of blocks in each row.
    pub fn across(self) -> u32 {
        self.size.width.div_ceil(BLOCK)
    }

    /// The number of blocks.
    pub fn count(self) -> u32 {
        self.across() * self.size.height.div_ceil(BLOCK)
    }

    /// The pixels of a block.
    pub fn region(self, number: u32) -> Region {
        let (x, y) = (
            number % self.across() * BLOCK,
            number / self.across() * BLOCK,
        );
        Region {
            x,
            y,
            width: BLOCK.min(self.size.width - x),
            height: BLOCK.min(self.size.height - y),
        }
    }

    /// The number of pixels of a block.
    pub fn area(self, number: u32) -> usize {
        self.region(number).size().pixels()
    }
}
