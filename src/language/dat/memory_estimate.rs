//! Estimates of the memory that a `.dat` text takes: for its tree and its scene.

use super::tree::Tree;
use crate::memory_estimate::{Counts, each, scene_fits};
use geometry::{Affine, Shape};
use memory::OutOfMemory;
use scene::Material;
use text::Span;

/// Estimate of the bytes of a record: itself, its place and its name, in several lists.
const RECORD: usize = 2 * size_of::<Shape>() + 2 * size_of::<Affine>() + size_of::<Material>();

/// Estimates the bytes needed to build a tree with these counts.
pub(crate) fn tree_bytes(counts: &Counts) -> u64 {
    each(counts.lines + 1, 2 * size_of::<Span>())
}

/// Fails if the tree's scene does not fit into memory.
pub(super) fn fits(tree: &Tree) -> Result<(), OutOfMemory> {
    scene_fits(tree.records.len(), "record", RECORD)
}
