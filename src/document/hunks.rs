//! The differences between two texts, in chunks: leaves and the white space between them.
//!
//! Leaves are the same only if they play the same role: an object's first number is not a count.
//!
//! A diff finds a shortest edit script, which is not always what happened: in a run of equal leaves
//! it cannot tell which one is new. Ambiguities are resolved in favour of larger hunks, since a
//! needless question is better than a silently wrong merge.

use std::collections::BTreeMap;
use std::ops::{Index, Range};
use std::sync::Arc;
use std::time::{Duration, Instant};

use similar::DiffOp;
use similar::algorithms::{Capture, Compact, Replace, myers};

use super::changes::Change;
use language::{Language, Role, Roles, Source, parts_of_comment};
use text::Span;

/// Time limit of the search for a short diff; what remains then counts as one hunk. In tests, a
/// slow machine must not change the result.
const PATIENCE: Duration = Duration::from_millis(if cfg!(test) { 3_600_000 } else { 500 });

/// More unchanged leaves in a row than this are never taken for a coincidence.
const COINCIDENCE: usize = 4;

/// This many equal chunks on either side of a change are aligned along with it, since its parts may
/// match them just as well.
const ROOM: usize = 64;

/// Hunks at least this many chunks from the edges of two windows are never joined.
pub(super) const APART: usize = COINCIDENCE + 2;

/// The length of a leaf's role.
const ROLE: usize = size_of::<Role>();

/// The number of leaves of each text.
pub(super) type Leaves<'t> = BTreeMap<&'t str, usize>;

/// A text split into alternating chunks: white space, leaf, white space, …, leaf, white space.
/// White space may be empty; leaves have odd indices. The concatenated chunks are the text.
pub(super) struct Chunks<'t> {
    text: &'t str,
    /// The start of each chunk, then the length of the text, which is below 4 GiB, as for spans.
    bounds: Vec<u32>,
    /// The text with the role of each leaf behind it, by which chunks are compared.
    keys: String,
    /// The chunks at the beginning whose roles are not known.
    unknown: usize,
}

impl<'t> Chunks<'t> {
    /// Splits a text at the bounds of its tokens and comments. `at_ends` tells whether it begins, and
    /// ends, where the whole text does.
    pub(super) fn of(language: Language, text: &'t str, at_ends: [bool; 2]) -> Self {
        let source = Source::new(language, Arc::new(text.to_owned()));
        let (leaves, roles, unknown) = leaves_of(&source, at_ends);
        let mut keys = String::with_capacity(text.len() + ROLE * leaves.len());
        let mut at = 0;
        for (leaf, role) in leaves.iter().zip(roles) {
            keys.push_str(&text[at..leaf.end()]);
            keys.extend(role.map(char::from));
            at = leaf.end();
        }
        keys.push_str(&text[at..]);
        let mut bounds = Vec::with_capacity(2 * leaves.len() + 2);
        bounds.push(0);
        let ends = leaves.iter().flat_map(|leaf| [leaf.start(), leaf.end()]);
        bounds.extend(ends.map(|end| end as u32));
        bounds.push(text.len() as u32);
        Self {
            text,
            bounds,
            keys,
            unknown: 2 * unknown,
        }
    }

    fn bound(&self, chunk: usize) -> usize {
        self.bounds[chunk] as usize
    }

    /// The number of chunks.
    pub(super) fn len(&self) -> usize {
        self.bounds.len() - 1
    }

    /// The last leaf that ends before an offset, and does not touch it.
    fn leaf_before(&self, offset: usize) -> Option<usize> {
        let before = self
            .bounds
            .partition_point(|&bound| (bound as usize) < offset);
        let chunk = before.checked_sub(2)?;
        (chunk + chunk % 2).checked_sub(1)
    }

    /// The whole text, of which the chunks are parts.
    pub(super) fn text(&self) -> &'t str {
        self.text
    }

    /// The chunks with their roles, in order.
    pub(super) fn iter(&self) -> impl Iterator<Item = &str> {
        (0..self.len()).map(|chunk| &self[chunk])
    }

    /// The span of a range of chunks.
    pub(super) fn span(&self, chunks: &Range<usize>) -> Span {
        Span::new(self.bound(chunks.start), self.bound(chunks.end))
    }

    /// How often each leaf is in a range of chunks.
    pub(super) fn leaves(&self, chunks: &Range<usize>) -> Leaves<'t> {
        let mut leaves = Leaves::new();
        for leaf in chunks.clone().filter(|chunk| chunk % 2 == 1) {
            let span = self.span(&(leaf..leaf + 1));
            *leaves.entry(span.of(self.text)).or_insert(0) += 1;
        }
        leaves
    }

    /// The text of a range of chunks.
    pub(super) fn slice(&self, chunks: &Range<usize>) -> &'t str {
        self.span(chunks).of(self.text)
    }
}

