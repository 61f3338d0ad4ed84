//! Numbers of pixels with room around each row, so that vectors of neighbours never leave it.

use rayon::prelude::*;

use geometry::IsCancelled;
use geometry::lanes::WIDTH;

/// Room on either side of a row: the farthest neighbours.
pub(super) const MARGIN: usize = 8;

/// A number of each pixel, laid out as [`Layout`] says.
pub(super) type Plane = Vec<f32>;

/// How the pixels of a picture are laid out, and whether work on them is to stop.
#[derive(Clone, Copy)]
pub(super) struct Layout<'c> {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Numbers in a row: whole vectors of pixels, and the room around.
    pub(super) stride: usize,
    /// Leaves planes unfinished once it returns true.
    pub(super) cancelled: IsCancelled<'c>,
}

/// The numbers in a row of this many pixels.
pub(super) fn stride(width: usize) -> usize {
    width.next_multiple_of(WIDTH) + 2 * MARGIN
}

impl<'c> Layout<'c> {
    /// The layout of so many pixels in rows of this width.
    pub(super) fn new(width: usize, pixels: usize, cancelled: IsCancelled<'c>) -> Self {
        Self {
            width,
            height: pixels / width,
            stride: stride(width),
            cancelled,
        }
    }

    /// The place of the first pixel in a row.
    pub(super) fn row(&self, y: usize) -> usize {
        y * self.stride + MARGIN
    }

    /// The place of a pixel, given its number in rows.
    pub(super) fn place(&self, pixel: usize) -> usize {
        self.row(pixel / self.width) + pixel % self.width
    }

    /// A plane of this number everywhere.
    pub(super) fn plane(&self, number: f32) -> Plane {
        vec![number; self.stride * self.height]
    }

    /// A plane of what `of` says of each pixel by its number, with `beyond` around.
    pub(super) fn filled(&self, beyond: f32, of: impl Fn(usize) -> f32 + Sync) -> Plane {
        let mut plane = self.plane(beyond);
        let rows = plane.par_chunks_exact_mut(self.stride).enumerate();
        rows.for_each(|(y, row)| {
            if (self.cancelled)() {
                return;
            }
            let pixels = row[MARGIN..][..self.width].iter_mut();
            for (pixel, number) in (y * self.width..).zip(pixels) {
                *number = of(pixel);
            }
        });
        plane
    }
}
