//! Changing fields: every change is an edit of the text, and one that makes an error is refused.

use super::{App, Mode};
use crate::language::Node;
use crate::language::table::Field;
use crate::language::{Before, Lowered, Visibility};
use crate::scene::Camera;
use crate::text::{Diagnostic, Edit, Span};

impl App {
    /// Reads the text's meaning again.
    pub(super) fn relower(&mut self) {
        let lowered = self.lowered();
        self.install(lowered);
    }

    /// What the text means after an edit, of which `changed` is what it put in the place of the bytes
    /// `old`. What is known of the text is what it meant before.
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
            .lower_again(&self.meshes, before, [old, changed]);
        lowered.unwrap_or_else(|refused| Lowered::refused(&refused))
    }

    /// What the text means; nothing but an error where there is no memory for it.
    pub(super) fn lowered(&mut self) -> Lowered {
        let lowered = self.document.lower(&self.meshes);
        lowered.unwrap_or_else(|refused| Lowered::refused(&refused))
    }

    /// Takes what the text means now.
    pub(super) fn install(&mut self, lowered: Lowered) {
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
        let said = self.said_view_parts();
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
        if refused.is_none() && self.said_view_parts() < said {
            refused = found.iter().find(touches).or_else(|| found.first());
        }
        if let Some(refused) = refused.cloned() {
            self.document.reject();
            return Err(refused);
        }
        self.install(lowered);
        Ok(())
    }

    fn said_view_parts(&self) -> usize {
        let fields = self.source().fields(Node::View);
        fields.iter().filter(|part| part.is_said()).count()
    }

    /// Sets components of the current field.
    pub(super) fn assign(&mut self, values: &[(usize, String)]) -> Result<(), Diagnostic> {
        let placed = self.placed();
        let Some(placed) = placed.get(self.field) else {
            return Ok(());
        };
        let is_camera = self
            .scene
            .as_ref()
            .is_some_and(|scene| self.field < self.source().view_literals(&scene.camera).len());
        let works = self.view.is_some() && is_camera && !placed.field.kind.is_size();
        if self.selected == Node::View && (works || placed.spans.is_empty()) {
            return self.assign_view(placed.field, values);
        }
        let edits = placed.edits(&**self.source(), values);
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
            camera = self
                .source()
                .view_saying(&camera, place, literal)
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
        let edits = self.source().view_edits(before, camera);
        self.try_edits(&edits)
    }

    /// Draws the selected object no longer, or again.
    pub(super) fn toggle_visibility(&mut self) {
        let Node::Object(object) = self.selected else {
            self.fail("only objects are shown or hidden");
            return;
        };
        let (wanted, done) = match self.source().drawn(object) {
            Some(_) => (Visibility::Hidden, "hidden"),
            None => (Visibility::Shown, "shown"),
        };
        let edits = self.source().visibility_edits(object, wanted);
        self.document.end_step();
        let outcome = edits.map_err(str::to_owned).and_then(|edits| {
            let refused = self.try_edits(&edits);
            refused.map_err(|refused| refused.message)
        });
        self.document.end_step();
        match outcome {
            Ok(()) => self.say(format!("{} is {done}", self.source().name(self.selected))),
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
        let lowered = self.lowered_again(old, span);
        self.install(lowered);
        if let Some(node) = self.source().node_at(span)
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
