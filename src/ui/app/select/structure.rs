//! Changing the structure of the scene: deleting, duplicating, reordering, copying, pasting, naming
//! and marking things. Each change is one edit of the text and one undo step.

use ::text::{Edit, counted};
use document::StepName;
use language::{Neighbour, Node, Placement, StructureError, Visibility};

use crate::app::{Dialog, PromptKind, Question, Shared, text};
use crate::msg::Effect;

/// Marks the selected node, or takes its mark away, and goes on to the next row.
pub(super) fn toggle_mark(shared: &mut Shared) {
    let node = shared.cursor.selected();
    if !shared.cursor.marks.remove(&node) {
        shared.cursor.marks.insert(node);
    }
    if let Some(next) = shared.cursor.row_after(1, shared.source()) {
        shared.select(next);
    }
    let marks = shared.cursor.marks.len();
    let words = counted(marks, "item");
    let back = shared.key_for("back");
    shared.say(format!("{words} marked; {back} clears the marks"));
}

/// Deletes the targets; asks first if that changes others, or if the selection has only come to them by
/// deleting what was selected before: a key that is held or struck twice deletes one thing.
pub(super) fn delete(shared: &mut Shared) {
    if shared.refuses_structure() {
        return;
    }
    let nodes = shared.targets();
    if follows_deletion(shared) || shared.source().consequence(&nodes).is_some() {
        shared.overlays.dialog = Some(Dialog::Delete(nodes));
    } else {
        delete_all(shared, &nodes);
    }
}

/// Whether nothing was changed, selected or marked since something was deleted.
fn follows_deletion(shared: &Shared) -> bool {
    let now = (shared.document.revision(), shared.cursor.selected());
    shared.cursor.deleted == Some(now) && shared.cursor.marks.is_empty()
}

/// The question whether to delete nodes that others use, or one after the other.
pub(crate) fn question_before_deleting(shared: &Shared, nodes: &[Node]) -> Question {
    let name = shared.targets_name(nodes);
    let text = match shared.source().consequence(nodes) {
        Some(consequence) => format!("Delete {name}? {consequence}."),
        None => format!("Delete {name} as well?"),
    };
    Question {
        title: " Delete ",
        text,
    }
}

/// Deletes what the open question is about.
pub(crate) fn delete_anyway(shared: &mut Shared) {
    if let Some(Dialog::Delete(nodes)) = shared.overlays.dialog.take() {
        delete_all(shared, &nodes);
    }
}

fn delete_all(shared: &mut Shared, nodes: &[Node]) {
    let name = shared.targets_name(nodes);
    let edits = shared.source().removal(nodes);
    if restructured(shared, edits, None, &format!("deleted: {name}")) {
        shared.cursor.deleted = Some((shared.document.revision(), shared.cursor.selected()));
        let them = if nodes.len() == 1 { "it" } else { "them" };
        let undo = shared.key_for("undo");
        shared.say(format!("deleted: {name}; {undo} brings {them} back"));
    }
}

/// Inserts copies of the targets after the last of them.
pub(super) fn duplicate(shared: &mut Shared) {
    if shared.refuses_structure() {
        return;
    }
    let nodes = shared.targets();
    let name = shared.targets_name(&nodes);
    let after = nodes
        .last()
        .copied()
        .unwrap_or_else(|| shared.cursor.selected());
    let copied = shared.source().copied(&nodes);
    let placed = copied.and_then(|copied| shared.source().insertion(&copied, after));
    place(shared, placed, &format!("duplicated: {name}"));
}

/// Exchanges the selected node and its neighbour.
pub(super) fn reorder(shared: &mut Shared, neighbour: Neighbour) {
    if shared.refuses_structure() {
        return;
    }
    let node = shared.cursor.selected();
    let words = match neighbour {
        Neighbour::Previous => "moved up",
        Neighbour::Next => "moved down",
    };
    let placed = shared.source().exchange(node, neighbour);
    place(shared, placed, words);
}

/// Copies the text of the targets, also to the terminal's clipboard.
pub(super) fn copy(shared: &mut Shared) -> Vec<Effect> {
    if shared.refuses_structure() {
        return Vec::new();
    }
    let nodes = shared.targets();
    match shared.source().copied(&nodes) {
        Ok(copied) => {
            let name = shared.targets_name(&nodes);
            let paste = shared.key_for("paste");
            let words = format!("copied: {name}; {paste} pastes it");
            shared.say(words);
            shared.cursor.copied = Some(copied.clone());
            vec![Effect::CopyText(copied)]
        }
        Err(refused) => {
            shared.fail(refused.to_string());
            Vec::new()
        }
    }
}

/// Inserts the text copied last after the selected node.
pub(super) fn insert_copied(shared: &mut Shared) {
    if let Some(copied) = shared.cursor.copied.clone() {
        insert(shared, &copied);
    } else {
        let copy = shared.key_for("copy");
        shared.fail(format!("nothing to paste: {copy} copies the selected item"));
    }
}

/// Reads a text as things of the scene and inserts them after the selected node.
pub(crate) fn insert(shared: &mut Shared, text: &str) {
    if shared.refuses_structure() {
        return;
    }
    let placed = shared.source().insertion(text, shared.cursor.selected());
    if let Err(StructureError::Foreign { reason }) = &placed {
        let edit = shared.key_for("edit");
        let message = format!("{reason}; to paste values into fields, press {edit}");
        shared.fail(message);
        return;
    }
    place(shared, placed, "pasted");
}

