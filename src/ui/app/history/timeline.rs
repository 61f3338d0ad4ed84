//! The undo history as a page: its steps, and jumping to any.

use ratatui::layout::Rect;

use super::undoing::{step_back, step_forward};
use crate::ui::app::shared::page::{List, Page};
use crate::ui::app::shared::steps::Steps;
use crate::ui::app::{Shared, text};
use crate::ui::history_layout::HistoryLayout;
use crate::ui::layout::split_bottom;

/// Opens the page of the undo history at the present text.
pub(crate) fn list_steps(shared: &mut Shared) {
    shared.document.end_step();
    let steps = Steps::of(&shared.document);
    if steps.rows.len() < 2 {
        shared.say("nothing has been changed yet");
        return;
    }
    let present = steps.present;
    let mut page = Page::new(List::Steps(steps));
    page.filter.at = present;
    shared.overlays.page = Some(page);
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
    for _ in 1..steps {
        if is_back {
            text::undo_text(shared);
        } else {
            text::redo_text(shared);
        }
    }
    if 1 < steps {
        text::relower(shared);
    }
    let done = if is_back {
        step_back(shared)
    } else {
        step_forward(shared)
    };
    let done = if steps == 1 {
        done
    } else {
        let verb = if is_back { "undone" } else { "redone" };
        let name = Steps::of(&shared.document).rows.into_iter().nth(at);
        name.map(|(_, name)| format!("{steps} steps {verb}, to: {name}"))
    };
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
pub(super) fn body(shared: &Shared) -> Rect {
    let (columns, lines) = shared.terminal;
    let areas = shared.areas();
    let bars = areas.hint.height + areas.status.height;
    split_bottom(Rect::new(0, 0, columns, lines), bars).0
}

/// The page of the history, if it is open.
pub(crate) fn open_steps(shared: &Shared) -> Option<(&Page, &Steps)> {
    let page = shared.overlays.page.as_ref()?;
    match &page.list {
        List::Steps(steps) => Some((page, steps)),
        List::Views(..) | List::Recent(_) => None,
    }
}
