//! The nodes of a text as symbols and folds.

use language::Node;
use serde_json::{Value, json};

use crate::document::Document;

/// The maximum number of symbols and of folds.
const MOST: usize = 10_000;

/// The answer to `textDocument/documentSymbol`, in the order of the text.
pub(crate) fn symbols(document: &Document) -> Value {
    let source = &document.source;
    let nodes = source.nodes().iter().map(|node| (source.span(node), node));
    let nodes = nodes.filter(|(span, _)| !span.is_empty());
    let mut nodes: Vec<_> = nodes.take(MOST).collect();
    nodes.sort_unstable_by_key(|(span, _)| *span);
    let symbol = |(span, node)| {
        let range = document.range(span);
        json!({
            "name": source.name(node),
            "detail": source.comment(node).unwrap_or_default(),
            "kind": kind(node),
            "range": range,
            "selectionRange": range,
        })
    };
    nodes.into_iter().map(symbol).collect()
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
    let folds = lines.filter(|[start, end]| start < end).take(MOST);
    folds
        .map(|[start, end]| json!({ "startLine": start, "endLine": end }))
        .collect()
}
