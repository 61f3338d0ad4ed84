//! The cursor: the selected node, its fields, the current component, and the value typed into it.

use std::collections::BTreeSet;
use std::sync::Arc;

use ratatui::layout::Rect;
use tui_input::Input;

use super::change::Change;
use super::live_edit::LiveEdit;
use super::rows::Rows;
use crate::arrange::Areas;
use crate::layout;
use language::{FieldSpans, Node, Nodes, Source};
use text::{Diagnostic, Edit, Span};

/// The maximum number of parts listed for a combined object.
const MAX_PARTS: usize = 32;

/// Size of a nudge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stride {
    /// A tenth of the field's step.
    Fine,
    /// The step of the field's table entry.
    #[default]
    Plain,
    /// Ten times the field's step.
    Coarse,
}

impl Stride {
    /// The size of one nudge of a field with this step.
    pub fn of(self, step: f64) -> f64 {
        match self {
            Self::Fine => step / 10.0,
            Self::Plain => step,
            Self::Coarse => step * 10.0,
        }
    }
}

/// The selection in the list and in the fields.
#[derive(Debug)]
pub struct Cursor {
    selected: Node,
    /// The fields of the selected node in the current text.
    fields: Vec<FieldSpans>,
    parts: Vec<(usize, Node)>,
    /// Which rows the list shows.
    pub rows: Rows,
    /// The first line of the list that is shown.
    pub list_top: usize,
    /// The index of the selected field.
    pub field: usize,
    /// The index of the first field shown.
    pub field_top: usize,
    /// The selected component of that field.
    pub component: usize,
    /// The size of a nudge.
    pub stride: Stride,
    /// A value being typed.
    pub typing: Option<Typing>,
    /// The slider being dragged.
    pub(crate) slide: Option<Slide>,
    /// The marked nodes, which commands apply to instead of the selected one.
    pub marks: BTreeSet<Node>,
    /// The text copied last.
    pub(crate) copied: Option<String>,
    /// What the last change did.
    pub(crate) changed: Option<Change>,
    /// The text's revision after something was deleted by a key, and what was selected then.
    pub(crate) deleted: Option<(u64, Node)>,
    /// The nodes of the text that the marks belong to.
    nodes: Nodes,
    /// What the list was filtered by last.
    pub(crate) searched: String,
    /// The component clicked a moment ago.
    clicked: Option<(usize, usize)>,
}

/// A slider being dragged.
#[derive(Debug)]
pub(crate) struct Slide {
    /// Its cells.
    pub(crate) bar: Rect,
    /// The change of the text.
    pub(crate) live_edit: LiveEdit,
}

/// A value being typed into a component.
#[derive(Debug, Default)]
pub struct Typing {
    /// The text and its cursor.
    pub input: Input,
    /// The literal that it was opened with; `None` if typing began in place of that.
    pub opened: Option<String>,
    /// Whether the next character replaces the text; moving the text's cursor keeps it.
    pub is_selected: bool,
    /// Why the last attempt was refused: the parser's own message.
    pub refused: Option<Diagnostic>,
}

/// The cursor before the text was replaced from outside.
#[derive(Debug)]
pub(crate) struct SavedCursor {
    /// The text that it was in.
    pub(crate) text: Arc<String>,
    /// The key of its field, and the span of its component if the text has it.
    field: Option<(&'static str, Option<Span>)>,
}

/// Whether a change of the text may have changed what nodes are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Names {
    /// It may have.
    Changed,
    /// It has only changed numbers.
    Kept,
}

impl Default for Cursor {
    fn default() -> Self {
        Self {
            selected: Node::View,
            fields: Vec::new(),
            parts: Vec::new(),
            rows: Rows::default(),
            list_top: 0,
            field: 0,
            field_top: 0,
            component: 0,
            stride: Stride::default(),
            typing: None,
            slide: None,
            marks: BTreeSet::new(),
            copied: None,
            changed: None,
            deleted: None,
            nodes: Nodes::default(),
            searched: String::new(),
            clicked: None,
        }
    }
}

impl Cursor {
    /// The selected node; the view until something else is selected.
    pub fn selected(&self) -> Node {
        self.selected
    }

    /// The fields of the selected node, with their spans in the text.
    pub fn fields(&self) -> &[FieldSpans] {
        &self.fields
    }

    /// The parts of the selected object in order, each with its depth below it; at most the first
    /// `MAX_PARTS`. Empty unless the object is a combination.
    pub fn parts(&self) -> &[(usize, Node)] {
        &self.parts
    }

