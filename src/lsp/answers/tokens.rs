//! The kinds of words, for editors that do not know the language.

use language::Language;
use serde_json::{Value, json};
use text::{Span, parse_number};

use crate::document::Document;

/// The types of tokens, by number.
pub(crate) const TYPES: [&str; 3] = ["comment", "number", "keyword"];

/// The answer to `textDocument/semanticTokens/full`.
pub(crate) fn all(document: &Document) -> Value {
    within(document, Span::new(0, document.text().len()))
}

/// The answer to `textDocument/semanticTokens/range`. Editors know `.xml`.
pub(crate) fn within(document: &Document, span: Span) -> Value {
    let source = &document.source;
    if source.language() == Language::Xml {
        return json!({ "data": [] });
    }
    let marks = match source.language() {
        Language::Ray => ["//", r"\\"],
        _ => ["#", "//"],
    };
    let mut data: Vec<usize> = Vec::new();
    let mut before = [0, 0];
    for leaf in source
        .leaves()
        .into_iter()
        .filter(|leaf| span.touches(*leaf))
    {
        let word = source.leaf_text(leaf);
        let kind = if marks.iter().any(|mark| word.starts_with(mark)) {
            0
        } else if parse_number(word).is_ok() {
            1
        } else {
            2
        };
        let line = document.line(leaf.start());
        let character = document.position(leaf.start())["character"].as_u64();
        let character = character.unwrap_or_default() as usize;
        let across = if line == before[0] {
            character - before[1]
        } else {
            character
        };
        data.extend([line - before[0], across, document.length(leaf), kind, 0]);
        before = [line, character];
    }
    json!({ "data": data })
}
