//! Values derived from the state, for drawing and for steps alike.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ratatui::layout::Rect;

use super::after_leaving::AfterLeaving;
use super::cursor::row_of;
use super::disk::OnDisk;
use super::live_edit::Meaning;
use super::overlays::{Dialog, PromptKind};
use super::page::PageFocus;
use crate::app::pictures::frame_window::{Marked, Reason};
use crate::app::pictures::picture::Picture;
use crate::app::pictures::region::Drawing;
use crate::app::pictures::until::Until;
use crate::app::{Shared, ShownWireframe};
use crate::arrange::{Areas, Shape, Zoom, arrange};
use crate::error_panel;
use crate::error_panel::{Panel, Wrong};
use crate::keymap::{Context, Line, Mode};
use crate::layout::raster;
use crate::listing::Listing;
use crate::msg::Target;
use language::schema::Field;
use language::{Node, Nodes, Source};
use render::Region;
use scene::{Camera, Rendering, Scene, Size};
use text::counted;

/// The picture size without a scene.
const NO_SCENE: Size = Size {
    width: 4,
    height: 3,
};

/// Objects beyond which only the selected step has a picture: each one takes a second or more to derive.
const MOST_OBJECTS: usize = 200_000;
/// The same for bytes of text.
const MOST_BYTES: usize = 16 << 20;

/// The number of items named in a message at most.
const MOST_NAMED: usize = 3;

impl Shared {
    /// The context whose keys are active; keys typed into a line take precedence.
    pub fn context(&self) -> Context {
        match &self.overlays.dialog {
            Some(Dialog::Leave(AfterLeaving::Editor)) => Context::SaveFirst,
            Some(Dialog::Leave(_)) if self.is_saved() && self.is_view_unwritten() => {
                Context::MovedView
            }
            Some(Dialog::Leave(AfterLeaving::Quit)) if self.is_saved() => Context::Wait,
            Some(Dialog::Leave(AfterLeaving::Quit)) => Context::Quit,
            Some(Dialog::Leave(_)) => Context::Leave,
            Some(Dialog::Delete(_)) => Context::Delete,
            Some(Dialog::Overwrite(_)) => Context::Overwrite,
            Some(Dialog::Conflict { .. }) => Context::Conflict,
            Some(Dialog::Recover(_)) => Context::Recover,
            None if let Some(page) = &self.overlays.page => page.context,
            None if self.overlays.errors.is_some() => Context::Errors,
            None if self.disk.is_opening() => Context::Opening,
            None if self.overlays.picker.is_some() => Context::Colour,
            None if self.mode == Mode::Inspect && self.inspection.explained.is_some() => {
                Context::Rays
            }
            None if self.pictures.drawing.is_some() && self.mode == Mode::Trace => Context::Region,
            None => Context::In(self.mode),
        }
    }

    /// The line that keys are typed into, if any; a question takes precedence.
    pub fn typed_line(&self) -> Option<Line> {
        self.open_line().filter(|_| self.overlays.dialog.is_none())
    }

    /// The line that is open, if any.
    pub(crate) fn open_line(&self) -> Option<Line> {
        let overlays = &self.overlays;
        let page = overlays.page.as_ref();
        let page = page.filter(|page| page.focus == PageFocus::Search);
        match &overlays.prompt {
            Some(prompt) => Some(match prompt.kind {
                PromptKind::Command => Line::Command,
                PromptKind::Filter(_) => Line::List,
                PromptKind::Name => Line::Name,
            }),
            None if overlays.menu.is_some() => Some(Line::Menu),
            None if self.cursor.typing.is_some() => Some(Line::Value),
            None => page.map(|page| {
                if page.is_read() {
                    Line::Search
                } else {
                    Line::Rows
                }
            }),
        }
    }

    /// How much of the screen the picture currently takes.
    pub fn zoom_now(&self) -> Zoom {
        match self.seen() {
            Target::Trace => Zoom::Picture,
            _ => self.zoom,
        }
    }

    /// The layout of the screen.
    pub fn areas(&self) -> Areas {
        self.areas_at(self.zoom_now())
    }

    /// The cells of the picture on screen and its size in half blocks; `None` if there is no room.
    pub fn raster(&self) -> Option<(Rect, Size)> {
        raster(self.areas().picture, self.framed())
    }

    /// The size of the picture on screen, whose aspect ratio it has there.
    pub(crate) fn framed(&self) -> Size {
        let is_compared = self.seen() == Target::Compared;
        let compared = self.pictures.compared_size.filter(|_| is_compared);
        compared.unwrap_or_else(|| self.output())
    }

