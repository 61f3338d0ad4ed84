//! Changing fields: every change is an edit of the text, and edits that cause errors are refused.

use super::App;
use super::assets::Notice;
use super::cursor::Names;
use super::typed::Values;
use crate::assets::{Loaded, Wanted};
use crate::language::table::Field;
use crate::language::{Before, Lowered, Node, Placed};
use crate::scene::Camera;
use crate::text::{Diagnostic, Edit, Span, cover, parse_number};
use crate::ui::keymap::{Action, Mode};

impl App {
    /// Takes files of the scene that were read.
    pub(super) fn assets_read(&mut self, wanted: &Wanted, loaded: Loaded) {
        let Some(news) = self.assets.take(wanted, loaded) else {
            return;
        };
        self.pictures.due |= news.images;
        if news.meaning {
            // Meshes may name pictures, which are requested then.
            self.relower();
        }
        match news.notice {
            Some(Notice::Faults) => {
                let (severity, words) = self.assets.faults(&self.key_for(Action::Errors));
                self.overlays.show(severity, words);
            }
            Some(Notice::Elsewhere(words)) => self.overlays.say(words),
            Some(Notice::Reloaded) => self.overlays.say("files reloaded"),
            None => {}
        }
    }

    /// Lowers the text again.
    pub(super) fn relower(&mut self) {
        let lowered = self.lowered();
        self.install(lowered);
    }

    /// Lowers the text after an edit that replaced the bytes `old` by `changed`, reusing what is
    /// known from before the edit.
    fn lowered_again(&mut self, old: Span, changed: Span) -> Lowered {
        let sound = self.error_count() == 0;
        let Some(scene) = self.scene.as_ref().filter(|_| sound) else {
            return self.lowered();
        };
        let before = Before {
            scene,
            diagnostics: &self.diagnostics,
        };
        let lowered = self
            .document
            .lower_again(&self.assets.meshes, before, [old, changed]);
        lowered.unwrap_or_else(|refused| Lowered::refused(&refused))
    }

    /// Lowers the text. If there is not enough memory, the result is only an error.
    pub(super) fn lowered(&mut self) -> Lowered {
        let lowered = self.document.lower(&self.assets.meshes);
        lowered.unwrap_or_else(|refused| Lowered::refused(&refused))
    }

    /// Installs the new meaning of the text.
    pub(super) fn install(&mut self, lowered: Lowered) {
        self.install_with(lowered, Names::Changed);
    }

    fn install_with(&mut self, lowered: Lowered, names: Names) {
        let (path, source) = (self.disk.path.as_deref(), self.document.source());
        self.diagnostics = self.assets.report(path, source, lowered.diagnostics);
        self.keep_solo();
        // A scene that lacks a mesh may still have an error.
        if let Some(scene) = lowered.scene.filter(|_| !self.assets.lack_meshes())
            && self.pictures.follow(self.scene.as_deref(), &scene)
        {
            self.scene = Some(scene.into());
        }
        self.cursor.renew(self.document.source(), names);
        self.keep_mode();
    }

    /// Ends EDIT mode if there is no field.
    pub(super) fn keep_mode(&mut self) {
        if self.cursor.fields().is_empty() && self.mode == Mode::Edit {
            self.mode = Mode::Select;
        }
    }

    /// Makes edits. If they add errors, or an error touches one of them, returns that error and
    /// leaves the text as before.
    pub(super) fn try_edits(&mut self, edits: &[Edit]) -> Result<(), Diagnostic> {
        self.attempt(edits, |app| app.lowered_after(edits))
    }

    /// As [`App::try_edits`] if the scene is that of the text after other edits of the same things,
    /// which were taken back.
    pub(super) fn try_edits_anew(&mut self, edits: &[Edit]) -> Result<(), Diagnostic> {
        // The findings would be in the wrong places.
        if self.diagnostics.is_empty() {
            self.try_edits(edits)
        } else {
            self.attempt(edits, Self::lowered)
        }
    }

    /// Lowers the text after edits.
    fn lowered_after(&mut self, edits: &[Edit]) -> Lowered {
        let after = spans_after(edits);
        match (cover(edits), after.first(), after.last()) {
            (Some(old), Some(first), Some(last)) => self.lowered_again(old, first.to(*last)),
            _ => self.lowered(),
        }
    }

