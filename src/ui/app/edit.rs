//! Changing fields: every change is an edit of the text, and one that makes an error is refused.

use super::{App, Mode};
use crate::scene::fields::Field;
use crate::scene::{self, Before, Camera, Lowered, Node, Visibility};
use crate::text::{Diagnostic, Edit, Span};

impl App {
    /// Reads the text's meaning again.
    pub(super) fn relower(&mut self) {
        self.install(self.lowered());
    }

    /// What the text means after an edit, of which `changed` is what it put in the place of the bytes
    /// `old`. What is known of the text is what it meant before.
    fn lowered_again(&self, old: Span, changed: Span) -> Lowered {
        let Some(scene) = self.scene.as_ref().filter(|_| self.error_count() == 0) else {
            return self.lowered();
        };
        let before = Before {
            scene,
            origins: &self.origins,
            diagnostics: &self.diagnostics,
        };
        let (text, tree) = (self.document.text(), self.document.tree());
        scene::lower_again(text, tree, &self.meshes, before, [old, changed])
    }

    /// What the text means; nothing but an error where there is no memory for it.
    pub(super) fn lowered(&self) -> Lowered {
        let (text, tree) = (self.document.text(), self.document.tree());
        match scene::fits(text, tree) {
            Ok(()) => scene::lower(text, tree, &self.meshes),
            Err(refused) => Lowered::refused(tree, &refused),
        }
    }

    pub(super) fn install(&mut self, lowered: Lowered) {
        self.origins = lowered.origins;
        self.diagnostics = self.with_files(lowered.diagnostics);
        // A scene that lacks a mesh may yet have an error.
        if let Some(scene) = lowered.scene.filter(|_| !self.lacks_meshes()) {
            if let Some(view) = &mut self.view {
                view.size = scene.camera.size;
            }
            if self.view == Some(scene.camera) {
                self.view = None;
            }
            let before = self.scene.as_ref().map(|scene| scene.objects.len());
            if before.is_some_and(|count| count != scene.objects.len()) {
                self.preview.forget_objects();
            }
            if self.scene.as_deref() != Some(&scene) {
                self.scene = Some(scene.into());
                self.pending.scene = true;
            }
        }
        self.keep_selection();
    }

    /// Keeps the selection on a thing that is there, and the cursor on a component of it.
    pub(super) fn keep_selection(&mut self) {
        if let Some(node) = self.nodes().get(self.row_of(self.selected)) {
            self.selected = node;
        }
        self.keep_cursor();
    }

    /// Keeps the cursor on a component that is there.
    pub(super) fn keep_cursor(&mut self) {
        let placed = self.placed();
        self.field = self.field.min(placed.len().saturating_sub(1));
        let components = placed
            .get(self.field)
            .map_or(1, |placed| placed.field.kind.components());
        self.component = self.component.min(components - 1);
        if placed.is_empty() && self.mode == Mode::Edit {
            self.mode = Mode::Select;
        }
    }

    /// Makes edits, unless they leave more errors than there were or one where they were made:
    /// that one comes back, and the text is as before.
    pub(super) fn try_edits(&mut self, edits: &[Edit]) -> Result<(), Diagnostic> {
        let said = self.said_view_parts(&self.origins);
        let errors = self.error_count();
        match edits {
            [edit] if !edit.span.is_empty() => self.document.set(edit.span, &edit.text),
            _ => self.document.edit(edits),
        }
        let touched = spans_after(edits);
        let lowered = match (edits, &touched[..]) {
            ([edit], &[changed]) => self.lowered_again(edit.span, changed),
            _ => self.lowered(),
        };
        let touches = |d: &&Diagnostic| touched.iter().any(|span| d.span.touches(*span));
        let found = &lowered.diagnostics;
        let mut refused = found.iter().filter(|d| d.is_error()).find(touches);
        if refused.is_none() && errors < found.errors() {
            refused = found.first_error();
        }
        // What is wrong in a view comment is a warning, but the whole view goes with it.
        if refused.is_none() && self.said_view_parts(&lowered.origins) < said {
            refused = found.iter().find(touches).or_else(|| found.first());
        }
        if let Some(refused) = refused.cloned() {
            self.document.reject();
            return Err(refused);
        }
        self.install(lowered);
        Ok(())
    }

    fn said_view_parts(&self, origins: &scene::Origins) -> usize {
        let fields = origins.fields(self.document.tree(), Node::View);
        fields.iter().filter(|part| part.is_said()).count()
    }

