//! Names of places in the text.

use super::App;
use crate::language::{Node, Source};
use crate::text::{Position, Span};

/// Up to this many nodes are named; more are counted.
const NAMED: usize = 2;

impl App {
    /// The name of a place in the text, such as `object 4 (sphere) centre x`, or of the nodes that
    /// it covers; `None` if there are none.
    pub fn place_name(&self, span: Span) -> Option<String> {
        name_of(self.source(), span)
    }

    /// Describes how many errors the text has and where the first one is.
    pub(super) fn error_place(&self) -> Option<String> {
        let first = self.diagnostics.first_error()?;
        let line = Position::of(self.document.text(), first.span.start()).line;
        Some(match self.error_count() {
            1 => format!("line {line} has an error"),
            errors => format!("{errors} errors, the first on line {line}"),
        })
    }
}

/// The name of a place in any text.
pub(super) fn name_of(source: &Source, span: Span) -> Option<String> {
    // These comments may be inside the text of another node.
    for node in [Node::View, Node::Render] {
        let own = source.span(node);
        if own.start() <= span.start() && span.end() <= own.end() && !own.is_empty() {
            return Some(name_in(source, node, span));
        }
    }
    let touched = source.nodes_in(span);
    match touched.as_slice() {
        [] => {
            let node = source.node_at(span)?;
            Some(name_in(source, node, span))
        }
        [node] => Some(name_in(source, *node, span)),
        [first, .., last] if NAMED < touched.len() => Some(format!(
            "{} items, {} to {}",
            touched.len(),
            source.name(*first),
            source.name(*last)
        )),
        several => {
            let names: Vec<_> = several.iter().map(|&node| source.name(node)).collect();
            Some(names.join(", "))
        }
    }
}

/// A node's name, with the field and component if the span overlaps only one.
fn name_in(source: &Source, node: Node, span: Span) -> String {
    let overlaps = |place: &Span| {
        if span.is_empty() {
            place.touches(span)
        } else {
            place.start() < span.end() && span.start() < place.end()
        }
    };
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
            let found = name_of(&source, span);
            assert_eq!(found.as_deref(), Some(name), "{from}..{until}");
        }
    }
}