    fn attempt(
        &mut self,
        edits: &[Edit],
        lower: impl FnOnce(&mut Self) -> Lowered,
    ) -> Result<(), Diagnostic> {
        let written = self.written_view_parts();
        let errors = self.error_count();
        let names = self.names_after(edits);
        match edits {
            [edit] if !edit.span.is_empty() => self.document.set(edit.span, &edit.text),
            _ => self.document.edit(edits),
        }
        let touched = spans_after(edits);
        let lowered = lower(self);
        let touches = |d: &&Diagnostic| touched.iter().any(|span| d.span.touches(*span));
        let found = &lowered.diagnostics;
        let mut refused = found.iter().filter(|d| d.is_error()).find(touches);
        if refused.is_none() && errors < found.errors() {
            refused = found.first_error();
        }
        // An error in a view comment is only a warning, but it disables the whole view.
        if refused.is_none() && self.written_view_parts() < written {
            refused = found.iter().find(touches).or_else(|| found.first());
        }
        if let Some(refused) = refused.cloned() {
            self.document.reject();
            return Err(refused);
        }
        self.install_with(lowered, names);
        Ok(())
    }

    /// Whether edits may change what nodes are called: edits of numbers do not.
    fn names_after(&self, edits: &[Edit]) -> Names {
        let text = self.document.text();
        let is_number = |edit: &Edit| {
            parse_number(edit.span.of(text)).is_ok() && parse_number(&edit.text).is_ok()
        };
        if edits.iter().all(is_number) {
            Names::Kept
        } else {
            Names::Changed
        }
    }

    fn written_view_parts(&self) -> usize {
        let fields = self.source().fields(Node::View);
        fields.iter().filter(|part| part.is_explicit()).count()
    }

    /// Sets components of the current field.
    pub(super) fn assign(&mut self, values: &[(usize, String)]) -> Result<(), Diagnostic> {
        let Some(placed) = self.cursor.current() else {
            return Ok(());
        };
        let is_camera = self.scene.as_ref().is_some_and(|scene| {
            self.cursor.field < self.source().view_literals(&scene.camera).len()
        });
        let works = self.pictures.view.is_some() && is_camera && !placed.field.kind.is_size();
        if self.cursor.selected() == Node::View && (works || placed.spans.is_empty()) {
            return self.assign_view(placed.field, values);
        }
        self.try_edits(&self.edits_of(&[(placed, values)]))
    }

    /// Sets components of the current field and those below it, in one edit.
    pub(super) fn assign_fields(&mut self, values: &[Values]) -> Result<(), Diagnostic> {
        if self.cursor.selected() == Node::View {
            let message = "the fields of the view are set one at a time";
            return Err(Diagnostic::error(Span::at(0), message, ""));
        }
        let below = self.cursor.fields().iter().skip(self.cursor.field);
        let wanted: Vec<_> = below.zip(values.iter().map(Vec::as_slice)).collect();
        self.try_edits(&self.edits_of(&wanted))
    }

    /// Whether a field is set in all marked nodes, as the selected one is one of them.
    pub(super) fn sets_marked(&self) -> bool {
        self.cursor.marks.contains(&self.cursor.selected())
    }

    /// The edits that set components of fields of the selected node or, if it is marked, of all
    /// marked nodes that have them.
    pub(super) fn edits_of(&self, wanted: &[(&Placed, &[(usize, String)])]) -> Vec<Edit> {
        let source = self.source();
        if !self.sets_marked() {
            let owned = |&(placed, values): &(_, &[_])| (placed, values.to_vec());
            return source.edits(&wanted.iter().map(owned).collect::<Vec<_>>());
        }
        let fields = self.cursor.marks.iter().map(|&node| source.fields(node));
        let found = fields.flatten().filter_map(|placed| {
            let is_meant = |(wanted, _): &&(&Placed, _)| {
                wanted.field.key == placed.field.key && wanted.field.kind == placed.field.kind
            };
            let (_, values) = wanted.iter().find(is_meant)?;
            Some((placed, values.to_vec()))
        });
        let found: Vec<_> = found.collect();
        let wanted = found
            .iter()
            .map(|(placed, values)| (placed, values.clone()));
        source.edits(&wanted.collect::<Vec<_>>())
    }

