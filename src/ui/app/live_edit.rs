//! The state of changes of the text that are tried out.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::language::{Before, Node};
use crate::scene::Scene;
use crate::text::{Edit, Findings};

/// A change of the text that is being tried out: each attempt replaces the one before, so that the
/// whole is one undo step.
#[derive(Clone, Debug)]
pub(super) struct LiveEdit {
    /// The text's revision after the last attempt; at another one, it can no longer be replaced.
    pub(super) revision: u64,
    /// Whether the last attempt changed the text.
    pub(super) is_applied: bool,
    /// The marked nodes, whose marks go if an attempt adds a node.
    pub(super) marks: BTreeSet<Node>,
    /// What the text before the live edit means, if it has no errors.
    pub(super) base: Option<Meaning>,
    /// What takes the last attempt back after a merge.
    pub(super) back: Option<TakenBack>,
}

/// A live edit that only shows something, such as a frame of a track, and is reverted before anything
/// else reads or changes the text.
#[derive(Clone, Debug)]
pub(super) struct TransientEdit {
    pub(super) live_edit: LiveEdit,
    /// Whether there were unsaved edits before.
    pub(super) was_dirty: bool,
}

/// What a text without errors means.
#[derive(Clone, Debug)]
pub(super) struct Meaning {
    pub(super) scene: Arc<Scene>,
    pub(super) findings: Findings,
}

impl Meaning {
    /// The meaning of the text before an edit.
    pub(super) fn before(&self) -> Before<'_> {
        Before {
            scene: &self.scene,
            diagnostics: &self.findings,
        }
    }
}

/// Edits that take an attempt back in a text that was merged meanwhile.
#[derive(Clone, Debug)]
pub(super) struct TakenBack {
    /// The revision of the merged text.
    pub(super) revision: u64,
    pub(super) edits: Vec<Edit>,
}
