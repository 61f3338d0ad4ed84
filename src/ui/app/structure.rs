//! Changing the structure of the scene: deleting, duplicating, reordering, copying, pasting, naming
//! and marking things. Each change is one edit of the text and one undo step.

use super::{Dialog, PromptKind, Shared, naming};
use crate::document::StepName;
use crate::language::{Neighbour, Node, StructureError, Visibility};
use crate::text::{Edit, Span, counted};
use crate::ui::msg::Effect;

/// The number of items named in a message at most.
const MOST_NAMED: usize = 3;

impl Shared {
    /// The marked nodes, otherwise the selected one.
    pub(super) fn targets(&self) -> Vec<Node> {
        if self.cursor.marks.is_empty() {
            return vec![self.cursor.selected()];
        }
        self.cursor.marks.iter().copied().collect()
    }

    /// The name of the targets: `object 2 (box)`, or `3 marked items: ` and the names of the first.
    pub(super) fn targets_name(&self, nodes: &[Node]) -> String {
        let is_marked = |node: &Node| self.cursor.marks.contains(node);
        let shown = nodes.iter().take(MOST_NAMED);
        let names: Vec<_> = shown.map(|node| self.source().name(*node)).collect();
        let names = names.join(", ");
        let more = if MOST_NAMED < nodes.len() {
            ", …"
        } else {
            ""
        };
        match nodes {
            [_] if !nodes.iter().all(is_marked) => names,
            _ => format!("{}: {names}{more}", counted(nodes.len(), "marked item")),
        }
    }

    /// Marks the selected node, or takes its mark away, and goes on to the next row.
    pub(super) fn toggle_mark(&mut self) {
        let node = self.cursor.selected();
        if !self.cursor.marks.remove(&node) {
            self.cursor.marks.insert(node);
        }
        if let Some(next) = self.cursor.row_after(1, self.source()) {
            self.select(next);
        }
        let marks = self.cursor.marks.len();
        let words = counted(marks, "item");
        let back = self.key_for("back");
        self.overlays
            .say(format!("{words} marked; {back} clears the marks"));
    }

    /// Deletes the targets; asks first if that changes others.
    pub(super) fn delete(&mut self) {
        if self.refuses_structure() {
            return;
        }
        let nodes = self.targets();
        match self.source().consequence(&nodes) {
            Some(_) => self.overlays.dialog = Some(Dialog::Delete(nodes)),
            None => self.delete_all(&nodes),
        }
    }

    /// The question whether to delete nodes that others use.
    pub(crate) fn consequence(&self, nodes: &[Node]) -> String {
        let consequence = self.source().consequence(nodes).unwrap_or_default();
        format!("Delete {}? {consequence}.", self.targets_name(nodes))
    }

    /// Deletes what the open question is about.
    pub(super) fn delete_anyway(&mut self) {
        if let Some(Dialog::Delete(nodes)) = self.overlays.dialog.take() {
            self.delete_all(&nodes);
        }
    }

    fn delete_all(&mut self, nodes: &[Node]) {
        let name = self.targets_name(nodes);
        let edits = self.source().removal(nodes);
        self.restructure(edits, None, &format!("deleted: {name}"));
    }

    /// Inserts copies of the targets after the last of them.
    pub(super) fn duplicate(&mut self) {
        if self.refuses_structure() {
            return;
        }
        let nodes = self.targets();
        let name = self.targets_name(&nodes);
        let after = nodes
            .last()
            .copied()
            .unwrap_or_else(|| self.cursor.selected());
        let copied = self.source().copied(&nodes);
        let placed = copied.and_then(|copied| self.source().insertion(&copied, after));
        let at = placed.as_ref().ok().map(|placed| placed.at);
        let edits = placed.map(|placed| placed.edits);
        self.restructure(edits, at, &format!("duplicated: {name}"));
    }