    /// Sets components of the working view, or of a part of the view that the text omits.
    fn assign_view(&mut self, field: &Field, values: &[(usize, String)]) -> Result<(), Diagnostic> {
        let refuse = |reason: &str| {
            let message = format!("view {}: {reason}", field.key);
            Diagnostic::error(Span::at(0), message, field.allowed.words())
        };
        let scene = self.scene.clone().filter(|_| self.error_count() == 0);
        let (Some(scene), Some(camera)) = (scene, self.camera()) else {
            return Err(refuse("cannot be set while the scene has errors"));
        };
        // The picture's size exists only in the text: setting it must not write the working view.
        let is_size = field.kind.is_size();
        let camera = if is_size { scene.camera } else { camera };
        let mut camera = camera;
        for (component, literal) in values {
            let place = (self.cursor.field, *component);
            camera = self
                .source()
                .view_with(&camera, place, literal)
                .map_err(|limits| refuse(&format!("must be {limits}")))?;
        }
        if camera.eye == camera.target {
            return Err(refuse("eye and target must differ"));
        }
        if self.pictures.view.is_some() && !is_size {
            self.pictures.set_view(camera, Some(scene.camera));
            return Ok(());
        }
        self.write_camera(&camera, &scene.camera)
    }

    /// Writes a camera into the text where it differs from the text's own.
    pub(super) fn write_camera(
        &mut self,
        camera: &Camera,
        before: &Camera,
    ) -> Result<(), Diagnostic> {
        let edits = self.source().view_edits(before, camera);
        self.try_edits(&edits)
    }

    pub(super) fn undo(&mut self) {
        let length = self.document.text().len();
        let changed = self.document.undo();
        self.show_change(length, changed, "undone", "nothing to undo");
    }

    pub(super) fn redo(&mut self) {
        let length = self.document.text().len();
        let changed = self.document.redo();
        self.show_change(length, changed, "redone", "nothing to redo");
    }

    /// Lowers the text after an undo or redo, selects the changed node and reports it. `length` is
    /// the text's length before.
    fn show_change(&mut self, length: usize, changed: Option<Span>, done: &str, otherwise: &str) {
        let Some(span) = changed else {
            self.overlays.say(otherwise);
            return;
        };
        // The text after the change is as long as before.
        let behind = self.document.text().len() - span.end();
        let old = Span::new(span.start(), length - behind);
        let lowered = self.lowered_again(old, span);
        self.install(lowered);
        let node_at = |at: usize| self.source().node_at(Span::at(at));
        if node_at(span.start()) != node_at(span.end()) {
            self.show_restructured(done);
            return;
        }
        if let Some(node) = self.source().node_at(span)
            && node != self.cursor.selected()
        {
            self.select(node);
        }
        if let Some(field) = self.cursor.field_at(span) {
            self.cursor.focus(field, self.cursor.component);
        }
        match self.place_name(span) {
            Some(place) => self.overlays.say(format!("{done}: {place}")),
            None => self.overlays.say(done),
        }
    }

    /// Selects what an undone or redone change of several places was about, and reports it.
    fn show_restructured(&mut self, done: &str) {
        let span = self.document.longest_change();
        let written = self.first_node_in(span);
        if let Some(node) = written.or_else(|| self.source().node_at(span)) {
            self.select(node);
        }
        match written {
            Some(node) => {
                let name = self.source().name(node);
                self.overlays.say(format!("{done}: {name}"));
            }
            None => self.overlays.say(done),
        }
    }
}

/// The spans of edits in the text after they are made.
pub(super) fn spans_after(edits: &[Edit]) -> Vec<Span> {
    let (mut removed, mut inserted) = (0, 0);
    edits
        .iter()
        .map(|edit| {
            let start = edit.span.start() + inserted - removed;
            removed += edit.span.len();
            inserted += edit.text.len();
            Span::new(start, start + edit.text.len())
        })
        .collect()
}