    /// The selected field, if there is one.
    pub(crate) fn current(&self) -> Option<&FieldSpans> {
        self.fields.get(self.field)
    }

    /// Selects a node and drops a value being typed. If the list does not show the node, it is shown
    /// unfiltered and unfolded as far as necessary.
    pub fn select(&mut self, node: Node, source: &Source) {
        self.typing = None;
        self.reveal(node, source);
        if node != self.selected {
            self.field = 0;
            self.component = 0;
            self.field_top = 0;
            self.stand_on(node, source);
        }
    }

    /// Selects the marked node above the selected one, if some are marked and it is not, so that the fields
    /// are those that are set.
    pub(crate) fn select_marked(&mut self, source: &Source) {
        let before = self.marks.range(..=self.selected).next_back();
        if let Some(&node) = before.or_else(|| self.marks.first()) {
            self.select(node, source);
        }
    }

    fn reveal(&mut self, node: Node, source: &Source) {
        let row = source.nodes().before(node);
        if !self.rows.shows(row) && !self.rows.filter().is_empty() {
            self.rows.filter_by("", source);
        }
        if let (Node::Object(object), false) = (node, self.rows.shows(row)) {
            let mut folded = self.rows.folded().clone();
            for group in source.groups_of(object) {
                folded.remove(&group);
            }
            self.rows.fold(folded, source);
        }
    }

    /// Moves the selection to a row that the list shows: to the group that hides it, otherwise to the
    /// nearest one. A list without rows is shown unfiltered.
    pub(crate) fn settle(&mut self, source: &Source) {
        let (nodes, row) = (source.nodes(), row_of(source, self.selected));
        if self.rows.shows(row) {
            return;
        }
        let group = match self.selected {
            Node::Object(object) if self.rows.filter().is_empty() => {
                let groups = source.groups_of(object);
                let mut rows = groups.map(|group| nodes.before(Node::Object(group)));
                rows.find(|&row| self.rows.shows(row))
            }
            _ => None,
        };
        match group.or_else(|| self.rows.nearest(row, source)) {
            Some(row) => self.select(nodes.get(row).unwrap_or(self.selected), source),
            None => self.reveal(self.selected, source),
        }
    }

    /// Updates the cursor after the text has changed; the selection stays on an existing node.
    pub fn renew(&mut self, source: &Source, names: Names) {
        let nodes = source.nodes();
        if nodes != self.nodes || names == Names::Changed {
            self.rows.renew(source);
        }
        if nodes != self.nodes {
            // Their indices belong to others now.
            self.marks.clear();
            self.nodes = nodes;
        }
        let row = row_of(source, self.selected);
        self.stand_on(nodes.get(row).unwrap_or(self.selected), source);
        self.keep();
        if self.typing.is_none() {
            self.settle(source);
        }
    }

    fn stand_on(&mut self, node: Node, source: &Source) {
        self.selected = node;
        self.fields = source.fields(node);
        self.parts = match node {
            Node::Object(object) => source.parts(object, MAX_PARTS),
            _ => Vec::new(),
        };
    }

    /// Keeps the cursor on an existing component.
    fn keep(&mut self) {
        self.field = self.field.min(self.fields.len().saturating_sub(1));
        let field = self.fields.get(self.field);
        let components = field.map_or(1, |placed| placed.field.kind.components());
        self.component = self.component.min(components - 1);
    }

    /// Returns the node `rows` further down the list.
    pub(crate) fn row_after(&self, rows: isize, source: &Source) -> Option<Node> {
        let place = self.rows.place_of(row_of(source, self.selected));
        let place = moved(place, rows, self.rows.count(source));
        source.nodes().get(self.rows.at(place, source)?)
    }

    /// Moves the cursor to a component of a field.
    pub(crate) fn focus(&mut self, field: usize, component: usize) {
        if let Some(placed) = self.fields.get(field) {
            self.field = field;
            self.component = component.min(placed.field.kind.components() - 1);
        }
    }

    /// The field with a value at this span of the text.
    pub(crate) fn field_at(&self, span: Span) -> Option<usize> {
        let touches = |placed: &FieldSpans| placed.spans.iter().any(|at| at.touches(span));
        self.fields.iter().position(touches)
    }