    /// Exchanges the selected node and its neighbour.
    pub(super) fn reorder(&mut self, neighbour: Neighbour) {
        if self.refuses_structure() {
            return;
        }
        let node = self.cursor.selected();
        let words = match neighbour {
            Neighbour::Previous => "moved up",
            Neighbour::Next => "moved down",
        };
        let placed = self.source().exchange(node, neighbour);
        let at = placed.as_ref().ok().map(|placed| placed.at);
        let edits = placed.map(|placed| placed.edits);
        self.restructure(edits, at, words);
    }

    /// Copies the text of the targets, also to the terminal's clipboard.
    pub(super) fn copy(&mut self) -> Vec<Effect> {
        if self.refuses_structure() {
            return Vec::new();
        }
        let nodes = self.targets();
        match self.source().copied(&nodes) {
            Ok(copied) => {
                let name = self.targets_name(&nodes);
                let paste = self.key_for("paste");
                let words = format!("copied: {name}; {paste} pastes it");
                self.overlays.say(words);
                self.cursor.copied = Some(copied.clone());
                vec![Effect::CopyText(copied)]
            }
            Err(refused) => {
                self.overlays.fail(refused.to_string());
                Vec::new()
            }
        }
    }

    /// Inserts the text copied last after the selected node.
    pub(super) fn insert_copied(&mut self) {
        if let Some(copied) = self.cursor.copied.clone() {
            self.insert(&copied);
        } else {
            let copy = self.key_for("copy");
            let words = format!("nothing to paste: {copy} copies the selected item");
            self.overlays.fail(words);
        }
    }

    /// Reads a text as things of the scene and inserts them after the selected node.
    pub(super) fn insert(&mut self, text: &str) {
        if self.refuses_structure() {
            return;
        }
        let placed = self.source().insertion(text, self.cursor.selected());
        if let Err(StructureError::Foreign { reason }) = &placed {
            let edit = self.key_for("edit");
            let message = format!("{reason}; to paste values into fields, press {edit}");
            self.overlays.fail(message);
            return;
        }
        let at = placed.as_ref().ok().map(|placed| placed.at);
        let edits = placed.map(|placed| placed.edits);
        self.restructure(edits, at, "pasted");
    }

    /// Opens a line to type the new name of the selected node.
    pub(super) fn start_renaming(&mut self) {
        if self.refuses_structure() {
            return;
        }
        let node = self.cursor.selected();
        match self.source().called(node).map(str::to_owned) {
            Some(name) => self.overlays.open_prompt_over(PromptKind::Name, &name),
            None => {
                if let Err(reason) = self.source().renaming(node, "name") {
                    self.overlays.fail(reason.to_string());
                }
            }
        }
    }

    /// Gives the selected node another name; references to it follow.
    pub(super) fn rename(&mut self, name: &str) {
        if self.refuses_structure() {
            return;
        }
        let name = name.trim();
        let before = self.source().name(self.cursor.selected());
        let edits = self.source().renaming(self.cursor.selected(), name);
        let done = match name {
            "" => "name removed".to_owned(),
            name => format!("renamed: {name}"),
        };
        if !self.restructure(edits, None, &done) {
            return;
        }
        if !name.is_empty() {
            let step = StepName::done(format!("renamed {before} to {name}"));
            self.document.name_step(step);
        }
        self.merge_input();
    }

    /// Makes the frame of the selected node orthonormal.
    pub(super) fn orthonormalise(&mut self) {
        if self.refuses_structure() {
            return;
        }
        let node = self.cursor.selected();
        let name = self.source().name(node);
        let edits = self.source().orthonormalised(node);
        if edits.as_ref().is_ok_and(Vec::is_empty) {
            self.overlays.say(format!("{name} is already orthonormal"));
            return;
        }
        self.restructure(edits, None, &format!("orthonormalised: {name}"));
    }

