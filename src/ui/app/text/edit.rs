//! Edits of the text: those that cause errors are refused, and the others give the scene its new meaning.

use super::naming::{name_of_change, name_of_value};
use crate::app::shared::assets::Notice;
use crate::app::shared::cursor::Names;
use crate::app::shared::live_edit::Meaning;
use crate::app::shared::messages::About;
use crate::app::{Shared, display};
use assets::{Loaded, Wanted};
use document::StepName;
use language::{Lowered, Node, Outlook, outlook};
use text::{Diagnostic, Edit, Findings, Severity, Span, keep_columns, parse_number};

/// Takes files of the scene that were read.
pub(crate) fn assets_read(shared: &mut Shared, wanted: &Wanted, loaded: Loaded) {
    let Some(news) = shared.assets.take(wanted, loaded) else {
        return;
    };
    shared.pictures.due |= news.images;
    if news.meaning {
        // Meshes may name pictures, which are requested then.
        relower(shared);
    }
    match news.notice {
        Some(Notice::Faults) => {
            if let Some(words) = shared.assets.faults(&shared.key_for("errors")) {
                let overlays = &mut shared.overlays;
                overlays.complain(About::Assets, Severity::Warning, &words);
            } else {
                shared.overlays.end_complaint(About::Assets);
                shared.say("all files can be read now");
            }
        }
        Some(Notice::Elsewhere(words)) => shared.say(words),
        Some(Notice::Reloaded) => shared.say("files reloaded"),
        None => {}
    }
}

/// Lowers the text again.
pub(crate) fn relower(shared: &mut Shared) {
    let lowered = lowered(shared);
    install(shared, lowered);
}

/// Lowers the text after an edit, reusing what is known of the text before.
pub(crate) fn lowered_after(shared: &mut Shared, before: Option<&Meaning>) -> Lowered {
    let meshes = &shared.assets.loaded.meshes;
    let lowered = match before {
        Some(before) => shared.document.lower_again(meshes, before.before()),
        None => shared.document.lower(meshes),
    };
    lowered.unwrap_or_else(|refused| Lowered::refused(&refused))
}

/// Lowers the text. If there is not enough memory, the result is only an error.
pub(crate) fn lowered(shared: &mut Shared) -> Lowered {
    lowered_after(shared, None)
}

/// Installs the new meaning of the text.
pub(crate) fn install(shared: &mut Shared, lowered: Lowered) {
    install_with(shared, lowered, Names::Changed);
}

fn install_with(shared: &mut Shared, lowered: Lowered, names: Names) {
    let (path, source) = (shared.disk.path.as_deref(), shared.document.source());
    shared.reported = shared.assets.report(path, source, lowered.diagnostics);
    if !shared.assets.have_faults() {
        shared.overlays.end_complaint(About::Assets);
    }
    display::keep_solo(shared);
    // A scene that lacks a mesh may still have an error.
    if let Some(scene) = lowered.scene.filter(|_| !shared.assets.lack_meshes())
        && shared.pictures.follow(shared.scene.as_deref(), &scene)
    {
        shared.scene = Some(scene.into());
    }
    judge_text(shared);
    shared.cursor.renew(shared.document.source(), names);
    shared.keep_mode();
}

/// Makes edits. If they add errors, or an error touches one of them, returns that error and
/// leaves the text as before.
pub(crate) fn try_edits(shared: &mut Shared, edits: &[Edit]) -> Result<(), Diagnostic> {
    let before = shared.meaning();
    try_edits_after(shared, before.as_ref(), edits)
}

/// Makes edits as an undo step of its own, as [`try_edits`] does.
pub(crate) fn try_step(shared: &mut Shared, edits: &[Edit]) -> Result<(), Diagnostic> {
    shared.document.end_step();
    let outcome = try_edits(shared, edits);
    shared.document.end_step();
    outcome
}

/// Makes edits as an undo step of this name, or shows why not; returns whether they are made.
pub(crate) fn make_step(shared: &mut Shared, edits: &[Edit], name: impl Into<String>) -> bool {
    let outcome = try_step(shared, edits);
    match &outcome {
        Ok(()) => shared.document.name_step(StepName::done(name)),
        Err(refused) => shared.fail(&*refused.message),
    }
    outcome.is_ok()
}

