//! Three-way merging of texts by leaves: tokens and comments, and the white space between them.
//!
//! This is diff3 (Khanna, Kunal, Pierce, "A Formal Investigation of Diff3", 2007): the changes of
//! both texts to their common ancestor are aligned, overlapping ones form a region, and a region
//! that both changed differently is a conflict.

use std::sync::Arc;

use super::Document;
use super::changes::{Change, LIMITS, changes};
use super::hunks::{Chunks, Leaves, hunks};
use super::regions::{Region, regions};
use super::windows::{self, Window, widening, windows};
use crate::language::{Language, Source};
use crate::text;
use crate::text::{Edit, Span};

/// One of the two changed texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The text being edited.
    Mine,
    /// The text from outside.
    Theirs,
}

/// A place that both texts changed differently.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conflict {
    /// The span in the text being edited.
    pub span: Span,
    /// The text of the common ancestor.
    pub base: String,
    /// The text being edited, in `span`.
    pub mine: String,
    /// The text from outside.
    pub theirs: String,
    /// The decision; undecided conflicts keep `Mine`.
    pub decision: Option<Side>,
    /// The span in the common ancestor, which identifies the conflict after further edits.
    ancestor: Span,
}

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

/// A place where the result may differ from the text being edited.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Piece {
    /// A change made only in the text from outside.
    Theirs(Edit),
    /// The index of a conflict.
    Conflict(usize),
}

impl Side {
    /// `Theirs` for `Mine` and the reverse.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Mine => Self::Theirs,
            Self::Theirs => Self::Mine,
        }
    }
}

impl Conflict {
    /// The text of one side.
    pub fn text(&self, side: Side) -> &str {
        match side {
            Side::Mine => &self.mine,
            Side::Theirs => &self.theirs,
        }
    }
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
    pub(super) fn counts(&self, merged: &Source) -> Vec<Edit> {
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
    [base, mine, theirs]: [&str; 3],
    [of_mine, of_theirs]: &[Vec<Change>; 2],
    margin: usize,
) -> Option<(Vec<Piece>, Vec<Conflict>)> {
    let (mut pieces, mut conflicts) = (Vec::new(), Vec::new());
    let windows = windows(base, of_mine, of_theirs, margin);
    let is_alone = windows.len() == 1;
    for window in windows {
        let sides = Sides {
            base: Chunks::of(language, window.base.of(base), window.at_ends),
            mine: Chunks::of(language, window.mine.of(mine), window.at_ends),
            theirs: Chunks::of(language, window.theirs.of(theirs), window.at_ends),
        };
        let (merged, open) = sides.merge(language, window, is_alone)?;
        let later = |piece| match piece {
            Piece::Theirs(edit) => Piece::Theirs(Edit {
                span: edit.span.shifted(window.mine.start()),
                ..edit
            }),
            Piece::Conflict(index) => Piece::Conflict(index + conflicts.len()),
        };
        pieces.extend(merged.into_iter().map(later));
        conflicts.extend(open.into_iter().map(|conflict| Conflict {
            span: conflict.span.shifted(window.mine.start()),
            ancestor: conflict.ancestor.shifted(window.base.start()),
            ..conflict
        }));
    }
    Some((pieces, conflicts))
}

/// The edits of the pieces, with each conflict decided by `decide`.
fn edits(
    pieces: &[Piece],
    conflicts: &[Conflict],
    decide: impl Fn(&Conflict) -> Side,
) -> Vec<Edit> {
    pieces
        .iter()
        .filter_map(|piece| match piece {
            Piece::Theirs(edit) => Some(edit.clone()),
            Piece::Conflict(index) => {
                let conflict = &conflicts[*index];
                (decide(conflict) == Side::Theirs).then(|| Edit {
                    span: conflict.span,
                    text: conflict.theirs.clone(),
                })
            }
        })
        .collect()
}

/// The three texts, or corresponding parts of them.
struct Sides<'t> {
    base: Chunks<'t>,
    mine: Chunks<'t>,
    theirs: Chunks<'t>,
}

