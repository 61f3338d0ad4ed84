//! IDs and names: where they are defined and used, and what renaming them changes.

use language::Node;
use language::schema::Kind;
use serde_json::{Value, json};
use text::Span;

use crate::document::{Document, Place};

/// The node that the value of a field names.
pub(crate) fn target(document: &Document, place: &Place) -> Option<Node> {
    let (Kind::Reference(category) | Kind::Name(category)) = place.field().kind else {
        return None;
    };
    let literal = document.source.leaf_text(place.span);
    let known = document.source.references(place.node, category).into_iter();
    let found = known.into_iter().find(|(name, _)| name == literal);
    found.map(|(_, node)| node)
}

/// The words that a node is called by, its definition among them, in text order: what renaming it
/// changes. Empty if it has no ID and no name.
fn words(document: &Document, node: Node) -> Vec<Span> {
    // No text is likely to have either already.
    let unused = ["987654321", "name-987654321"];
    let mut renamings = unused
        .iter()
        .map(|name| document.source.renaming(node, name));
    let edits = renamings.find_map(Result::ok).unwrap_or_default();
    let spans = edits.iter().map(|edit| edit.span);
    spans.filter(|span| !span.is_empty()).collect()
}

/// The node that the word at an offset defines or names, and all words that it is called by.
fn subject(document: &Document, at: usize) -> Option<(Node, Vec<Span>)> {
    let used = document
        .place(at)
        .and_then(|place| target(document, &place));
    let node = used.or_else(|| document.source.node_at(Span::at(at)))?;
    let words = words(document, node);
    let is_here = words.iter().any(|word| word.touches(Span::at(at)));
    is_here.then_some((node, words))
}

/// The answer to `textDocument/definition`.
pub(crate) fn definition(document: &Document, at: usize) -> Value {
    let Some((node, words)) = subject(document, at) else {
        return Value::Null;
    };
    let own = document.source.span(node);
    let name = words.into_iter().find(|word| own.touches(*word));
    document.location(name.unwrap_or(own))
}

/// The answer to `textDocument/references`.
pub(crate) fn references(document: &Document, at: usize, with_definition: bool) -> Value {
    let Some((node, words)) = subject(document, at) else {
        return Value::Null;
    };
    let own = document.source.span(node);
    let wanted = |word: &Span| with_definition || !own.touches(*word);
    let words = words.into_iter().filter(wanted);
    words.map(|word| document.location(word)).collect()
}

/// The answer to `textDocument/documentHighlight`.
pub(crate) fn highlights(document: &Document, at: usize) -> Value {
    let Some((_, words)) = subject(document, at) else {
        return Value::Null;
    };
    let words = words.iter();
    words
        .map(|word| json!({ "range": document.range(*word) }))
        .collect()
}

/// The answer to `textDocument/prepareRename`.
pub(crate) fn renamed(document: &Document, at: usize) -> Value {
    let here = subject(document, at).and_then(|(_, words)| {
        let is_here = |word: &Span| word.touches(Span::at(at));
        words.into_iter().find(is_here)
    });
    here.map_or(Value::Null, |word| document.range(word))
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
