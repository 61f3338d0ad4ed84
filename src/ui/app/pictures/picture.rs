//! The picture on screen, and the newer one that replaces it as fast as the link allows.

use std::collections::VecDeque;
use std::iter;
use std::sync::Arc;

use super::cell_image::{CellImage, Layer, border};
use super::frame_window::{FrameWindow, Reason};
use super::viewport::Viewport;
use render::{Frame, NO_OBJECT, Progress, Region};
use scene::Size;

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
    /// The size requested last, and the part of it.
    pub asked: Option<(Size, Option<Region>)>,
    /// Which part of it is on screen.
    pub viewport: Viewport,
    /// Whether tracing is paused.
    pub paused: bool,
    /// The newest frame; `None` before the first.
    pub latest: Option<Arc<Frame>>,
    /// What is seen where the newest frame, of a region, shows nothing: the last frame of all.
    under: Option<Arc<Frame>>,
    /// The picture on screen.
    pub shown: CellImage,
    target: CellImage,
    /// How the target sees the newest frame; `None` before it does.
    frame_window: Option<FrameWindow>,
    /// The cell to compare next, in row-major order.
    cursor: usize,
    /// The number of cells not yet compared with the target.
    left: usize,
    /// The object outlined in the target.
    outlined: Vec<u32>,
    /// Whether the scene's objects were renumbered since the newest frame.
    is_renumbered: bool,
    /// The cells in which the outline changes. They are sent first, because they answer a key.
    outline: VecDeque<usize>,
}

impl Picture {
    /// Creates a picture of which nothing is traced yet. What a region leaves is seen in another
    /// frame.
    pub(crate) fn over(under: Option<Arc<Frame>>) -> Self {
        Self {
            under,
            ..Self::default()
        }
    }

    /// Takes a frame. Frames must arrive in the order in which they were made.
    pub fn take(&mut self, frame: Arc<Frame>) {
        self.is_renumbered = false;
        let covers = is_whole(&frame);
        let before = self.latest.replace(frame);
        if covers {
            self.under = None;
        } else if let Some(before) = before.filter(|before| is_whole(before)) {
            self.under = Some(before);
        }
        self.frame_window = None;
    }

    /// Whether something of the picture requested last has arrived.
    pub(crate) fn shows_wanted(&self) -> bool {
        let latest = self.latest.as_ref().map(|frame| frame.generation);
        self.wanted.is_some() && self.wanted == latest
    }