    /// Hides the targets, or shows them again if the first is hidden.
    pub(super) fn toggle_visibility(&mut self) {
        let objects = self.targets().into_iter().filter_map(|node| match node {
            Node::Object(object) => Some(object),
            _ => None,
        });
        let objects: Vec<_> = objects.collect();
        let Some(&first) = objects.first() else {
            self.overlays.fail("only objects can be shown or hidden");
            return;
        };
        let (wanted, done) = match self.source().drawn(first) {
            Some(_) => (Visibility::Hidden, "hidden"),
            None => (Visibility::Shown, "shown"),
        };
        let mut shown = objects.iter().filter(|_| wanted == Visibility::Shown);
        if let Some(reason) = shown.find_map(|&object| self.refuses_part(object)) {
            self.overlays.fail(reason);
            return;
        }
        self.document.end_step();
        let edits = self.source().visibility_edits(&objects, wanted);
        let outcome = edits.map_err(str::to_owned).and_then(|edits| {
            let refused = self.try_edits(&edits);
            refused.map_err(|refused| refused.message)
        });
        self.document.end_step();
        let nodes: Vec<_> = objects.into_iter().map(Node::Object).collect();
        match outcome {
            Ok(()) => {
                let name = self.targets_name(&nodes);
                self.document
                    .name_step(StepName::done(format!("{done} {name}")));
                self.overlays.say(format!("{done}: {name}"));
            }
            Err(reason) => self.overlays.fail(reason),
        }
    }

    /// Why an object cannot be shown by itself, if it is only drawn as a part of another.
    fn refuses_part(&self, object: usize) -> Option<String> {
        let source = self.source();
        if source.drawn(object).is_some() {
            return None;
        }
        let combines = |group: &usize| source.operation(*group).is_some();
        let mut whole = source.group_of(object).filter(combines)?;
        while source.drawn(whole).is_none()
            && let Some(outer) = source.group_of(whole)
        {
            whole = outer;
        }
        let [part, whole] = [object, whole].map(|object| source.name(Node::Object(object)));
        let key = self.key_for("visibility");
        Some(format!(
            "{part} is part of {whole}: {key} there shows or hides it"
        ))
    }

    /// Makes structural edits as one undo step, selects the node written by the edit `at`, and says
    /// what is done or why not. Returns whether it is done.
    pub(super) fn restructure(
        &mut self,
        edits: Result<Vec<Edit>, StructureError>,
        at: Option<usize>,
        done: &str,
    ) -> bool {
        let outcome = edits.map_err(|refused| refused.to_string());
        let outcome = outcome.and_then(|edits| {
            self.document.end_step();
            let placed = at.and_then(|at| super::edit::spans_after(&edits).get(at).copied());
            let outcome = self.try_edits(&edits);
            self.document.end_step();
            outcome.map(|()| placed).map_err(|refused| refused.message)
        });
        match outcome {
            Ok(placed) => {
                self.cursor.marks.clear();
                if let Some(node) = placed.and_then(|span| self.first_node_in(span)) {
                    self.select(node);
                }
                let selected = self.source().name(self.cursor.selected());
                self.document.name_step(naming::done(done, &selected));
                self.overlays.say(done);
                true
            }
            Err(reason) => {
                self.overlays.fail(reason);
                false
            }
        }
    }

    /// The first node, other than view and render settings, whose text is in a span, or what combines it there.
    pub(super) fn first_node_in(&self, span: Span) -> Option<Node> {
        let source = self.source();
        let mut nodes = source.nodes_in(span).into_iter();
        let mut node = nodes.find(|node| !matches!(node, Node::View | Node::Render))?;
        let is_inside = |own: Span| span.start() <= own.start() && own.end() <= span.end();
        while let Node::Object(object) = node
            && let Some(group) = source.group_of(object).map(Node::Object)
            && is_inside(source.span(group))
        {
            node = group;
        }
        Some(node)
    }

    /// Whether the structure cannot change because the text has errors; says so.
    pub(super) fn refuses_structure(&mut self) -> bool {
        let has_errors = 0 < self.error_count();
        if has_errors {
            self.overlays
                .fail("correct the text's errors before adding, moving or deleting items");
        }
        has_errors
    }
}
