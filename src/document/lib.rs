//! The sole owner of a scene's text and tree, its undo history and the text last saved.
//!
//! A document receives texts and edits. It knows no files, and passes lowered scenes on unread.

mod changes;
mod difference;
mod history;
mod hunks;
mod merge;
mod numbers;
mod pieces;
mod rebase;
mod regions;
mod sides;
mod snapshot;
mod steps;
#[cfg(test)]
mod tests;
mod timeline;
mod windows;

pub use difference::{Difference, edits_between};
pub use merge::Merge;
pub use numbers::Numbers;
pub use pieces::{Conflict, Side};
pub use snapshot::{Merged, Snapshot};
pub use steps::{State, StateId, StepName};
pub use timeline::Timeline;
pub use windows::differences;

use std::sync::Arc;

use history::History;
use language::{Before, Language, Lowered, Source};
use memory::OutOfMemory;
use scene::Meshes;
use text::{Edit, Span, cover};

/// A scene text being edited.
#[derive(Clone, Debug)]
pub struct Document {
    source: Source,
    saved: Arc<String>,
    /// Whether the two differ. Cached: it is asked at every key, and comparing 85 MB takes 10 ms.
    is_dirty: bool,
    /// The number of changes to the text.
    revision: u64,
    history: History,
    /// The longest change of the last undo or redo.
    longest: Span,
}

/// What becomes of the undo history when a text is taken from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Past {
    /// It is cleared: undo must not return to what another program has replaced.
    Cleared,
    /// The steps remain up to the first whose place was changed.
    Rebased,
}

/// The result of adopting a merge whose conflicts were decided.
#[derive(Debug)]
pub enum Adopted {
    /// The merge was applied as one undoable step.
    Taken,
    /// The text was edited meanwhile, which left undecided conflicts; nothing was changed.
    Conflict(Merge),
    /// The text, or the saved text, was replaced meanwhile; nothing was changed.
    OutOfDate,
}

impl Document {
    /// Creates a document whose text and saved text are `text`.
    pub fn new(language: Language, text: String) -> Self {
        Self {
            saved: Arc::new(text.clone()),
            source: Source::new(language, Arc::new(text)),
            is_dirty: false,
            revision: 0,
            history: History::default(),
            longest: Span::default(),
        }
    }

    /// The language of the text.
    pub fn language(&self) -> Language {
        self.source.language()
    }

    /// The text with its tree, and the origins of its scene as of the last lowering.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Lowers the text, see [`SceneText::lower`](language::SceneText::lower).
    pub fn lower(&mut self, meshes: &Meshes) -> Result<Lowered, OutOfMemory> {
        self.source.lower(meshes)
    }

    /// Lowers the text after an edit, see
    /// [`SceneText::lower_again`](language::SceneText::lower_again).
    pub fn lower_again(
        &mut self,
        meshes: &Meshes,
        before: Before<'_>,
    ) -> Result<Lowered, OutOfMemory> {
        self.source.lower_again(meshes, before)
    }

    /// The current text, with unsaved edits.
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// The text, shared; later edits do not affect it.
    pub fn shared_text(&self) -> Arc<String> {
        Arc::clone(self.source.text())
    }

    /// The text last saved or loaded, which is the ancestor of the next merge.
    pub fn saved(&self) -> &Arc<String> {
        &self.saved
    }

    /// Whether there are unsaved changes.
    pub fn is_dirty(&self) -> bool {
        self.is_dirty
    }

    /// The revision number of the text, which changes with every edit.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Replaces the text of one leaf of the tree as an undoable step. Consecutive calls on the same
    /// leaf (the span follows the length of the literal) merge into one step until
    /// [`Document::end_step`] or another operation; a run that returns to its initial text is not a
    /// step. Repeating the same literal changes nothing.
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

    /// Applies sorted, disjoint edits as one undoable step, or as none if they change nothing.
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

    /// The text that a span had before the run of [`Document::set`] calls that wrote it, if that can go on.
    pub fn at_first(&self, span: Span) -> Option<&str> {
        self.history.at_first(span)
    }

    /// Ends a run of merged [`Document::set`] calls; the next call begins a new step.
    pub fn end_step(&mut self) {
        self.history.close();
    }

    /// Reverts the last `set` or `edit` call (one call, even inside a merged step) as if it had
    /// never been made, as for an invalid value. Also restores the redo steps and the origins of
    /// the scene. Does nothing after undo, redo or a text from outside.
    pub fn reject(&mut self) {
        if let Some(inverse) = self.history.revert() {
            self.source.revert(&inverse);
            self.count_change();
        }
    }

    /// The edits that take back the last `set` or `edit` call, see [`Document::reject`], in a text
    /// merged from this one. `None` if the text from outside changed the same places, or if there is
    /// no such call.
    pub fn taken_back(&self, merged: &Merged) -> Option<Vec<Edit>> {
        let mut before = String::clone(self.source.text());
        text::apply(&mut before, self.history.last_inverse()?);
        let (language, present) = (self.language(), self.source.text());
        let merged = merged.document.source.text();
        let merge = Merge::new(language, present, merged, &Arc::new(before));
        merge
            .conflicts
            .is_empty()
            .then(|| merge.counted_edits(language))
    }

    /// Undoes one step. Returns the changed span of the resulting text, or `None` if there is
    /// nothing to undo.
    pub fn undo(&mut self) -> Option<Span> {
        let step = self.history.next_undo()?;
        let inverse = self.change(&step.edits);
        self.longest = longest(&inverse);
        let changed = cover(&inverse);
        self.history.undone(&step, inverse);
        changed
    }

