//! The nodes of a text as symbols and folds.

use language::Node;
use serde_json::{Value, json};

use crate::document::Document;

/// The maximum number of symbols: editors show them in a list.
const MOST: usize = 10_000;

/// The answer to `textDocument/documentSymbol`.
pub(crate) fn symbols(document: &Document) -> Value {
    let source = &document.source;
    let nodes = source
        .nodes()
        .iter()
        .filter(|node| !source.span(*node).is_empty());
    let symbol = |node| {
        let range = document.range(source.span(node));
        json!({
            "name": source.name(node),
            "detail": source.comment(node).unwrap_or_default(),
            "kind": kind(node),
            "range": range,
            "selectionRange": range,
        })
    };
    nodes.take(MOST).map(symbol).collect()
}

/// The nearest of the protocol's kinds, which editors show as icons.
fn kind(node: Node) -> u8 {
    match node {
        // Namespace.
        Node::Render => 3,
        // Interface.
        Node::View => 11,
        // Constant.
        Node::Ambient | Node::Background | Node::Environment => 14,
        // Event.
        Node::Light(_) => 24,
        // Property.
        Node::Material(_) | Node::Texture(_) => 7,
        // Object.
        Node::Object(_) => 19,
    }
}

/// The answer to `textDocument/foldingRange`: nodes of several lines.
pub(crate) fn folds(document: &Document) -> Value {
    let source = &document.source;
    let lines = source.nodes().iter().map(|node| {
        let span = source.span(node);
        [span.start(), span.end()].map(|at| document.line(at))
    });
    let folds = lines.filter(|[start, end]| start < end);
    folds
        .map(|[start, end]| json!({ "startLine": start, "endLine": end }))
        .collect()
}
