//! The state that every language keeps of a text.

use std::fmt::Debug;
use std::mem;
use std::sync::Arc;

use super::{Editable, Lowered};
use crate::memory::OutOfMemory;
use crate::text::{self, Edit, Span, cover};

/// A text, its tree, and the places of its nodes.
#[derive(Clone, Debug)]
pub struct Written<Tree, Origins> {
    /// Copied on write if shared.
    pub(super) text: Arc<String>,
    pub(super) tree: Tree,
    /// The places found by the last lowering.
    pub(super) origins: Origins,
    /// The places replaced by the last lowering; `None` once the text has changed.
    former: Option<Origins>,
    /// Whether text that may have begun a comment was removed since the last lowering.
    pub(super) has_lost_slash: bool,
}

impl<Tree, Origins: Default> Written<Tree, Origins> {
    /// Parses a text.
    pub(super) fn new(text: Arc<String>) -> Self
    where
        Tree: Parse,
    {
        Self {
            tree: Tree::parse(&text),
            text,
            origins: Origins::default(),
            former: None,
            has_lost_slash: false,
        }
    }

    /// Stores the places found by a lowering, or none if it was refused.
    pub(super) fn store(
        &mut self,
        found: Result<(Origins, Lowered), OutOfMemory>,
    ) -> Result<Lowered, OutOfMemory> {
        let (origins, lowered) = match found {
            Ok((origins, lowered)) => (origins, Ok(lowered)),
            Err(refused) => (Origins::default(), Err(refused)),
        };
        self.place(origins);
        lowered
    }

    /// Stores the places found by a lowering.
    pub(super) fn place(&mut self, origins: Origins) {
        let before = mem::replace(&mut self.origins, origins);
        // Of several lowerings of one text, the first replaced the places of the text before.
        self.former.get_or_insert(before);
        self.has_lost_slash = false;
    }
}

/// A tree that a text is parsed into.
pub(super) trait Parse: Sized {
    /// Parses a text. Never fails: every part of it has a place in the tree.
    fn parse(text: &str) -> Self;

    /// Updates the tree after an edit that replaced the first span by the second; `text` is the new
    /// text.
    fn follow(&mut self, text: &str, edit: [Span; 2]) {
        let _ = edit;
        *self = Self::parse(text);
    }
}

impl<Tree: Debug + Parse, Origins: Debug + Default> Editable for Written<Tree, Origins> {
    fn text(&self) -> &Arc<String> {
        &self.text
    }

    fn change(&mut self, edits: &[Edit]) -> Vec<Edit> {
        let mut removed = edits.iter().map(|edit| edit.span.of(&self.text));
        self.has_lost_slash |= removed.any(|removed| removed.contains('/'));
        let inverse = text::apply(Arc::make_mut(&mut self.text), edits);
        let old = cover(edits).unwrap_or_default();
        let changed = cover(&inverse).unwrap_or_default();
        self.tree.follow(&self.text, [old, changed]);
        self.former = None;
        inverse
    }

    fn substitute(&mut self, text: Arc<String>, edit: &Edit) -> Arc<String> {
        let before = mem::replace(&mut self.text, text);
        self.has_lost_slash |= edit.span.of(&before).contains('/');
        self.tree.follow(&self.text, [edit.span, edit.placed()]);
        self.former = None;
        before
    }

    fn revert(&mut self, inverse: &[Edit]) {
        let former = self.former.take();
        self.change(inverse);
        if let Some(former) = former {
            self.origins = former;
            self.has_lost_slash = false;
        }
    }
}
