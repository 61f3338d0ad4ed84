//! The University of Utah's `.xml`: elements with attributes, and nested objects.

mod add;
mod around_mesh;
mod copies;
mod lower;
mod memory_estimate;
mod motion;
mod origins;
mod parameter;
mod roles;
mod scene_text;
// One parameter per row.
#[rustfmt::skip]
mod schema;
mod structure;
#[cfg(test)]
mod tests;
mod tree;
mod view;
mod write;

use super::written::Written;
use glam::DVec3;
use origins::Origins;
use text::Findings;
use tree::Tree;

pub use around_mesh::{ShownMesh, Up, around_mesh};
pub use lower::{Tag, tag_at};
pub(super) use memory_estimate::tree_bytes;
pub(super) use write::write;

/// An `.xml` text.
pub(super) type Source = Written<Tree, Origins>;

/// Whether no leaf crosses a line end.
pub(super) const LEAVES_KEEP_TO_LINES: bool = false;

/// Whether changed objects can be lowered alone.
pub(super) const LOWERS_CHANGES: bool = false;

/// The axis that points up in most of its scenes.
pub(super) const VERTICAL: DVec3 = DVec3::Z;

/// A small valid scene to begin with.
pub(super) const TEMPLATE: &str = include_str!("template.xml");

/// A minimal valid scene to put a first thing into.
pub(super) const SKELETON: &str = include_str!("skeleton.xml");

/// Returns the errors of every text with this beginning.
pub(super) fn errors_of_beginning(beginning: &str) -> Findings {
    let mut findings = Findings::default();
    if let Some(fault) = tree::fault_of_beginning(beginning) {
        findings.error(|| fault);
    }
    findings
}
