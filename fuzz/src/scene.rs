//! The scene languages: parsing never fails, lowering ends, and all spans lie within the text.

use std::sync::Arc;

use halflight::language::{Language, Lowered, Source};
use halflight::scene::Meshes;
use halflight::text::{Position, Span};

/// Reads a `.ray` text.
pub fn ray(input: &[u8]) {
    read(Language::Ray, &String::from_utf8_lossy(input));
}

/// Reads a `.dat` text.
pub fn dat(input: &[u8]) {
    read(Language::Dat, &String::from_utf8_lossy(input));
}

/// Reads a `.test` text.
pub fn cse167(input: &[u8]) {
    read(Language::Cse167, &String::from_utf8_lossy(input));
}

/// Reads a `.xml` text.
pub fn xml(input: &[u8]) {
    read(Language::Xml, &String::from_utf8_lossy(input));
}

/// Reads a text and checks the result.
pub(super) fn read(language: Language, text: &str) -> (Source, Lowered) {
    let mut source = Source::new(language, Arc::new(text.to_owned()));
    let mut end = 0;
    for leaf in source.leaves() {
        assert!(end <= leaf.start(), "leaves are in order");
        end = leaf.end();
        assert!(is_of(text, leaf) && !leaf.is_empty());
    }
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    check(&source, &lowered);
    (source, lowered)
}

/// Checks the meaning of a text.
pub(super) fn check(source: &Source, lowered: &Lowered) {
    let text = source.text();
    let found = &lowered.diagnostics;
    assert_eq!(lowered.scene.is_none(), 0 < found.errors());
    for diagnostic in found.iter() {
        assert!(is_of(text, diagnostic.span), "{diagnostic:?}");
        let Position { line, column } = Position::of(text, diagnostic.span.start());
        assert!(0 < line && 0 < column && !diagnostic.message.is_empty());
    }
    assert!(found.is_sorted_by_key(|diagnostic| diagnostic.span.start()));
    // The first nodes are representative of long texts.
    for node in source.nodes().iter().take(64) {
        assert!(!source.name(node).is_empty() && is_of(text, source.span(node)));
        source.comment(node);
        for placed in source.fields(node) {
            assert!(placed.spans.iter().all(|&span| is_of(text, span)));
        }
    }
    for file in source.files() {
        assert!(is_of(text, file.span));
    }
}

/// Whether a span lies in a text and ends at character boundaries.
fn is_of(text: &str, span: Span) -> bool {
    text.get(span.range()).is_some()
}