    /// The last frame of all of the picture.
    pub(crate) fn whole(&self) -> Option<Arc<Frame>> {
        let latest = self.latest.as_ref().filter(|frame| is_whole(frame));
        latest.or(self.under.as_ref()).cloned()
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

    /// The object under a pixel of the newest frame.
    pub fn object_at(&self, pixel: [u32; 2]) -> Option<u32> {
        let frame = self.latest.as_ref().filter(|_| !self.is_renumbered)?;
        let object = frame.objects.get(frame.index_of(pixel)?).copied()?;
        (object != NO_OBJECT).then_some(object)
    }

    /// Forgets the objects under the pixels on screen until a newer frame arrives: after
    /// renumbering, the outline would be around an object that is not selected.
    pub fn forget_objects(&mut self) {
        self.shown.objects.fill(NO_OBJECT);
        self.is_renumbered = true;
        if let Some(frame_window) = self.frame_window {
            self.outline(&frame_window, &[]);
        }
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

    /// Copies cells of the newest frame as `sight` shows it, with the outlines of `outlined`, to the
    /// screen until `budget` bytes are spent, and continues there next time; `usize::MAX` copies all
    /// of them. Changes of the outline go first. Over a limited link, pixels of an unfinished frame
    /// that are almost right are skipped; a finished frame is shown exactly.
    pub fn advance(&mut self, frame_window: &FrameWindow, outlined: &[u32], budget: usize) {
        self.aim(frame_window, outlined);
        let tolerance = match budget {
            usize::MAX => 0,
            _ if self.latest.as_ref().is_some_and(|f| f.progress.complete) => 0,
            _ => HYSTERESIS,
        };
        let cells = frame_window.cells();
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
            if self.bring_cell(frame_window, cell, tolerance) {
                spent += BYTES_PER_CELL;
            }
        }
    }

    /// Whether parts of the newest frame are not on screen yet.
    pub fn is_pending(&self) -> bool {
        0 < self.left || !self.outline.is_empty()
    }

    /// Makes the newest frame the target, with the outline of an object.
    fn aim(&mut self, frame_window: &FrameWindow, outlined: &[u32]) {
        let Some(frame) = &self.latest else {
            return;
        };
        let size = frame_window.size;
        let mut is_stale = self.outlined != outlined;
        if self.shown.size != size {
            is_stale = true;
            self.shown = if self.shown.pixels.is_empty() {
                CellImage::black(size)
            } else {
                self.shown.resampled(size)
            };
            self.cursor = 0;
        }
        if self.frame_window != Some(*frame_window) {
            is_stale = true;
            let frames: Vec<_> = iter::once(frame)
                .chain(&self.under)
                .map(|frame| (frame, frame_window.colours(frame)))
                .collect();
            let layers: Vec<_> = frames
                .iter()
                .map(|(frame, colours)| Layer::of(frame, colours))
                .collect();
            self.target = CellImage::seen(&layers, frame_window);
            self.frame_window = Some(*frame_window);
            // The objects under the pixels cost nothing to send.
            self.shown.objects.clone_from(&self.target.objects);
            self.left = frame_window.cells();
        }
        if is_stale {
            self.outline(frame_window, outlined);
        }
    }

    /// Sets the outline of the target.
    fn outline(&mut self, frame_window: &FrameWindow, outlined: &[u32]) {
        self.outlined = outlined.to_vec();
        self.target.outline = match outlined {
            [] => Vec::new(),
            outlined => self.shown.outline_of(outlined),
        };
        for at in border(frame_window, Reason::Drawn) {
            self.target.outline.resize(self.shown.size.pixels(), false);
            self.target.outline[at] = true;
        }
        let changes = |cell: &usize| {
            let mut pixels = frame_window.grid.pixels(self.shown.size, *cell);
            pixels.any(|at| self.shown.is_outlined(at) != self.target.is_outlined(at))
        };
        self.outline = (0..frame_window.cells()).filter(changes).collect();
    }

    /// Copies the pixels of a cell to the screen and returns whether any changed.
    fn bring_cell(&mut self, frame_window: &FrameWindow, cell: usize, tolerance: u8) -> bool {
        let mut changed = false;
        for at in frame_window.grid.pixels(self.shown.size, cell) {
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

fn is_whole(frame: &Frame) -> bool {
    frame.size == frame.whole()
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use render::Overexposure;

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
            denoised: Vec::new(),
            errors: Vec::new(),
            range: None,
            overexposure: Overexposure::default(),
            progress: Progress {
                pass: 1,
                passes: 2,
                spp: 1,
                mean_spp: 1.0,
                done: 0.5,
                elapsed: Duration::ZERO,
                rays: 1,
                shadow_rays: 0,
                over_budget: 0,
                noise: None,
                complete,
            },
            query: None,
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
        picture.advance(&FrameWindow::whole(size), &[], 13 * BYTES_PER_CELL);
        assert_eq!(rows_shown(&picture, GREY), [10, 10, 3, 3, 0, 0]);
        assert!(picture.is_pending());
        picture.advance(&FrameWindow::whole(size), &[], 0);
        assert_eq!(rows_shown(&picture, GREY), [10, 10, 3, 3, 0, 0]);
        picture.advance(&FrameWindow::whole(size), &[], usize::MAX);
        assert_eq!(rows_shown(&picture, GREY), [10; 6]);
        assert!(!picture.is_pending());
    }

    #[test]
    fn a_newer_frame_continues_where_the_superseded_one_stopped() {
        let size = size(10, 6);
        let newer = [200; 3];
        let mut picture = Picture::default();
        picture.take(frame(1, size, GREY, true));
        picture.advance(&FrameWindow::whole(size), &[], 10 * BYTES_PER_CELL);
        picture.take(frame(2, size, newer, true));
        picture.advance(&FrameWindow::whole(size), &[], 10 * BYTES_PER_CELL);
        assert_eq!(rows_shown(&picture, newer), [0, 0, 10, 10, 0, 0]);
        picture.advance(&FrameWindow::whole(size), &[], usize::MAX);
        assert_eq!(rows_shown(&picture, newer), [10; 6]);
    }

    #[test]
    fn almost_right_pixels_wait_for_the_finished_frame_on_a_slow_link() {
        let size = size(4, 4);
        let shown_after = |pixel, complete, budget| {
            let mut picture = Picture::default();
            picture.take(frame(1, size, GREY, true));
            picture.advance(&FrameWindow::whole(size), &[], usize::MAX);
            picture.take(frame(1, size, pixel, complete));
            picture.advance(&FrameWindow::whole(size), &[], budget);
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
            picture.advance(&FrameWindow::whole(size(4, 2)), outlined, usize::MAX);
            assert_eq!(outline(&picture), marks, "{outlined:?}");
        }
        picture.advance(&FrameWindow::whole(size(4, 2)), &[7], usize::MAX);
        picture.forget_objects();
        picture.advance(&FrameWindow::whole(size(4, 2)), &[7], usize::MAX);
        assert_eq!(outline(&picture), "........");
    }

    /// The selection itself answers as text; the cells of its outline wait for the link.
    #[test]
    fn the_outline_precedes_the_picture_but_needs_a_budget() {
        let mut picture = Picture::default();
        picture.take(half(true));
        picture.advance(&FrameWindow::whole(size(4, 2)), &[], usize::MAX);
        picture.advance(&FrameWindow::whole(size(4, 2)), &[7], 0);
        assert_eq!(outline(&picture), "........");
        assert!(picture.is_pending());
        let mut brighter = Arc::unwrap_or_clone(half(true));
        brighter.pixels.fill([200; 3]);
        picture.take(Arc::new(brighter));
        picture.advance(&FrameWindow::whole(size(4, 2)), &[7], BYTES_PER_CELL);
        assert_eq!(outline(&picture), ".#...#..");
        assert_eq!(rows_shown(&picture, GREY), [3, 3]);
        picture.advance(&FrameWindow::whole(size(4, 2)), &[7], usize::MAX);
        assert_eq!(rows_shown(&picture, [200; 3]), [4, 4]);
        assert!(!picture.is_pending());
    }

    #[test]
    fn a_full_size_trace_is_shown_at_the_size_of_the_screen() {
        let mut picture = Picture::default();
        picture.take(frame(1, size(640, 480), GREY, true));
        picture.advance(&FrameWindow::whole(size(64, 48)), &[], usize::MAX);
        assert_eq!(rows_shown(&picture, GREY), [64; 48]);
        assert_eq!(picture.shown.object_at(63, 47), Some(7));
        assert_eq!(picture.shown.object_at(64, 0), None);
    }
}
