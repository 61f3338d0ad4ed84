//! What follows from the state: read by drawing and by the steps alike.

use ratatui::layout::Rect;

use super::picture::Picture;
use super::{App, Disk, FieldRow, Mode, Outline, Provenance, Stride};
use crate::language::Placed;
use crate::language::table::Field;
use crate::language::{Node, Nodes, Source};
use crate::scene::{Camera, Size};
use crate::text::Findings;
use crate::ui::view::layout::{Areas, Zoom, arrange, raster};

/// The size of a picture of nothing.
const NO_SCENE: Size = Size {
    width: 4,
    height: 3,
};

/// The most parts of a combined object that are listed.
const MOST_PARTS: usize = 32;

impl App {
    /// How much of the screen the picture takes now.
    pub fn zoom_now(&self) -> Zoom {
        match self.mode {
            Mode::Trace => Zoom::Picture,
            _ => self.zoom,
        }
    }

    /// Where everything is on the screen.
    pub fn areas(&self) -> Areas {
        self.areas_at(self.zoom_now())
    }

    /// The cells of the picture on screen and its size in pixels; `None` where there is no room.
    pub fn raster(&self) -> Option<(Rect, Size)> {
        raster(self.areas().picture, self.output())
    }

    /// As [`App::raster`], for the preview even while the full-size trace is on screen.
    pub(super) fn preview_size(&self) -> Option<Size> {
        raster(self.areas_at(self.zoom).picture, self.output()).map(|(_, size)| size)
    }

    /// The picture on screen.
    pub fn picture(&self) -> &Picture {
        match (self.mode, &self.trace) {
            (Mode::Trace, Some(trace)) => trace,
            _ => &self.preview,
        }
    }

    /// The picture on screen, to bring newer rows to it.
    pub fn picture_mut(&mut self) -> &mut Picture {
        match (self.mode, &mut self.trace) {
            (Mode::Trace, Some(trace)) => trace,
            _ => &mut self.preview,
        }
    }

    /// From where the pictures are seen: the working view, or the scene's own camera.
    pub fn camera(&self) -> Option<Camera> {
        self.view.or_else(|| Some(self.scene.as_ref()?.camera))
    }

    /// Size of the output picture.
    pub fn output(&self) -> Size {
        self.camera().map_or(NO_SCENE, |camera| camera.size)
    }

    /// How many errors the text as it stands has; the picture is stale if there are any.
    pub fn error_count(&self) -> usize {
        self.diagnostics.errors()
    }

    /// The errors and warnings to be shown, and the text they are in: those of the file on disk
    /// where it is what is wrong.
    pub fn wrong(&self) -> (&str, &Findings) {
        match &self.broken {
            Some(broken) if self.is_disk_wrong() => (&broken.text, &broken.diagnostics),
            _ => (self.document.text(), &self.diagnostics),
        }
    }

    /// Whether the file on disk has errors while the text has none.
    pub fn is_disk_wrong(&self) -> bool {
        self.disk == Disk::Broken && self.broken.is_some() && self.error_count() == 0
    }

    /// What would be lost if the program ended now, in words; `None` is nothing.
    pub fn losses(&self) -> Option<String> {
        let edits = format!("{} has edits that are not saved", self.file_name());
        let export = self.export.as_ref().map(|export| {
            let name = export.destination.path.display();
            format!("the export to {name} is not done")
        });
        let save = self.file_being_saved();
        let save = save.map(|path| format!("{} is still being written", path.display()));
        match (self.document.is_dirty(), export) {
            (false, export) => export.or(save),
            (true, None) => Some(edits),
            (true, Some(export)) => Some(format!("{edits}, and {export}")),
        }
    }

    /// How far one nudge of a field goes now.
    pub fn step(&self, field: &Field) -> f64 {
        match self.stride {
            Stride::Fine => field.step / 10.0,
            Stride::Plain => field.step,
            Stride::Coarse => field.step * 10.0,
        }
    }

    /// The object whose outline is to be marked in the picture.
    pub fn marked_object(&self) -> Option<u32> {
        let marks = self.mode == Mode::Select && self.outline == Outline::Marked;
        match self.selected {
            Node::Object(index) if marks && self.error_count() == 0 => self.source().drawn(index),
            _ => None,
        }
    }

    /// What the scene is called on screen.
    pub fn file_name(&self) -> String {
        self.path.as_ref().map_or_else(
            || "(no file)".to_owned(),
            |path| {
                path.file_name()
                    .unwrap_or(path.as_os_str())
                    .to_string_lossy()
                    .into_owned()
            },
        )
    }

    /// The text as it stands, and where its things stand in it.
    pub fn source(&self) -> &Source {
        self.document.source()
    }

    /// The things of the text as it stands: the list's rows.
    pub fn nodes(&self) -> Nodes {
        self.source().nodes()
    }

    /// The list's row of a node; the nearest one if the text no longer has it.
    pub fn row_of(&self, node: Node) -> usize {
        let nodes = self.nodes();
        nodes.before(node).min(nodes.len().saturating_sub(1))
    }

    /// The fields of the selected thing as they are shown.
    pub fn fields(&self) -> Vec<FieldRow> {
        let placed = self.placed();
        placed
            .iter()
            .enumerate()
            .map(|(index, placed)| self.field_row(index, placed))
            .collect()
    }

    /// The fields of the selected thing and where they stand in the text.
    pub(super) fn placed(&self) -> Vec<Placed> {
        self.source().fields(self.selected)
    }

    /// What the selected object combines, in order, each with how deep it lies below it: the first
    /// ones, if they are many. Nothing where it is not a combination.
    pub fn parts(&self) -> Vec<(usize, Node)> {
        match self.selected {
            Node::Object(object) => self.source().parts(object, 1 + MOST_PARTS).split_off(1),
            _ => Vec::new(),
        }
    }

    /// Where everything is in an area of the screen.
    pub fn areas_in(&self, area: Rect, zoom: Zoom) -> Areas {
        arrange(area, zoom, self.placed().len() + self.parts().len())
    }

    fn areas_at(&self, zoom: Zoom) -> Areas {
        let (columns, rows) = self.terminal;
        self.areas_in(Rect::new(0, 0, columns, rows), zoom)
    }

    fn field_row(&self, index: usize, placed: &Placed) -> FieldRow {
        let source = self.source();
        let said = (0..).zip(&placed.spans).map(|(component, span)| {
            let said = || source.said(*span).to_owned();
            let default = placed.default_of(component);
            default.map_or_else(
                || (said(), Provenance::Text),
                |default| (default.to_owned(), Provenance::Default),
            )
        });
        let (said, sources): (Vec<_>, Vec<_>) = said.unzip();
        let row = |literals, source| FieldRow {
            field: placed.field,
            literals,
            sources: vec![source; placed.field.kind.components()],
        };
        let shown = |camera: &Camera| -> Vec<String> {
            let literals = self.source().view_literals(camera);
            literals.into_iter().nth(index).unwrap_or_default()
        };
        let scene = self.scene.as_ref();
        if let (Node::View, Some(view), Some(scene)) = (self.selected, &self.view, scene)
            && shown(view) != shown(&scene.camera)
        {
            return row(shown(view), Provenance::WorkingView);
        }
        match scene {
            Some(scene) if said.is_empty() => row(shown(&scene.camera), Provenance::Default),
            None if said.is_empty() => row(
                vec!["?".to_owned(); placed.field.kind.components()],
                Provenance::Default,
            ),
            _ => FieldRow {
                field: placed.field,
                literals: said,
                sources,
            },
        }
    }
}
