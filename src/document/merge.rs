//! Three-way merging of texts by leaves: tokens and comments, and the white space between them.
//!
//! The method is diff3's (Khanna, Kunal, Pierce, "A Formal Investigation of Diff3", 2007): changes
//! of both texts against their common ancestor are laid side by side, those that meet form a
//! region, and a region that both changed differently is a conflict.

use std::ops::Range;
use std::sync::Arc;

use super::Document;
use super::hunks::{Chunks, Hunk, hunks};
use super::windows::{Change, Window, widening, windows};
use crate::language::Language;
use crate::text;
use crate::text::{Edit, Span};

/// One of the two texts that changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The text under edit.
    Mine,
    /// The text that came from outside.
    Theirs,
}

/// A place that both texts changed, differently.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conflict {
    /// Where it stands in the text under edit.
    pub span: Span,
    /// The common ancestor's text.
    pub base: String,
    /// The text under edit.
    pub mine: String,
    /// The text from outside.
    pub theirs: String,
    /// What was decided; undecided conflicts keep `Mine`.
    pub decision: Option<Side>,
    /// Where it stands in the common ancestor: which conflict it is, when mine goes on.
    ancestor: Span,
}

/// A three-way merge: pieces both agree on, and conflicts between them.
#[derive(Clone, Debug)]
pub struct Merge {
    /// The conflicts, in text order.
    pub conflicts: Vec<Conflict>,
    /// What to change in `mine`, in text order.
    pieces: Vec<Piece>,
    pub(super) base: Arc<String>,
    pub(super) mine: Arc<String>,
    pub(super) theirs: Arc<String>,
}

/// A place where the outcome may differ from the text under edit.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Piece {
    /// Only the other text changed it.
    Theirs(Edit),
    /// The conflict of this index.
    Conflict(usize),
}

impl Side {
    /// The other text.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Mine => Self::Theirs,
            Self::Theirs => Self::Mine,
        }
    }
}

impl Conflict {
    /// What one of the texts says there.
    pub fn said(&self, side: Side) -> &str {
        match side {
            Side::Mine => &self.mine,
            Side::Theirs => &self.theirs,
        }
    }
}

impl Merge {
    /// Merges the changes of two texts against their common ancestor.
    pub fn new(
        language: Language,
        base: &Arc<String>,
        mine: &Arc<String>,
        theirs: &Arc<String>,
    ) -> Self {
        let changes = [mine, theirs].map(|other| Change::between(base, other));
        let (pieces, conflicts) = widening(language, |margin| {
            settle(language, [base, mine, theirs], changes, margin)
        });
        Self {
            conflicts,
            pieces,
            base: Arc::clone(base),
            mine: Arc::clone(mine),
            theirs: Arc::clone(theirs),
        }
    }

    /// Whether the text under edit still is the one that it started from.
    pub fn is_of(&self, document: &Document) -> bool {
        Arc::ptr_eq(&self.mine, document.source.text())
    }

    /// The merged text under the decisions made so far.
    pub fn text(&self) -> String {
        let mut text = String::clone(&self.mine);
        text::apply(&mut text, &self.edits());
        text
    }

    /// The edits that turn the text under edit into the merged one.
    pub(super) fn edits(&self) -> Vec<Edit> {
        edits(&self.pieces, &self.conflicts, |conflict| {
            conflict.decision.unwrap_or(Side::Mine)
        })
    }

    /// The same merge for a text under edit that has gone on; conflicts that are still the same
    /// keep their decisions.
    pub(super) fn onto(self, language: Language, mine: &Arc<String>) -> Self {
        let mut merge = Self::new(language, &self.base, mine, &self.theirs);
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

/// What to change in mine and what is to be decided, by the lines around the changes of both texts:
/// the ancestor's, mine and theirs. `None` where a margin of so many bytes is too narrow to tell.
fn settle(
    language: Language,
    [base, mine, theirs]: [&str; 3],
    changes: [Option<Change>; 2],
    margin: usize,
) -> Option<(Vec<Piece>, Vec<Conflict>)> {
    let (mut pieces, mut conflicts) = (Vec::new(), Vec::new());
    for window in windows(base, changes[0], changes[1], margin) {
        let sides = Sides {
            base: Chunks::of(language, window.base.of(base)),
            mine: Chunks::of(language, window.mine.of(mine)),
            theirs: Chunks::of(language, window.theirs.of(theirs)),
        };
        let (settled, open) = sides.merge(language, window)?;
        let later = |piece| match piece {
            Piece::Theirs(edit) => Piece::Theirs(Edit {
                span: edit.span.later(window.mine.start()),
                ..edit
            }),
            Piece::Conflict(index) => Piece::Conflict(index + conflicts.len()),
        };
        pieces.extend(settled.into_iter().map(later));
        conflicts.extend(open.into_iter().map(|conflict| Conflict {
            span: conflict.span.later(window.mine.start()),
            ancestor: conflict.ancestor.later(window.base.start()),
            ..conflict
        }));
    }
    Some((pieces, conflicts))
}

/// The edits that the pieces ask for under some decisions.
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

/// The three texts, or parts of them that correspond.
struct Sides<'t> {
    base: Chunks<'t>,
    mine: Chunks<'t>,
    theirs: Chunks<'t>,
}

impl Sides<'_> {
    /// What to change in mine and what is to be decided; `None` if they are too narrow a window to
    /// tell.
    fn merge(&self, language: Language, window: Window) -> Option<(Vec<Piece>, Vec<Conflict>)> {
        let mine = hunks(&self.base, &self.mine);
        let theirs = hunks(&self.base, &self.theirs);
        if [&mine, &theirs]
            .into_iter()
            .any(|hunks| window.is_narrow(&self.base, hunks))
        {
            return None;
        }
        let regions = regions(&mine, &theirs);
        let (pieces, conflicts) = self.settle(&regions);
        // Changes side by side can run together, as when one text opens a comment where the other
        // takes away the line's end behind it. Then the merged text no longer has their leaves.
        let holds = [Side::Mine, Side::Theirs].into_iter().all(|side| {
            let mut text = self.mine.text().to_owned();
            text::apply(&mut text, &edits(&pieces, &conflicts, |_| side));
            Chunks::of(language, &text)
                .iter()
                .eq(self.outcome(&regions, side))
        });
        if holds {
            return Some((pieces, conflicts));
        }
        let whole = regions.into_iter().reduce(|first, later| first.to(&later));
        Some(self.settle(whole.as_slice()))
    }

