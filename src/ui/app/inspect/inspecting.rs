//! Inspecting: a cross over the picture, and what is under it.

use crate::app::shared::inspection::Cross;
use crate::app::{Shared, display};
use crate::keymap::Mode;
use crate::layout::Side;
use language::Node;
use scene::Size;
use text::{Position, Severity};

/// Starts inspecting where the cross was last if that is on screen, otherwise in the middle.
pub(crate) fn start(shared: &mut Shared) {
    shared.document.end_step();
    if shared.scene.is_none() {
        shared.refuse_picture(Severity::Error, &shared.no_picture());
        return;
    }
    let Some((cells, _)) = shared.raster() else {
        shared.fail("no room for a picture");
        return;
    };
    if shared.mode != Mode::Inspect {
        shared.inspection.begin(shared.mode, shared.seen());
        shared.inspection.explained = None;
        shared.mode = Mode::Inspect;
    }
    if cross_cell(shared).is_none() {
        place_cross(shared, (cells.width / 2, cells.height / 2));
    }
    move_cross(shared, 0, 0);
}

/// Returns to the mode before.
pub(crate) fn stop(shared: &mut Shared) {
    shared.mode = shared.inspection.before();
}

/// The cross as a pixel of the picture on screen; in its middle before the first inspection.
/// `None` without a picture.
pub(crate) fn cross(shared: &Shared) -> Option<Cross> {
    let size = frame_size(shared)?;
    Some(match shared.inspection.cross {
        Some(cross) => cross.in_size(size),
        None => Cross::middle(size),
    })
}

/// Moves the cross by some pixels.
pub(super) fn move_cross(shared: &mut Shared, right: i32, down: i32) {
    if let Some(mut cross) = cross(shared) {
        cross.step(right, down);
        shared.inspection.cross = Some(cross);
        reveal_cross(shared);
    }
}

/// Moves the window over a zoomed picture to the cross if that has left it.
pub(super) fn reveal_cross(shared: &mut Shared) {
    /// The share of the window that is kept between the cross and its edge.
    const MARGIN: f64 = 0.1;
    if cross_cell(shared).is_none()
        && let Some(([column, row], (cells, _))) = cross_place(shared).zip(shared.raster())
    {
        let from = [
            column / f64::from(cells.width),
            row / f64::from(cells.height),
        ];
        let to = from.map(|share| share.clamp(MARGIN, 1.0 - MARGIN));
        display::shift_window(shared, from, to);
    }
}

/// Moves the cross to a cell of the picture.
pub(crate) fn place_cross(shared: &mut Shared, cell: (u16, u16)) {
    let place = display::pixel_at(shared, cell).zip(frame_size(shared));
    shared.inspection.cross = place.map(|(pixel, size)| Cross { pixel, size });
}

/// Selects what is under the cross, and ends inspecting.
pub(super) fn select_crossed(shared: &mut Shared) {
    pick(shared, node_under_cross(shared));
}

/// The cell that the cross is in, from the upper left corner of the picture; `None` if it is not
/// on screen.
pub(crate) fn cross_cell(shared: &Shared) -> Option<(u16, u16)> {
    let (cells, _) = shared.raster()?;
    let [column, row] = cross_place(shared)?;
    let is_inside = 0.0 <= column
        && 0.0 <= row
        && column < f64::from(cells.width)
        && row < f64::from(cells.height);
    is_inside.then_some((column as u16, row as u16))
}

/// Where the middle of the crossed pixel is, in cells from the upper left corner of the picture.
fn cross_place(shared: &Shared) -> Option<[f64; 2]> {
    let Cross { pixel, size } = cross(shared)?;
    place_on_screen(shared, pixel.map(|at| f64::from(at) + 0.5), size)
}

/// The side of the picture that the cross is not on.
pub(crate) fn free_side(shared: &Shared) -> Side {
    let width = shared.raster().map_or(0, |(cells, _)| cells.width);
    match cross_cell(shared) {
        Some((column, _)) if width / 2 <= column => Side::Left,
        _ => Side::Right,
    }
}

/// The size of the picture on screen, whose pixels are inspected.
fn frame_size(shared: &Shared) -> Option<Size> {
    let latest = shared.picture().latest.as_ref().map(|frame| frame.whole());
    latest.or_else(|| display::frame_window(shared).map(|frame_window| frame_window.size))
}

/// Where a place of the picture is on screen, in cells from the picture's corner; the whole picture
/// has the size `whole`.
pub(crate) fn place_on_screen(shared: &Shared, [x, y]: [f64; 2], whole: Size) -> Option<[f64; 2]> {
    let (_, halves) = shared.raster()?;
    let scaled = |at: f64, to: u32, from: u32| at * f64::from(to) / f64::from(from.max(1));
    let place = [
        scaled(x, halves.width, whole.width),
        scaled(y, halves.height, whole.height),
    ];
    let [column, half] = display::frame_window(shared)?.on_screen(place, halves);
    Some([column, 0.5 * half])
}

/// The node under a pixel of the picture on screen. Fails if it cannot be determined: objects
/// are known by their numbers in the scene shown, which may differ from the text's.
pub(crate) fn node_at(shared: &Shared, pixel: [u32; 2]) -> Result<Option<Node>, &'static str> {
    if 0 < shared.error_count() {
        return Err("the text has errors: the picture shows the last valid scene");
    }
    if shared.picture().is_outdated() {
        return Err("the preview does not show the changed scene yet");
    }
    let object = shared.picture().object_at(pixel);
    Ok(object.map(|object| Node::Object(shared.source().object(object))))
}

/// The node whose symbol or surface is under the cross.
pub(super) fn node_under_cross(shared: &Shared) -> Result<Option<Node>, &'static str> {
    let symbol = cross_cell(shared).and_then(|cell| display::symbol_at(shared, cell));
    match (symbol, cross(shared)) {
        (None, Some(cross)) => node_at(shared, cross.pixel),
        (symbol, _) => Ok(symbol),
    }
}

/// The line of the text on which a node begins, from 1.
pub(crate) fn line_of(shared: &Shared, node: Node) -> usize {
    Position::of(shared.document.text(), shared.source().span(node).start()).line
}

/// Selects the node whose symbol is at a cell of the picture, and ends inspecting; returns whether
/// there is one.
pub(crate) fn pick_symbol(shared: &mut Shared, cell: (u16, u16)) -> bool {
    let node = display::symbol_at(shared, cell);
    if let Some(node) = node {
        pick_node(shared, node);
    }
    node.is_some()
}

/// Selects a node found in the picture, and ends inspecting.
pub(crate) fn pick(shared: &mut Shared, found: Result<Option<Node>, &'static str>) {
    match found {
        Ok(Some(node)) => pick_node(shared, node),
        Ok(None) => shared.say("nothing there"),
        Err(reason) => shared.refuse_picture(Severity::Warning, reason),
    }
}

/// Selects a node that was picked in the picture, and leaves INSPECT.
pub(super) fn pick_node(shared: &mut Shared, node: Node) {
    shared.select(node);
    if shared.mode == Mode::Inspect {
        shared.mode = Mode::Select;
    }
}
