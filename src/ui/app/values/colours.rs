//! The colours of fields.

use super::literals::plain;
use language::schema::Kind;
use language::{FieldSpans, Source};
use scene::Rgb;
use text::parse_number;

/// The number of nodes whose colours are offered.
const NODES: usize = 1000;

/// The colour that the literals of a field represent.
pub(crate) fn of_literals(kind: Kind, literals: &[String]) -> Option<Rgb> {
    let channel = |at: usize| parse_number(plain(literals.get(at)?)).ok();
    let colour = || Some(Rgb::new(channel(0)?, channel(1)?, channel(2)?));
    match kind {
        Kind::Colour => colour(),
        Kind::ScaledColour => Some(channel(3)? * colour()?),
        _ => None,
    }
}

/// The colour of a field, as written or by default.
fn of_field(source: &Source, placed: &FieldSpans) -> Option<Rgb> {
    of_literals(placed.field.kind, &literals(source, placed))
}

/// The literals of a field, as written or by default; none of a part of the view that the text
/// omits.
pub(crate) fn literals(source: &Source, placed: &FieldSpans) -> Vec<String> {
    let literal = |(component, span)| match placed.default_of(component) {
        Some(default) => default.to_owned(),
        None => source.leaf_text(span).to_owned(),
    };
    let spans = placed.spans.iter().copied();
    spans.enumerate().map(literal).collect()
}

/// The different colours of the first nodes of a scene, at most `limit`.
pub(crate) fn of_scene(source: &Source, limit: usize) -> Vec<Rgb> {
    let mut found = Vec::new();
    for node in source.nodes().iter().take(NODES) {
        for placed in source.fields(node) {
            let colour = of_field(source, &placed);
            if let Some(colour) = colour.filter(|colour| !found.contains(colour)) {
                found.push(colour);
            }
            if limit <= found.len() {
                return found;
            }
        }
    }
    found
}
