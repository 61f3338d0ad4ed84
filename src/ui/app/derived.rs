//! Values derived from the state, for drawing and for steps alike.

use ratatui::layout::Rect;

use super::App;
use super::cursor::row_of;
use super::disk::OnDisk;
use super::overlays::Dialog;
use super::picture::Picture;
use super::pictures::Outline;
use crate::language::table::Field;
use crate::language::{Node, Nodes, Source};
use crate::scene::{Camera, Integrator, Size};
use crate::text::Diagnostic;
use crate::ui::errors::{self, Panel, Wrong};
use crate::ui::keymap::{Context, Mode};
use crate::ui::layout::{Areas, Zoom, arrange, raster};

/// The picture size without a scene.
const NO_SCENE: Size = Size {
    width: 4,
    height: 3,
};

impl App {
    /// The context whose keys are active; keys typed into a line take precedence.
    pub fn context(&self) -> Context {
        match &self.overlays.dialog {
            Some(Dialog::Quit) => Context::Quit,
            Some(Dialog::Conflict { .. }) => Context::Conflict,
            Some(Dialog::Recover(_)) => Context::Recover,
            None if self.overlays.help.is_some() => Context::Help,
            None if self.overlays.errors.is_some() => Context::Errors,
            None if self.disk.is_opening() => Context::Opening,
            None => Context::In(self.mode),
        }
    }

    /// How much of the screen the picture currently takes.
    pub fn zoom_now(&self) -> Zoom {
        match self.mode {
            Mode::Trace => Zoom::Picture,
            _ => self.zoom,
        }
    }

    /// The layout of the screen.
    pub fn areas(&self) -> Areas {
        self.areas_at(self.zoom_now())
    }

    /// The cells of the picture on screen and its size in pixels; `None` if there is no room.
    pub fn raster(&self) -> Option<(Rect, Size)> {
        raster(self.areas().picture, self.output())
    }

    /// Like [`App::raster`], but for the preview even while the full-size trace is on screen.
    pub(super) fn preview_size(&self) -> Option<Size> {
        raster(self.areas_at(self.zoom).picture, self.output()).map(|(_, size)| size)
    }

    /// The picture on screen.
    pub fn picture(&self) -> &Picture {
        self.pictures.seen(self.mode)
    }

    /// The picture on screen, mutable in order to advance it.
    pub fn picture_mut(&mut self) -> &mut Picture {
        self.pictures.seen_mut(self.mode)
    }

    /// The camera of the pictures: the working view, otherwise the scene's own.
    pub fn camera(&self) -> Option<Camera> {
        self.pictures.camera(self.own_camera())
    }

    /// The scene's own camera, regardless of the working view.
    pub(super) fn own_camera(&self) -> Option<Camera> {
        self.scene.as_ref().map(|scene| scene.camera)
    }

    /// Whether the integrator differs from the scene's choice.
    pub fn is_integrator_changed(&self) -> bool {
        let own = self.scene.as_ref().map(|scene| scene.setting.integrator);
        self.integrator() != own.unwrap_or_default()
    }

    /// The integrator: the user's choice, otherwise the scene's.
    pub fn integrator(&self) -> Integrator {
        self.pictures.integrator(self.scene.as_deref())
    }

    /// Size of the output picture.
    pub fn output(&self) -> Size {
        self.camera().map_or(NO_SCENE, |camera| camera.size)
    }

