//! Boston University's `.dat`: one record per line, with numeric IDs.

mod add;
mod clashing_ids;
mod copies;
mod form;
mod lower;
mod memory_estimate;
mod origins;
mod roles;
mod scene_text;
mod structure;
mod table;
#[cfg(test)]
mod tests;
mod tree;
mod view;
mod visibility;
mod write;

use super::written::Written;
use origins::Origins;
use text::Findings;
use tree::Tree;

pub(super) use memory_estimate::tree_bytes;
pub(super) use write::write;

/// A `.dat` text.
pub(super) type Source = Written<Tree, Origins>;

/// Whether no leaf crosses a line end.
pub(super) const LEAVES_KEEP_TO_LINES: bool = true;

/// Whether changed objects can be lowered alone.
pub(super) const LOWERS_CHANGES: bool = false;

/// A small valid scene to begin with.
pub(super) const TEMPLATE: &str = include_str!("template.dat");

/// A minimal valid scene to put a first thing into.
pub(super) const SKELETON: &str = include_str!("skeleton.dat");

/// Returns the errors of every text with this beginning.
pub(super) fn errors_of_beginning(beginning: &str) -> Findings {
    lower::errors_of_beginning(beginning, &tree::parse(beginning))
}
