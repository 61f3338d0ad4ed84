//! Names of places in the text, and of undo steps after the edits that make them.

use std::collections::{BTreeMap, BTreeSet};

use crate::app::Shared;
use document::StepName;
use language::{FieldSpans, Node, Source};
use text::{Edit, Position, Span, counted};

/// The number of edits that are looked at; more are only counted, as that takes long.
const MOST_READ: usize = 64;

/// The number of characters shown of a value.
const MOST_SHOWN: usize = 24;

/// Up to this many nodes are named; more are counted.
const NAMED: usize = 2;

/// The name of a place in the text, such as `object 4 (sphere) centre x`, or of the nodes that
/// it covers; `None` if there are none.
pub(crate) fn place_name(shared: &Shared, span: Span) -> Option<String> {
    name_of_places(shared.source(), &[span])
}

/// Describes how many errors the text has and where the first one is.
pub(crate) fn error_place(shared: &Shared) -> Option<String> {
    let first = shared.diagnostics.first_error()?;
    let line = Position::of(shared.document.text(), first.span.start()).line;
    Some(match shared.error_count() {
        1 => format!("line {line} has an error"),
        errors => format!("{errors} errors, the first on line {line}"),
    })
}

/// The name of places in any text; `None` if no node is there.
pub(crate) fn name_of_places(source: &Source, spans: &[Span]) -> Option<String> {
    let mut touched: BTreeMap<Node, Vec<Span>> = BTreeMap::new();
    for span in spans {
        for node in nodes_at(source, *span) {
            touched.entry(node).or_default().push(*span);
        }
    }
    if touched.len() <= NAMED {
        let names = touched
            .iter()
            .map(|(&node, spans)| name_in(source, node, spans));
        return names.reduce(|names, name| format!("{names}, {name}"));
    }
    let (first, last) = (touched.first_key_value()?, touched.last_key_value()?);
    let [first, last] = [first, last].map(|(&node, _)| source.name(node));
    Some(format!("{} items, {first} to {last}", touched.len()))
}

/// The nodes that a place covers, or is in.
fn nodes_at(source: &Source, span: Span) -> Vec<Node> {
    // These comments may be inside the text of another node.
    for node in [Node::View, Node::Render] {
        let own = source.span(node);
        if own.start() <= span.start() && span.end() <= own.end() && !own.is_empty() {
            return vec![node];
        }
    }
    let touched = source.nodes_in(span);
    if touched.is_empty() {
        return source.node_at(span).into_iter().collect();
    }
    touched
}

/// The span of the field of several numbers that a span is in; `None` if it is in none or in more.
pub(crate) fn whole_field(source: &Source, span: Span) -> Option<Span> {
    let [node] = nodes_at(source, span)[..] else {
        return None;
    };
    let is_in = |own: &Span| own.start() <= span.start() && span.end() <= own.end();
    let fields = source.fields(node);
    let mut wholes = fields.iter().filter_map(|placed| {
        let several = placed.spans.len() > 1;
        let cover = placed.spans.iter().copied().reduce(Span::to);
        cover.filter(|cover| several && is_in(cover))
    });
    let found = wholes.next()?;
    wholes.next().is_none().then_some(found)
}

/// A node's name, with the field and component if the spans overlap only one.
fn name_in(source: &Source, node: Node, spans: &[Span]) -> String {
    let overlap = |place: &Span, span: &Span| {
        if span.is_empty() {
            place.touches(*span)
        } else {
            place.start() < span.end() && span.start() < place.end()
        }
    };
    let overlaps = |place: &Span| spans.iter().any(|span| overlap(place, span));
    let name = source.name(node);
    let fields = source.fields(node);
    let mut touched = fields
        .iter()
        .filter(|placed| placed.spans.iter().any(overlaps));
    let (Some(placed), None) = (touched.next(), touched.next()) else {
        return name;
    };
    let names = placed.field.kind.component_names();
    let mut components = placed
        .spans
        .iter()
        .zip(names)
        .filter(|(at, _)| overlaps(at));
    match (components.next(), components.next()) {
        (Some((_, component)), None) if 1 < names.len() => {
            format!("{name} {} {component}", placed.field.key)
        }
        _ => format!("{name} {}", placed.field.key),
    }
}

