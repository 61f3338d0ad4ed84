//! The picture on screen, and the newer one that replaces it as fast as the link allows.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::render::{Frame, NO_OBJECT, Progress};
use crate::scene::Size;

/// Mean cost of sending one changed cell to the terminal, in bytes.
const BYTES_PER_CELL: usize = 24;

/// Channel error up to which pixels of an unfinished picture are not sent over a slow link.
const HYSTERESIS: u8 = 3;

/// A picture of a scene: what is on screen, and the newest frame.
#[derive(Debug, Default)]
pub struct Picture {
    /// The generation requested last; older frames show an older scene. `None` while nothing is
    /// running, before a start or after a stop.
    pub wanted: Option<u64>,
    /// The size requested last.
    pub asked: Option<Size>,
    /// The newest frame; `None` before the first.
    pub latest: Option<Arc<Frame>>,
    /// The picture on screen.
    pub shown: Shown,
    target: Shown,
    /// The cell to compare next, in row-major order.
    cursor: usize,
    /// The number of cells not yet compared with the target.
    left: usize,
    /// The object outlined in the target.
    outlined: Vec<u32>,
    /// The cells in which the outline changes. They are sent first, because they answer a key.
    outline: VecDeque<usize>,
}

/// Pixels as shown on screen: each cell has two, one above the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shown {
    /// Size in pixels, as [`raster`](crate::ui::layout::raster) computed it for the picture's area.
    pub size: Size,
    /// RGB, row by row.
    pub pixels: Vec<[u8; 3]>,
    /// The object under each pixel, or [`NO_OBJECT`].
    pub objects: Vec<u32>,
    /// Whether each pixel is on the outline of the selected object; empty without an outline.
    pub outline: Vec<bool>,
}

impl Default for Shown {
    fn default() -> Self {
        Self {
            size: Size {
                width: 0,
                height: 0,
            },
            pixels: Vec::new(),
            objects: Vec::new(),
            outline: Vec::new(),
        }
    }
}

impl Shown {
    /// Returns the object under a pixel.
    pub fn object_at(&self, x: u32, y: u32) -> Option<u32> {
        if self.size.width <= x {
            return None;
        }
        let at = y as usize * self.size.width as usize + x as usize;
        let object = self.objects.get(at).copied()?;
        (object != NO_OBJECT).then_some(object)
    }

    /// Whether the pixel with this index is on the outline.
    pub fn is_outlined(&self, at: usize) -> bool {
        self.outline.get(at) == Some(&true)
    }

    /// Computes the outline of objects, ascending: their pixels that border on others. The edge of the picture
    /// does not count as a border, so that an object extending beyond it is not framed there.
    fn outline_of(&self, objects: &[u32]) -> Vec<bool> {
        let Size { width, height } = self.size;
        let is_object = |x: u32, y: u32| {
            let inside = x < width && y < height;
            let at = y as usize * width as usize + x as usize;
            let is_outlined = |object: &u32| objects.binary_search(object).is_ok();
            !inside || self.objects.get(at).is_some_and(is_outlined)
        };
        let is_border = |x: u32, y: u32| {
            let neighbours = [
                (x.wrapping_sub(1), y),
                (x + 1, y),
                (x, y.wrapping_sub(1)),
                (x, y + 1),
            ];
            is_object(x, y) && !neighbours.iter().all(|&(x, y)| is_object(x, y))
        };
        (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| is_border(x, y))
            .collect()
    }

    /// Resamples the picture, without its outline: averages when shrinking, repeats the nearest
    /// pixels when enlarging.
    #[must_use]
    pub fn resampled(&self, size: Size) -> Self {
        resample(&self.pixels, &self.objects, self.size, size)
    }
}

impl Picture {
    /// Takes a frame. Frames must arrive in the order in which they were made.
    pub fn take(&mut self, frame: Arc<Frame>) {
        self.latest = Some(frame);
        self.target = Shown::default();
    }

    /// Whether a frame is the first of its generation, the answer to an edit.
    pub fn is_first(&self, frame: &Frame) -> bool {
        let latest = self.latest.as_ref();
        latest.is_none_or(|latest| latest.generation != frame.generation)
    }

    /// Progress of the newest frame, unless it is of an older generation than requested.
    pub fn progress(&self) -> Option<&Progress> {
        self.latest
            .as_ref()
            .filter(|frame| self.wanted == Some(frame.generation))
            .map(|frame| &frame.progress)
    }

