//! Moving cursors: through the list, the fields, the help, the errors; searching and picking.

use super::{App, Dialog, Mode};
use crate::language::Node;
use crate::ui::keymap;
use crate::ui::keymap::Context;
use crate::ui::view::layout;

impl App {
    /// Selects a thing.
    pub(super) fn select(&mut self, node: Node) {
        self.document.end_step();
        self.typing = None;
        if node != self.selected {
            self.selected = node;
            self.field = 0;
            self.component = 0;
            self.field_top = 0;
        }
    }

    pub(super) fn move_cursor(&mut self, context: Context, rows: isize) {
        match context {
            Context::In(Mode::Select) => {
                let row = moved(self.row_of(self.selected), rows, self.nodes().len());
                if let Some(node) = self.nodes().get(row) {
                    self.select(node);
                }
            }
            Context::In(Mode::Edit) => {
                let count = self.placed().len();
                self.focus_field(moved(self.field, rows, count), self.component);
            }
            Context::Errors => {
                let at = self.errors.unwrap_or(0);
                self.errors = Some(moved(at, rows, self.wrong().1.len()));
            }
            Context::Help => {
                if let Some(help) = &mut self.help {
                    let lines = keymap::help(help.search.value(), self.mode).len();
                    help.top = moved(help.top, rows, lines);
                }
            }
            Context::Conflict => {
                if let Some(Dialog::Conflict { merge, at, .. }) = &mut self.dialog {
                    *at = moved(*at, rows, merge.conflicts.len());
                }
            }
            Context::In(_) | Context::Opening | Context::Quit | Context::Recover => {}
        }
    }

    /// Lines that go by with one Page Down.
    pub(super) fn page(&self, context: Context) -> isize {
        let areas = self.areas();
        let panel = match context {
            Context::Errors => areas.errors,
            Context::Help => areas.picture,
            _ => areas.list,
        };
        (layout::contents(panel).height as isize - 1).max(1)
    }

    /// Puts the cursor on a component of a field.
    pub(super) fn focus_field(&mut self, field: usize, component: usize) {
        self.document.end_step();
        let placed = self.placed();
        if let Some(placed) = placed.get(field) {
            self.field = field;
            self.component = component.min(placed.field.kind.components() - 1);
        }
    }

    /// Keeps the cursors among what is shown.
    pub(super) fn scroll(&mut self) {
        let wrong = self.wrong().1.len();
        self.errors = self.errors.filter(|_| 0 < wrong);
        self.errors = self.errors.map(|at| at.min(wrong - 1));
        let areas = self.areas();
        let fields = usize::from(layout::field_rows(areas.fields).height);
        let count = self.placed().len();
        self.field_top = layout::first_shown(self.field_top, self.field, count, fields);
        let rows = usize::from(layout::contents(areas.list).height);
        let row = self.row_of(self.selected);
        self.list_top = layout::first_shown(self.list_top, row, self.nodes().len(), rows);
    }

    /// Selects the next light or object, or the one before, and around.
    pub(super) fn cycle(&mut self, step: isize) {
        let nodes = self.nodes();
        let first = nodes.before(Node::Light(0));
        let count = nodes.len() - first;
        if count == 0 {
            return;
        }
        let row = match self.row_of(self.selected).checked_sub(first) {
            Some(at) => (at as isize + step).rem_euclid(count as isize) as usize,
            None if step < 0 => count - 1,
            None => 0,
        };
        if let Some(node) = nodes.get(first + row) {
            self.select(node);
        }
    }

    /// Selects the next thing whose name or comment holds what was searched for, or the one before.
    pub(super) fn search(&mut self, step: isize) {
        let wanted = self.searched.to_lowercase();
        let nodes = self.nodes();
        let count = nodes.len() as isize;
        if wanted.is_empty() || count == 0 {
            return;
        }
        let from = self.row_of(self.selected) as isize;
        let called = |&row: &usize| {
            let node = nodes.get(row);
            node.is_some_and(|node| self.is_called(node, &wanted))
        };
        let found: Vec<_> = (0..nodes.len()).filter(called).collect();
        let nearest = |&at: &usize| (step * (found[at] as isize - from) - 1).rem_euclid(count);
        match (0..found.len()).min_by_key(nearest) {
            Some(at) => {
                if let Some(node) = nodes.get(found[at]) {
                    self.select(node);
                }
                self.say(format!("{} of {}", at + 1, found.len()));
            }
            None => self.fail(format!("no match for {}", self.searched)),
        }
    }

