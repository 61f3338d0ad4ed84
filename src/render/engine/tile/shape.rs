//! The division of a picture into tiles.

use super::AREA;
use scene::Size;

/// Edge length of most tiles, in pixels; a multiple of the spacing of the coarsest grid.
const TILE: u32 = 16;

/// Width and height of a tile in pixels, both powers of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileShape {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl TileShape {
    /// Chooses squares unless the picture is narrower or lower: pixels beyond the picture cost
    /// memory too, and grids start at tile edges.
    pub(crate) fn of(size: Size) -> Self {
        let edge = |pixels: u32| pixels.min(TILE).next_power_of_two();
        if size.height < TILE {
            let height = edge(size.height);
            Self {
                width: AREA / height,
                height,
            }
        } else {
            let width = edge(size.width);
            Self {
                width,
                height: AREA / width,
            }
        }
    }

    /// Index of a pixel in a tile with this corner.
    pub(super) fn index(self, [left, top]: [u32; 2], [x, y]: [u32; 2]) -> usize {
        ((y - top) * self.width + (x - left)) as usize
    }

    /// The top left pixel of a tile with this number.
    pub(crate) fn corner(self, number: usize, size: Size) -> [u32; 2] {
        let across = self.across(size);
        [
            (number % across) as u32 * self.width,
            (number / across) as u32 * self.height,
        ]
    }

    /// The number of the tile of a pixel.
    pub(crate) fn number(self, [x, y]: [u32; 2], size: Size) -> usize {
        (y / self.height) as usize * self.across(size) + (x / self.width) as usize
    }

    /// Tiles in each row of a picture.
    pub(crate) fn across(self, size: Size) -> usize {
        size.width.div_ceil(self.width) as usize
    }

    /// Tiles in a picture.
    pub(crate) fn count(self, size: Size) -> usize {
        self.across(size) * size.height.div_ceil(self.height) as usize
    }
}
