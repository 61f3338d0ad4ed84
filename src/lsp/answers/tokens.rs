//! Highlighting, for editors that do not know the language.

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
    let mut data: Vec<usize> = Vec::new();
    let mut before = [0, 0];
    for leaf in source
        .leaves()
        .into_iter()
        .filter(|leaf| span.touches(*leaf))
    {
        let word = source.leaf_text(leaf);
        let kind = if source.is_comment(leaf) {
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

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;
    use crate::positions::Encoding;

    #[test]
    fn comments_are_those_of_the_language() {
        for (language, text, kinds) in [
            (Language::Ray, "// c\n#1 2\n", [0, 2, 1]),
            (Language::Dat, "// c\nmat 2\n", [0, 2, 1]),
            (Language::Dat, "mat #2 3\n", [2, 2, 1]),
            (Language::Cse167, "spp 1 # c\n", [2, 1, 0]),
            (Language::Cse167, "spp 1 // c\n", [2, 1, 2]),
        ] {
            let file = (PathBuf::from("/none/a"), language);
            let uri = "file:///none/a".to_owned();
            let document = Document::new(uri, file, text.to_owned(), Encoding::Utf8);
            let tokens = all(&document);
            let data = tokens["data"].as_array().expect("a list");
            let found: Vec<_> = data.chunks(5).take(3).map(|token| &token[3]).collect();
            assert_eq!(found, kinds, "{text}");
        }
    }
}