/// The first node, other than view and render settings, whose text is in a span, or the group around it if
/// that is in the span too.
pub(crate) fn first_node_in(shared: &Shared, span: Span) -> Option<Node> {
    let source = shared.source();
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

/// The name of a step that makes these edits of the present text, if they set one field.
pub(super) fn name_of_value(shared: &Shared, edits: &[Edit]) -> Option<StepName> {
    let text = shared.document.text();
    let (place, values) = match edits {
        [edit] if is_value(edit.span.of(text)) && is_value(&edit.text) => {
            let place = name_of_places(shared.source(), &[edit.span])?;
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
        [span] => match name_of_places(shared.source(), &[*span]) {
            Some(place) => format!("changed {place}"),
            None => return StepName::default(),
        },
        spans => changed(shared, spans),
    })
}

/// The only field that these edits set, with its node.
fn field_of(shared: &Shared, edits: &[Edit]) -> Option<(Node, FieldSpans)> {
    let source = shared.source();
    let node = source.node_at(edits.first()?.span)?;
    let sets = |placed: &FieldSpans| {
        let is_own = |edit: &Edit| !edit.span.is_empty() && placed.spans.contains(&edit.span);
        edits.iter().all(is_own)
    };
    let placed = source.fields(node).into_iter().find(sets)?;
    Some((node, placed))
}

/// The literals of a field before and after edits.
fn values(shared: &Shared, placed: &FieldSpans, edits: &[Edit]) -> [String; 2] {
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
        let holds = |placed: &FieldSpans| spans.iter().all(|span| placed.spans.contains(span));
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    use language::Language;
    use scene::Meshes;

    #[test]
    fn places_are_named_after_their_nodes() {
        let text = "\
.1 .1 .1 // view: eye 0 0 9 fov 40
1 5 5 5 1 1 1
3
sphere 0 0 0 1 0 0 0 0 0 0 0 0 0 1 0 0 1
sphere 1 0 0 1 0 0 0 0 0 0 0 0 0 1 0 0 1
sphere 2 0 0 1 0 0 0 0 0 0 0 0 0 1 0 0 1
";
        let mut source = Source::new(Language::Ray, Arc::new(text.to_owned()));
        source.lower(&Meshes::default()).expect("there is memory");
        let at = |part: &str| text.find(part).expect("a part of the text");
        for (from, until, name) in [
            (0, 2, "ambient colour red"),
            (at("40"), at("40") + 2, "view fov"),
            (0, 5, "ambient colour"),
            (at("5 5 5") + 2, at("5 5 5") + 2, "light 1 position y"),
            (at("sphere 1") + 7, at("sphere 1") + 14, "object 2 (sphere)"),
            (
                at("sphere 1"),
                at("sphere 2") + 3,
                "object 2 (sphere), object 3 (sphere)",
            ),
            (0, text.len(), "5 items, ambient to object 3 (sphere)"),
        ] {
            let span = Span::new(from, until);
            let found = name_of_places(&source, &[span]);
            assert_eq!(found.as_deref(), Some(name), "{from}..{until}");
        }
        let [radius, centre, other] = [("0 0 0 1", 6), ("1 0 0 1", 0), ("2 0 0 1", 0)]
            .map(|(part, number)| Span::at(at(&format!("sphere {part}")) + 7 + number));
        let named = |spans: &[Span]| name_of_places(&source, spans);
        for (spans, name) in [
            (&[][..], None),
            (
                &[radius, other],
                Some("object 1 (sphere) radius, object 3 (sphere) centre x"),
            ),
            (
                &[centre, other],
                Some("object 2 (sphere) centre x, object 3 (sphere) centre x"),
            ),
            (
                &[radius, centre, other],
                Some("3 items, object 1 (sphere) to object 3 (sphere)"),
            ),
        ] {
            assert_eq!(named(spans).as_deref(), name);
        }
    }
}