    /// Which picture is on screen.
    pub fn seen(&self) -> Target {
        match self.mode {
            Mode::Inspect => self.inspection.seen(),
            Mode::Trace => Target::Trace,
            Mode::Compare => Target::Compared,
            _ => Target::Preview,
        }
    }

    /// The picture on screen.
    pub fn picture(&self) -> &Picture {
        self.pictures.seen(self.seen())
    }

    /// The picture on screen, mutable in order to advance it.
    pub fn picture_mut(&mut self) -> &mut Picture {
        self.pictures.seen_mut(self.seen())
    }

    /// The camera of the pictures: the working view, otherwise the scene's own.
    pub fn camera(&self) -> Option<Camera> {
        self.pictures.camera(self.own_camera())
    }

    /// The scene's own camera, regardless of the working view.
    pub(crate) fn own_camera(&self) -> Option<Camera> {
        self.scene.as_ref().map(|scene| scene.camera)
    }

    /// Whether the integrator differs from the scene's choice.
    pub fn is_integrator_changed(&self) -> bool {
        let own = self.scene.as_ref().map(|scene| scene.setting.rendering);
        self.rendering().integrator() != own.unwrap_or_default().integrator()
    }

    /// The render settings: the user's, completed by the scene's.
    pub fn rendering(&self) -> Rendering {
        self.pictures.rendering(self.scene.as_deref())
    }

    /// When the full-size trace is complete.
    pub(crate) fn until(&self) -> Until {
        self.pictures.until(self.scene.as_deref())
    }

    /// Size of the output picture.
    pub fn output(&self) -> Size {
        self.camera().map_or(NO_SCENE, |camera| camera.size)
    }

    /// The number of errors in the current text; the picture is stale if there are any.
    pub fn error_count(&self) -> usize {
        self.diagnostics.errors()
    }

    /// Whether there is nothing to see: the text is blank, or its scene has no objects.
    pub fn is_empty(&self) -> bool {
        let is_bare = |scene: &Arc<Scene>| scene.objects.is_empty() && self.error_count() == 0;
        !self.disk.is_opening()
            && (self.document.text().trim().is_empty() || self.scene.as_ref().is_some_and(is_bare))
    }

