//! How much memory a `.dat` text takes: its tree, and its scene.

use super::tree::{Record, Tree};
use crate::geometry::{Affine, Shape};
use crate::language::room::{Counts, each};
use crate::memory::{self, Need, OutOfMemory};
use crate::scene::Material;
use crate::text::{Span, counted};

/// What a thing takes: itself, its place and its name, in several lists.
const RECORD: usize = 2 * size_of::<Shape>() + 2 * size_of::<Affine>() + size_of::<Material>();

/// About how many bytes a tree of so many leaves takes while it is made.
pub(in crate::language) fn tree_bytes(counts: &Counts) -> u64 {
    each(counts.tokens, 2 * size_of::<Span>())
        + each(counts.lines, 2 * size_of::<Record>())
        + each(counts.comments, 2 * size_of::<Span>())
}

/// Refuses a tree whose scene does not fit into memory.
pub(super) fn fits(tree: &Tree) -> Result<(), OutOfMemory> {
    let count = tree.records.len();
    let bytes = each(count as u64, RECORD);
    memory::check(bytes, || Need {
        what: counted(count, "record"),
        bytes,
    })
}
