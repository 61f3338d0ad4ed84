//! Values derived from the state, for drawing and for steps alike.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ratatui::layout::Rect;

use super::Shared;
use super::after_leaving::AfterLeaving;
use super::colours;
use super::cursor::row_of;
use super::disk::OnDisk;
use super::overlays::{Dialog, PromptKind};
use super::page::{List, PageFocus};
use super::picture::Picture;
use super::pictures::Outline;
use super::until::Until;
use crate::language::table::Field;
use crate::language::{Node, Nodes, Source};
use crate::scene::{Camera, Rendering, Rgb, Scene, Size};
use crate::text::Diagnostic;
use crate::ui::arrange::{Areas, Shape, Zoom, arrange};
use crate::ui::errors::{self, Panel, Wrong};
use crate::ui::keymap::{Context, Line, Mode};
use crate::ui::layout::raster;
use crate::ui::listing::Listing;
use crate::ui::msg::Target;

/// The picture size without a scene.
const NO_SCENE: Size = Size {
    width: 4,
    height: 3,
};

/// The loss of the working view.
const LOST_VIEW: &str = "the moved view is not in the text";

impl Shared {
    /// The context whose keys are active; keys typed into a line take precedence.
    pub fn context(&self) -> Context {
        match &self.overlays.dialog {
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
            None if self.overlays.help.is_some() => Context::Help,
            None if let Some(page) = &self.overlays.page => match page.list {
                List::Views(..) => Context::Views,
                List::Recent(_) => Context::Recent,
                List::Steps(_) => Context::Steps,
            },
            None if self.overlays.history.is_some() => Context::Messages,
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

    /// The line that keys are typed into, if any.
    pub fn typed_line(&self) -> Option<Line> {
        let overlays = &self.overlays;
        if overlays.dialog.is_some() {
            return None;
        }
        let help = overlays.help.as_ref();
        match &overlays.prompt {
            Some(prompt) => Some(match prompt.kind {
                PromptKind::Command => Line::Command,
                PromptKind::Filter(_) => Line::List,
                PromptKind::Name => Line::Name,
            }),
            None if overlays.menu.is_some() => Some(Line::Filter),
            None if self.cursor.typing.is_some() => Some(Line::Value),
            None => help
                .filter(|help| help.focus == PageFocus::Search)
                .map(|_| Line::Search),
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
    pub(super) fn framed(&self) -> Size {
        let is_compared = self.seen() == Target::Compared;
        let compared = self.compared.framed().filter(|_| is_compared);
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
        match self.seen() {
            Target::Compared => &self.compared.seen,
            target => self.pictures.seen(target),
        }
    }

    /// The picture on screen, mutable in order to advance it.
    pub fn picture_mut(&mut self) -> &mut Picture {
        match self.seen() {
            Target::Compared => &mut self.compared.seen,
            target => self.pictures.seen_mut(target),
        }
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
        let own = self.scene.as_ref().map(|scene| scene.setting.rendering);
        self.rendering().integrator() != own.unwrap_or_default().integrator()
    }

    /// The render settings: the user's, completed by the scene's.
    pub fn rendering(&self) -> Rendering {
        self.pictures.rendering(self.scene.as_deref())
    }

    /// When the full-size trace is complete.
    pub(super) fn until(&self) -> Until {
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
        self.losses_before(&AfterLeaving::Quit)
    }

    /// Describes what would be lost by leaving the scene now; `None` if nothing. Work under way ends
    /// only with the program.
    pub fn losses_before(&self, next: &AfterLeaving) -> Option<String> {
        let view = self.is_view_unwritten().then(|| LOST_VIEW.to_owned());
        let mut lost: Vec<_> = self.lost_text().into_iter().chain(view).collect();
        if *next == AfterLeaving::Quit {
            lost.extend(self.lost_export());
            if lost.is_empty() {
                lost.extend(self.lost_save());
            }
        }
        let last = lost.pop()?;
        Some(match lost.len() {
            0 => last,
            1 => format!("{}, and {last}", lost[0]),
            _ => format!("{}, and {last}", lost.join(", ")),
        })
    }

    /// Whether the text lacks the working view, even under a name.
    pub(super) fn is_view_unwritten(&self) -> bool {
        let Some((view, own)) = self.pictures.view.zip(self.own_camera()) else {
            return false;
        };
        let saved = self.source().saved_views();
        !saved.iter().any(|saved| saved.camera(&own) == view)
    }

    /// Why the text would be lost, if it would.
    fn lost_text(&self) -> Option<String> {
        let name = self.disk.name();
        match &self.disk.state {
            // An untouched template can be started again.
            OnDisk::New if !self.document.is_dirty() => None,
            OnDisk::New if self.disk.path.is_none() => {
                Some("the new scene is not saved".to_owned())
            }
            OnDisk::New => Some(format!("{name} is new and not saved")),
            _ if self.document.is_dirty() => Some(format!("{name} has unsaved edits")),
            OnDisk::Missing => Some(format!("{name} no longer exists")),
            _ => None,
        }
    }

    /// The export that would end too early.
    fn lost_export(&self) -> Option<String> {
        let export = self.jobs.export.as_ref()?;
        let name = export.destination.path.display();
        Some(match self.jobs.queued() {
            0 => format!("{name} is still being exported"),
            queued => format!("{name} is still being exported, and {queued} more queued"),
        })
    }

    /// The save that would not be waited for.
    fn lost_save(&self) -> Option<String> {
        let path = self.jobs.file_being_saved()?;
        Some(format!("{} is still being written", path.display()))
    }

    /// The size of one nudge of a field.
    pub fn step(&self, field: &Field) -> f64 {
        self.cursor.stride.of(field.step)
    }

    /// The objects of the scene to outline in the picture, ascending: the selected one, or those of
    /// the selected material.
    pub fn outlined_objects(&self) -> Vec<u32> {
        let outlines = matches!(self.mode, Mode::Select | Mode::Move);
        if !outlines || self.pictures.outline != Outline::Shown || 0 < self.error_count() {
            return Vec::new();
        }
        let source = self.source();
        match self.cursor.selected() {
            Node::Object(index) => source.drawn(index).into_iter().collect(),
            Node::Material(material) => {
                let drawn = self.scene.as_ref().map_or(0, |scene| scene.objects.len());
                let drawn = 0..u32::try_from(drawn).unwrap_or(u32::MAX);
                let uses = |object: &u32| source.material(source.object(*object)) == Some(material);
                drawn.filter(uses).collect()
            }
            _ => Vec::new(),
        }
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
        let areas = arrange(area, &self.shape(zoom));
        // The picture is scaled to what the errors leave rather than hidden by them.
        match self.errors_panel(areas.room_for_errors()) {
            Some(panel) => areas.make_room(panel.area.height),
            None => areas,
        }
    }

    /// What the layout of the screen depends on besides its size.
    pub(super) fn shape(&self, zoom: Zoom) -> Shape {
        Shape {
            zoom,
            output: self.framed(),
            fields: self.cursor.fields().len() + self.cursor.parts().len(),
            panels: self.panels,
        }
    }

    pub(super) fn areas_at(&self, zoom: Zoom) -> Areas {
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

/// A field of the selected node as shown; see [`Shared::fields`].
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

    /// The colour that its literals represent.
    pub fn colour(&self) -> Option<Rgb> {
        colours::of_literals(self.field.kind, &self.literals)
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
