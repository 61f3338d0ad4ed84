//! Zooming and panning the picture on screen.

use super::Shared;
use super::frame_window::FrameWindow;
use super::viewport::{Detail, Screen, Viewport};
use crate::scene::Size;
use crate::ui::keymap::Mode;
use crate::ui::layout::raster;
use crate::ui::msg::Target;

/// The middle of the window, in shares of its size.
const MIDDLE: [f64; 2] = [0.5; 2];

/// How the picture is to be scaled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ScaleOrder {
    /// Say how it is.
    Tell,
    /// Show all of it.
    Fit,
    /// Show 2 to this power pixels on screen for one of the picture.
    At(i8),
}

impl ScaleOrder {
    /// Parses nothing, `fit`, or a scale; the error says what is expected.
    pub(super) fn parse(said: &str) -> Result<Self, String> {
        match (said.trim(), Viewport::parse(said)) {
            ("", _) => Ok(Self::Tell),
            ("fit", _) => Ok(Self::Fit),
            (_, Some(scale)) => Ok(Self::At(scale)),
            (_, None) => Err("zoom takes fit, 1:1, or a power of two such as 4 or 1:2".to_owned()),
        }
    }
}

impl Shared {
    /// How the picture on screen is seen; `None` if there is no room.
    pub fn frame_window(&self) -> Option<FrameWindow> {
        let screen = self.screen()?;
        let detail = match self.seen() {
            Target::Trace | Target::Compared => Detail::Full,
            _ => Detail::OnScreen,
        };
        Some(FrameWindow {
            size: screen.grid.size(screen.halves),
            grid: screen.grid,
            window: self.viewport().window(screen, detail),
            marked: self.marked(),
            display: self.pictures.display,
        })
    }

    /// Which part of the picture on screen is seen. A wireframe is seen whole.
    pub fn viewport(&self) -> Viewport {
        let viewport = self.picture().viewport;
        match (self.wireframe(), self.screen()) {
            (Some(_), _) => Viewport::default(),
            (None, Some(screen)) => viewport.on(screen),
            (None, None) => viewport,
        }
    }

    /// The pixel, of the whole picture that the newest frame is of, under the upper half of a cell,
    /// counted from the picture's upper left one. [`Frame::index_of`](crate::render::Frame::index_of)
    /// finds it in the frame.
    pub fn pixel_at(&self, cell: (u16, u16)) -> Option<[u32; 2]> {
        let frame = self.picture().latest.as_ref()?;
        self.frame_window()?.pixel_at(cell, frame.whole())
    }

    /// The pixel of the output picture under the upper half of a cell.
    pub(super) fn output_pixel_at(&self, cell: (u16, u16)) -> Option<[u32; 2]> {
        self.frame_window()?.pixel_at(cell, self.output())
    }

    /// The pixel of the output picture in the upper left corner of the screen.
    pub fn pixel_in_corner(&self) -> Option<[u32; 2]> {
        self.output_pixel_at((0, 0))
    }

    /// What the preview is traced for.
    pub(super) fn preview_screen(&self) -> Option<Screen> {
        let (_, halves) = raster(self.areas_at(self.zoom).picture, self.output())?;
        Some(self.screen_of(self.output(), halves))
    }

    fn screen(&self) -> Option<Screen> {
        let (_, halves) = self.raster()?;
        Some(self.screen_of(self.framed(), halves))
    }

    fn screen_of(&self, output: Size, halves: Size) -> Screen {
        Screen {
            output,
            halves,
            grid: self.pictures.grid,
        }
    }

    /// Zooms by doublings about the pixel that is pointed at, otherwise about the middle.
    pub(super) fn magnify(&mut self, steps: i8) {
        let pointed = match self.mode {
            Mode::Compare => self.cross_on_screen(),
            _ => None,
        };
        self.adjust(|now, screen| {
            let Size { width, height } = screen.halves;
            let about = pointed.map(|[x, y]| [x / f64::from(width), y / f64::from(height)]);
            now.zoomed(steps, about.unwrap_or(MIDDLE), screen)
        });
    }

    /// Zooms by doublings about a cell of the screen.
    pub(super) fn magnify_at(&mut self, steps: i8, at: (u16, u16)) {
        let about = self.share_at(at).unwrap_or(MIDDLE);
        self.adjust(|now, screen| now.zoomed(steps, about, screen));
    }

    /// Moves the window by steps to the right and down.
    pub(super) fn scroll_picture(&mut self, right: i8, down: i8) {
        self.adjust(|now, screen| now.panned([right.into(), down.into()], screen));
    }

    /// Moves what is at a place on screen, in half blocks from the picture's upper left corner, to the
    /// middle, unless all of the picture is on screen.
    pub(super) fn centre_on(&mut self, [x, y]: [f64; 2]) {
        if !self.viewport().is_fit() {
            self.adjust(|now, screen| {
                let Size { width, height } = screen.halves;
                let from = [x / f64::from(width), y / f64::from(height)];
                now.dragged(from, MIDDLE, screen)
            });
        }
    }

    /// Moves what is in one cell of the screen to another.
    pub(super) fn drag_picture(&mut self, from: (u16, u16), to: (u16, u16)) {
        if let (Some(from), Some(to)) = (self.share_at(from), self.share_at(to)) {
            self.adjust(|now, screen| now.dragged(from, to, screen));
        }
    }

    /// Moves the window so that what is at one place of it is at another, both in shares of its size.
    pub(super) fn shift_window(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.adjust(|now, screen| now.dragged(from, to, screen));
    }

    /// Switches between one pixel on screen for one of the picture, and all of it.
    pub(super) fn toggle_scale(&mut self) {
        self.adjust(Viewport::toggled);
        self.tell_scale();
    }

    pub(super) fn order_scale(&mut self, order: ScaleOrder) {
        match order {
            ScaleOrder::Tell => {}
            ScaleOrder::Fit => self.adjust(|_, _| Viewport::default()),
            ScaleOrder::At(scale) => {
                self.adjust(|now, screen| now.scaled(scale, MIDDLE, screen));
            }
        }
        self.tell_scale();
    }

    fn tell_scale(&mut self) {
        let name = self.viewport().name();
        self.overlays.say(format!("zoom {name}"));
    }

    fn adjust(&mut self, change: impl FnOnce(Viewport, Screen) -> Viewport) {
        if self.wireframe().is_some() {
            self.overlays.say("a wireframe is shown whole");
            return;
        }
        if let Some(screen) = self.screen() {
            let picture = self.picture_mut();
            picture.viewport = change(picture.viewport.on(screen), screen);
        }
    }

    /// The place of a cell's middle in the window, in shares of its size.
    fn share_at(&self, at: (u16, u16)) -> Option<[f64; 2]> {
        let (cells, _) = self.raster()?;
        let share = |at: u16, from: u16, length: u16| {
            let within = f64::from(at) - f64::from(from) + 0.5;
            within / f64::from(length.max(1))
        };
        Some([
            share(at.0, cells.x, cells.width),
            share(at.1, cells.y, cells.height),
        ])
    }
}
