//! Repeating the last change on what is selected now.

use crate::app::shared::change::Change;
use crate::app::values::{colours, literals};
use crate::app::{Shared, Tool, select, text, transform};
use crate::keymap::Mode;
use ::text::Edit;
use language::schema::Field;
use language::{FieldSpans, Motion, Node};

/// Does the last change again: to the marked things, otherwise to the selected one, in EDIT to the field
/// under the cursor if that takes such a value. One undo step.
pub(crate) fn repeat(shared: &mut Shared) {
    let Some(change) = shared.cursor.changed.clone() else {
        shared.say("nothing to repeat yet: change a field, a type or a place first");
        return;
    };
    let nodes = match shared.mode {
        Mode::Edit if !text::sets_marked(shared) => vec![shared.cursor.selected()],
        _ => shared.targets(),
    };
    if nodes.contains(&Node::View) {
        shared.fail("the view takes no repeated change");
        return;
    }
    match change {
        Change::Set(field, values) => {
            let words: Vec<_> = values.iter().map(|(_, literal)| literal.trim()).collect();
            let words = format!("{} {}", field.key, words.join(" "));
            let (edits, changed) = edits_to(shared, &nodes, field, |_| Some(values.clone()));
            repeat_edits(shared, (&nodes, &changed), &edits, (field.key, &words));
        }
        Change::Nudged(field, component, by) => {
            let sign = if by < 0.0 { "" } else { "+" };
            let words = format!("{} {sign}{by}", field.key);
            let (edits, changed) = edits_by(shared, &nodes, (field, component), by);
            repeat_edits(shared, (&nodes, &changed), &edits, (field.key, &words));
        }
        Change::Retyped(kind) => {
            let edits = shared.source().retyping(shared.cursor.selected(), &kind);
            select::restructure(shared, edits, None, &format!("repeated: changed to {kind}"));
        }
        Change::Moved {
            motion,
            decimals,
            words,
        } => match edits_moving(shared, &nodes, motion, decimals) {
            Ok(edits) => repeat_edits(shared, (&nodes, &nodes), &edits, ("place", &words)),
            Err(reason) => shared.fail(reason),
        },
    }
}

/// Notes that the present values of the current field were set.
pub(super) fn note_set(shared: &mut Shared) {
    let Some(placed) = shared.cursor.current() else {
        return;
    };
    let literals = colours::literals(shared.source(), placed);
    let values = literals.into_iter().enumerate().collect();
    shared.cursor.changed = Some(Change::Set(placed.field, values));
}

/// Makes the edits of a repeated change, and says what was repeated on what; nodes without such a field
/// are left.
fn repeat_edits(
    shared: &mut Shared,
    (nodes, changed): (&[Node], &[Node]),
    edits: &[Edit],
    (key, words): (&str, &str),
) {
    if changed.is_empty() {
        let names = shared.targets_name(nodes);
        shared.fail(format!("{names} has no {key}"));
        return;
    }
    let names = shared.targets_name(changed);
    let left = match nodes.len() - changed.len() {
        0 => String::new(),
        left => format!("; {left} without {key}"),
    };
    if text::make_step(shared, edits, format!("repeated {words}: {names}")) {
        shared.say(format!("repeated: {words} on {names}{left}"));
    }
}

/// The edits that give nodes values of a field like this one, and the nodes that have it.
fn edits_to(
    shared: &Shared,
    nodes: &[Node],
    field: &Field,
    values: impl Fn(&FieldSpans) -> Option<Vec<(usize, String)>>,
) -> (Vec<Edit>, Vec<Node>) {
    let source = shared.source();
    let has_field = |&node: &Node| {
        let fields = source.fields(node);
        let here = shared.cursor.current().filter(|placed| {
            let is_here = shared.mode == Mode::Edit && node == shared.cursor.selected();
            is_here && placed.field.kind == field.kind
        });
        let placed = here.or_else(|| text::placed_like(&fields, field))?;
        Some((node, placed.clone(), values(placed)?))
    };
    let found: Vec<_> = nodes.iter().filter_map(has_field).collect();
    let wanted = found
        .iter()
        .map(|(_, placed, values)| (placed, values.clone()));
    let edits = source.edits(&wanted.collect::<Vec<_>>());
    (edits, found.iter().map(|&(node, ..)| node).collect())
}

/// The edits that change a component of a field of nodes by an amount, and the nodes that have it.
pub(super) fn edits_by(
    shared: &Shared,
    nodes: &[Node],
    (field, component): (&Field, usize),
    by: f64,
) -> (Vec<Edit>, Vec<Node>) {
    edits_to(shared, nodes, field, |placed| {
        let present = colours::literals(shared.source(), placed);
        let literal = present.get(component)?;
        let nudged = literals::nudged(literal, by, by.abs())?;
        let nudged = literals::kept_in(placed.field.usual, literal, nudged);
        Some(vec![(component, nudged)])
    })
}

/// The edits that move nodes as something else was moved, about their own place.
fn edits_moving(
    shared: &Shared,
    nodes: &[Node],
    mut motion: Motion,
    decimals: usize,
) -> Result<Vec<Edit>, String> {
    let tool = match motion {
        Motion::Move(_) => Tool::Move,
        Motion::Rotate { .. } => Tool::Rotate,
        Motion::Scale { .. } => Tool::Scale,
    };
    let selected = shared.cursor.selected();
    let node = nodes.iter().find(|node| **node == selected);
    let Some(&node) = node.or_else(|| nodes.first()) else {
        return Ok(Vec::new());
    };
    let pose = transform::pose_for(shared, tool, node, nodes)?;
    if let Motion::Rotate { about, .. } | Motion::Scale { about, .. } = &mut motion {
        *about = pose.centre;
    }
    let edits = shared.source().motion(nodes, &motion, decimals);
    edits.map_err(|refused| refused.to_string())
}