    /// The errors and warnings to show and the text that they refer to: the file on disk if that is
    /// what has errors.
    pub(crate) fn wrong(&self) -> Wrong<'_> {
        let (text, findings) = match &self.disk.state {
            OnDisk::Faulty(faulty) if self.error_count() == 0 => {
                (&**faulty.text, &faulty.diagnostics)
            }
            _ => (self.document.text(), &self.diagnostics),
        };
        Wrong {
            text,
            findings,
            at: self.overlays.errors,
        }
    }

    /// The list of errors and warnings in an area, if there are any to show.
    pub(crate) fn errors_panel(&self, area: Rect) -> Option<Panel> {
        error_panel::panel(&self.wrong(), &self.disk.name(), area)
    }

    /// Whether the file on disk has errors while the text has none.
    pub fn is_disk_wrong(&self) -> bool {
        matches!(self.disk.state, OnDisk::Faulty(_)) && self.error_count() == 0
    }

    /// Whether the file holds the text.
    pub(crate) fn is_saved(&self) -> bool {
        !self.document.is_dirty() && self.disk.state == OnDisk::Known
    }

    /// The size of one nudge of a field.
    pub fn step(&self, field: &Field) -> f64 {
        self.cursor.stride.of(field.step)
    }

    /// The scene's own file and those that it uses.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let used = self.assets.files().iter().map(PathBuf::as_path);
        self.disk.path.as_deref().into_iter().chain(used)
    }

    /// The current text with its parsed structure.
    pub fn source(&self) -> &Source {
        self.document.source()
    }

    /// The nodes of the current text: the rows of the list.
    pub fn nodes(&self) -> Nodes {
        self.source().nodes()
    }

    /// The lines of the list.
    pub fn listing(&self) -> Listing<'_> {
        self.cursor.rows.listing(self.source())
    }

    /// The list's row of the selected node.
    pub fn selected_row(&self) -> usize {
        row_of(self.source(), self.cursor.selected())
    }

    /// The layout of an area of the screen.
    pub fn areas_in(&self, area: Rect, zoom: Zoom) -> Areas {
        let (lesson, rest) = self.above.split(area);
        let areas = arrange(rest, &self.shape(zoom)).below(lesson);
        // The picture is scaled to what the errors leave rather than hidden by them.
        match self.errors_panel(areas.room_for_errors()) {
            Some(panel) => areas.make_room(panel.area.height),
            None => areas,
        }
    }

    /// What the layout of the screen depends on besides its size.
    pub(crate) fn shape(&self, zoom: Zoom) -> Shape {
        Shape {
            zoom,
            output: self.framed(),
            fields: self.cursor.fields().len() + self.cursor.parts().len(),
            lines: Listing::new(self.nodes(), None).len(),
            explains: self.mode.needs_more_than_the_list(),
            panels: self.panels,
        }
    }

    pub(crate) fn areas_at(&self, zoom: Zoom) -> Areas {
        let (columns, rows) = self.terminal;
        self.areas_in(Rect::new(0, 0, columns, rows), zoom)
    }

    /// What to press for what keys with this name do, as messages say it: the first of them here or in
    /// another mode, otherwise their description in the command line.
    pub fn key_for(&self, name: &str) -> String {
        let here = self.keymap.key(self.context(), name);
        let named = || {
            let mut named = self.keymap.actions(self.mode).into_iter();
            let named = named.find(|named| named.name == name)?;
            let first = named.keys.split(' ').next().filter(|key| !key.is_empty());
            Some(first.map_or_else(|| format!(":{}", named.words), str::to_owned))
        };
        here.or_else(named).unwrap_or_default()
    }

    /// Whether the scene is too large for many pictures.
    pub fn is_large(&self) -> bool {
        let objects = self.scene.as_ref().map_or(0, |scene| scene.objects.len());
        MOST_OBJECTS < objects || MOST_BYTES < self.document.text().len()
    }

    /// The reason why there is no picture.
    pub(crate) fn no_picture(&self) -> String {
        if self.assets.are_awaited() {
            "still reading the scene's files".to_owned()
        } else {
            let errors = self.key_for("errors");
            format!("no picture: the scene has errors; press {errors} to list them")
        }
    }

    /// The wireframe if it is on screen instead of a traced picture.
    pub fn wireframe(&self) -> Option<&ShownWireframe> {
        let wireframe = self.pictures.wireframe.as_ref();
        wireframe.filter(|_| self.seen() == Target::Preview)
    }

    /// The marked nodes, otherwise the selected one.
    pub(crate) fn targets(&self) -> Vec<Node> {
        if self.cursor.marks.is_empty() {
            return vec![self.cursor.selected()];
        }
        self.cursor.marks.iter().copied().collect()
    }

    /// The name of the targets: `object 2 (box)`, or `3 marked items: ` and the names of the first.
    pub(crate) fn targets_name(&self, nodes: &[Node]) -> String {
        let shown = nodes.iter().take(MOST_NAMED);
        let names: Vec<_> = shown.map(|node| self.source().name(*node)).collect();
        let mut names = names.join(", ");
        if MOST_NAMED < nodes.len() {
            names += ", …";
        }
        match nodes {
            [node] if !self.cursor.marks.contains(node) => names,
            _ => format!("{}: {names}", counted(nodes.len(), "marked item")),
        }
    }

    /// The scene if the text has no errors.
    pub(crate) fn sound_scene(&self) -> Option<Arc<Scene>> {
        self.scene.clone().filter(|_| self.error_count() == 0)
    }

    /// What the text means, if it has no errors.
    pub(crate) fn meaning(&self) -> Option<Meaning> {
        let scene = self.sound_scene()?;
        let findings = self.reported.clone();
        Some(Meaning { scene, findings })
    }

    /// The region to mark in the full-size trace.
    pub(crate) fn marked(&self) -> Option<Marked> {
        if self.mode != Mode::Trace {
            return None;
        }
        let whole = self.output();
        let drawn = self.region_drawn().map(|region| (region, Reason::Drawn));
        let traced = self.region().map(|region| (region, Reason::Traced));
        let (region, reason) = drawn.or(traced)?;
        Some(Marked {
            whole,
            region,
            reason,
        })
    }

    /// The region of the full-size trace, if it has one that lies in the picture.
    pub(crate) fn region(&self) -> Option<Region> {
        let region = self.pictures.region?;
        region.within(self.output()).ok()
    }

    /// The region being drawn, as told in the status line.
    pub fn region_drawn(&self) -> Option<Region> {
        self.pictures.drawing.map(Drawing::region)
    }

    /// Whether the text lacks the working view, even under a name.
    pub(crate) fn is_view_unwritten(&self) -> bool {
        let Some((view, own)) = self.pictures.view.zip(self.own_camera()) else {
            return false;
        };
        let saved = self.source().saved_views();
        !saved.iter().any(|saved| saved.camera(&own) == view)
    }
}
