//! Zooming and panning the picture on screen.

use crate::app::Shared;
use crate::app::pictures::frame_window::FrameWindow;
use crate::app::pictures::viewport::{Detail, Screen, Viewport};
use crate::layout::raster;
use crate::msg::Target;
use scene::Size;

/// The middle of the window, in shares of its size.
const MIDDLE: [f64; 2] = [0.5; 2];

/// How the picture is to be scaled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ScaleOrder {
    /// Say how it is.
    Tell,
    /// Show all of it.
    Fit,
    /// Show 2 to this power pixels on screen for one of the picture.
    At(i8),
}

impl ScaleOrder {
    /// Parses nothing, `fit`, or a scale; the error says what is expected.
    pub(crate) fn parse(said: &str) -> Result<Self, String> {
        match (said.trim(), Viewport::parse(said)) {
            ("", _) => Ok(Self::Tell),
            ("fit", _) => Ok(Self::Fit),
            (_, Some(scale)) => Ok(Self::At(scale)),
            (_, None) => Err("zoom takes fit, 1:1, or a power of two such as 4 or 1:2".to_owned()),
        }
    }
}

/// The cell of the picture under the pointer, from the picture's corner.
pub(crate) fn picture_cell(shared: &Shared, at: (u16, u16)) -> Option<(u16, u16)> {
    let (cells, _) = shared.raster()?;
    let is_inside = cells.contains(at.into());
    is_inside.then(|| (at.0 - cells.x, at.1 - cells.y))
}

/// The cell of the picture nearest to the pointer, from the picture's corner.
pub(crate) fn cell_near(shared: &Shared, at: (u16, u16)) -> Option<(u16, u16)> {
    let (cells, _) = shared.raster()?;
    let near =
        |at: u16, from: u16, length: u16| at.saturating_sub(from).min(length.saturating_sub(1));
    Some((
        near(at.0, cells.x, cells.width),
        near(at.1, cells.y, cells.height),
    ))
}

/// The magnification of the picture on screen, relative to one of this size that fills its cells.
pub(crate) fn magnification(shared: &Shared, size: Size) -> f64 {
    frame_window(shared).map_or(1.0, |frame_window| frame_window.magnification(size))
}

/// How the picture on screen is seen; `None` if there is no room.
pub fn frame_window(shared: &Shared) -> Option<FrameWindow> {
    let screen = screen(shared)?;
    let detail = match shared.seen() {
        Target::Trace | Target::Compared => Detail::Full,
        _ => Detail::OnScreen,
    };
    Some(FrameWindow {
        size: screen.grid.size(screen.halves),
        grid: screen.grid,
        window: viewport(shared).window(screen, detail),
        marked: shared.marked(),
        display: shared.pictures.display,
    })
}

/// Which part of the picture on screen is seen. A wireframe is seen whole.
pub(crate) fn viewport(shared: &Shared) -> Viewport {
    let viewport = shared.picture().viewport;
    match (shared.wireframe(), screen(shared)) {
        (Some(_), _) => Viewport::default(),
        (None, Some(screen)) => viewport.on(screen),
        (None, None) => viewport,
    }
}

/// The pixel, of the whole picture that the newest frame is of, under the upper half of a cell,
/// counted from the picture's upper left one. [`Frame::index_of`](render::Frame::index_of)
/// finds it in the frame.
pub(crate) fn pixel_at(shared: &Shared, cell: (u16, u16)) -> Option<[u32; 2]> {
    let frame = shared.picture().latest.as_ref()?;
    frame_window(shared)?.pixel_at(cell, frame.whole())
}

/// The pixel of the output picture under the upper half of a cell.
pub(crate) fn output_pixel_at(shared: &Shared, cell: (u16, u16)) -> Option<[u32; 2]> {
    frame_window(shared)?.pixel_at(cell, shared.output())
}

/// The pixel of the output picture in the upper left corner of the screen.
pub(crate) fn pixel_in_corner(shared: &Shared) -> Option<[u32; 2]> {
    output_pixel_at(shared, (0, 0))
}

/// What the preview is traced for.
pub(crate) fn preview_screen(shared: &Shared) -> Option<Screen> {
    let (_, halves) = raster(shared.areas_at(shared.zoom).picture, shared.output())?;
    Some(screen_of(shared, shared.output(), halves))
}

