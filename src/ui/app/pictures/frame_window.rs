//! How a frame is seen: which part of it, on which pixels of the screen.

use std::borrow::Cow;
use std::ops::Range;

use render::{Display, Frame, Region};
use scene::Size;

/// How a picture is mapped to the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameWindow {
    /// Pixels of the picture on screen.
    pub size: Size,
    /// Pixels in each cell.
    pub grid: Grid,
    /// The part of the picture that fills them; `None` for all of it.
    pub window: Option<Window>,
    /// The region that is marked.
    pub marked: Option<Marked>,
    /// How light is displayed.
    pub display: Display,
}

/// The part of a picture that is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// The size of the whole picture at this scale.
    pub whole: Size,
    /// The part of it.
    pub part: Region,
    /// The pixels on screen that the part covers; those beyond the screen are cut off.
    pub fills: Size,
}

/// A window along one axis, in pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    /// The length of the whole picture at this scale.
    pub(crate) whole: u32,
    /// The first pixel of the part.
    pub(crate) start: u32,
    /// The length of the part.
    pub(crate) length: u32,
    /// The pixels on screen that the part covers.
    pub(crate) fills: u32,
}

/// A region of a picture, marked on screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Marked {
    /// The size of the whole picture.
    pub whole: Size,
    /// The region.
    pub region: Region,
    /// Why it is marked.
    pub reason: Reason,
}

/// Why a region is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// It is being drawn.
    Drawn,
    /// It alone is traced.
    Traced,
}

/// Pixels in each cell, which is taken to be twice as high as wide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Pixels side by side, at least 1.
    pub across: u16,
    /// Pixels one above the other, at least 1.
    pub down: u16,
}

impl FrameWindow {
    /// A window over a whole frame on two pixels a cell.
    pub fn whole(size: Size) -> Self {
        Self {
            size,
            grid: Grid::HALF_BLOCKS,
            window: None,
            marked: None,
            display: Display::default(),
        }
    }

    /// The colours of the frame's pixels as they are to be seen.
    pub(crate) fn colours<'f>(&self, frame: &'f Frame) -> Cow<'f, [[u8; 3]]> {
        let displayed = self.display.apply(frame);
        displayed.map_or(Cow::Borrowed(&frame.pixels), Cow::Owned)
    }

    /// What of a picture of this size is seen.
    pub(crate) fn window_of(&self, whole: Size) -> Window {
        self.window.unwrap_or_else(|| Window {
            whole,
            part: Region::whole(whole),
            fills: self.size,
        })
    }

    /// The pixel, in a picture of this size, under the upper half of a cell, counted from the
    /// picture's upper left one.
    pub fn pixel_at(&self, (column, row): (u16, u16), whole: Size) -> Option<[u32; 2]> {
        let Grid { across, down } = self.grid;
        let x = u32::from(column) * u32::from(across) + u32::from(across) / 2;
        let y = u32::from(row) * u32::from(down) + u32::from(down) / 4;
        if self.size.width <= x || self.size.height <= y {
            return None;
        }
        let [columns, rows] = self.window_of(whole).extents();
        Some([columns.pixel(x, whole.width)?, rows.pixel(y, whole.height)?])
    }

    /// Where a place of the whole picture is on screen, both in half blocks from its upper left
    /// corner, if the whole picture has the size `halves`.
    pub fn on_screen(&self, [x, y]: [f64; 2], halves: Size) -> [f64; 2] {
        let Some(window) = self.window else {
            return [x, y];
        };
        let [columns, rows] = window.extents();
        let [across, down] = [self.grid.across, self.grid.down].map(f64::from);
        [
            columns.on_screen(x, halves.width) / across,
            rows.on_screen(y, halves.height) / (0.5 * down),
        ]
    }

    /// How much larger it shows the picture than if it showed all of it in the size `halves`.
    pub fn magnification(&self, halves: Size) -> f64 {
        let [from, to] = [0.0, 1.0].map(|x| self.on_screen([x, 0.0], halves)[0]);
        to - from
    }

    /// The number of cells of the picture.
    pub(crate) fn cells(&self) -> usize {
        self.grid.cells(self.size)
    }
}

impl Window {
    /// What it is along x, and along y.
    pub(crate) fn extents(self) -> [Extent; 2] {
        let Self { whole, part, fills } = self;
        [
            Extent {
                whole: whole.width,
                start: part.x,
                length: part.width,
                fills: fills.width,
            },
            Extent {
                whole: whole.height,
                start: part.y,
                length: part.height,
                fills: fills.height,
            },
        ]
    }
}