    /// Whether the newest frame shows an older scene than requested. The objects under its pixels
    /// are numbered as in that scene.
    pub fn is_outdated(&self) -> bool {
        let latest = self.latest.as_ref();
        latest.is_some_and(|frame| self.wanted.is_some_and(|wanted| wanted != frame.generation))
    }

    /// Forgets the objects under the pixels on screen until a newer frame arrives: after
    /// renumbering, the outline would be around an object that is not selected.
    pub fn forget_objects(&mut self) {
        self.shown.objects.fill(NO_OBJECT);
        self.outline(&[]);
    }

    /// Whether every requested sample has been taken and is on its way to the screen.
    pub fn is_complete(&self) -> bool {
        self.progress().is_some_and(|progress| progress.complete)
    }

    /// Whether a sample was requested that is not taken yet.
    pub fn is_awaited(&self) -> bool {
        self.wanted.is_some() && !self.is_complete()
    }

    /// Whether a pixel was requested that has no sample of its own yet.
    pub fn is_coarse(&self) -> bool {
        self.is_awaited() && self.progress().is_none_or(|progress| progress.spp < 1)
    }

    /// Copies cells of the newest frame, with the outlines of `outlined`, to the screen until `budget`
    /// bytes are spent, and continues there next time; `usize::MAX` copies the whole frame. Changes
    /// of the outline go first. Over a limited link, pixels of an unfinished frame that are almost
    /// right are skipped; a finished frame is shown exactly.
    pub fn advance(&mut self, size: Size, outlined: &[u32], budget: usize) {
        self.aim(size, outlined);
        let tolerance = match budget {
            usize::MAX => 0,
            _ if self.latest.as_ref().is_some_and(|f| f.progress.complete) => 0,
            _ => HYSTERESIS,
        };
        let cells = cells(size);
        let mut spent = 0;
        while spent < budget {
            let cell = if let Some(cell) = self.outline.pop_front() {
                cell
            } else if 0 < self.left {
                let cell = self.cursor;
                self.cursor = (cell + 1) % cells;
                self.left -= 1;
                cell
            } else {
                break;
            };
            if self.bring_cell(cell, tolerance) {
                spent += BYTES_PER_CELL;
            }
        }
    }

    /// Whether parts of the newest frame are not on screen yet.
    pub fn is_pending(&self) -> bool {
        0 < self.left || !self.outline.is_empty()
    }

    /// Makes the newest frame at this size the target, with the outline of an object.
    fn aim(&mut self, size: Size, outlined: &[u32]) {
        let Some(frame) = &self.latest else {
            return;
        };
        let mut is_stale = self.outlined != outlined;
        if self.shown.size != size {
            is_stale = true;
            self.shown = if self.shown.pixels.is_empty() {
                Shown {
                    size,
                    pixels: vec![[0; 3]; size.pixels()],
                    objects: vec![NO_OBJECT; size.pixels()],
                    outline: Vec::new(),
                }
            } else {
                self.shown.resampled(size)
            };
            self.cursor = 0;
        }
        if self.target.size != size {
            is_stale = true;
            self.target = resample(&frame.pixels, &frame.objects, frame.size, size);
            // The objects under the pixels cost nothing to send.
            self.shown.objects.clone_from(&self.target.objects);
            self.left = cells(size);
        }
        if is_stale {
            self.outline(outlined);
        }
    }

    /// Sets the outline of the target.
    fn outline(&mut self, outlined: &[u32]) {
        self.outlined = outlined.to_vec();
        self.target.outline = match outlined {
            [] => Vec::new(),
            outlined => self.shown.outline_of(outlined),
        };
        let changes = |cell: &usize| {
            self.pixels_of(*cell)
                .any(|at| self.shown.is_outlined(at) != self.target.is_outlined(at))
        };
        self.outline = (0..cells(self.shown.size)).filter(changes).collect();
    }

    /// The indices of a cell's pixels; the last row of cells may lack the lower ones.
    fn pixels_of(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        let width = self.shown.size.width as usize;
        let pixels = self.shown.pixels.len();
        let upper = cell / width * 2 * width + cell % width;
        [upper, upper + width]
            .into_iter()
            .filter(move |&at| at < pixels)
    }

    /// Copies the pixels of a cell to the screen and returns whether any changed.
    fn bring_cell(&mut self, cell: usize, tolerance: u8) -> bool {
        let mut changed = false;
        for at in self.pixels_of(cell) {
            let (shown, target) = (self.shown.pixels[at], self.target.pixels[at]);
            let off = |(shown, target): (&u8, &u8)| tolerance < shown.abs_diff(*target);
            if shown.iter().zip(&target).any(off) {
                self.shown.pixels[at] = target;
                changed = true;
            }
            let is_outlined = self.target.is_outlined(at);
            if self.shown.is_outlined(at) != is_outlined {
                self.shown.outline.resize(self.shown.pixels.len(), false);
                self.shown.outline[at] = is_outlined;
                changed = true;
            }
        }
        changed
    }
}