    /// Records a click; returns whether it is the second within a moment on the same component.
    pub(crate) fn click(&mut self, at: (usize, usize)) -> bool {
        let is_second = self.clicked.take() == Some(at);
        self.clicked = (!is_second).then_some(at);
        is_second
    }

    pub(crate) fn forget_click(&mut self) {
        self.clicked = None;
    }

    /// Moves to another component, wrapping around.
    pub(crate) fn next_component(&mut self, step: isize) {
        let counts = self.fields.iter();
        let counts: Vec<_> = counts
            .map(|placed| placed.field.kind.components())
            .collect();
        let count: usize = counts.iter().sum();
        if count == 0 {
            return;
        }
        let before: usize = counts[..self.field].iter().sum();
        let at = (before + self.component) as isize + step;
        let mut at = at.rem_euclid(count as isize) as usize;
        self.field = 0;
        while counts[self.field] <= at {
            at -= counts[self.field];
            self.field += 1;
        }
        self.component = at;
    }

    /// The stride of a step with a key that has this one: a modifier key takes precedence over what
    /// was set before.
    pub(crate) fn stride_with(&self, held: Stride) -> Stride {
        match held {
            Stride::Plain => self.stride,
            Stride::Fine | Stride::Coarse => held,
        }
    }

    /// Decreases or increases the stride and returns its description.
    pub(crate) fn change_stride(&mut self, step: isize) -> &'static str {
        self.stride = match (self.stride, step < 0) {
            (Stride::Coarse, true) | (Stride::Fine, false) => Stride::Plain,
            (_, true) => Stride::Fine,
            (_, false) => Stride::Coarse,
        };
        match self.stride {
            Stride::Fine => "nudge step ×0.1",
            Stride::Plain => "nudge step ×1",
            Stride::Coarse => "nudge step ×10",
        }
    }

    /// Scrolls so that the cursors are visible.
    pub(crate) fn scroll(&mut self, areas: &Areas, source: &Source) {
        let fields = usize::from(layout::field_rows(areas.fields, areas.explains).height);
        let count = self.fields.len();
        self.field_top = layout::first_shown(self.field_top, self.field, count, fields);
        let rows = usize::from(layout::contents(areas.list).height);
        let listing = self.rows.listing(source);
        let line = listing.line_of(row_of(source, self.selected));
        self.list_top = layout::first_shown(self.list_top, line, listing.len(), rows);
    }

    /// Records the cursor's position in a text.
    pub(crate) fn hold(&self, text: Arc<String>) -> SavedCursor {
        let field = self.current().map(|placed| {
            let span = placed.spans.get(self.component).copied();
            (placed.field.key, span)
        });
        SavedCursor { text, field }
    }

    /// Returns the cursor to the number that it was on before an edit, keeping a value typed there;
    /// returns whether that had to be dropped because the field is gone.
    pub(crate) fn follow(
        &mut self,
        held: &SavedCursor,
        edit: Option<&Edit>,
        source: &Source,
    ) -> bool {
        let Some((key, span)) = held.field else {
            return self.typing.take().is_some();
        };
        let moved = span.zip(edit).and_then(|(span, edit)| {
            if edit.span.end() <= span.start() {
                let by = |at: usize| at + edit.text.len() - edit.span.len();
                Some(Span::new(by(span.start()), by(span.end())))
            } else {
                (span.end() <= edit.span.start()).then_some(span)
            }
        });
        let component = self.component;
        if let Some(node) = moved.and_then(|span| source.node_at(span))
            && node != self.selected
        {
            self.reveal(node, source);
            self.stand_on(node, source);
        }
        // Several fields may have the same key.
        let holds = |place: &FieldSpans| moved.is_some_and(|span| place.spans.contains(&span));
        let mut fields = self.fields.iter();
        let field = fields.position(holds).or_else(|| {
            let mut fields = self.fields.iter();
            fields.position(|place| place.field.key == key)
        });
        if let Some(field) = field {
            self.focus(field, component);
            return false;
        }
        self.keep();
        self.typing.take().is_some()
    }
}

/// The list's row of a node, or the nearest one if the text no longer has it.
pub(crate) fn row_of(source: &Source, node: Node) -> usize {
    let nodes = source.nodes();
    nodes.before(node).min(nodes.len().saturating_sub(1))
}

/// Moves an index, limited to `count` entries.
pub(crate) fn moved(at: usize, by: isize, count: usize) -> usize {
    at.saturating_add_signed(by).min(count.saturating_sub(1))
}
