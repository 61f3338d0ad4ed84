//! The undo history as a page: its steps, and jumping to any.

use ratatui::layout::Rect;

use super::undoing::{step_back, step_forward};
use crate::app::text::{redo_text, relower, undo_text};
use crate::app::{Page, Shared};
use crate::history_layout::HistoryLayout;
use crate::keymap::Context;
use crate::layout::split_bottom;
use document::{Document, StepName};
use text::counted;

/// Opens the page of the undo history at the present text.
pub(crate) fn list_steps(shared: &mut Shared) {
    shared.document.end_step();
    let names = step_names(&shared.document);
    if names.len() < 2 {
        shared.say("nothing has been changed yet");
        return;
    }
    let mut page = Page::of(Context::History, "Undo history", names);
    page.filter.at = shared.document.present();
    shared.overlays.open_page(page);
}

/// The names of the texts, the first one first: each is named by the step that led to it.
pub(super) fn step_names(document: &Document) -> Vec<String> {
    let names = document.states().map(|state| state.name);
    let words = |name: Option<&StepName>| name.map(ToString::to_string);
    names
        .map(|name| words(name).unwrap_or_else(|| "as opened".to_owned()))
        .collect()
}

/// The place of a text relative to the present one: `2 steps back`.
pub(crate) fn when(document: &Document, at: usize) -> String {
    let present = document.present();
    match present.checked_sub(at) {
        Some(0) => "now".to_owned(),
        Some(back) => format!("{} back", counted(back, "step")),
        None => format!("{} ahead", counted(at - present, "step")),
    }
}

/// Goes to the text under the cursor of the page, and closes it.
pub(super) fn go_to_chosen(shared: &mut Shared) {
    if let Some(at) = shared.overlays.take_chosen() {
        go_to_state(shared, at);
    }
}

/// Goes to a text of the history by undo or redo; every step in between can be redone or undone
/// as ever.
pub(crate) fn go_to_state(shared: &mut Shared, at: usize) {
    let present = shared.document.present();
    let steps = present.abs_diff(at);
    if steps == 0 {
        shared.say("this is the present text");
        return;
    }
    let is_back = at < present;
    let cross = if is_back { undo_text } else { redo_text };
    for _ in 1..steps {
        cross(shared);
    }
    if 1 < steps {
        relower(shared);
    }
    let step = if is_back { step_back } else { step_forward };
    let mut done = step(shared);
    if 1 < steps {
        let verb = if is_back { "undone" } else { "redone" };
        let name = step_names(&shared.document).into_iter().nth(at);
        done = name.map(|name| format!("{steps} steps {verb}, to: {name}"));
    }
    shared.say(done.unwrap_or_default());
}

/// The places on the page of the history in an area above the status line.
pub(crate) fn history_layout(shared: &Shared, body: Rect) -> HistoryLayout {
    if shared.has_colours {
        HistoryLayout::with_pictures(body)
    } else {
        HistoryLayout::with_names(body)
    }
}

/// The rows that Page Down moves on the page of the history.
pub(crate) fn step_rows(shared: &Shared) -> isize {
    let strip = history_layout(shared, body(shared));
    (strip.list.height / strip.height) as isize
}

/// The area above the status line.
pub(crate) fn body(shared: &Shared) -> Rect {
    let (columns, lines) = shared.terminal;
    let areas = shared.areas();
    let bars = areas.hint.height + areas.status.height;
    split_bottom(Rect::new(0, 0, columns, lines), bars).0
}