/// The number of cells of a picture of this size.
fn cells(size: Size) -> usize {
    size.width as usize * size.height.div_ceil(2) as usize
}

fn resample(pixels: &[[u8; 3]], objects: &[u32], from: Size, to: Size) -> Shown {
    if from == to || from.pixels() == 0 {
        return Shown {
            size: from,
            pixels: pixels.to_vec(),
            objects: objects.to_vec(),
            outline: Vec::new(),
        };
    }
    let width = from.width as usize;
    let mut shown = Shown {
        size: to,
        pixels: Vec::with_capacity(to.pixels()),
        objects: Vec::with_capacity(to.pixels()),
        outline: Vec::new(),
    };
    for y in 0..to.height {
        let rows = covered(y, to.height, from.height);
        for x in 0..to.width {
            let columns = covered(x, to.width, from.width);
            let mut sum = [0u64; 3];
            for row in rows.clone() {
                for pixel in &pixels[row * width + columns.start..row * width + columns.end] {
                    for (sum, channel) in sum.iter_mut().zip(pixel) {
                        *sum += u64::from(*channel);
                    }
                }
            }
            let count = (rows.len() * columns.len()) as u64;
            shown
                .pixels
                .push(sum.map(|sum| ((sum + count / 2) / count) as u8));
            let middle = |range: &std::ops::Range<usize>| range.start + range.len() / 2;
            shown
                .objects
                .push(objects[middle(&rows) * width + middle(&columns)]);
        }
    }
    shown
}