impl Index<usize> for Chunks<'_> {
    type Output = str;

    /// A chunk, and if it is a leaf its role.
    fn index(&self, chunk: usize) -> &str {
        let start = self.bound(chunk) + ROLE * (chunk / 2);
        &self.keys[start..self.bound(chunk + 1) + ROLE * chunk.div_ceil(2)]
    }
}

/// The leaves of a text with their roles, and the number of those at the beginning whose roles are not
/// known. A comment that states render settings is a leaf for each of them.
fn leaves_of(source: &Source, at_ends: [bool; 2]) -> (Vec<Span>, Vec<Role>, usize) {
    let whole = source.leaves();
    let Roles { roles, unknown } = source.roles(&whole, at_ends);
    let (mut leaves, mut of_leaves) = (
        Vec::with_capacity(whole.len()),
        Vec::with_capacity(whole.len()),
    );
    let mut before = unknown;
    for (at, (&leaf, role)) in whole.iter().zip(roles).enumerate() {
        let parts = if source.is_comment(leaf) {
            parts_of_comment(source.text(), leaf)
        } else {
            Vec::new()
        };
        if at == unknown {
            before = leaves.len();
        }
        if parts.is_empty() {
            leaves.push(leaf);
            of_leaves.push(role);
        }
        for (part, role) in parts {
            leaves.push(part);
            of_leaves.push(role);
        }
    }
    if whole.len() <= unknown {
        before = leaves.len();
    }
    (leaves, of_leaves, before)
}

/// A range of base chunks replaced by other chunks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Hunk {
    /// The replaced chunks; empty for an insertion.
    pub(super) base: Range<usize>,
    /// The new chunks; empty for a deletion.
    pub(super) other: Range<usize>,
}

impl Hunk {
    /// Whether the number of chunks changes; otherwise they are replaced one by one.
    pub(super) fn is_structural(&self) -> bool {
        self.base.len() != self.other.len()
    }

    /// The number of leaves removed or added, whichever is greater.
    fn leaves(&self) -> usize {
        leaves(&self.base).max(leaves(&self.other))
    }
}

/// The differences between two texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Hunks {
    /// The differences, in order and disjoint.
    pub(super) all: Vec<Hunk>,
    /// The base chunks on which the hunks depend, at least from the first hunk to the last; empty
    /// if there are none.
    pub(super) reach: Range<usize>,
    /// Whether the roles of all leaves in them are known.
    pub(super) is_certain: bool,
}

/// The differences between `base` and `other`, whose texts differ by `changes`. Leaves replaced one
/// by one are separate hunks. An insertion or deletion that could equally have happened a few chunks
/// away covers all those positions.
///
/// Each change is aligned on its own. Among shortest edit scripts of both texts, the choice at one
/// place would depend on changes far away.
pub(super) fn hunks(base: &Chunks, other: &Chunks, changes: &[Change]) -> Hunks {
    let raw = fuse(differences(base, other, changes));
    let mut hunks: Vec<Hunk> = Vec::with_capacity(raw.len());
    for (index, hunk) in raw.iter().enumerate() {
        if hunk.is_structural() {
            let from = hunks.last().map_or(0, |last| last.base.end);
            let to = raw
                .get(index + 1)
                .map_or(base.len(), |next| next.base.start);
            hunks.push(widen(hunk, base, other, from..to));
        } else {
            let pairs = hunk.base.clone().zip(hunk.other.clone());
            hunks.extend(
                pairs
                    .filter(|&(b, o)| base[b] != other[o])
                    .map(|(b, o)| Hunk {
                        base: b..b + 1,
                        other: o..o + 1,
                    }),
            );
        }
    }
    // Of fused differences the outer chunks may be equal.
    let ends =
        [raw.first(), raw.last(), hunks.first(), hunks.last()].map(|hunk| hunk.map(|h| &h.base));
    let ends = || ends.iter().copied().flatten();
    let start = ends().map(|base| base.start).min().unwrap_or(0);
    let end = ends().map(|base| base.end).max().unwrap_or(0);
    let is_known =
        |hunk: &Hunk| base.unknown <= hunk.base.start && other.unknown <= hunk.other.start;
    Hunks {
        is_certain: raw.iter().chain(&hunks).all(is_known),
        all: hunks,
        reach: start..end,
    }
}

/// The differences found by the diff, separated by equal chunks.
fn differences(base: &Chunks, other: &Chunks, changes: &[Change]) -> Vec<Hunk> {
    let deadline = Instant::now().checked_add(PATIENCE);
    let mut hunks: Vec<Hunk> = Vec::new();
    for part in parts(base, other, changes) {
        // `capture_diff_deadline` would do the same, and compile all other algorithms too.
        let mut capture = Compact::new(Replace::new(Capture::new()), base, other);
        let Ok(()) =
            myers::diff_deadline(&mut capture, base, part.base, other, part.other, deadline);
        for op in capture.into_inner().into_inner().into_ops() {
            if matches!(op, DiffOp::Equal { .. }) {
                continue;
            }
            let (old, new) = (op.old_range(), op.new_range());
            match hunks.last_mut() {
                Some(last) if last.base.end == old.start && last.other.end == new.start => {
                    last.base.end = old.end;
                    last.other.end = new.end;
                }
                _ => hunks.push(Hunk {
                    base: old,
                    other: new,
                }),
            }
        }
    }
    hunks
}