    /// What becomes of each region: a region of one side's making is that side's, one that both
    /// changed alike changes once.
    fn settle(&self, regions: &[Region]) -> (Vec<Piece>, Vec<Conflict>) {
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

    /// The chunks of the merged text with all conflicts decided for one side.
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

/// Chunks of all three texts that correspond, with changes that belong together.
#[derive(Clone, Debug)]
struct Region {
    base: Range<usize>,
    mine: Range<usize>,
    theirs: Range<usize>,
}

impl Region {
    /// The region from this one to a later one.
    fn to(&self, later: &Self) -> Self {
        Self {
            base: self.base.start..later.base.end,
            mine: self.mine.start..later.mine.end,
            theirs: self.theirs.start..later.theirs.end,
        }
    }
}

/// Lays the changes of two texts side by side: those that clash share a region.
fn regions(mine: &[Hunk], theirs: &[Hunk]) -> Vec<Region> {
    let (mut mine, mut theirs) = (Walk::new(mine), Walk::new(theirs));
    let mut regions = Vec::new();
    loop {
        let first = [mine.peek(), theirs.peek()]
            .into_iter()
            .flatten()
            .min_by_key(|hunk| (hunk.base.start, hunk.base.end));
        let Some(first) = first else {
            return regions;
        };
        let mut base = first.base.clone();
        let starts = (mine.position(base.start), theirs.position(base.start));
        mine.structural = false;
        theirs.structural = false;
        // The first hunk is the region itself; the rest joins by clashing with it.
        if !mine.take_if(&mut base, |hunk, base| hunk.base == *base) {
            theirs.take_if(&mut base, |hunk, base| hunk.base == *base);
        }
        loop {
            let grown = mine.take_if(&mut base, |hunk, base| clash(hunk, base, &theirs))
                || theirs.take_if(&mut base, |hunk, base| clash(hunk, base, &mine));
            if !grown {
                break;
            }
        }
        regions.push(Region {
            mine: starts.0..mine.position(base.end),
            theirs: starts.1..theirs.position(base.end),
            base,
        });
    }
}

/// Whether a hunk shares a chunk with a region, or touches it where both it and the other text
/// change the number of chunks, so that their order would be a guess.
fn clash(hunk: &Hunk, region: &Range<usize>, other: &Walk) -> bool {
    let shares = hunk.base.start < region.end && region.start < hunk.base.end;
    let touches = hunk.base.start <= region.end && region.start <= hunk.base.end;
    shares || (touches && hunk.is_structural() && other.structural)
}

/// A walk along one text's hunks.
struct Walk<'h> {
    hunks: &'h [Hunk],
    /// A place of the base behind the hunks taken so far, and the same place in the other text.
    passed: (usize, usize),
    /// Whether a hunk taken into the present region changes the number of chunks.
    structural: bool,
}

impl<'h> Walk<'h> {
    fn new(hunks: &'h [Hunk]) -> Self {
        Self {
            hunks,
            passed: (0, 0),
            structural: false,
        }
    }

    /// The next hunk.
    fn peek(&self) -> Option<&'h Hunk> {
        self.hunks.first()
    }

    /// Where a place of the base, not before the hunks taken, stands in the other text.
    fn position(&self, base: usize) -> usize {
        self.passed.1 + (base - self.passed.0)
    }

    /// Takes the next hunk into the region if it meets a condition; whether it did.
    fn take_if(
        &mut self,
        region: &mut Range<usize>,
        condition: impl Fn(&Hunk, &Range<usize>) -> bool,
    ) -> bool {
        let Some((hunk, rest)) = self.hunks.split_first() else {
            return false;
        };
        if !condition(hunk, region) {
            return false;
        }
        region.end = region.end.max(hunk.base.end);
        self.hunks = rest;
        self.passed = (hunk.base.end, hunk.other.end);
        self.structural |= hunk.is_structural();
        true
    }
}

#[cfg(test)]
mod tests;
