//! Inspecting: a cross over the picture, and what is under it.

use super::Shared;
use super::inspection::Cross;
use crate::language::Node;
use crate::scene::Size;
use crate::text::{Position, Severity};
use crate::ui::keymap::{Context, Mode};
use crate::ui::layout::Side;

impl Shared {
    /// Starts inspecting where the cross was last if that is on screen, otherwise in the middle.
    pub(super) fn start_inspecting(&mut self) {
        let Some((cells, _)) = self.raster() else {
            self.overlays.fail("no room for a picture");
            return;
        };
        if self.mode != Mode::Inspect {
            self.inspection.begin(self.mode, self.seen());
            self.inspection.explained = None;
            self.mode = Mode::Inspect;
        }
        if self.cross_cell().is_none() {
            self.place_cross((cells.width / 2, cells.height / 2));
        }
        self.move_cross(0, 0);
    }

    /// Returns to the mode before.
    pub(super) fn stop_inspecting(&mut self) {
        self.mode = self.inspection.before();
    }

    /// The cross as a pixel of the picture on screen; in its middle before the first inspection.
    /// `None` without a picture.
    pub fn cross(&self) -> Option<Cross> {
        let size = self.frame_size()?;
        let cross = self.inspection.cross;
        let middle = || Cross::middle(size);
        Some(cross.map_or_else(middle, |cross| cross.in_size(size)))
    }

    /// Moves the cross by some pixels.
    pub(super) fn move_cross(&mut self, right: i32, down: i32) {
        if let Some(mut cross) = self.cross() {
            cross.step(right, down);
            self.inspection.cross = Some(cross);
            self.reveal_cross();
        }
    }

    /// Moves the window over a zoomed picture to the cross if that has left it.
    pub(super) fn reveal_cross(&mut self) {
        /// The share of the window that is kept between the cross and its edge.
        const MARGIN: f64 = 0.1;
        if self.cross_cell().is_none()
            && let (Some(place), Some((cells, _))) = (self.cross_place(), self.raster())
        {
            let [column, row] = place;
            let from = [
                column / f64::from(cells.width),
                row / f64::from(cells.height),
            ];
            let to = from.map(|share| share.clamp(MARGIN, 1.0 - MARGIN));
            self.shift_window(from, to);
        }
    }

    /// Moves the cross to a cell of the picture.
    pub(super) fn place_cross(&mut self, cell: (u16, u16)) {
        let (pixel, size) = (self.pixel_at(cell), self.frame_size());
        let place = pixel.zip(size);
        self.inspection.cross = place.map(|(pixel, size)| Cross { pixel, size });
    }

    /// Selects what is under the cross, and ends inspecting.
    pub(super) fn select_crossed(&mut self) {
        self.pick(self.node_under_cross());
    }

    /// The cell that the cross is in, from the upper left corner of the picture; `None` if it is not
    /// on screen.
    pub fn cross_cell(&self) -> Option<(u16, u16)> {
        let (cells, _) = self.raster()?;
        let [column, row] = self.cross_place()?;
        let is_inside = 0.0 <= column
            && 0.0 <= row
            && column < f64::from(cells.width)
            && row < f64::from(cells.height);
        is_inside.then_some((column as u16, row as u16))
    }

    /// Where the middle of the crossed pixel is, in cells from the upper left corner of the picture.
    fn cross_place(&self) -> Option<[f64; 2]> {
        let cross = self.cross()?;
        self.place_on_screen(cross.pixel.map(|at| f64::from(at) + 0.5), cross.size)
    }

    /// The side of the picture that the cross is not on.
    pub fn free_side(&self) -> Side {
        let width = self.raster().map_or(0, |(cells, _)| cells.width);
        match self.cross_cell() {
            Some((column, _)) if width / 2 <= column => Side::Left,
            _ => Side::Right,
        }
    }

    /// The size of the picture on screen, whose pixels are inspected.
    fn frame_size(&self) -> Option<Size> {
        let latest = self.picture().latest.as_ref().map(|frame| frame.whole());
        latest.or_else(|| self.frame_window().map(|frame_window| frame_window.size))
    }

    /// Where a place of the picture is on screen, in cells from the picture's corner; the whole picture
    /// has the size `whole`.
    pub fn place_on_screen(&self, [x, y]: [f64; 2], whole: Size) -> Option<[f64; 2]> {
        let (_, halves) = self.raster()?;
        let scaled = |at: f64, to: u32, from: u32| at * f64::from(to) / f64::from(from.max(1));
        let place = [
            scaled(x, halves.width, whole.width),
            scaled(y, halves.height, whole.height),
        ];
        let [column, half] = self.frame_window()?.on_screen(place, halves);
        Some([column, 0.5 * half])
    }

    /// The node under a pixel of the picture on screen. Fails if it cannot be determined: objects
    /// are known by their numbers in the scene shown, which may differ from the text's.
    pub fn node_at(&self, pixel: [u32; 2]) -> Result<Option<Node>, &'static str> {
        if 0 < self.error_count() {
            return Err("the text has errors: the picture shows the last valid scene");
        }
        if self.picture().is_outdated() {
            return Err("the preview does not show the changed scene yet");
        }
        let object = self.picture().object_at(pixel);
        Ok(object.map(|object| Node::Object(self.source().object(object))))
    }

    /// The node that the editor is to show: what is inspected, otherwise the selected one.
    pub(super) fn node_in_focus(&self) -> Node {
        let inspected = match self.context() {
            Context::Rays => self.explained_node(),
            Context::In(Mode::Inspect) => self.node_under_cross().ok().flatten(),
            _ => None,
        };
        inspected.unwrap_or_else(|| self.cursor.selected())
    }

    /// The node whose symbol or surface is under the cross.
    fn node_under_cross(&self) -> Result<Option<Node>, &'static str> {
        let symbol = self.cross_cell().and_then(|cell| self.symbol_at(cell));
        match (symbol, self.cross()) {
            (None, Some(cross)) => self.node_at(cross.pixel),
            (symbol, _) => Ok(symbol),
        }
    }

    /// The line of the text on which a node begins, from 1.
    pub fn line_of(&self, node: Node) -> usize {
        Position::of(self.document.text(), self.source().span(node).start()).line
    }

    /// Selects the node whose symbol is at a cell of the picture, and ends inspecting; returns whether
    /// there is one.
    pub(super) fn pick_symbol(&mut self, cell: (u16, u16)) -> bool {
        let node = self.symbol_at(cell);
        if let Some(node) = node {
            self.pick_node(node);
        }
        node.is_some()
    }

    /// Selects a node found in the picture, and ends inspecting.
    pub(super) fn pick(&mut self, found: Result<Option<Node>, &'static str>) {
        match found {
            Ok(Some(node)) => self.pick_node(node),
            Ok(None) => self.overlays.say("nothing there"),
            Err(reason) => self.refuse_picture(Severity::Warning, reason),
        }
    }

    pub(super) fn pick_node(&mut self, node: Node) {
        self.select(node);
        if self.mode == Mode::Inspect {
            self.mode = Mode::Select;
        }
    }
}