/// The pixels of `from` that pixel `at` of `to` covers, at least one.
fn covered(at: u32, to: u32, from: u32) -> std::ops::Range<usize> {
    let scaled = |at: u32| (u64::from(at) * u64::from(from) / u64::from(to)) as usize;
    let start = scaled(at);
    start..scaled(at + 1).max(start + 1)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    const GREY: [u8; 3] = [100; 3];

    fn size(width: u32, height: u32) -> Size {
        Size { width, height }
    }

    /// A frame of a single colour.
    fn frame(generation: u64, size: Size, pixel: [u8; 3], complete: bool) -> Arc<Frame> {
        Arc::new(Frame {
            generation,
            size,
            corner: [0; 2],
            pixels: vec![pixel; size.pixels()],
            objects: vec![7; size.pixels()],
            values: Vec::new(),
            progress: Progress {
                pass: 1,
                passes: 2,
                spp: 1,
                done: 0.5,
                elapsed: Duration::ZERO,
                rays: 1,
                shadow_rays: 0,
                over_budget: 0,
                noise: None,
                complete,
            },
        })
    }

    /// The number of pixels on screen in each row, from the top.
    fn rows_shown(picture: &Picture, pixel: [u8; 3]) -> Vec<usize> {
        let rows = picture
            .shown
            .pixels
            .chunks(picture.shown.size.width as usize);
        rows.map(|row| row.iter().filter(|&&shown| shown == pixel).count())
            .collect()
    }

    #[test]
    fn a_budget_copies_cells_in_order_and_the_next_one_continues() {
        let size = size(10, 6);
        let mut picture = Picture::default();
        picture.take(frame(1, size, GREY, true));
        picture.advance(size, &[], 13 * BYTES_PER_CELL);
        assert_eq!(rows_shown(&picture, GREY), [10, 10, 3, 3, 0, 0]);
        assert!(picture.is_pending());
        picture.advance(size, &[], 0);
        assert_eq!(rows_shown(&picture, GREY), [10, 10, 3, 3, 0, 0]);
        picture.advance(size, &[], usize::MAX);
        assert_eq!(rows_shown(&picture, GREY), [10; 6]);
        assert!(!picture.is_pending());
    }

    #[test]
    fn a_newer_frame_continues_where_the_superseded_one_stopped() {
        let size = size(10, 6);
        let newer = [200; 3];
        let mut picture = Picture::default();
        picture.take(frame(1, size, GREY, true));
        picture.advance(size, &[], 10 * BYTES_PER_CELL);
        picture.take(frame(2, size, newer, true));
        picture.advance(size, &[], 10 * BYTES_PER_CELL);
        assert_eq!(rows_shown(&picture, newer), [0, 0, 10, 10, 0, 0]);
        picture.advance(size, &[], usize::MAX);
        assert_eq!(rows_shown(&picture, newer), [10; 6]);
    }

    #[test]
    fn almost_right_pixels_wait_for_the_finished_frame_on_a_slow_link() {
        let size = size(4, 4);
        let shown_after = |pixel, complete, budget| {
            let mut picture = Picture::default();
            picture.take(frame(1, size, GREY, true));
            picture.advance(size, &[], usize::MAX);
            picture.take(frame(1, size, pixel, complete));
            picture.advance(size, &[], budget);
            picture.shown.pixels[0]
        };
        for (pixel, complete, budget, shown) in [
            ([103, 97, 100], false, 1000, GREY),
            ([104, 100, 100], false, 1000, [104, 100, 100]),
            ([103, 97, 100], true, 1000, [103, 97, 100]),
            ([103, 97, 100], false, usize::MAX, [103, 97, 100]),
        ] {
            assert_eq!(shown_after(pixel, complete, budget), shown);
        }
    }

    /// Object 7 fills the three right columns, up to the edge of the picture.
    fn half(complete: bool) -> Arc<Frame> {
        let size = size(4, 2);
        let mut frame = Arc::unwrap_or_clone(frame(1, size, GREY, complete));
        frame.objects = [NO_OBJECT, 7, 7, 7].repeat(2);
        Arc::new(frame)
    }

    fn outline(picture: &Picture) -> String {
        let marks = (0..picture.shown.pixels.len()).map(|at| picture.shown.is_outlined(at));
        marks.map(|mark| if mark { '#' } else { '.' }).collect()
    }

    #[test]
    fn the_outline_is_inside_the_object_and_not_along_the_edge() {
        let mut picture = Picture::default();
        picture.take(half(true));
        for (outlined, marks) in [
            (&[7][..], ".#...#.."),
            (&[8], "........"),
            (&[], "........"),
        ] {
            picture.advance(size(4, 2), outlined, usize::MAX);
            assert_eq!(outline(&picture), marks, "{outlined:?}");
        }
        picture.advance(size(4, 2), &[7], usize::MAX);
        picture.forget_objects();
        picture.advance(size(4, 2), &[7], usize::MAX);
        assert_eq!(outline(&picture), "........");
    }

    /// The selection itself answers as text; the cells of its outline wait for the link.
    #[test]
    fn the_outline_precedes_the_picture_but_needs_a_budget() {
        let mut picture = Picture::default();
        picture.take(half(true));
        picture.advance(size(4, 2), &[], usize::MAX);
        picture.advance(size(4, 2), &[7], 0);
        assert_eq!(outline(&picture), "........");
        assert!(picture.is_pending());
        let mut brighter = Arc::unwrap_or_clone(half(true));
        brighter.pixels.fill([200; 3]);
        picture.take(Arc::new(brighter));
        picture.advance(size(4, 2), &[7], BYTES_PER_CELL);
        assert_eq!(outline(&picture), ".#...#..");
        assert_eq!(rows_shown(&picture, GREY), [3, 3]);
        picture.advance(size(4, 2), &[7], usize::MAX);
        assert_eq!(rows_shown(&picture, [200; 3]), [4, 4]);
        assert!(!picture.is_pending());
    }

    #[test]
    fn shrinking_averages_and_enlarging_repeats_pixels() {
        let shown = Shown {
            size: size(2, 2),
            pixels: vec![[0, 0, 0], [100, 0, 0], [0, 50, 0], [101, 51, 8]],
            objects: vec![1, 2, 3, 4],
            outline: Vec::new(),
        };
        let one = shown.resampled(size(1, 1));
        // 201/4, 101/4 and 8/4, rounded.
        assert_eq!(one.pixels, [[50, 25, 2]]);
        let four = shown.resampled(size(4, 4));
        assert_eq!(four.objects[..8], [1, 1, 2, 2, 1, 1, 2, 2]);
        assert_eq!(four.resampled(size(2, 2)), shown);
        assert_eq!(shown.resampled(size(2, 2)), shown);
    }

    #[test]
    fn a_full_size_trace_is_shown_at_the_size_of_the_screen() {
        let mut picture = Picture::default();
        picture.take(frame(1, size(640, 480), GREY, true));
        picture.advance(size(64, 48), &[], usize::MAX);
        assert_eq!(rows_shown(&picture, GREY), [64; 48]);
        assert_eq!(picture.shown.object_at(63, 47), Some(7));
        assert_eq!(picture.shown.object_at(64, 0), None);
    }
}