    /// The number of errors in the current text; the picture is stale if there are any.
    pub fn error_count(&self) -> usize {
        self.diagnostics.errors()
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

    /// The list of errors and warnings over the picture, if there are any to show.
    pub(crate) fn errors_panel(&self, area: Rect) -> Option<Panel> {
        errors::panel(&self.wrong(), &self.disk.name(), area)
    }

    /// Whether the file on disk has errors while the text has none.
    pub fn is_disk_wrong(&self) -> bool {
        matches!(self.disk.state, OnDisk::Faulty(_)) && self.error_count() == 0
    }

    /// Whether the file holds the text.
    pub(super) fn is_saved(&self) -> bool {
        !self.document.is_dirty() && self.disk.state == OnDisk::Known
    }

    /// Describes what would be lost by quitting now; `None` if nothing.
    pub fn losses(&self) -> Option<String> {
        let name = self.disk.name();
        let text = if self.document.is_dirty() {
            Some(format!("{name} has unsaved edits"))
        } else {
            let is_missing = self.disk.state == OnDisk::Missing;
            is_missing.then(|| format!("{name} no longer exists"))
        };
        let export = self.jobs.export.as_ref().map(|export| {
            let name = export.destination.path.display();
            format!("{name} is still being exported")
        });
        let save = self.jobs.file_being_saved();
        let save = save.map(|path| format!("{} is still being written", path.display()));
        match (text, export) {
            (None, export) => export.or(save),
            (text, None) => text,
            (Some(text), Some(export)) => Some(format!("{text}, and {export}")),
        }
    }

    /// The size of one nudge of a field.
    pub fn step(&self, field: &Field) -> f64 {
        self.cursor.stride.of(field.step)
    }

    /// The object to outline in the picture.
    pub fn marked_object(&self) -> Option<u32> {
        let marks = self.mode == Mode::Select && self.pictures.outline == Outline::Marked;
        match self.cursor.selected() {
            Node::Object(index) if marks && self.error_count() == 0 => self.source().drawn(index),
            _ => None,
        }
    }

    /// The current text with its parsed structure.
    pub fn source(&self) -> &Source {
        self.document.source()
    }

    /// The nodes of the current text: the rows of the list.
    pub fn nodes(&self) -> Nodes {
        self.source().nodes()
    }

    /// The list's row of the selected node.
    pub fn selected_row(&self) -> usize {
        row_of(self.source(), self.cursor.selected())
    }

    /// The fields of the selected node as shown.
    pub fn fields(&self) -> Vec<FieldRow> {
        let fields = 0..self.cursor.fields().len();
        fields.filter_map(|index| self.field_row(index)).collect()
    }

    /// The most severe error or warning about a field of the selected node.
    pub fn field_finding(&self, index: usize) -> Option<&Diagnostic> {
        let placed = self.cursor.fields().get(index)?;
        let touches = |d: &&Diagnostic| {
            let mut spans = (0..).zip(&placed.spans);
            spans.any(|(at, span)| placed.default_of(at).is_none() && d.span.touches(*span))
        };
        let found = self.diagnostics.iter().filter(touches);
        found.max_by_key(|d| d.severity)
    }

    /// The layout of an area of the screen.
    pub fn areas_in(&self, area: Rect, zoom: Zoom) -> Areas {
        arrange(
            area,
            zoom,
            self.cursor.fields().len() + self.cursor.parts().len(),
        )
    }

    fn areas_at(&self, zoom: Zoom) -> Areas {
        let (columns, rows) = self.terminal;
        self.areas_in(Rect::new(0, 0, columns, rows), zoom)
    }

    pub(super) fn field_row(&self, index: usize) -> Option<FieldRow> {
        let placed = self.cursor.fields().get(index)?;
        let source = self.source();
        let written = (0..).zip(&placed.spans).map(|(component, span)| {
            let literal = || source.leaf_text(*span).to_owned();
            let default = placed.default_of(component);
            default.map_or_else(
                || (literal(), Provenance::Text),
                |default| (default.to_owned(), Provenance::Default),
            )
        });
        let (literals, sources): (Vec<_>, Vec<_>) = written.unzip();
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
        if let (Node::View, Some(view), Some(scene)) =
            (self.cursor.selected(), &self.pictures.view, scene)
            && shown(view) != shown(&scene.camera)
        {
            return Some(row(shown(view), Provenance::WorkingView));
        }
        Some(match scene {
            Some(scene) if literals.is_empty() => row(shown(&scene.camera), Provenance::Default),
            None if literals.is_empty() => row(
                vec!["?".to_owned(); placed.field.kind.components()],
                Provenance::Default,
            ),
            _ => FieldRow {
                field: placed.field,
                literals,
                sources,
            },
        })
    }
}

/// A field of the selected node as shown; see [`App::fields`].
#[derive(Clone, Debug, PartialEq)]
pub struct FieldRow {
    /// Its description in the language's table.
    pub field: &'static Field,
    /// One literal per component.
    pub literals: Vec<String>,
    /// The provenance of each literal.
    pub sources: Vec<Provenance>,
}

impl FieldRow {
    /// Whether all literals have this provenance.
    pub fn is_all(&self, source: Provenance) -> bool {
        self.sources.iter().all(|&of| of == source)
    }
}

/// The provenance of a field's literal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Provenance {
    /// It is in the text.
    Text,
    /// It is a default, absent from the text.
    Default,
    /// It is from the working view, which differs from the text here.
    WorkingView,
}
