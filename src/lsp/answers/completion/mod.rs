//! What the value at an offset may be.

use language::schema::Kind;
use serde_json::{Value, json};

use crate::document::Document;

/// The answer to `textDocument/completion`: the words of a choice, and the IDs or names that exist.
pub(crate) fn at(document: &Document, at: usize) -> Value {
    let Some(place) = document.place(at) else {
        return json!([]);
    };
    let item = |word: &str, detail: &str| {
        let edit = text::Edit {
            span: place.span,
            text: document.source.spelled(place.span, word).into_owned(),
        };
        json!({ "label": word, "detail": detail, "textEdit": document.text_edit(&edit) })
    };
    match place.field().kind {
        Kind::Choice(words) => words
            .iter()
            .map(|word| item(word, place.field().doc))
            .collect(),
        Kind::Reference(category) | Kind::Name(category) => {
            let known = document.source.references(place.node, category).into_iter();
            known
                .map(|(word, node)| {
                    let comment = document.source.comment(node).unwrap_or_default();
                    item(&word, &format!("{} {comment}", document.source.name(node)))
                })
                .collect()
        }
        _ => json!([]),
    }
}
