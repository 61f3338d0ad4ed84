//! The three texts of a merge, or corresponding parts of them, compared.

use super::changes::Change;
use super::hunks::{Chunks, Leaves, hunks};
use super::pieces::{Place, Side, edits, pieces};
use super::regions::{Region, regions};
use super::windows::{Window, within};
use language::Language;

/// Corresponding parts of three texts, and where they differ.
pub(super) struct Sides<'t> {
    window: Window,
    base: Chunks<'t>,
    mine: Chunks<'t>,
    theirs: Chunks<'t>,
    regions: Vec<Region>,
}

impl<'t> Sides<'t> {
    /// Compares the lines of a window; `None` if it is too narrow to be certain.
    pub(super) fn of(
        language: Language,
        window: Window,
        [base, mine, theirs]: [&'t str; 3],
        [of_mine, of_theirs]: &[Vec<Change>; 2],
    ) -> Option<Self> {
        let base = Chunks::of(language, window.base.of(base), window.at_ends);
        let mine = Chunks::of(language, window.mine.of(mine), window.at_ends);
        let theirs = Chunks::of(language, window.theirs.of(theirs), window.at_ends);
        let of_mine = hunks(&base, &mine, &within(of_mine, window.base, window.mine));
        let of_theirs = within(of_theirs, window.base, window.theirs);
        let of_theirs = hunks(&base, &theirs, &of_theirs);
        let is_narrow = [&of_mine, &of_theirs]
            .into_iter()
            .any(|hunks| window.is_narrow(&base, hunks));
        (!is_narrow).then(|| Self {
            regions: regions(&of_mine.all, &of_theirs.all),
            window,
            base,
            mine,
            theirs,
        })
    }

    /// The places in the whole texts at which they differ.
    pub(super) fn places(&self) -> impl Iterator<Item = Place> {
        let window = self.window;
        self.regions.iter().map(move |region| {
            let place = self.place(region);
            Place {
                base: place.base.shifted(window.base.start()),
                mine: place.mine.shifted(window.mine.start()),
                theirs: place.theirs.shifted(window.theirs.start()),
            }
        })
    }

    /// The place of a region in these parts of the texts.
    fn place(&self, region: &Region) -> Place {
        Place {
            base: self.base.span(&region.base),
            mine: self.mine.span(&region.mine),
            theirs: self.theirs.span(&region.theirs),
        }
    }

    /// Whether the merged text has the leaves that were merged. Adjacent changes can run together,
    /// for example if one text opens a comment where the other removes the next line break.
    pub(super) fn holds(&self, language: Language) -> bool {
        let places: Vec<_> = self
            .regions
            .iter()
            .map(|region| self.place(region))
            .collect();
        let texts = [self.base.text(), self.mine.text(), self.theirs.text()];
        let (pieces, conflicts) = pieces(texts, &places);
        [Side::Mine, Side::Theirs].into_iter().all(|side| {
            let mut text = self.mine.text().to_owned();
            text::apply(&mut text, &edits(&pieces, &conflicts, |_| side));
            Chunks::of(language, &text, self.window.at_ends)
                .iter()
                .eq(self.outcome(side))
        })
    }

    /// The chunks of the merged text if all conflicts are decided for one side.
    fn outcome(&self, side: Side) -> impl Iterator<Item = &str> {
        let mut parts = Vec::with_capacity(2 * self.regions.len() + 1);
        let mut at = 0;
        for region in &self.regions {
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

    /// Whether both sides made the same change.
    fn is_alike(&self, region: &Region) -> bool {
        let mine = self.mine.slice(&region.mine);
        mine == self.theirs.slice(&region.theirs) && mine != self.base.slice(&region.base)
    }

    /// What both sides changed alike: the leaves removed and added.
    fn alike(&self) -> impl Iterator<Item = [Leaves<'t>; 2]> {
        let alike = self.regions.iter().filter(|region| self.is_alike(region));
        alike.map(|region| {
            let old = self.base.leaves(&region.base);
            let new = self.mine.leaves(&region.mine);
            [without(&old, &new), without(&new, &old)]
        })
    }

    /// What the sides did not change alike: the leaves before and after, for each of them.
    fn others(&self) -> impl Iterator<Item = [Leaves<'t>; 2]> {
        let others = self.regions.iter().filter(|region| !self.is_alike(region));
        others.flat_map(|region| {
            [(&self.mine, &region.mine), (&self.theirs, &region.theirs)]
                .map(|(side, range)| [self.base.leaves(&region.base), side.leaves(range)])
        })
    }
}

/// Whether one side has moved what the other has deleted, moved elsewhere or copied. Half of a move
/// is then a change that both made alike, and only the other half would be merged.
pub(super) fn divide_a_move(parts: &[Sides<'_>]) -> bool {
    let alike: Vec<_> = parts.iter().flat_map(Sides::alike).collect();
    if alike.is_empty() {
        return false;
    }
    let others: Vec<_> = parts.iter().flat_map(Sides::others).collect();
    // Some leaves of a moved thing may have been taken for those of another.
    let is_among = |leaves: &Leaves<'_>, others: &Leaves<'_>| {
        2 * number(&without(leaves, others)) < number(leaves)
    };
    alike.iter().any(|[removed, added]| {
        let moves = |[old, new]: &[Leaves<'_>; 2]| is_among(removed, new) || is_among(added, old);
        others.iter().any(moves)
    })
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
