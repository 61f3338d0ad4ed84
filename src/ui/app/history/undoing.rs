//! Undoing and redoing steps.

use crate::app::{Buffer, Shared, files, text};
use crate::msg::Effect;
use ::text::Span;

/// Undoes a step, and says which.
pub(crate) fn undo(shared: &mut Shared) -> Vec<Effect> {
    let done = step_back(shared);
    let owner = shared.buffer.as_ref().and_then(Buffer::owner);
    let elsewhere = owner.map(|editor| format!("undo in {editor}"));
    shared.say(done.or(elsewhere).as_deref().unwrap_or("nothing to undo"));
    files::catch_up(shared)
}

/// Redoes a step, and says which.
pub(crate) fn redo(shared: &mut Shared) -> Vec<Effect> {
    let done = step_forward(shared);
    let owner = shared.buffer.as_ref().and_then(Buffer::owner);
    let elsewhere = owner.map(|editor| format!("redo in {editor}"));
    shared.say(done.or(elsewhere).as_deref().unwrap_or("nothing to redo"));
    files::catch_up(shared)
}

/// Undoes a step and selects what it changed; returns what to say, or `None` without a step.
pub(super) fn step_back(shared: &mut Shared) -> Option<String> {
    let step = shared.document.undoable();
    let done = step.map(|step| format!("undone: {step}"));
    take_step(shared, text::undo_text);
    done
}

/// Redoes a step and selects what it changed; returns what to say, or `None` without a step.
pub(super) fn step_forward(shared: &mut Shared) -> Option<String> {
    let step = shared.document.redoable();
    let done = step.map(|step| format!("redone: {step}"));
    take_step(shared, text::redo_text);
    done
}

/// Undoes or redoes a step if there is one, lowers the text and selects the changed node.
fn take_step(shared: &mut Shared, cross: fn(&mut Shared) -> Option<Span>) {
    let before = shared.nodes();
    let Some(span) = cross(shared) else {
        return;
    };
    let meaning = shared.meaning();
    let lowered = text::lowered_after(shared, meaning.as_ref());
    text::install(shared, lowered);
    let node_at = |at: usize| shared.source().node_at(Span::at(at));
    if before != shared.nodes() || node_at(span.start()) != node_at(span.end()) {
        select_restructured(shared);
        return;
    }
    if let Some(node) = shared.source().node_at(span)
        && node != shared.cursor.selected()
    {
        shared.select(node);
    }
    if let Some(field) = shared.cursor.field_at(span) {
        shared.cursor.focus(field, shared.cursor.component);
    }
}

/// Selects what an undone or redone change of several places was about.
fn select_restructured(shared: &mut Shared) {
    let span = shared.document.longest_change();
    let written = text::first_node_in(shared, span);
    if let Some(node) = written.or_else(|| shared.source().node_at(span)) {
        shared.select(node);
    }
}
