//! The sole owner of a scene's text, its tree, its undo history and the text last saved.
//!
//! A document knows no files and no scenes: it is handed texts and edits.

mod history;
mod hunks;
mod merge;
mod snapshot;
#[cfg(test)]
mod tests;
mod windows;

pub use merge::{Conflict, Merge, Side};
pub use snapshot::{Merged, Snapshot};
pub use windows::differences;

use std::sync::Arc;

use crate::language::{Before, Language, Lowered, Source};
use crate::memory::OutOfMemory;
use crate::scene::Meshes;
use crate::text::{Edit, Span, cover};
use history::History;

/// A scene's text under edit.
#[derive(Clone, Debug)]
pub struct Document {
    source: Source,
    saved: Arc<String>,
    /// Whether the two differ: asked with every key, and in a text of 85 MB an answer of 10 ms.
    is_dirty: bool,
    /// How often the text has changed.
    revision: u64,
    history: History,
}

/// What became of a merge whose conflicts were decided.
#[derive(Debug)]
pub enum Adopted {
    /// Its outcome is in the text now, as one undoable step.
    Taken,
    /// The text was edited since, and conflicts are open again; nothing was touched.
    Conflict(Merge),
    /// The text, or the text saved, is another one since; nothing was touched.
    OutOfDate,
}

impl Document {
    /// A document whose saved text is `text`.
    pub fn new(language: Language, text: String) -> Self {
        Self {
            saved: Arc::new(text.clone()),
            source: Source::new(language, Arc::new(text)),
            is_dirty: false,
            revision: 0,
            history: History::default(),
        }
    }

    /// Its language.
    pub fn language(&self) -> Language {
        self.source.language()
    }

    /// The text with its tree, and where its things stand as of the last lowering.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Finds the meaning of the text: [`Answers::lower`](crate::language::Answers::lower).
    pub fn lower(&mut self, meshes: &Meshes) -> Result<Lowered, OutOfMemory> {
        self.source.lower(meshes)
    }

    /// Finds it after an edit: [`Answers::lower_again`](crate::language::Answers::lower_again).
    pub fn lower_again(
        &mut self,
        meshes: &Meshes,
        before: Before<'_>,
        spans: [Span; 2],
    ) -> Result<Lowered, OutOfMemory> {
        self.source.lower_again(meshes, before, spans)
    }

    /// The text.
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// The text, for others to hold while this one is edited on.
    pub fn shared_text(&self) -> Arc<String> {
        Arc::clone(self.source.text())
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
    /// [`Document::end_step`] or another operation; a run that ends where it began is not a step.
    /// The same literal again changes nothing.
    pub fn set(&mut self, span: Span, literal: &str) {
        if span.of(self.text()) == literal {
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
            .filter(|edit| edit.span.of(self.source.text()) != edit.text)
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
    /// can be redone again, and things stand where they stood. Does nothing if undo, redo or a text from outside came after the call.
    pub fn reject(&mut self) {
        if let Some(inverse) = self.history.take_back() {
            self.change(&inverse);
            self.source.restore();
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

    /// Notes that `text` was written to the file; it need not be the present text, which may have
    /// been edited while it was written.
    pub fn mark_saved(&mut self, text: Arc<String>) {
        self.history.close();
        self.set_saved(text);
    }

    /// What a text from outside is merged with, elsewhere; copies nothing.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            language: self.language(),
            saved: Arc::clone(&self.saved),
            edited: self.is_dirty.then(|| self.shared_text()),
        }
    }

    /// Becomes a text from outside where there are no unsaved edits; what it was before. That is not an
    /// edit of this document's, and the history starts anew: undo must not lead back to what another
    /// program has replaced.
    #[must_use = "to free it may take long"]
    pub fn load(&mut self, mut document: Self) -> Self {
        document.revision = self.revision + 1;
        std::mem::replace(self, document)
    }

    /// Becomes what a merge with a text from outside has led to, as one undoable step if that
    /// changes the text; what it was before. The merge is one of this document as it is now.
    #[must_use = "to free it may take long"]
    pub fn take(&mut self, merged: Merged) -> Self {
        let Merged { mut document, back } = merged;
        document.history = std::mem::take(&mut self.history);
        if !back.is_empty() {
            document.history.record(back);
        }
        document.history.settle();
        self.load(document)
    }

    /// Takes the outcome of a merge whose conflicts were decided, as one undoable step.
    ///
    /// If the text was edited since, it is merged anew under the decisions that still apply.
    pub fn adopt(&mut self, mut merge: Merge) -> Adopted {
        if merge.base != self.saved {
            return Adopted::OutOfDate;
        }
        if merge.mine != *self.source.text() {
            merge = merge.onto(self.language(), self.source.text());
            if merge.conflicts.iter().any(|c| c.decision.is_none()) {
                return Adopted::Conflict(merge);
            }
        }
        self.edit(&merge.edits());
        self.history.settle();
        self.set_saved(merge.theirs);
        Adopted::Taken
    }

    /// Takes the outcome of a merge of this text with edits from elsewhere, as one undoable step; the
    /// text saved stays the same. Unlike for [`Document::adopt`], the text from outside is the edited
    /// one.
    pub fn restore(&mut self, merge: &Merge) -> Adopted {
        if merge.mine != *self.source.text() {
            return Adopted::OutOfDate;
        }
        self.edit(&merge.edits());
        self.history.settle();
        Adopted::Taken
    }

    fn set_saved(&mut self, text: Arc<String>) {
        self.is_dirty = *self.source.text() != text;
        self.saved = text;
    }

    /// Changes text and tree; the edits that lead back.
    fn change(&mut self, edits: &[Edit]) -> Vec<Edit> {
        let inverse = self.source.change(edits);
        self.is_dirty = *self.source.text() != self.saved;
        self.revision += 1;
        inverse
    }
}
