//! How a frame is seen: which part of it, on which pixels of the screen.

use std::borrow::Cow;

use crate::render::Frame;
use crate::scene::{Camera, Size};

/// How a frame is mapped to the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sight {
    /// Pixels of the picture on screen.
    pub size: Size,
    /// Pixels in each cell.
    pub grid: Grid,
    /// The part of the frame that fills them; `None` for all of it.
    pub part: Option<Part>,
}

/// Pixels in each cell, which is taken to be twice as high as wide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Pixels side by side, at least 1.
    pub across: u16,
    /// Pixels one above the other, at least 1.
    pub down: u16,
}

/// A rectangle of a frame, in pixels from its top left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Columns to its left.
    pub left: u32,
    /// Rows above it.
    pub top: u32,
    /// Width and height, at least 1.
    pub size: Size,
}

impl Sight {
    /// A sight of a whole frame on two pixels a cell.
    pub fn whole(size: Size) -> Self {
        Self {
            size,
            grid: Grid::HALF_BLOCKS,
            part: None,
        }
    }

    /// The colours of the frame's pixels as they are to be seen.
    pub(super) fn colours<'f>(&self, frame: &'f Frame) -> Cow<'f, [[u8; 3]]> {
        Cow::Borrowed(&frame.pixels)
    }

    /// The part of a frame of this size that is seen.
    pub(super) fn part_of(&self, frame: Size) -> Part {
        let whole = Part {
            left: 0,
            top: 0,
            size: frame,
        };
        self.part
            .map_or(whole, |part| part.clipped(frame).unwrap_or(whole))
    }

    /// Where a point of a frame of this size is on screen, in cells from the picture's corner.
    pub fn place_of(&self, frame: Size, [x, y]: [f64; 2]) -> [f64; 2] {
        let part = self.part_of(frame);
        let place = |at: f64, start: u32, length: u32, pixels: u32, each: u16| {
            (at - f64::from(start)) * f64::from(pixels) / (f64::from(length) * f64::from(each))
        };
        let (seen, shown) = (part.size, self.size);
        [
            place(x, part.left, seen.width, shown.width, self.grid.across),
            place(y, part.top, seen.height, shown.height, self.grid.down),
        ]
    }

    /// The number of cells of the picture.
    pub(super) fn cells(&self) -> usize {
        self.grid.cells(self.size)
    }
}

impl Part {
    /// What of it lies inside a frame of this size, if anything does.
    fn clipped(self, frame: Size) -> Option<Self> {
        let inside = |from: u32, length: u32, end: u32| {
            let length = length.min(end.checked_sub(from)?);
            (0 < length).then_some(length)
        };
        let size = Size {
            width: inside(self.left, self.size.width, frame.width)?,
            height: inside(self.top, self.size.height, frame.height)?,
        };
        Some(Self { size, ..self })
    }
}

impl Grid {
    /// Two pixels in each cell, one above the other.
    pub const HALF_BLOCKS: Self = Self { across: 1, down: 2 };

    /// The size in pixels of a picture that has the size `halves` in half blocks.
    pub fn size(self, halves: Size) -> Size {
        let Self { across, down } = self;
        Size {
            width: halves.width * u32::from(across),
            height: (halves.height * u32::from(down)).div_ceil(u32::from(Self::HALF_BLOCKS.down)),
        }
    }

    /// The camera that shows on this grid what `camera` shows on half blocks of this size.
    pub(super) fn camera(self, camera: Camera, halves: Size) -> Camera {
        if self == Self::HALF_BLOCKS {
            return camera;
        }
        let aspect = |size: Size| f64::from(size.width) / f64::from(size.height);
        Camera {
            pixel_aspect: camera.pixel_aspect * aspect(halves) / aspect(self.size(halves)),
            ..camera
        }
    }

    /// The number of cells of a picture of this size.
    pub(super) fn cells(self, size: Size) -> usize {
        self.columns(size) * size.height.div_ceil(self.down.into()) as usize
    }

    /// The number of cells in each row of a picture of this size.
    pub(super) fn columns(self, size: Size) -> usize {
        size.width.div_ceil(self.across.into()) as usize
    }

    /// The indices of the pixels in a cell of a picture of this size, row by row; the last row and
    /// column of cells may lack some.
    pub(super) fn pixels(self, size: Size, cell: usize) -> impl Iterator<Item = usize> {
        let Size { width, height } = size;
        let columns = self.columns(size);
        let left = (cell % columns) as u32 * u32::from(self.across);
        let top = (cell / columns) as u32 * u32::from(self.down);
        let rows = top..height.min(top + u32::from(self.down));
        let end = width.min(left + u32::from(self.across));
        rows.flat_map(move |y| (left..end).map(move |x| y as usize * width as usize + x as usize))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Focus, Lens};

    fn size(width: u32, height: u32) -> Size {
        Size { width, height }
    }

    #[test]
    fn a_cell_holds_the_pixels_of_its_grid() {
        let check = |(across, down), size, cell, pixels: &[usize]| {
            let grid = Grid { across, down };
            assert_eq!(grid.pixels(size, cell).collect::<Vec<_>>(), pixels);
        };
        check((1, 2), size(3, 4), 4, &[7, 10]);
        check((1, 2), size(3, 3), 4, &[7]);
        check((2, 3), size(4, 6), 3, &[14, 15, 18, 19, 22, 23]);
        check((2, 3), size(3, 4), 3, &[11]);
        assert_eq!(Grid { across: 2, down: 3 }.cells(size(3, 4)), 4);
    }

    #[test]
    fn every_grid_shows_the_same_framing() {
        let camera = Camera {
            eye: glam::DVec3::Z,
            target: glam::DVec3::ZERO,
            up: glam::DVec3::Y,
            lens: Lens::Perspective(45.0),
            pixel_aspect: 1.5,
            depths: Camera::ALL_DEPTHS,
            focus: Focus::PINHOLE,
            size: size(4, 3),
        };
        let halves = size(40, 31);
        for (across, down, expected) in [
            (1, 2, size(40, 31)),
            (2, 2, size(80, 31)),
            (2, 3, size(80, 47)),
            (2, 4, size(80, 62)),
            (8, 16, size(320, 248)),
        ] {
            let grid = Grid { across, down };
            let pixels = grid.size(halves);
            assert_eq!(pixels, expected);
            let width = |camera: Camera, size: Size| {
                camera.pixel_aspect * f64::from(size.width) / f64::from(size.height)
            };
            let seen = width(grid.camera(camera, halves), pixels);
            assert!((seen - width(camera, halves)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_part_is_clipped_to_the_frame() {
        let part = |left, top, width, height| Part {
            left,
            top,
            size: size(width, height),
        };
        for (asked, seen) in [
            (part(1, 2, 3, 3), part(1, 2, 3, 3)),
            (part(8, 5, 3, 3), part(8, 5, 2, 1)),
            (part(10, 0, 3, 3), part(0, 0, 10, 6)),
        ] {
            let sight = Sight {
                part: Some(asked),
                ..Sight::whole(size(4, 4))
            };
            assert_eq!(sight.part_of(size(10, 6)), seen);
        }
    }
}
