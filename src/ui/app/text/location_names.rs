//! Names of places in the text.

use std::collections::BTreeMap;

use crate::language::{Node, Source};
use crate::text::{Position, Span};
use crate::ui::app::Shared;

/// Up to this many nodes are named; more are counted.
const NAMED: usize = 2;

/// The name of a place in the text, such as `object 4 (sphere) centre x`, or of the nodes that
/// it covers; `None` if there are none.
pub(crate) fn place_name(shared: &Shared, span: Span) -> Option<String> {
    name_of(shared.source(), &[span])
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
pub(crate) fn name_of(source: &Source, spans: &[Span]) -> Option<String> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    use crate::language::Language;
    use crate::scene::Meshes;

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
            let found = name_of(&source, &[span]);
            assert_eq!(found.as_deref(), Some(name), "{from}..{until}");
        }
        let [radius, centre, other] = [("0 0 0 1", 6), ("1 0 0 1", 0), ("2 0 0 1", 0)]
            .map(|(part, number)| Span::at(at(&format!("sphere {part}")) + 7 + number));
        let named = |spans: &[Span]| name_of(&source, spans);
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
