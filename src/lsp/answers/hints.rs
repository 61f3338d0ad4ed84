//! The names of fields in front of bare numbers.

use language::Language;
use serde_json::{Value, json};
use text::Span;

use crate::document::Document;

/// The maximum number of hints: more than any window shows.
const MOST: usize = 5_000;

/// The answer to `textDocument/inlayHint`.
pub(crate) fn within(document: &Document, span: Span) -> Value {
    // Attributes have names of their own.
    if document.source.language() == Language::Xml {
        return json!([]);
    }
    let fields = document
        .stated_in(span)
        .filter(|placed| placed.field.kind.is_numeric());
    let hints = fields.filter(|placed| span.touches(placed.spans[0]));
    let hints = hints.take(MOST).map(|placed| {
        json!({
            "position": document.position(placed.spans[0].start()),
            "label": format!("{}:", placed.field.key),
            "kind": 2,
            "paddingRight": true,
            "tooltip": placed.field.doc,
        })
    });
    hints.collect()
}