    /// Whether a thing's name or comment holds a word in lower case.
    fn is_called(&self, node: Node, word: &str) -> bool {
        let holds = |said: &str| said.to_lowercase().contains(word);
        holds(&self.source().name(node)) || self.source().comment(node).is_some_and(holds)
    }

    pub(super) fn toggle_errors(&mut self) {
        self.errors = match self.errors {
            Some(_) => None,
            None if self.wrong().1.is_empty() => {
                self.say("no errors, no warnings");
                None
            }
            None => Some(0),
        };
    }

    /// Selects the thing that the diagnostic under the cursor is about.
    pub(super) fn go_to_error(&mut self) {
        let Some(at) = self.errors else {
            return;
        };
        if self.is_disk_wrong() {
            self.warn("it is in the file on disk: E opens the editor at the line");
            return;
        }
        let Some(span) = self.diagnostics.get(at).map(|diagnostic| diagnostic.span) else {
            return;
        };
        match self.source().node_at(span) {
            Some(node) => {
                self.errors = None;
                self.select(node);
                let placed = self.placed();
                let field = placed
                    .iter()
                    .position(|placed| placed.spans.iter().any(|s| s.touches(span)));
                self.focus_field(field.unwrap_or(0), 0);
            }
            None => self.warn("nothing to select there: E opens the editor at the line"),
        }
    }

    /// Begins to pick, in the middle of the picture or where the last pick was.
    pub(super) fn start_pick(&mut self) {
        let Some((cells, _)) = self.raster() else {
            self.fail("there is no room for a picture");
            return;
        };
        if self.cross == (0, 0) {
            self.cross = (cells.width / 2, cells.height / 2);
        }
        self.mode = Mode::Pick;
        self.move_cross(0, 0);
    }

    pub(super) fn move_cross(&mut self, right: i32, down: i32) {
        let Some((cells, _)) = self.raster() else {
            return;
        };
        let moved = |at: u16, by: i32, cells: u16| {
            (i32::from(at) + by).clamp(0, i32::from(cells.max(1)) - 1) as u16
        };
        self.cross = (
            moved(self.cross.0, right, cells.width),
            moved(self.cross.1, down, cells.height),
        );
    }

    pub(super) fn pick_cross(&mut self) {
        let (column, row) = self.cross;
        self.pick(u32::from(column), 2 * u32::from(row));
    }

    /// What lies under a pixel of the picture on screen, or why that can't be said: objects are
    /// known by their number in the scene that is shown, which need not be the text's.
    pub fn node_under(&self, x: u32, y: u32) -> Result<Option<Node>, &'static str> {
        if 0 < self.error_count() {
            return Err("the text has errors: the picture is of the last scene without");
        }
        if self.picture().is_outdated() {
            return Err("the picture is not of the changed scene yet");
        }
        let object = self.picture().shown.object_at(x, y);
        Ok(object.map(|object| Node::Object(self.source().object(object))))
    }

    /// Selects what lies under a pixel of the picture on screen, and has then done with picking.
    pub(super) fn pick(&mut self, x: u32, y: u32) {
        match self.node_under(x, y) {
            Ok(Some(node)) => {
                self.select(node);
                if self.mode == Mode::Pick {
                    self.mode = Mode::Select;
                }
            }
            Ok(None) => self.say("nothing is there"),
            Err(reason) => self.warn(reason),
        }
    }
}

/// A cursor after a move, kept among `count` places.
fn moved(at: usize, by: isize, count: usize) -> usize {
    at.saturating_add_signed(by).min(count.saturating_sub(1))
}
