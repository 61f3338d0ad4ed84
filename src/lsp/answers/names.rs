//! IDs and names: where they are defined and used, and what renaming them changes.

use language::schema::Kind;
use language::{FieldSpans, Node};
use serde_json::{Value, json};
use text::Span;

use crate::document::{Document, Place};
use crate::positions::word_at;

/// The node that the value of a field names.
pub(crate) fn target(document: &Document, place: &Place) -> Option<Node> {
    named(document, place.node, &place.placed)
}

fn named(document: &Document, node: Node, placed: &FieldSpans) -> Option<Node> {
    let (Kind::Reference(category) | Kind::Name(category)) = placed.field.kind else {
        return None;
    };
    let literal = document.source.leaf_text(*placed.spans.first()?);
    let known = document.source.references(node, category).into_iter();
    let found = known.into_iter().find(|(name, _)| name == literal);
    found.map(|(_, node)| node)
}

/// The node that the word at an offset defines or names, and that word.
fn subject(document: &Document, at: usize) -> Option<(Node, Span)> {
    if let Some(place) = document.place(at)
        && let Some(node) = target(document, &place)
    {
        return Some((node, place.span));
    }
    let word = word_at(document.text(), at);
    let node = document.source.node_at(Span::at(at))?;
    let is_name = document.source.called(node) == Some(word.of(document.text()));
    (is_name && !word.is_empty()).then_some((node, word))
}

/// The words that name a node, in text order, without its definition.
fn uses(document: &Document, of: Node) -> Vec<Span> {
    let Some(name) = document.source.called(of) else {
        return Vec::new();
    };
    let mut uses = Vec::new();
    for node in document.source.nodes().iter() {
        for placed in document.source.fields(node) {
            let is_name = matches!(placed.field.kind, Kind::Reference(_) | Kind::Name(_));
            let span = placed
                .spans
                .first()
                .filter(|_| is_name && placed.is_explicit());
            let Some(span) = span.filter(|span| document.source.leaf_text(**span) == name) else {
                continue;
            };
            if named(document, node, &placed) == Some(of) {
                uses.push(*span);
            }
        }
    }
    uses.sort_unstable();
    uses.dedup();
    uses
}

/// The answer to `textDocument/definition`.
pub(crate) fn definition(document: &Document, at: usize) -> Value {
    let found = subject(document, at);
    found.map_or(Value::Null, |(node, _)| {
        document.location(document.source.span(node))
    })
}

/// The answer to `textDocument/references`.
pub(crate) fn references(document: &Document, at: usize, with_definition: bool) -> Value {
    let Some((node, _)) = subject(document, at) else {
        return Value::Null;
    };
    let own = with_definition.then(|| document.source.span(node));
    let all = own.into_iter().chain(uses(document, node));
    all.map(|span| document.location(span)).collect()
}

/// The answer to `textDocument/documentHighlight`: all uses, and the word itself.
pub(crate) fn highlights(document: &Document, at: usize) -> Value {
    let Some((node, word)) = subject(document, at) else {
        return Value::Null;
    };
    let mut all = uses(document, node);
    all.push(word);
    all.sort_unstable();
    all.dedup();
    all.iter()
        .map(|span| json!({ "range": document.range(*span) }))
        .collect()
}

/// The answer to `textDocument/rename`; an error says why a name cannot be given.
pub(crate) fn rename(document: &Document, at: usize, name: &str) -> Result<Value, String> {
    let (node, _) = subject(document, at).ok_or("there is no ID or name here")?;
    let edits = document
        .source
        .renaming(node, name)
        .map_err(|error| error.to_string())?;
    Ok(document.workspace_edit(&edits))
}
