//! How much memory a `.xml` text takes: its tree, and its scene.

use super::tree::{Attribute, Element, Tree};
use crate::geometry::Affine;
use crate::language::room::{Counts, each};
use crate::memory::{self, Need, OutOfMemory};
use crate::scene::{Object, Utah};
use crate::text::{Span, counted};

/// What the parser keeps of a node, in lists that grow.
const NODE: usize = 2 * 80;

/// What it keeps of an attribute.
const ATTRIBUTE: usize = 64;

/// What an element takes: an object with where it is, or a part of a material or of a light.
const ELEMENT: usize = 2 * size_of::<Object>() + size_of::<Affine>() + size_of::<Utah>() / 2;

/// About how many bytes a tree of so many leaves takes while it is made.
pub(in crate::language) fn tree_bytes(counts: &Counts) -> u64 {
    each(counts.openings, NODE + 2 * size_of::<Element>())
        + each(counts.equals, ATTRIBUTE + 2 * size_of::<Attribute>())
        + each(counts.tokens, 2 * size_of::<Span>())
}

/// Refuses a tree whose scene does not fit into memory.
pub(super) fn fits(tree: &Tree) -> Result<(), OutOfMemory> {
    let count = tree.elements.len();
    let bytes = each(count as u64, ELEMENT);
    memory::check(bytes, || Need {
        what: counted(count, "element"),
        bytes,
    })
}
