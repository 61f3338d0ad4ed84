//! The languages of scenes: parsing never fails, lowering comes to an end, and whatever is said of a
//! text belongs to it.

use halflight::format::{Format, Tree, parse};
use halflight::scene::{Lowered, Meshes, lower};
use halflight::text::{Position, Span};

/// Reads a `.ray` text.
pub fn ray(input: &[u8]) {
    read(Format::Ray, &String::from_utf8_lossy(input));
}

/// Reads a `.dat` text.
pub fn dat(input: &[u8]) {
    read(Format::Dat, &String::from_utf8_lossy(input));
}

/// Reads a `.xml` text.
pub fn xml(input: &[u8]) {
    read(Format::Xml, &String::from_utf8_lossy(input));
}

/// Reads a text and checks what comes out.
pub(super) fn read(format: Format, text: &str) -> (Tree, Lowered) {
    let tree = parse(format, text);
    let mut end = 0;
    for leaf in tree.leaves() {
        assert!(end <= leaf.start(), "leaves stand in order");
        end = leaf.end();
        assert!(is_of(text, leaf) && !leaf.is_empty());
    }
    let lowered = lower(text, &tree, &Meshes::default());
    check(text, &tree, &lowered);
    (tree, lowered)
}

/// Checks what a text means.
pub(super) fn check(text: &str, tree: &Tree, lowered: &Lowered) {
    let found = &lowered.diagnostics;
    assert_eq!(lowered.scene.is_none(), 0 < found.errors());
    for diagnostic in found.iter() {
        assert!(is_of(text, diagnostic.span), "{diagnostic:?}");
        let Position { line, column } = Position::of(text, diagnostic.span.start());
        assert!(0 < line && 0 < column && !diagnostic.message.is_empty());
    }
    assert!(found.is_sorted_by_key(|diagnostic| diagnostic.span.start()));
    let origins = &lowered.origins;
    // The list of a long text is as its beginning is.
    for node in origins.nodes().iter().take(64) {
        assert!(!origins.name(node).is_empty() && is_of(text, origins.span(tree, node)));
        origins.comment(text, tree, node);
        for placed in origins.fields(tree, node) {
            assert!(placed.spans.iter().all(|&span| is_of(text, span)));
        }
    }
    for file in origins.files(text, tree) {
        assert!(is_of(text, file.span));
    }
}

/// Whether a span is in a text, from one character to another.
fn is_of(text: &str, span: Span) -> bool {
    text.get(span.range()).is_some()
}
