//! The sole owner of a scene's text, its tree, its undo history and the text last saved.
//!
//! A document knows no files and no scenes: it is handed texts and edits.

mod history;
mod hunks;
mod merge;
#[cfg(test)]
mod tests;

pub use merge::{Conflict, Merge, Side};

use std::sync::Arc;

use crate::format::{self, Format, Tree};
use crate::text::{self, Edit, Span};
use history::History;

/// A scene's text under edit.
#[derive(Clone, Debug)]
pub struct Document {
    format: Format,
    text: String,
    tree: Tree,
    saved: Arc<String>,
    /// Whether the two differ: asked with every key, and in a text of 85 MB an answer of 10 ms.
    is_dirty: bool,
    /// How often the text has changed.
    revision: u64,
    history: History,
}

/// What became of a text from outside.
#[derive(Debug)]
pub enum Replaced {
    /// It brings nothing: it says what was last saved or loaded, or what the text says already, or
    /// a newer text from outside was taken since.
    Unchanged,
    /// There were no unsaved edits: it is the text now, and there is nothing to undo or redo.
    Loaded,
    /// Its changes and the unsaved ones touch different places: both are in the text now, as one
    /// undoable step.
    Merged,
    /// Both changed the same places; nothing was touched. [`Document::adopt`] takes the outcome.
    Conflict(Merge),
}

impl Document {
    /// A document whose saved text is `text`.
    pub fn new(format: Format, text: String) -> Self {
        let tree = format::parse(format, &text);
        Self {
            format,
            saved: Arc::new(text.clone()),
            text,
            tree,
            is_dirty: false,
            revision: 0,
            history: History::default(),
        }
    }

