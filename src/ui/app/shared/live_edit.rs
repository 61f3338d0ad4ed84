//! The state of changes of the text that are tried out.

use std::collections::BTreeSet;
use std::sync::Arc;

use language::{Before, Node};
use scene::Scene;
use text::{Edit, Findings};

/// A change of the text that is being tried out: each attempt replaces the one before, so that the
/// whole is one undo step.
#[derive(Clone, Debug)]
pub(crate) struct LiveEdit {
    /// The text's revision after the last attempt; at another one, it can no longer be replaced.
    pub(crate) revision: u64,
    /// Whether the last attempt changed the text.
    pub(crate) is_applied: bool,
    /// The marked nodes, whose marks go if an attempt adds a node.
    pub(crate) marks: BTreeSet<Node>,
    /// What the text before the live edit means, if it has no errors.
    pub(crate) base: Option<Meaning>,
    /// What takes the last attempt back after a merge.
    pub(crate) back: Option<TakenBack>,
}

/// A live edit that only shows something, such as a frame of a track, and is reverted before anything
/// else reads or changes the text.
#[derive(Clone, Debug)]
pub(crate) struct TransientEdit {
    pub(crate) live_edit: LiveEdit,
    /// Whether there were unsaved edits before.
    pub(crate) was_dirty: bool,
}

/// What a text without errors means.
#[derive(Clone, Debug)]
pub(crate) struct Meaning {
    pub(crate) scene: Arc<Scene>,
    pub(crate) findings: Findings,
}

impl Meaning {
    /// The meaning of the text before an edit.
    pub(crate) fn before(&self) -> Before<'_> {
        Before {
            scene: &self.scene,
            diagnostics: &self.findings,
        }
    }
}

/// Edits that take an attempt back in a text that was merged meanwhile.
#[derive(Clone, Debug)]
pub(crate) struct TakenBack {
    /// The revision of the merged text.
    pub(crate) revision: u64,
    pub(crate) edits: Vec<Edit>,
}
