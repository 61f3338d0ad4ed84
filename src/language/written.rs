//! What every language keeps of a text.

use std::sync::Arc;

use crate::text::{self, Edit, Span, cover};

/// A text, its tree, and where its things stand.
#[derive(Clone, Debug)]
pub struct Written<Tree, Origins> {
    /// Where others hold it, it is copied before it changes.
    pub(super) text: Arc<String>,
    pub(super) tree: Tree,
    /// As of the last lowering.
    pub(super) origins: Origins,
    /// What the last lowering has replaced; `None` once the text has changed.
    former: Option<Origins>,
}

impl<Tree, Origins: Default> Written<Tree, Origins> {
    /// A text that is not lowered yet.
    pub(super) fn new(text: Arc<String>, tree: Tree) -> Self {
        Self {
            text,
            tree,
            origins: Origins::default(),
            former: None,
        }
    }

    /// Applies edits, sorted and disjoint; returns those that lead back. `follow` is given the tree to
    /// become that of the new text, in which the first span is replaced by the second.
    pub(super) fn apply(
        &mut self,
        edits: &[Edit],
        follow: impl FnOnce(&mut Tree, &str, [Span; 2]),
    ) -> Vec<Edit> {
        let inverse = text::apply(Arc::make_mut(&mut self.text), edits);
        let old = cover(edits).unwrap_or_default();
        let changed = cover(&inverse).unwrap_or_default();
        follow(&mut self.tree, &self.text, [old, changed]);
        self.former = None;
        inverse
    }

    /// Takes the places that a lowering has found.
    pub(super) fn place(&mut self, origins: Origins) {
        let before = std::mem::replace(&mut self.origins, origins);
        // Of several lowerings of one text the first has replaced those of the text before.
        self.former.get_or_insert(before);
    }

    /// Takes back the places of the lowerings since the text last changed.
    pub(super) fn take_back(&mut self) {
        if let Some(former) = self.former.take() {
            self.origins = former;
        }
    }
}