    /// Its language.
    pub fn format(&self) -> Format {
        self.format
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text alone.
    pub fn into_text(self) -> String {
        self.text
    }

    /// The tree of the text.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The text last saved or loaded: the ancestor of the next merge.
    pub fn saved(&self) -> &Arc<String> {
        &self.saved
    }

    /// Whether the text differs from the saved one.
    pub fn is_dirty(&self) -> bool {
        self.is_dirty
    }

    /// What stands for the text: another number for any other text.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Replaces the text of one leaf of the tree as an undoable step. Consecutive calls on the same
    /// leaf (the span follows the literal's length) merge into one step until
    /// [`Document::end_step`] or another operation; a run that ends where it began is no step.
    /// The same literal again changes nothing.
    pub fn set(&mut self, span: Span, literal: &str) {
        if span.of(&self.text) == literal {
            self.history.record_nothing();
            return;
        }
        let edit = Edit {
            span,
            text: literal.to_owned(),
        };
        for inverse in self.change(&[edit]) {
            self.history.record_literal(inverse, literal);
        }
    }

    /// Applies edits, sorted and disjoint, as one undoable step; none if they change nothing.
    pub fn edit(&mut self, edits: &[Edit]) {
        let edits: Vec<_> = edits
            .iter()
            .filter(|edit| edit.span.of(&self.text) != edit.text)
            .cloned()
            .collect();
        if edits.is_empty() {
            self.history.record_nothing();
        } else {
            let inverse = self.change(&edits);
            self.history.record(inverse);
        }
    }

    /// Ends the run of merged [`Document::set`] calls: the next one is a step of its own.
    pub fn end_step(&mut self) {
        self.history.close();
    }

    /// Takes back the last `set` or `edit` call (one call, even inside a merged step) as if it had
    /// never been made: for a value that turns out to be refused. What it made impossible to redo
    /// can be redone again. Does nothing if undo, redo or a text from outside came after the call.
    pub fn reject(&mut self) {
        if let Some(inverse) = self.history.take_back() {
            self.change(&inverse);
        }
    }

    /// Undoes one step; the span of what changed in the text as it is afterwards, or `None` if
    /// there is nothing to undo.
    pub fn undo(&mut self) -> Option<Span> {
        let step = self.history.next_undo()?;
        let inverse = self.change(&step);
        let changed = cover(&inverse);
        self.history.undone(inverse);
        changed
    }

    /// Redoes one undone step, as [`Document::undo`].
    pub fn redo(&mut self) -> Option<Span> {
        let step = self.history.next_redo()?;
        let inverse = self.change(&step);
        let changed = cover(&inverse);
        self.history.redone(inverse);
        changed
    }

    /// How many places of another text differ from this one: numbers and words, or runs of them.
    pub fn differences(&self, other: &str) -> usize {
        let chunks = |text| hunks::Chunks::of(self.format, text);
        hunks::hunks(&chunks(&self.text), &chunks(other)).len()
    }

    /// Notes that `text` was written to the file; it need not be the present text, which may have
    /// been edited while it was written.
    pub fn mark_saved(&mut self, text: String) {
        self.history.close();
        self.set_saved(text);
    }

    /// Takes a text that the file holds now. What it brings is a step where it is merged with
    /// unsaved edits. Without those it is no edit of this document's, and the history starts anew:
    /// undo must not lead back to what another program has replaced.
    ///
    /// Whatever comes back, a merge still being decided is out of date: drop it.
    pub fn replace(&mut self, theirs: String) -> Replaced {
        if theirs == *self.saved {
            return Replaced::Unchanged;
        }
        if theirs == self.text {
            self.set_saved(theirs);
            return Replaced::Unchanged;
        }
        if !self.is_dirty() {
            drop(self.load(Self::new(self.format, theirs)));
            return Replaced::Loaded;
        }
        let merge = Merge::new(self.format, &self.saved, &self.text, theirs);
        if merge.conflicts.is_empty() {
            self.take(&merge.edits(), merge.theirs);
            Replaced::Merged
        } else {
            // The saved text stays: it is still the ancestor of both when the next text comes.
            Replaced::Conflict(merge)
        }
    }

    /// As [`Document::replace`] where there are no unsaved edits, for a text that was read elsewhere;
    /// what this one was before.
    #[must_use = "to free it may take long"]
    pub fn load(&mut self, mut document: Self) -> Self {
        document.revision = self.revision + 1;
        std::mem::replace(self, document)
    }

    /// Takes the outcome of a merge whose conflicts were decided, as one undoable step.
    ///
    /// If the text was edited since, it is merged anew under the decisions that still apply, and
    /// [`Replaced::Conflict`] hands back what they leave open. If the saved text is another one
    /// since, the merge is out of date and nothing is touched.
    pub fn adopt(&mut self, mut merge: Merge) -> Replaced {
        if merge.base != *self.saved {
            return Replaced::Unchanged;
        }
        if merge.mine != self.text {
            merge = merge.onto(self.format, &self.text);
            if merge.conflicts.iter().any(|c| c.decision.is_none()) {
                return Replaced::Conflict(merge);
            }
        }
        self.take(&merge.edits(), merge.theirs);
        Replaced::Merged
    }

    /// Applies what a text from outside brought; `theirs` is what the file holds.
    fn take(&mut self, edits: &[Edit], theirs: String) {
        self.edit(edits);
        self.history.settle();
        self.set_saved(theirs);
    }

    fn set_saved(&mut self, text: String) {
        self.is_dirty = self.text != text;
        self.saved = Arc::new(text);
    }

    /// Changes text and tree; the edits that lead back.
    fn change(&mut self, edits: &[Edit]) -> Vec<Edit> {
        let inverse = text::apply(&mut self.text, edits);
        let old = cover(edits).unwrap_or_default();
        let changed = cover(&inverse).unwrap_or_default();
        self.tree.follow(&self.text, old, changed);
        self.is_dirty = self.text != *self.saved;
        self.revision += 1;
        inverse
    }
}

/// The smallest span that covers all of the edits' spans.
fn cover(edits: &[Edit]) -> Option<Span> {
    edits.iter().map(|edit| edit.span).reduce(Span::to)
}
