//! Three-way merging of texts by leaves: tokens and comments, and the white space between them.
//!
//! This is diff3 (Khanna, Kunal, Pierce, "A Formal Investigation of Diff3", 2007): the changes of
//! both texts to their common ancestor are aligned, overlapping ones form a region, and a region
//! that both changed differently is a conflict.

use std::sync::Arc;

use super::Document;
use super::changes::{Change, LIMITS, changes};
use super::pieces::{Conflict, Piece, Place, Side, edits, joined, pieces};
use super::sides::{Sides, divide_a_move};
use super::windows::{self, Window, widening, windows};
use language::{Language, Source};
use text::{Edit, Span};

/// A three-way merge: changes that apply cleanly, and conflicts.
#[derive(Clone, Debug)]
pub struct Merge {
    /// The conflicts, in text order.
    pub conflicts: Vec<Conflict>,
    /// The changes to `mine`, in text order.
    pieces: Vec<Piece>,
    /// Whether the changes are sound only one side at a time.
    is_undivided: bool,
    pub(super) base: Arc<String>,
    pub(super) mine: Arc<String>,
    pub(super) theirs: Arc<String>,
}

impl Merge {
    /// Merges the changes that two texts made to their common ancestor.
    pub fn new(
        language: Language,
        base: &Arc<String>,
        mine: &Arc<String>,
        theirs: &Arc<String>,
    ) -> Self {
        let changes = [mine, theirs].map(|other| changes(base, other, LIMITS));
        let (pieces, conflicts) = widening(language, |margin| {
            resolve(language, [base, mine, theirs], &changes, margin)
        });
        Self {
            conflicts,
            pieces,
            is_undivided: false,
            base: Arc::clone(base),
            mine: Arc::clone(mine),
            theirs: Arc::clone(theirs),
        }
    }

    /// A merge that leaves everything from the first change to the last to one decision.
    pub(super) fn undivided(base: &Arc<String>, mine: &Arc<String>, theirs: &Arc<String>) -> Self {
        let changes = [mine, theirs].map(|other| changes(base, other, LIMITS));
        let window = windows::undivided(base, &changes[0], &changes[1]);
        let conflict = |window: Window| Conflict {
            span: window.mine,
            base: window.base.of(base).to_owned(),
            mine: window.mine.of(mine).to_owned(),
            theirs: window.theirs.of(theirs).to_owned(),
            decision: None,
            ancestor: window.base,
            outside: window.theirs,
        };
        let conflicts: Vec<_> = window.map(conflict).into_iter().collect();
        Self {
            pieces: (0..conflicts.len()).map(Piece::Conflict).collect(),
            conflicts,
            is_undivided: true,
            base: Arc::clone(base),
            mine: Arc::clone(mine),
            theirs: Arc::clone(theirs),
        }
    }

    /// Makes one conflict of those in the same field, whose span in the text being edited `field` gives:
    /// the channels of a colour are one decision.
    pub fn join(&mut self, field: impl Fn(Span) -> Option<Span>) {
        let texts = [&**self.base, &**self.mine, &**self.theirs];
        let (pieces, conflicts) = joined(texts, &self.pieces, &self.conflicts, field);
        (self.pieces, self.conflicts) = (pieces, conflicts);
    }

    /// Whether the text being edited is still the one merged.
    pub fn is_of(&self, document: &Document) -> bool {
        Arc::ptr_eq(&self.mine, document.source.text())
    }

    /// The merged text with the decisions made so far.
    pub fn text(&self) -> String {
        let mut text = String::clone(&self.mine);
        text::apply(&mut text, &self.edits());
        text
    }

    /// The edits that turn the text being edited into the merged text, and then correct its counts.
    pub(super) fn counted_edits(&self, language: Language) -> Vec<Edit> {
        let mut source = Source::new(language, Arc::new(self.text()));
        let counts = self.counts(&source);
        if counts.is_empty() {
            return self.edits();
        }
        source.change(&counts);
        let edit = text::smallest_edit(&self.mine, source.text());
        edit.into_iter().collect()
    }

    /// The edits that correct the counts of the merged text: both sides may have added or deleted
    /// something, and then state the same count. None if the counts of a side were already wrong.
    fn counts(&self, merged: &Source) -> Vec<Edit> {
        let is_exact = |text: &Arc<String>| {
            let source = Source::new(merged.language(), Arc::clone(text));
            source.recount().is_empty()
        };
        let counts = merged.recount();
        if counts.is_empty() || !is_exact(&self.mine) || !is_exact(&self.theirs) {
            return Vec::new();
        }
        counts
    }

    /// The edits that turn the text being edited into the merged text.
    pub(super) fn edits(&self) -> Vec<Edit> {
        edits(&self.pieces, &self.conflicts, |conflict| {
            conflict.decision.unwrap_or(Side::Mine)
        })
    }

    /// Repeats the merge for a text edited meanwhile. Unchanged conflicts keep their decisions.
    pub(super) fn onto(self, language: Language, mine: &Arc<String>) -> Self {
        let mut merge = if self.is_undivided {
            Self::undivided(&self.base, mine, &self.theirs)
        } else {
            Self::new(language, &self.base, mine, &self.theirs)
        };
        let mut earlier = self.conflicts.into_iter().peekable();
        for conflict in &mut merge.conflicts {
            while earlier
                .next_if(|old| old.ancestor < conflict.ancestor)
                .is_some()
            {}
            let same = |old: &Conflict| {
                (old.ancestor, &old.mine, &old.theirs)
                    == (conflict.ancestor, &conflict.mine, &conflict.theirs)
            };
            conflict.decision = earlier.next_if(same).and_then(|old| old.decision);
        }
        merge
    }
}

/// The changes to mine and the conflicts, found in the lines around the changes of the ancestor,
/// mine and theirs. `None` if a margin of `margin` bytes is too narrow for a certain result.
fn resolve(
    language: Language,
    texts: [&str; 3],
    changes: &[Vec<Change>; 2],
    margin: usize,
) -> Option<(Vec<Piece>, Vec<Conflict>)> {
    let windows = windows(texts[0], &changes[0], &changes[1], margin).into_iter();
    let sides = windows.map(|window| Sides::of(language, window, texts, changes));
    let sides = sides.collect::<Option<Vec<_>>>()?;
    let mut places: Vec<_> = sides.iter().flat_map(Sides::places).collect();
    if !sides.iter().all(|sides| sides.holds(language)) || divide_a_move(&sides) {
        places = places.into_iter().reduce(Place::to).into_iter().collect();
    }
    Some(pieces(texts, &places))
}

#[cfg(test)]
mod tests;
