//! Moves the cursors of lists, fields, pages and panels; opens the list of errors.

use super::shared::cursor::moved;
use super::{Shared, edit, history, inspect};
use crate::keymap::{Context, Mode};
use crate::layout;

/// Moves the cursor of what has the keys by some lines; positive is down.
pub(crate) fn move_cursor(shared: &mut Shared, rows: isize) {
    move_cursor_in(shared, shared.context(), rows);
}

/// Moves it by some pages.
pub(crate) fn turn_page(shared: &mut Shared, pages: isize) {
    move_cursor(shared, pages * page(shared));
}

/// Moves the cursor of a context by some lines; positive is down.
pub(crate) fn move_cursor_in(shared: &mut Shared, context: Context, rows: isize) {
    match context {
        Context::In(Mode::Select) => shared.move_selection(rows),
        Context::In(Mode::Edit) => shared.move_field(rows),
        Context::Errors => {
            let at = shared.overlays.errors.unwrap_or(0);
            shared.overlays.errors = Some(moved(at, rows, shared.wrong().findings.len()));
        }
        Context::Conflict => {
            if let Some((merge, at, _)) = shared.overlays.conflict() {
                *at = moved(*at, rows, merge.conflicts.len());
            }
        }
        _ if Context::PAGES.contains(&context) => {
            let messages = shared.overlays.messages.past().len();
            if let Some(page) = &mut shared.overlays.page {
                let count = match context {
                    Context::Messages => messages,
                    // A step ends with what fills the page.
                    Context::Help => usize::MAX,
                    _ => page.shown().len(),
                };
                page.filter.go(rows, count);
            }
        }
        Context::Colour => edit::move_picker(shared, rows),
        Context::Rays => inspect::move_in_rays(shared, rows),
        _ => {}
    }
}

/// The number of lines that Page Down moves.
fn page(shared: &Shared) -> isize {
    let areas = shared.areas();
    let panel = match shared.context() {
        Context::Help => return (help_rows(shared) as isize - 1).max(1),
        Context::Rays => inspect::ray_panels(shared).map_or(areas.list, |panels| panels.lines),
        Context::Errors => areas.errors,
        Context::History | Context::Samples => return history::step_rows(shared),
        context if Context::PAGES.contains(&context) => areas.picture,
        _ => areas.list,
    };
    (layout::contents(panel).height as isize - 1).max(1)
}

/// The lines of the help page inside its frame.
pub(crate) fn help_rows(shared: &Shared) -> usize {
    let areas = shared.areas();
    let outside = areas.hint.height + areas.status.height + 2;
    usize::from(shared.terminal.1.saturating_sub(outside))
}

/// Opens the list of errors and warnings, or closes it.
pub(crate) fn toggle_errors(shared: &mut Shared) {
    shared.overlays.errors = match shared.overlays.errors {
        Some(_) => None,
        None if shared.wrong().findings.is_empty() => {
            let text = "no errors or warnings";
            let words = match &shared.suggestions.said {
                Some(of_picture) => format!("{text} in the text, but {of_picture}"),
                None => text.to_owned(),
            };
            shared.say(words);
            None
        }
        None => Some(0),
    };
}

/// Selects the node to which the selected diagnostic refers.
pub(crate) fn go_to_error(shared: &mut Shared) {
    let Some(at) = shared.overlays.errors else {
        return;
    };
    let edit_line = format!("press {} to edit that line", shared.key_for("editor"));
    if shared.is_disk_wrong() {
        shared.warn(format!("this is in the file on disk: {edit_line}"));
        return;
    }
    let Some(span) = shared.diagnostics.get(at).map(|diagnostic| diagnostic.span) else {
        return;
    };
    if let Some(node) = shared.source().node_at(span) {
        shared.overlays.errors = None;
        shared.select(node);
        let field = shared.cursor.field_at(span);
        shared.focus_field(field.unwrap_or(0), 0);
    } else {
        shared.warn(format!("nothing to select there: {edit_line}"));
    }
}