impl Sides<'_> {
    /// The changes to mine and the conflicts; `None` if the window is too narrow to be certain. If there
    /// are others, what both texts changed alike may be half of a move to one of them.
    fn merge(
        &self,
        language: Language,
        window: Window,
        is_alone: bool,
    ) -> Option<(Vec<Piece>, Vec<Conflict>)> {
        let mine = hunks(&self.base, &self.mine);
        let theirs = hunks(&self.base, &self.theirs);
        if [&mine, &theirs]
            .into_iter()
            .any(|hunks| window.is_narrow(&self.base, hunks))
        {
            return None;
        }
        let regions = regions(&mine.all, &theirs.all);
        if !is_alone && regions.iter().any(|region| self.is_alike(region)) {
            return None;
        }
        let (pieces, conflicts) = self.resolve(&regions);
        // Adjacent changes can run together, for example if one text opens a comment where the
        // other removes the next line break. Then the merged text no longer has their leaves.
        let holds = [Side::Mine, Side::Theirs].into_iter().all(|side| {
            let mut text = self.mine.text().to_owned();
            text::apply(&mut text, &edits(&pieces, &conflicts, |_| side));
            Chunks::of(language, &text, window.at_ends)
                .iter()
                .eq(self.outcome(&regions, side))
        });
        if holds && !self.divides_a_move(&regions) {
            return Some((pieces, conflicts));
        }
        let whole = regions.into_iter().reduce(|first, later| first.to(&later));
        Some(self.resolve(whole.as_slice()))
    }

    /// Resolves each region: a change by one side is taken, and so is one that both sides made
    /// alike; different changes conflict.
    fn resolve(&self, regions: &[Region]) -> (Vec<Piece>, Vec<Conflict>) {
        let (mut pieces, mut conflicts) = (Vec::new(), Vec::new());
        for region in regions {
            let base = self.base.slice(&region.base);
            let mine = self.mine.slice(&region.mine);
            let theirs = self.theirs.slice(&region.theirs);
            let span = self.mine.span(&region.mine);
            if mine == theirs || theirs == base {
                continue;
            }
            if mine == base {
                pieces.push(Piece::Theirs(Edit {
                    span,
                    text: theirs.to_owned(),
                }));
                continue;
            }
            pieces.push(Piece::Conflict(conflicts.len()));
            conflicts.push(Conflict {
                span,
                base: base.to_owned(),
                mine: mine.to_owned(),
                theirs: theirs.to_owned(),
                decision: None,
                ancestor: self.base.span(&region.base),
            });
        }
        (pieces, conflicts)
    }

    /// Whether both sides made the same change.
    fn is_alike(&self, region: &Region) -> bool {
        let mine = self.mine.slice(&region.mine);
        mine == self.theirs.slice(&region.theirs) && mine != self.base.slice(&region.base)
    }

    /// Whether one side has moved what the other has deleted, moved elsewhere or copied. Half of a
    /// move is then a change that both made alike, and only the other half would be merged.
    fn divides_a_move(&self, regions: &[Region]) -> bool {
        let (alike, others): (Vec<_>, Vec<_>) =
            regions.iter().partition(|region| self.is_alike(region));
        let others: Vec<_> = others
            .into_iter()
            .flat_map(|region| {
                [(&self.mine, &region.mine), (&self.theirs, &region.theirs)]
                    .map(|(side, range)| [self.base.leaves(&region.base), side.leaves(range)])
            })
            .collect();
        alike.iter().any(|region| {
            let (old, new) = (
                self.base.leaves(&region.base),
                self.mine.leaves(&region.mine),
            );
            let (removed, added) = (without(&old, &new), without(&new, &old));
            // Some leaves of a moved thing may have been taken for those of another.
            let is_among = |leaves: &Leaves<'_>, others: &Leaves<'_>| {
                2 * number(&without(leaves, others)) < number(leaves)
            };
            let moves =
                |[old, new]: &[Leaves<'_>; 2]| is_among(&removed, new) || is_among(&added, old);
            others.iter().any(moves)
        })
    }

    /// The chunks of the merged text if all conflicts are decided for one side.
    fn outcome(&self, regions: &[Region], side: Side) -> impl Iterator<Item = &str> {
        let mut parts = Vec::with_capacity(2 * regions.len() + 1);
        let mut at = 0;
        for region in regions {
            parts.push((&self.mine, at..region.mine.start));
            let base = self.base.slice(&region.base);
            let takes_theirs = self.theirs.slice(&region.theirs) != base
                && (side == Side::Theirs || self.mine.slice(&region.mine) == base);
            parts.push(if takes_theirs {
                (&self.theirs, region.theirs.clone())
            } else {
                (&self.mine, region.mine.clone())
            });
            at = region.mine.end;
        }
        parts.push((&self.mine, at..self.mine.len()));
        parts
            .into_iter()
            .flat_map(|(chunks, range)| range.map(|at| &chunks[at]))
    }
}

/// The leaves of which there are more than among others, and how many more.
fn without<'t>(leaves: &Leaves<'t>, others: &Leaves<'_>) -> Leaves<'t> {
    let more = leaves.iter().filter_map(|(&leaf, &count)| {
        let more = count.saturating_sub(others.get(leaf).copied().unwrap_or(0));
        (0 < more).then_some((leaf, more))
    });
    more.collect()
}

fn number(leaves: &Leaves<'_>) -> usize {
    leaves.values().sum()
}

#[cfg(test)]
mod tests;