fn screen(shared: &Shared) -> Option<Screen> {
    let (_, halves) = shared.raster()?;
    Some(screen_of(shared, shared.framed(), halves))
}

fn screen_of(shared: &Shared, output: Size, halves: Size) -> Screen {
    Screen {
        output,
        halves,
        grid: shared.pictures.grid,
    }
}

/// Zooms by doublings about the middle.
pub(crate) fn magnify(shared: &mut Shared, steps: i8) {
    magnify_about(shared, steps, None);
}

/// Zooms by doublings about a place on screen, in half blocks from the picture's upper left corner,
/// otherwise about the middle.
pub(crate) fn magnify_about(shared: &mut Shared, steps: i8, place: Option<[f64; 2]>) {
    adjust(shared, |now, screen| {
        let Size { width, height } = screen.halves;
        let about = place.map(|[x, y]| [x / f64::from(width), y / f64::from(height)]);
        now.zoomed(steps, about.unwrap_or(MIDDLE), screen)
    });
}

/// Zooms by doublings about a cell of the screen.
pub(crate) fn magnify_at(shared: &mut Shared, steps: i8, at: (u16, u16)) {
    let about = share_at(shared, at).unwrap_or(MIDDLE);
    adjust(shared, |now, screen| now.zoomed(steps, about, screen));
}

/// Moves the window by steps to the right and down.
pub(crate) fn scroll_picture(shared: &mut Shared, right: i8, down: i8) {
    adjust(shared, |now, screen| {
        now.panned([right.into(), down.into()], screen)
    });
}

/// Moves what is at a place on screen, in half blocks from the picture's upper left corner, to the
/// middle, unless all of the picture is on screen.
pub(crate) fn centre_on(shared: &mut Shared, [x, y]: [f64; 2]) {
    if !viewport(shared).is_fit() {
        adjust(shared, |now, screen| {
            let Size { width, height } = screen.halves;
            let from = [x / f64::from(width), y / f64::from(height)];
            now.dragged(from, MIDDLE, screen)
        });
    }
}

/// Moves what is in one cell of the screen to another.
pub(crate) fn drag_picture(shared: &mut Shared, from: (u16, u16), to: (u16, u16)) {
    if let (Some(from), Some(to)) = (share_at(shared, from), share_at(shared, to)) {
        shift_window(shared, from, to);
    }
}

/// Moves the window so that what is at one place of it is at another, both in shares of its size.
pub(crate) fn shift_window(shared: &mut Shared, from: [f64; 2], to: [f64; 2]) {
    adjust(shared, |now, screen| now.dragged(from, to, screen));
}

/// Switches between one pixel on screen for one of the picture, and all of it.
pub(crate) fn toggle_scale(shared: &mut Shared) {
    adjust(shared, Viewport::toggled);
    tell_scale(shared);
}

/// Zooms as `:zoom` asks, and says how the picture is zoomed.
pub(crate) fn order_scale(shared: &mut Shared, order: ScaleOrder) {
    match order {
        ScaleOrder::Tell => {}
        ScaleOrder::Fit => adjust(shared, |_, _| Viewport::default()),
        ScaleOrder::At(scale) => adjust(shared, |now, screen| now.scaled(scale, MIDDLE, screen)),
    }
    tell_scale(shared);
}

fn tell_scale(shared: &mut Shared) {
    let name = viewport(shared).name();
    shared.say(format!("zoom {name}"));
}

fn adjust(shared: &mut Shared, change: impl FnOnce(Viewport, Screen) -> Viewport) {
    if shared.wireframe().is_some() {
        shared.say("a wireframe is shown whole");
        return;
    }
    if let Some(screen) = screen(shared) {
        let picture = shared.picture_mut();
        picture.viewport = change(picture.viewport.on(screen), screen);
    }
}

/// The place of a cell's middle in the window, in shares of its size.
fn share_at(shared: &Shared, at: (u16, u16)) -> Option<[f64; 2]> {
    let (cells, _) = shared.raster()?;
    let share = |at: u16, from: u16, length: u16| {
        let within = f64::from(at) - f64::from(from) + 0.5;
        within / f64::from(length.max(1))
    };
    Some([
        share(at.0, cells.x, cells.width),
        share(at.1, cells.y, cells.height),
    ])
}