impl Extent {
    /// The pixels that pixel `at` on screen covers, at least one; `None` beyond the part.
    pub(crate) fn covered(self, at: u32) -> Option<Range<usize>> {
        let [length, fills] = [self.length, self.fills.max(1)].map(u64::from);
        let scaled = |at: u32| u64::from(at) * length / fills;
        let (first, end) = (scaled(at), scaled(at + 1));
        let end = end.max(first + 1).min(length);
        let start = self.start as usize;
        (first < end).then(|| start + first as usize..start + end as usize)
    }

    /// The pixel of a picture of another length under the middle of pixel `at` on screen; `None` beyond the
    /// part.
    fn pixel(self, at: u32, whole: u32) -> Option<u32> {
        let [at, length, fills] = [at, self.length, self.fills.max(1)].map(u64::from);
        // Twice the centre of the pixel on screen, in pixels of the part.
        let within = (2 * at + 1) * length / fills;
        let twice = 2 * u64::from(self.start) + within;
        let twice = twice * u64::from(whole) / u64::from(self.whole.max(1));
        let pixel = (twice / 2).min(u64::from(whole.max(1)) - 1) as u32;
        (at * length / fills < length).then_some(pixel)
    }

    /// Where a place of a picture of another length is on screen, in pixels.
    fn on_screen(self, at: f64, whole: u32) -> f64 {
        let at = at / f64::from(whole) * f64::from(self.whole) - f64::from(self.start);
        at * f64::from(self.fills) / f64::from(self.length)
    }
}

impl Default for Grid {
    fn default() -> Self {
        Self::HALF_BLOCKS
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

    /// The number of cells of a picture of this size.
    pub(crate) fn cells(self, size: Size) -> usize {
        self.columns(size) * size.height.div_ceil(self.down.into()) as usize
    }

    /// The number of cells in each row of a picture of this size.
    pub(crate) fn columns(self, size: Size) -> usize {
        size.width.div_ceil(self.across.into()) as usize
    }

    /// The indices of the pixels in a cell of a picture of this size, row by row; the last row and
    /// column of cells may lack some.
    pub(crate) fn pixels(self, size: Size, cell: usize) -> impl Iterator<Item = usize> {
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
    fn every_grid_divides_the_same_cells() {
        for (across, down, expected) in [
            (1, 2, size(40, 31)),
            (2, 2, size(80, 31)),
            (2, 3, size(80, 47)),
            (2, 4, size(80, 62)),
            (8, 16, size(320, 248)),
        ] {
            assert_eq!(Grid { across, down }.size(size(40, 31)), expected);
        }
    }

    #[test]
    fn cells_find_the_pixels_they_show() {
        let whole = size(40, 30);
        let frame_window = |part: &str, fills| FrameWindow {
            window: Some(Window {
                whole,
                part: Region::parse(part).expect("a region"),
                fills,
            }),
            ..FrameWindow::whole(size(20, 12))
        };
        let all = FrameWindow::whole(size(20, 12));
        let blocks = frame_window("8,6,5,3", size(20, 12));
        let cut = frame_window("8,6,3,2", size(24, 16));
        let narrow = frame_window("8,6,4,3", size(16, 12));
        for (frame_window, cell, whole, pixel) in [
            (all, (0, 0), whole, Some([1, 1])),
            (all, (19, 5), whole, Some([39, 26])),
            (all, (20, 0), whole, None),
            (blocks, (0, 0), whole, Some([8, 6])),
            (blocks, (3, 1), whole, Some([8, 6])),
            (blocks, (4, 2), whole, Some([9, 7])),
            (blocks, (4, 2), size(80, 60), Some([18, 14])),
            (cut, (8, 4), whole, Some([9, 7])),
            (narrow, (16, 0), whole, None),
        ] {
            assert_eq!(
                frame_window.pixel_at(cell, whole),
                pixel,
                "{frame_window:?} {cell:?}"
            );
        }
    }

    #[test]
    fn places_move_with_the_window() {
        let halves = size(20, 12);
        let frame_window = FrameWindow {
            window: Some(Window {
                whole: size(40, 24),
                part: Region::parse("8,6,5,3").expect("a region"),
                fills: halves,
            }),
            ..FrameWindow::whole(halves)
        };
        assert_eq!(frame_window.on_screen([4.0, 3.0], halves), [0.0, 0.0]);
        assert_eq!(frame_window.on_screen([6.5, 4.5], halves), [20.0, 12.0]);
        let whole = FrameWindow::whole(halves);
        assert_eq!(whole.on_screen([4.0, 3.0], halves), [4.0, 3.0]);
    }
}
