//! Changing fields: every change is an edit of the text, and edits that cause errors are refused.

use std::sync::Arc;

use super::Shared;
use super::assets::Notice;
use super::cursor::Names;
use super::live_edit::Meaning;
use super::messages::About;
use crate::assets::{Loaded, Wanted};
use crate::language::{Lowered, Node, Nodes};
use crate::scene::Scene;
use crate::text::{Diagnostic, Edit, Findings, Span, parse_number};
use crate::ui::keymap::Mode;
use crate::ui::msg::Effect;

impl Shared {
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
                let (severity, words) = self.assets.faults(&self.key_for("errors"));
                if let Some(severity) = severity {
                    self.overlays.complain(About::Assets, severity, &words);
                } else {
                    self.overlays.end_complaint(About::Assets);
                    self.overlays.say(words);
                }
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

    /// Lowers the text after an edit, reusing what is known of the text before.
    pub(super) fn lowered_after(&mut self, before: Option<&Meaning>) -> Lowered {
        let Some(before) = before else {
            return self.lowered();
        };
        let meshes = &self.assets.meshes;
        let lowered = self.document.lower_again(meshes, before.before());
        lowered.unwrap_or_else(|refused| Lowered::refused(&refused))
    }

    /// What the text means, if it has no errors.
    pub(super) fn meaning(&self) -> Option<Meaning> {
        let scene = self.sound_scene()?;
        let findings = self.reported.clone();
        Some(Meaning { scene, findings })
    }

    /// The scene if the text has no errors.
    pub(super) fn sound_scene(&self) -> Option<Arc<Scene>> {
        self.scene.clone().filter(|_| self.error_count() == 0)
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
        self.reported = self.assets.report(path, source, lowered.diagnostics);
        if !self.assets.have_faults() {
            self.overlays.end_complaint(About::Assets);
        }
        self.keep_solo();
        // A scene that lacks a mesh may still have an error.
        if let Some(scene) = lowered.scene.filter(|_| !self.assets.lack_meshes())
            && self.pictures.follow(self.scene.as_deref(), &scene)
        {
            self.scene = Some(scene.into());
        }
        self.judge_text();
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
        let before = self.meaning();
        self.try_edits_after(before.as_ref(), edits)
    }

    /// As [`Shared::try_edits`], given what the text before the edits means; the scene may be that of other
    /// edits, which were taken back.
    pub(super) fn try_edits_after(
        &mut self,
        before: Option<&Meaning>,
        edits: &[Edit],
    ) -> Result<(), Diagnostic> {
        self.attempt(edits, |shared| shared.lowered_after(before))
    }

    fn attempt(
        &mut self,
        edits: &[Edit],
        lower: impl FnOnce(&mut Self) -> Lowered,
    ) -> Result<(), Diagnostic> {
        let written = self.written_view_parts();
        let errors = self.error_count();
        let skipped = self.skipped_settings(&self.reported);
        let names = self.names_after(edits);
        let step = self.name_of_value(edits);
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
        // A warning of a render setting means that it is skipped; others may have been before.
        if refused.is_none() && skipped < self.skipped_settings(found) {
            let is_setting = |d: &&Diagnostic| self.source().node_at(d.span) == Some(Node::Render);
            let mut settings = found.iter().filter(is_setting);
            refused = settings.clone().find(touches).or_else(|| settings.next());
        }
        if let Some(refused) = refused.cloned() {
            self.document.reject();
            return Err(refused.refused());
        }
        let step = step.unwrap_or_else(|| self.name_of_change(&touched));
        self.document.name_step(step);
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

    /// The number of warnings of render settings.
    fn skipped_settings(&self, found: &Findings) -> usize {
        let nodes = found.iter().map(|d| self.source().node_at(d.span));
        nodes.filter(|node| *node == Some(Node::Render)).count()
    }

    fn written_view_parts(&self) -> usize {
        let fields = self.source().fields(Node::View);
        fields.iter().filter(|part| part.is_explicit()).count()
    }

    pub(super) fn undo(&mut self) -> Vec<Effect> {
        let done = self.step_back();
        self.overlays
            .say(done.as_deref().unwrap_or("nothing to undo"));
        self.catch_up()
    }

    pub(super) fn redo(&mut self) -> Vec<Effect> {
        let done = self.step_forward();
        self.overlays
            .say(done.as_deref().unwrap_or("nothing to redo"));
        self.catch_up()
    }

    /// Undoes a step and selects what it changed; returns what to say, or `None` without a step.
    pub(super) fn step_back(&mut self) -> Option<String> {
        let (before, step) = (self.nodes(), self.document.undoable());
        let done = step.map(|step| format!("undone: {step}"));
        let changed = self.undo_text();
        self.show_change(&before, changed);
        done
    }

    /// Redoes a step and selects what it changed; returns what to say, or `None` without a step.
    pub(super) fn step_forward(&mut self) -> Option<String> {
        let (before, step) = (self.nodes(), self.document.redoable());
        let done = step.map(|step| format!("redone: {step}"));
        let changed = self.redo_text();
        self.show_change(&before, changed);
        done
    }

    /// Lowers the text after an undo or redo, and selects the changed node, given the nodes before.
    fn show_change(&mut self, before: &Nodes, changed: Option<Span>) {
        let Some(span) = changed else {
            return;
        };
        let meaning = self.meaning();
        let lowered = self.lowered_after(meaning.as_ref());
        self.install(lowered);
        let node_at = |at: usize| self.source().node_at(Span::at(at));
        if *before != self.nodes() || node_at(span.start()) != node_at(span.end()) {
            self.select_restructured();
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
    }

    /// Selects what an undone or redone change of several places was about.
    fn select_restructured(&mut self) {
        let span = self.document.longest_change();
        let written = self.first_node_in(span);
        if let Some(node) = written.or_else(|| self.source().node_at(span)) {
            self.select(node);
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