/// Opens a line to type the new name of the selected node.
pub(super) fn start_renaming(shared: &mut Shared) {
    if shared.refuses_structure() {
        return;
    }
    let node = shared.cursor.selected();
    match shared.source().called(node).map(str::to_owned) {
        Some(name) => shared.overlays.open_prompt_over(PromptKind::Name, &name),
        None => {
            if let Err(reason) = shared.source().renaming(node, "name") {
                shared.fail(reason.to_string());
            }
        }
    }
}

/// Gives the selected node another name; references to it follow.
pub(crate) fn rename(shared: &mut Shared, name: &str) {
    if shared.refuses_structure() {
        return;
    }
    let name = name.trim();
    let before = shared.source().name(shared.cursor.selected());
    let edits = shared.source().renaming(shared.cursor.selected(), name);
    let done = match name {
        "" => "name removed".to_owned(),
        name => format!("renamed: {name}"),
    };
    if !restructure(shared, edits, None, &done) {
        return;
    }
    if !name.is_empty() {
        let step = StepName::done(format!("renamed {before} to {name}"));
        shared.document.name_step(step);
    }
    text::merge_input(shared);
}

/// Makes the frame of the selected node orthonormal.
pub(crate) fn orthonormalise(shared: &mut Shared) {
    if shared.refuses_structure() {
        return;
    }
    let node = shared.cursor.selected();
    let name = shared.source().name(node);
    let edits = shared.source().orthonormalised(node);
    if edits.as_ref().is_ok_and(Vec::is_empty) {
        shared.say(format!("{name} is already orthonormal"));
        return;
    }
    restructure(shared, edits, None, &format!("orthonormalised: {name}"));
}

/// Hides the targets, or shows them again if the first is hidden.
pub(super) fn toggle_visibility(shared: &mut Shared) {
    let objects = shared.targets().into_iter().filter_map(|node| match node {
        Node::Object(object) => Some(object),
        _ => None,
    });
    let objects: Vec<_> = objects.collect();
    let Some(&first) = objects.first() else {
        shared.fail("only objects can be shown or hidden");
        return;
    };
    let (wanted, done) = match shared.source().drawn(first) {
        Some(_) => (Visibility::Hidden, "hidden"),
        None => (Visibility::Shown, "shown"),
    };
    let mut shown = objects.iter().filter(|_| wanted == Visibility::Shown);
    if let Some(reason) = shown.find_map(|&object| refuses_part(shared, object)) {
        shared.fail(reason);
        return;
    }
    shared.document.end_step();
    let edits = match shared.source().visibility_edits(&objects, wanted) {
        Ok(edits) => edits,
        // Nothing is wrong: that is what the language can say.
        Err(reason) => {
            shared.warn(reason);
            return;
        }
    };
    let outcome = text::try_step(shared, &edits).map_err(|refused| refused.message);
    let nodes: Vec<_> = objects.into_iter().map(Node::Object).collect();
    match outcome {
        Ok(()) => {
            let name = shared.targets_name(&nodes);
            shared
                .document
                .name_step(StepName::done(format!("{done} {name}")));
            shared.say(format!("{done}: {name}"));
        }
        Err(reason) => shared.fail(reason),
    }
}

/// Why an object cannot be shown by itself, if it is only drawn as a part of another.
fn refuses_part(shared: &Shared, object: usize) -> Option<String> {
    let source = shared.source();
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
    let key = shared.key_for("visibility");
    Some(format!(
        "{part} is part of {whole}: {key} there shows or hides it"
    ))
}

/// Places a node as [`restructure`] does, and selects it.
pub(super) fn place(
    shared: &mut Shared,
    placed: Result<Placement, StructureError>,
    done: &str,
) -> bool {
    let at = placed.as_ref().ok().map(|placed| placed.at);
    restructure(shared, placed.map(|placed| placed.edits), at, done)
}

/// Makes structural edits as one undo step, selects the node written by the edit `at`, and says
/// what is done or why not. Returns whether it is done.
pub(crate) fn restructure(
    shared: &mut Shared,
    edits: Result<Vec<Edit>, StructureError>,
    at: Option<usize>,
    done: &str,
) -> bool {
    let is_done = restructured(shared, edits, at, done);
    if is_done {
        shared.say(done);
    }
    is_done
}

/// As [`restructure`], but says only why it is not done.
fn restructured(
    shared: &mut Shared,
    edits: Result<Vec<Edit>, StructureError>,
    at: Option<usize>,
    done: &str,
) -> bool {
    let outcome = edits.map_err(|refused| refused.to_string());
    let outcome = outcome.and_then(|edits| {
        let placed = at.and_then(|at| text::spans_after(&edits).get(at).copied());
        let outcome = text::try_step(shared, &edits);
        outcome.map(|()| placed).map_err(|refused| refused.message)
    });
    match outcome {
        Ok(placed) => {
            shared.cursor.marks.clear();
            if let Some(node) = placed.and_then(|span| text::first_node_in(shared, span)) {
                shared.select(node);
            }
            let selected = shared.source().name(shared.cursor.selected());
            shared.document.name_step(text::done(done, &selected));
            true
        }
        Err(reason) => {
            shared.fail(reason);
            false
        }
    }
}