    /// Sets components of the current field.
    pub(super) fn assign(&mut self, values: &[(usize, String)]) -> Result<(), Diagnostic> {
        let placed = self.placed();
        let Some(placed) = placed.get(self.field) else {
            return Ok(());
        };
        let is_camera = self.scene.as_ref().is_some_and(|scene| {
            self.field < scene::view_literals(&self.origins, &scene.camera).len()
        });
        let works = self.view.is_some() && is_camera && !placed.field.kind.is_size();
        if self.selected == Node::View && (works || placed.spans.is_empty()) {
            return self.assign_view(placed.field, values);
        }
        let edits = placed.edits(self.document.text(), self.document.tree(), values);
        self.try_edits(&edits)
    }

    /// Sets components of the working view, or of a part of the view that the text does not say.
    fn assign_view(&mut self, field: &Field, values: &[(usize, String)]) -> Result<(), Diagnostic> {
        let refuse = |said: &str| {
            let message = format!("view {}: {said}", field.key);
            Diagnostic::error(Span::at(0), message, field.allowed.words())
        };
        let scene = self.scene.clone().filter(|_| self.error_count() == 0);
        let (Some(scene), Some(camera)) = (scene, self.camera()) else {
            return Err(refuse("can't be set while the scene has errors"));
        };
        // The picture's size is the text's alone: setting it must not write the working view.
        let is_size = field.kind.is_size();
        let camera = if is_size { scene.camera } else { camera };
        let mut camera = camera;
        for (component, literal) in values {
            let place = (self.field, *component);
            camera = scene::view_saying(&self.origins, &camera, place, literal)
                .map_err(|limits| refuse(&format!("must be {limits}")))?;
        }
        if camera.eye == camera.target {
            return Err(refuse("eye and target must differ"));
        }
        if self.view.is_some() && !is_size {
            self.set_view(camera);
            return Ok(());
        }
        self.write_camera(&camera, &scene.camera)
    }

    /// Makes the text say a camera where it differs from the text's own.
    pub(super) fn write_camera(
        &mut self,
        camera: &Camera,
        before: &Camera,
    ) -> Result<(), Diagnostic> {
        let (text, tree) = (self.document.text(), self.document.tree());
        let edits = scene::view_edits(text, tree, &self.origins, before, camera);
        self.try_edits(&edits)
    }

    /// Draws the selected object no longer, or again.
    pub(super) fn toggle_visibility(&mut self) {
        let Node::Object(object) = self.selected else {
            self.fail("only objects are shown or hidden");
            return;
        };
        let (wanted, done) = match self.origins.drawn(object) {
            Some(_) => (Visibility::Hidden, "hidden"),
            None => (Visibility::Shown, "shown"),
        };
        let (text, tree) = (self.document.text(), self.document.tree());
        let edits = scene::visibility_edits(text, tree, &self.origins, object, wanted);
        self.document.end_step();
        let outcome = edits.map_err(str::to_owned).and_then(|edits| {
            let refused = self.try_edits(&edits);
            refused.map_err(|refused| refused.message)
        });
        self.document.end_step();
        match outcome {
            Ok(()) => self.say(format!("{} is {done}", self.origins.name(self.selected))),
            Err(reason) => self.fail(reason),
        }
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

    /// Reads the text again, which had this length before, goes to the thing that changed and says
    /// which it is.
    fn show_change(&mut self, length: usize, changed: Option<Span>, done: &str, otherwise: &str) {
        let Some(span) = changed else {
            self.say(otherwise);
            return;
        };
        // As much is behind the change as was before it.
        let behind = self.document.text().len() - span.end();
        let old = Span::new(span.start(), length - behind);
        self.install(self.lowered_again(old, span));
        if let Some(node) = self.origins.node_at(self.document.tree(), span)
            && node != self.selected
        {
            self.select(node);
        }
        if let Some(field) = self
            .placed()
            .iter()
            .position(|placed| placed.spans.iter().any(|s| s.touches(span)))
        {
            self.field = field;
            self.keep_cursor();
        }
        match self.place_name(span) {
            Some(place) => self.say(format!("{done}: {place}")),
            None => self.say(done),
        }
    }
}

/// Where edits stand in the text after they were made.
fn spans_after(edits: &[Edit]) -> Vec<Span> {
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
