//! The state that every language keeps of a text.

use std::fmt::Debug;
use std::mem;
use std::sync::Arc;

use super::{Editable, Lowered};
use memory::OutOfMemory;
use text::{Edit, Span, are_plain_numbers};

/// A text, its tree, and the places of its nodes.
#[derive(Clone, Debug)]
pub(crate) struct Written<Tree, Origins> {
    /// Copied on write if shared.
    pub(super) text: Arc<String>,
    pub(super) tree: Tree,
    /// The places found by the last lowering.
    pub(super) origins: Origins,
    /// The places replaced by the last lowering, and whether only the last change was made since they
    /// were found; `None` once the text has changed.
    former: Option<(Origins, bool)>,
    /// How the text has changed since the last lowering.
    pub(super) since: Since,
}

/// How a text has changed since its last lowering.
#[derive(Clone, Debug, Default)]
pub(super) enum Since {
    /// The places are those of the text.
    Unchanged,
    /// By edits made together, in text order.
    Edited(Vec<Replaced>),
    /// By several changes, or it was never lowered.
    #[default]
    Unknown,
}

/// A part of a text that an edit replaced.
#[derive(Clone, Copy, Debug)]
pub(super) struct Replaced {
    /// In the text before all edits.
    pub(super) old: Span,
    /// In the text after all edits.
    pub(super) new: Span,
    /// How many numbers the old part consisted of, from the first byte to the last; 0 if it held
    /// anything else.
    pub(super) numbers: usize,
}

impl Replaced {
    fn new(old: Span, new: Span, removed: &str) -> Self {
        Self {
            old,
            new,
            numbers: numbers(removed),
        }
    }
}

/// How many numbers a text consists of, from the first byte to the last; 0 if it holds anything else.
pub(super) fn numbers(text: &str) -> usize {
    if text.trim().len() < text.len() || !are_plain_numbers(text) {
        return 0;
    }
    text.split_ascii_whitespace().count()
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
            since: Since::Unknown,
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
        if lowered.is_err() {
            self.since = Since::Unknown;
        }
        lowered
    }

    /// Stores the places found by a lowering.
    pub(super) fn place(&mut self, origins: Origins) {
        let before = mem::replace(&mut self.origins, origins);
        // Of several lowerings of one text, the first replaced the places of the text before.
        let is_last = matches!(self.since, Since::Edited(_));
        self.former.get_or_insert((before, is_last));
        self.since = Since::Unchanged;
    }

    /// Updates what depends on the text after edits.
    fn follow(&mut self, edits: Vec<Replaced>)
    where
        Tree: Parse,
    {
        self.former = None;
        if edits.is_empty() {
            return;
        }
        self.tree.follow(&self.text, &edits);
        self.since = match self.since {
            Since::Unchanged => Since::Edited(edits),
            Since::Edited(_) | Since::Unknown => Since::Unknown,
        };
    }
}

/// A tree that a text is parsed into.
pub(super) trait Parse: Sized {
    /// Parses a text. Never fails: every part of it has a place in the tree.
    fn parse(text: &str) -> Self;

    /// Updates the tree after edits, at least one; `text` is the new text.
    fn follow(&mut self, text: &str, edits: &[Replaced]) {
        let _ = edits;
        *self = Self::parse(text);
    }
}

impl<Tree: Debug + Parse, Origins: Debug + Default> Editable for Written<Tree, Origins> {
    fn text(&self) -> &Arc<String> {
        &self.text
    }

    fn change(&mut self, edits: &[Edit]) -> Vec<Edit> {
        let inverse = text::apply(Arc::make_mut(&mut self.text), edits);
        let pairs = edits.iter().zip(&inverse);
        let replaced = pairs.map(|(edit, back)| Replaced::new(edit.span, back.span, &back.text));
        self.follow(replaced.collect());
        inverse
    }

    fn substitute(&mut self, text: Arc<String>, edit: &Edit) -> Arc<String> {
        let before = mem::replace(&mut self.text, text);
        let removed = edit.span.of(&before);
        self.follow(vec![Replaced::new(edit.span, edit.placed(), removed)]);
        before
    }

    fn revert(&mut self, inverse: &[Edit]) {
        if inverse.is_empty() {
            return;
        }
        let former = self.former.take();
        let mut is_last = matches!(self.since, Since::Edited(_));
        self.change(inverse);
        if let Some((places, of_last)) = former {
            (self.origins, is_last) = (places, of_last);
        }
        self.since = if is_last {
            Since::Unchanged
        } else {
            Since::Unknown
        };
    }
}
