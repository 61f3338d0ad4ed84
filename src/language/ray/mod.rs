//! Rice University's `.ray`: a stream of tokens for ambient light, lights and objects, and a comment
//! for the view.

mod add;
mod blocks;
mod incremental;
mod lower;
mod memory_estimate;
mod objects;
mod origins;
mod reader;
mod roles;
mod scene_text;
mod structure;
// One slot per row.
#[rustfmt::skip]
mod schema;
#[cfg(test)]
mod tests;
mod tree;
mod view;
mod view_comment;
mod write;

use super::written::Written;
use glam::DVec3;
use origins::Origins;
use text::Findings;
use tree::Tokens;

pub(super) use memory_estimate::tree_bytes;
pub(super) use write::write;

/// A `.ray` text.
pub(super) type Source = Written<Tokens, Origins>;

/// Whether no leaf crosses a line end.
pub(super) const LEAVES_KEEP_TO_LINES: bool = true;

/// Whether changed objects can be lowered alone.
pub(super) const LOWERS_CHANGES: bool = true;

/// The axis that points up in most of its scenes.
pub(super) const VERTICAL: DVec3 = DVec3::Y;

/// A small valid scene to begin with.
pub(super) const TEMPLATE: &str = include_str!("template.ray");

/// A minimal valid scene to put a first thing into.
pub(super) const SKELETON: &str = include_str!("skeleton.ray");

/// Returns the errors of every text with this beginning.
pub(super) fn errors_of_beginning(beginning: &str) -> Findings {
    lower::errors_of_beginning(beginning, &tree::parse(beginning))
}
