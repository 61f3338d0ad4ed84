//! Moving cursors: in the list, the fields, the help and the errors.

use super::Shared;
use super::cursor::moved;
use crate::language::Node;
use crate::ui::arrange::Areas;
use crate::ui::keymap::{Context, Mode};
use crate::ui::layout;

impl Shared {
    /// Selects a node; ends the current undo step.
    pub(super) fn select(&mut self, node: Node) {
        self.document.end_step();
        self.pictures.outline_selection();
        self.cursor.select(node, self.document.source());
    }

    /// Moves the cursor of what has the keys by some lines; positive is down.
    pub(super) fn move_cursor(&mut self, rows: isize) {
        self.move_cursor_in(self.context(), rows);
    }

    /// Moves it by some pages.
    pub(super) fn turn_page(&mut self, pages: isize) {
        self.move_cursor(pages * self.page());
    }

    pub(super) fn move_cursor_in(&mut self, context: Context, rows: isize) {
        match context {
            Context::In(Mode::Select) => {
                if let Some(node) = self.cursor.row_after(rows, self.source()) {
                    self.select(node);
                }
            }
            Context::In(Mode::Edit) => {
                let count = self.cursor.fields().len();
                self.focus_field(moved(self.cursor.field, rows, count), self.cursor.component);
            }
            Context::Errors => {
                let at = self.overlays.errors.unwrap_or(0);
                self.overlays.errors = Some(moved(at, rows, self.wrong().findings.len()));
            }
            Context::Help => {
                let columns = self.help_columns(self.terminal.0);
                let longest = columns.iter().map(Vec::len).max().unwrap_or(0);
                let lines = (longest + 1).saturating_sub(self.help_rows());
                if let Some(help) = &mut self.overlays.help {
                    help.top = moved(help.top, rows, lines);
                }
            }
            Context::Messages => {
                let count = self.overlays.messages.past().len();
                let top = self.overlays.history.as_mut();
                if let Some(top) = top {
                    *top = moved(*top, rows, count);
                }
            }
            Context::Conflict => {
                if let Some((merge, at, _)) = self.overlays.conflict() {
                    *at = moved(*at, rows, merge.conflicts.len());
                }
            }
            Context::Views | Context::Recent | Context::Steps => {
                if let Some(page) = &mut self.overlays.page {
                    page.go(rows);
                }
            }
            Context::Colour => self.move_picker(rows),
            Context::Rays => self.move_in_rays(rows),
            Context::In(_)
            | Context::Opening
            | Context::Region
            | Context::Quit
            | Context::Leave
            | Context::MovedView
            | Context::Delete
            | Context::Wait
            | Context::Overwrite
            | Context::Recover => {}
        }
    }

    /// The lines of the help page, inside its frame and above its search.
    fn help_rows(&self) -> usize {
        let areas = self.areas();
        let outside = areas.hint.height + areas.status.height + 3;
        usize::from(self.terminal.1.saturating_sub(outside))
    }

    /// The number of lines that Page Down moves.
    fn page(&self) -> isize {
        let areas = self.areas();
        let panel = match self.context() {
            Context::Help => return (self.help_rows() as isize - 1).max(1),
            Context::Rays => self.ray_panels().map_or(areas.list, |panels| panels.lines),
            Context::Errors => areas.errors,
            Context::Steps => return self.step_rows(),
            Context::Messages | Context::Views | Context::Recent => areas.picture,
            _ => areas.list,
        };
        (layout::contents(panel).height as isize - 1).max(1)
    }

    /// Moves the cursor to a component of a field.
    pub(super) fn focus_field(&mut self, field: usize, component: usize) {
        self.document.end_step();
        self.cursor.focus(field, component);
    }

    /// Scrolls so that the cursors are visible.
    pub(super) fn scroll(&mut self, areas: &Areas) {
        let wrong = self.wrong().findings.len();
        let errors = self.overlays.errors.filter(|_| 0 < wrong);
        self.overlays.errors = errors.map(|at| at.min(wrong - 1));
        self.cursor.scroll(areas, self.document.source());
        self.scroll_rays();
    }

    /// Selects the next or previous light or object in the list, wrapping around.
    pub(super) fn cycle(&mut self, step: isize) {
        let (rows, source) = (&self.cursor.rows, self.source());
        let first = rows.place_of(source.nodes().before(Node::Light(0)));
        let count = rows.count(source) - first;
        if count == 0 {
            return;
        }
        let place = match rows.place_of(self.selected_row()).checked_sub(first) {
            Some(at) => (at as isize + step).rem_euclid(count as isize) as usize,
            None if step < 0 => count - 1,
            None => 0,
        };
        let row = rows.at(first + place, source);
        if let Some(node) = row.and_then(|row| source.nodes().get(row)) {
            self.select(node);
        }
    }

    pub(super) fn toggle_errors(&mut self) {
        self.overlays.errors = match self.overlays.errors {
            Some(_) => None,
            None if self.wrong().findings.is_empty() => {
                let text = "no errors or warnings";
                let words = match &self.suggestions.said {
                    Some(of_picture) => format!("{text} in the text, but {of_picture}"),
                    None => text.to_owned(),
                };
                self.overlays.say(words);
                None
            }
            None => Some(0),
        };
    }

    /// Selects the node to which the selected diagnostic refers.
    pub(super) fn go_to_error(&mut self) {
        let Some(at) = self.overlays.errors else {
            return;
        };
        if self.is_disk_wrong() {
            let editor = self.key_for("editor");
            self.overlays.warn(format!(
                "this is in the file on disk: press {editor} to edit that line"
            ));
            return;
        }
        let Some(span) = self.diagnostics.get(at).map(|diagnostic| diagnostic.span) else {
            return;
        };
        if let Some(node) = self.source().node_at(span) {
            self.overlays.errors = None;
            self.select(node);
            let field = self.cursor.field_at(span);
            self.focus_field(field.unwrap_or(0), 0);
        } else {
            let editor = self.key_for("editor");
            self.overlays.warn(format!(
                "nothing to select there: press {editor} to edit that line"
            ));
        }
    }
}
