//! What the preview shows alone.

use std::collections::BTreeSet;

use language::Nodes;

/// What the preview shows alone. Without lights, or without objects, it shows all of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Solo {
    pub(crate) lights: BTreeSet<usize>,
    /// Objects of the text; groups stand for what is in them.
    pub(crate) objects: BTreeSet<usize>,
    /// The nodes of the text that these indices belong to.
    pub(crate) nodes: Nodes,
}
