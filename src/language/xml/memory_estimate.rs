//! Estimates of the memory that an `.xml` text takes: for its tree and its scene.

use super::tree::{Attribute, Element, Tree};
use crate::memory_estimate::{Counts, each, scene_fits};
use geometry::Affine;
use memory::OutOfMemory;
use scene::{Material, Object};
use text::Span;

/// The parser's bytes per node, in growing lists.
const NODE: usize = 2 * 80;

/// The parser's bytes per attribute.
const ATTRIBUTE: usize = 64;

/// Estimate of the bytes of an element: an object with its place, or part of a material or light.
const ELEMENT: usize = 2 * size_of::<Object>() + size_of::<Affine>() + size_of::<Material>() / 2;

/// Estimates the bytes needed to build a tree with these counts.
pub(crate) fn tree_bytes(counts: &Counts) -> u64 {
    each(counts.openings, NODE + 2 * size_of::<Element>())
        + each(counts.equals, ATTRIBUTE + 2 * size_of::<Attribute>())
        + each(counts.tokens, 2 * size_of::<Span>())
}

/// Fails if the tree's scene does not fit into memory.
pub(super) fn fits(tree: &Tree) -> Result<(), OutOfMemory> {
    scene_fits(tree.elements.len(), "element", ELEMENT)
}
