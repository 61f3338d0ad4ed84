//! Naming undo steps after the edits that make them.

use std::collections::{BTreeMap, BTreeSet};

use super::location_names::name_of;
use crate::document::StepName;
use crate::language::{Node, Placed};
use crate::text::{Edit, Span, counted};
use crate::ui::app::Shared;

/// The number of edits that are looked at; more are only counted, as that takes long.
const MOST_READ: usize = 64;

/// The number of characters shown of a value.
const MOST_SHOWN: usize = 24;

/// The name of a step that makes these edits of the present text, if they set one field.
pub(super) fn name_of_value(shared: &Shared, edits: &[Edit]) -> Option<StepName> {
    let text = shared.document.text();
    let (place, values) = match edits {
        [edit] if is_value(edit.span.of(text)) && is_value(&edit.text) => {
            let place = name_of(shared.source(), &[edit.span])?;
            (place, [edit.span.of(text), &edit.text].map(shortened))
        }
        [_] => return None,
        edits if MOST_READ < edits.len() => return None,
        edits => {
            let (node, placed) = field_of(shared, edits)?;
            let place = format!("{} {}", shared.source().name(node), placed.field.key);
            let values = values(shared, &placed, edits);
            (place, values.map(|value| shortened(&value)))
        }
    };
    let [before, after] = values;
    Some(StepName::set(place, &before, &after))
}

/// The name of a step that wrote these spans of the present text.
pub(super) fn name_of_change(shared: &Shared, written: &[Span]) -> StepName {
    StepName::done(match written {
        spans if MOST_READ < spans.len() => {
            format!("changed {}", counted(spans.len(), "place"))
        }
        [span] => match name_of(shared.source(), &[*span]) {
            Some(place) => format!("changed {place}"),
            None => return StepName::default(),
        },
        spans => changed(shared, spans),
    })
}

/// The only field that these edits set, with its node.
fn field_of(shared: &Shared, edits: &[Edit]) -> Option<(Node, Placed)> {
    let source = shared.source();
    let node = source.node_at(edits.first()?.span)?;
    let sets = |placed: &Placed| {
        let is_own = |edit: &Edit| !edit.span.is_empty() && placed.spans.contains(&edit.span);
        edits.iter().all(is_own)
    };
    let placed = source.fields(node).into_iter().find(sets)?;
    Some((node, placed))
}

/// The literals of a field before and after edits.
fn values(shared: &Shared, placed: &Placed, edits: &[Edit]) -> [String; 2] {
    let source = shared.source();
    let old = placed.spans.iter().map(|span| source.leaf_text(*span));
    let new = placed.spans.iter().map(|span| {
        let edit = edits.iter().find(|edit| edit.span == *span);
        edit.map_or_else(|| source.leaf_text(*span), |edit| &edit.text)
    });
    [old.collect::<Vec<_>>(), new.collect()].map(|literals| literals.join(" "))
}

/// Names what was written in several places.
fn changed(shared: &Shared, spans: &[Span]) -> String {
    let source = shared.source();
    let mut nodes: BTreeMap<Node, Vec<Span>> = BTreeMap::new();
    for span in spans {
        let node = match source.nodes_in(*span)[..] {
            [only] => Some(only),
            _ => source.node_at(*span),
        };
        if let Some(node) = node {
            nodes.entry(node).or_default().push(*span);
        }
    }
    let key = |(node, spans): (&Node, &Vec<Span>)| {
        let holds = |placed: &Placed| spans.iter().all(|span| placed.spans.contains(span));
        let field = source.fields(*node).into_iter().find(holds);
        field.map(|placed| placed.field.key)
    };
    let keys: BTreeSet<_> = nodes.iter().map(key).collect();
    let mut names = nodes.keys().map(|node| source.name(*node));
    let what = match (nodes.len(), names.next(), names.next_back()) {
        (1, Some(only), _) => only,
        (2, Some(first), Some(last)) => format!("{first}, {last}"),
        (count, Some(first), Some(last)) => format!("{count} items, {first} to {last}"),
        (..) => return StepName::default().to_string(),
    };
    match (keys.len(), keys.first()) {
        (1, Some(Some(key))) => format!("changed {key} of {what}"),
        _ => format!("changed {what}"),
    }
}

/// The name of a step by the message that it is done: `deleted: object 2` is `deleted object 2`.
/// Messages that name nothing are followed by what is selected.
pub(crate) fn done(message: &str, selected: &str) -> StepName {
    StepName::done(match message.split_once(": ") {
        Some((verb, what)) => format!("{verb} {what}"),
        None => format!("{message}: {selected}"),
    })
}

/// Whether a text is likely to be a value rather than a part of the structure.
fn is_value(text: &str) -> bool {
    !text.trim().is_empty() && !text.contains(['\n', '\r', '<', '>'])
}

/// A value in one short line.
fn shortened(value: &str) -> String {
    let value = value.split_whitespace().collect::<Vec<_>>().join(" ");
    match value.char_indices().nth(MOST_SHOWN) {
        Some((end, _)) => format!("{}…", &value[..end]),
        None => value,
    }
}
