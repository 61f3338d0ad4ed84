//! Where to insert missing elements and attributes in an `.xml` text.

use crate::field_spans::{Insertion, Piece};
use crate::xml::tree::Tree;
use text::Span;

/// Where to insert another attribute of an element.
pub(super) fn attribute(tree: &Tree, element: usize) -> Insertion {
    Insertion::at(tree.elements[element].attributes_end as usize)
}

/// Where to insert another child: after the last one with its indentation, or as the first one.
pub(super) fn child(tree: &Tree, parent: usize) -> Insertion {
    match tree.children(parent).last() {
        Some(last) => after(tree, last),
        None => first(tree, parent),
    }
}

/// Where to insert another element after one, with its indentation.
pub(in crate::xml) fn after(tree: &Tree, element: usize) -> Insertion {
    let own = &tree.elements[element];
    let before = vec![Piece::Copy(own.lead)];
    Insertion {
        between: before.clone(),
        before,
        ..Insertion::at(own.whole.end())
    }
}

/// Where to insert the first child, indented by two blanks more than its parent.
pub(in crate::xml) fn first(tree: &Tree, parent: usize) -> Insertion {
    let own = &tree.elements[parent];
    let mut between = vec![Piece::Copy(own.lead)];
    if !own.lead.is_empty() {
        between.push(Piece::Literal("  "));
    }
    if own.is_empty_tag() {
        let mut before = vec![Piece::Literal(">")];
        before.extend(&between);
        return Insertion {
            span: Span::new(own.attributes_end as usize, own.tag.end()),
            before,
            between,
            after: vec![
                Piece::Copy(own.lead),
                Piece::Literal("</"),
                Piece::Copy(own.name),
                Piece::Literal(">"),
            ],
        };
    }
    let is_empty = own.close as usize == own.tag.end();
    let after = is_empty.then_some(Piece::Copy(own.lead));
    Insertion {
        before: between.clone(),
        between,
        after: after.into_iter().collect(),
        ..Insertion::at(own.tag.end())
    }
}

/// Where to insert an element into the camera, which is missing itself.
pub(super) fn in_camera(tree: &Tree, root: usize) -> Insertion {
    let outer = child(tree, root);
    let lead = outer.between.clone();
    let is_indented = tree.elements[root].depth > 0
        || lead
            .iter()
            .any(|piece| matches!(piece, Piece::Copy(span) if !span.is_empty()));
    let mut between = lead.clone();
    if is_indented {
        between.push(Piece::Literal("  "));
    }
    let mut before = outer.before;
    before.push(Piece::Literal("<camera>"));
    before.extend(&between);
    let mut after = lead;
    after.push(Piece::Literal("</camera>"));
    after.extend(outer.after);
    Insertion {
        span: outer.span,
        before,
        between,
        after,
    }
}