/// The chunks around each of the changes; around several if no leaf is between them.
fn parts(base: &Chunks, other: &Chunks, changes: &[Change]) -> Vec<Hunk> {
    let cuts = changes.windows(2).filter_map(|pair| {
        let [end, start] = [pair[0].base.end(), pair[1].base.start()];
        let middle = end.midpoint(start);
        let leaf = base.leaf_before(middle)?;
        let other_leaf = other.leaf_before(pair[1].other.start() - (start - middle))?;
        let behind = |chunks: &Chunks, leaf: usize, end: usize| {
            let span = chunks.span(&(leaf..leaf + 1));
            Some([span.start().checked_sub(end)?, span.end() - end])
        };
        let place = behind(base, leaf, end)?;
        let is_same = behind(other, other_leaf, pair[0].other.end()) == Some(place);
        is_same.then_some([leaf + 1, other_leaf + 1])
    });
    let ends = std::iter::once([base.len(), other.len()]);
    let mut at = [0, 0];
    let mut parts = Vec::with_capacity(changes.len());
    for next in cuts.chain(ends) {
        parts.push(around(base, at[0]..next[0], other, at[1]..next[1]));
        at = next;
    }
    parts
}

/// The part of two ranges of chunks that has all their differences, and some equal chunks around
/// these.
fn around(base: &Chunks, mut old: Range<usize>, other: &Chunks, mut new: Range<usize>) -> Hunk {
    let is_same = |&(old, new): &(usize, usize)| base[old] == other[new];
    let head = old.clone().zip(new.clone()).take_while(is_same).count();
    let rests = [old.start + head..old.end, new.start + head..new.end];
    let [rest, other_rest] = rests.map(Iterator::rev);
    let tail = rest.zip(other_rest).take_while(is_same).count();
    for range in [&mut old, &mut new] {
        range.start += head.saturating_sub(ROOM);
        range.end -= tail.saturating_sub(ROOM);
    }
    Hunk {
        base: old,
        other: new,
    }
}

/// Joins hunks separated by so few unchanged leaves that these may be equal by coincidence: `0 1 2`
/// became `1 2 3` by three new values rather than by a deletion and an insertion.
fn fuse(hunks: Vec<Hunk>) -> Vec<Hunk> {
    let mut fused: Vec<Hunk> = Vec::with_capacity(hunks.len());
    let mut previous_leaves = 0;
    for hunk in hunks {
        let limit = (2 * previous_leaves.min(hunk.leaves())).min(COINCIDENCE);
        previous_leaves = hunk.leaves();
        match fused.last_mut() {
            Some(last) if leaves(&(last.base.end..hunk.base.start)) <= limit => {
                last.base.end = hunk.base.end;
                last.other.end = hunk.other.end;
            }
            _ => fused.push(hunk),
        }
    }
    fused
}

/// Widens an insertion or deletion to all positions that give the same text, within the base chunks
/// `room`. One that may be an append or a truncation is taken as such, and likewise at the
/// beginning of the text.
fn widen(hunk: &Hunk, base: &Chunks, other: &Chunks, room: Range<usize>) -> Hunk {
    let (chunks, block) = match (hunk.base.is_empty(), hunk.other.is_empty()) {
        (true, false) => (other, &hunk.other),
        (false, true) => (base, &hunk.base),
        _ => return hunk.clone(),
    };
    let back = (1..=hunk.base.start - room.start)
        .take_while(|step| chunks[block.start - step] == chunks[block.end - step])
        .count();
    let forth = (0..room.end - hunk.base.end)
        .take_while(|step| chunks[block.start + step] == chunks[block.end + step])
        .count();
    // The first and last chunks are white space; an edit next to them still counts as at an end.
    let at_start = hunk.base.start - back <= 1;
    let at_end = base.len() <= hunk.base.end + forth + 1;
    let slide = |range: &Range<usize>| match (at_start, at_end) {
        (false, true) => range.start + forth..range.end + forth,
        (true, false) => range.start - back..range.end - back,
        _ => range.start - back..range.end + forth,
    };
    Hunk {
        base: slide(&hunk.base),
        other: slide(&hunk.other),
    }
}

/// The number of leaves in a range of chunks.
fn leaves(chunks: &Range<usize>) -> usize {
    chunks.end / 2 - chunks.start / 2
}