/// As [`try_edits`], given what the text before the edits means; the scene may be that of other
/// edits, which were taken back.
pub(super) fn try_edits_after(
    shared: &mut Shared,
    before: Option<&Meaning>,
    edits: &[Edit],
) -> Result<(), Diagnostic> {
    let written = written_view_parts(shared);
    let errors = shared.error_count();
    let skipped = skipped_settings(shared, &shared.reported);
    let names = names_after(shared, edits);
    let step = name_of_value(shared, edits);
    let [mark, _] = shared.source().comment_marks();
    let length = |span| Some(shared.document.at_first(span)?.chars().count());
    let made = keep_columns(shared.document.text(), edits, mark, length);
    match &made[..] {
        [edit] if !edit.span.is_empty() => shared.document.set(edit.span, &edit.text),
        _ => shared.document.edit(&made),
    }
    // Without the blanks behind what was to be written.
    let own = |(span, edit): (Span, &Edit)| Span::new(span.start(), span.start() + edit.text.len());
    let touched: Vec<_> = spans_after(&made).into_iter().zip(edits).map(own).collect();
    let lowered = lowered_after(shared, before);
    let touches = |d: &&Diagnostic| touched.iter().any(|span| d.span.touches(*span));
    let found = &lowered.diagnostics;
    let mut refused = found.iter().filter(|d| d.is_error()).find(touches);
    if refused.is_none() && errors < found.errors() {
        refused = found.first_error();
    }
    // An error in a view comment is only a warning, but it disables the whole view.
    if refused.is_none() && written_view_parts(shared) < written {
        refused = found.iter().find(touches).or_else(|| found.first());
    }
    // A warning of a render setting means that it is skipped; others may have been before.
    if refused.is_none() && skipped < skipped_settings(shared, found) {
        let is_setting = |d: &&Diagnostic| shared.source().node_at(d.span) == Some(Node::Render);
        let mut settings = found.iter().filter(is_setting);
        refused = settings.clone().find(touches).or_else(|| settings.next());
    }
    if let Some(refused) = refused.cloned() {
        shared.document.reject();
        return Err(refused.refused());
    }
    let step = step.unwrap_or_else(|| name_of_change(shared, &touched));
    shared.document.name_step(step);
    install_with(shared, lowered, names);
    Ok(())
}

/// Whether edits may change what nodes are called: edits of numbers do not.
fn names_after(shared: &Shared, edits: &[Edit]) -> Names {
    let text = shared.document.text();
    let is_number =
        |edit: &Edit| parse_number(edit.span.of(text)).is_ok() && parse_number(&edit.text).is_ok();
    if edits.iter().all(is_number) {
        Names::Kept
    } else {
        Names::Changed
    }
}

/// The number of warnings of render settings.
fn skipped_settings(shared: &Shared, found: &Findings) -> usize {
    let nodes = found.iter().map(|d| shared.source().node_at(d.span));
    nodes.filter(|node| *node == Some(Node::Render)).count()
}

fn written_view_parts(shared: &Shared) -> usize {
    let fields = shared.source().fields(Node::View);
    fields.iter().filter(|part| part.is_explicit()).count()
}

/// Adds what the text shows of its picture to what was found in reading it.
pub(crate) fn judge_text(shared: &mut Shared) {
    let mut found = shared.reported.clone();
    shared.suggestions.prospects.clear();
    let scene = shared.scene.clone().filter(|_| found.errors() == 0);
    let Some(scene) = scene else {
        shared.diagnostics = found;
        return;
    };
    let asked = shared.rendering();
    for Outlook { warning, prospect } in outlook(shared.source(), &scene, &scene.camera, &asked) {
        found.warning(|| warning);
        shared.suggestions.prospects.push(prospect);
    }
    shared.diagnostics = found.sorted();
}

/// The spans of edits in the text after they are made.
pub(crate) fn spans_after(edits: &[Edit]) -> Vec<Span> {
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