    /// Redoes one step; returns like [`Document::undo`].
    pub fn redo(&mut self) -> Option<Span> {
        let step = self.history.next_redo()?;
        let inverse = self.change(&step.edits);
        self.longest = longest(&inverse);
        let changed = cover(&inverse);
        self.history.redone(&step, inverse);
        changed
    }

    /// The step that the next undo would undo.
    pub fn undoable(&self) -> Option<&StepName> {
        self.history.peek_undo().map(|step| &step.name)
    }

    /// The step that the next redo would redo.
    pub fn redoable(&self) -> Option<&StepName> {
        self.history.peek_redo().map(|step| &step.name)
    }

    /// Of the changes of the last undo or redo, the span of the longest: what the step was about,
    /// rather than a count that followed.
    pub fn longest_change(&self) -> Span {
        self.longest
    }

    /// Records that `text` was written to the file. It may differ from the current text, which may
    /// have been edited meanwhile.
    pub fn mark_saved(&mut self, text: Arc<String>) {
        self.history.close();
        self.set_saved(text);
    }

    /// A snapshot to merge with a text from outside on another thread. Copies nothing.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            language: self.language(),
            saved: Arc::clone(&self.saved),
            edited: self.is_dirty.then(|| self.shared_text()),
        }
    }

    /// Replaces the document by a text from outside, whose saved text it has too; returns the old one. The
    /// history may be cleared only if there are no unsaved edits.
    #[must_use = "freeing it may take long"]
    pub fn load(&mut self, mut document: Self, past: Past) -> Self {
        document.history = match past {
            Past::Cleared => History::after(&self.history),
            Past::Rebased if self.history.is_empty() => History::after(&self.history),
            Past::Rebased => {
                let outside = edits_between(self.text(), document.text());
                self.history.rebased(&outside)
            }
        };
        self.replace(document)
    }

    /// Replaces the document by the merge of its current state with a text from outside, whose changes are
    /// no step; returns the old one.
    #[must_use = "freeing it may take long"]
    pub fn follow(&mut self, merged: Merged) -> Self {
        self.load(merged.document, Past::Rebased)
    }

    /// The edits that lead from the saved text to this one: sorted, disjoint, each within a few lines.
    pub fn unsaved_edits(&self) -> Vec<Edit> {
        edits_between(&self.saved, self.text())
    }

    /// The edits that lead back to the saved text, see [`Document::unsaved_edits`].
    pub fn edits_to_saved(&self) -> Vec<Edit> {
        edits_between(self.text(), &self.saved)
    }

    /// Replaces the document by the merge of its current state with a text from outside, as one
    /// undoable step if that changes the text; returns the old one.
    #[must_use = "freeing it may take long"]
    pub fn take(&mut self, merged: Merged) -> Self {
        let Merged { mut document, back } = merged;
        document.history = std::mem::take(&mut self.history);
        if back.is_empty() {
            document.history.record_nothing();
        } else {
            document.history.record(back);
        }
        document.history.commit();
        self.replace(document)
    }

    /// Applies a merge whose conflicts were decided, as one undoable step.
    ///
    /// If the text was edited meanwhile, merges again with the decisions that still apply.
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
        self.edit(&merge.counted_edits(self.language()));
        self.history.commit();
        self.set_saved(merge.theirs);
        Adopted::Taken
    }

    /// Merges the text that was last taken from outside once more, with edits made after that which
    /// are meant as changes of `base`, the text saved before. With conflicts, `base` is the saved text
    /// again, and the merge is still to be adopted.
    pub fn merge_again(&mut self, base: Arc<String>) -> Adopted {
        let merge = Merge::new(self.language(), &base, self.source.text(), &self.saved);
        self.set_saved(base);
        if merge.conflicts.is_empty() {
            self.adopt(merge)
        } else {
            Adopted::Conflict(merge)
        }
    }

    /// Applies a merge of this text with recovered edits, as one undoable step; the saved text
    /// stays the same. Unlike in [`Document::adopt`], the text from outside is the edited one.
    pub fn restore(&mut self, merge: &Merge) -> Adopted {
        if merge.mine != *self.source.text() {
            return Adopted::OutOfDate;
        }
        self.edit(&merge.counted_edits(self.language()));
        self.history.commit();
        Adopted::Taken
    }

    fn replace(&mut self, mut document: Self) -> Self {
        document.revision = self.revision + 1;
        std::mem::replace(self, document)
    }

    fn set_saved(&mut self, text: Arc<String>) {
        self.is_dirty = *self.source.text() != text;
        self.saved = text;
    }

    /// Changes text and tree; returns the inverse edits.
    fn change(&mut self, edits: &[Edit]) -> Vec<Edit> {
        let inverse = self.source.change(edits);
        self.count_change();
        inverse
    }

    /// Updates what depends on the text having changed.
    fn count_change(&mut self) {
        self.is_dirty = *self.source.text() != self.saved;
        self.revision += 1;
    }
}

/// The span of the edit that replaces or is replaced by the most text.
fn longest(edits: &[Edit]) -> Span {
    let length = |edit: &&Edit| edit.span.len().max(edit.text.len());
    let longest = edits.iter().max_by_key(length);
    longest.map(|edit| edit.span).unwrap_or_default()
}
