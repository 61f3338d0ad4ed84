//! The changes of two texts to their common ancestor, aligned: overlapping ones form a region.

use std::ops::Range;

use super::hunks::Hunk;

/// Corresponding chunks of all three texts, with changes that belong together.
#[derive(Clone, Debug)]
pub(super) struct Region {
    pub(super) base: Range<usize>,
    pub(super) mine: Range<usize>,
    pub(super) theirs: Range<usize>,
}

/// Aligns the changes of two texts: those that clash share a region.
pub(super) fn regions(mine: &[Hunk], theirs: &[Hunk]) -> Vec<Region> {
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
        // The first hunk starts the region; others join by clashing with it.
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

/// Whether a hunk overlaps a region, or is adjacent to it while both the hunk and the other text
/// change the number of chunks, so that their order would be ambiguous.
fn clash(hunk: &Hunk, region: &Range<usize>, other: &Walk) -> bool {
    let shares = hunk.base.start < region.end && region.start < hunk.base.end;
    let touches = hunk.base.start <= region.end && region.start <= hunk.base.end;
    shares || (touches && hunk.is_structural() && other.structural)
}

/// A cursor over the hunks of one text.
struct Walk<'h> {
    hunks: &'h [Hunk],
    /// The end of the last hunk taken, in the base and in the other text.
    passed: (usize, usize),
    /// Whether a hunk in the current region changes the number of chunks.
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

    /// The next hunk, without passing it.
    fn peek(&self) -> Option<&'h Hunk> {
        self.hunks.first()
    }

    /// Maps a base index, not before the last hunk taken, to the other text.
    fn position(&self, base: usize) -> usize {
        self.passed.1 + (base - self.passed.0)
    }

    /// Takes the next hunk into the region if `condition` holds; returns whether it did.
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
