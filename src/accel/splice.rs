//! Adapts a tree to a few boxes that were removed and inserted, without changing its topology.

use std::ops::Range;

use super::node::{Bounds, Child, Node, WIDTH};
use super::refit::{Parents, copied, may_change};
use super::{Bvh, RUN, polls_at};
use geometry::{Aabb, IsCancelled};

/// Changes of [`Bvh::order`]. Places are those before the changes.
struct Changes {
    /// The places of removed boxes, in ascending order.
    removed: Vec<usize>,
    /// The places before which boxes are inserted, at the end of a leaf, in ascending order; and their
    /// new indices.
    inserted: Vec<(usize, u32)>,
}

/// See [`Bvh::spliced`].
pub(super) fn splice(
    bvh: &Bvh,
    removed: Range<u32>,
    inserted: u32,
    aabb: impl Fn(u32) -> Aabb,
    cancelled: IsCancelled<'_>,
) -> Option<Bvh> {
    let count = removed.len() + inserted as usize;
    if !may_change(bvh, count) {
        return None;
    }
    let new = removed.start..removed.start + inserted;
    let bounds = |index: u32| Bounds::around(aabb(index), bvh.reference);
    let fits = |index: u32| !aabb(index).is_empty() && bounds(index).is_finite();
    if !new.clone().all(fits) {
        return None;
    }
    let numbered = (0..).zip(&bvh.order);
    let gone = numbered.filter(|(_, index)| removed.contains(index));
    let mut changes = Changes {
        removed: gone.map(|(place, _)| place).collect(),
        inserted: Vec::new(),
    };
    for index in new {
        let place = place_for(bvh, &bounds(index), &changes)?;
        let at = changes
            .inserted
            .partition_point(|(other, _)| *other <= place);
        changes.inserted.insert(at, (place, index));
    }
    let renumbered = |index: u32| {
        if index < removed.start {
            index
        } else {
            index - (removed.end - removed.start) + inserted
        }
    };
    let order = changes.applied(&bvh.order, renumbered, cancelled)?;
    let mut nodes = copied(&bvh.nodes, cancelled)?;
    let mut touched = Vec::new();
    for (number, node) in nodes.iter_mut().enumerate() {
        if polls_at(number) && cancelled() {
            return None;
        }
        for lane in 0..WIDTH {
            let Child::Leaf { first, count } = node.child(lane) else {
                continue;
            };
            let old = first as usize..first as usize + usize::from(count);
            let run = changes.moved(&old);
            let is_touched = changes.touch(&old);
            if count == 0 || (run == old && !is_touched) {
                continue;
            }
            let mut own = node.bounds(lane);
            if is_touched {
                touched.push(number);
                let around = |sum: Bounds, &index: &u32| sum.union(&bounds(index));
                own = order[run.clone()].iter().fold(Bounds::EMPTY, around);
            }
            let child = Child::Leaf {
                // A missing child starts at 0.
                first: if run.is_empty() { 0 } else { run.start as u32 },
                count: run.len() as u8,
            };
            node.put(lane, &own, child);
        }
    }
    let parents = Parents::of(&nodes, cancelled)?;
    for number in touched {
        parents.enclose(&mut nodes, number);
    }
    let gone = changes
        .removed
        .partition_point(|place| *place < bvh.bounded);
    Some(Bvh {
        farthest: nodes.first().map_or(0.0, Node::farthest),
        nodes,
        bounded: bvh.bounded - gone + inserted as usize,
        order,
        moved: bvh.moved + count,
        ..*bvh
    })
}

/// The end of the leaf that grows least by a box, level by level; `None` if it is full.
fn place_for(bvh: &Bvh, bounds: &Bounds, changes: &Changes) -> Option<usize> {
    let mut node = bvh.nodes.first()?;
    loop {
        let filled = (0..WIDTH).filter(|lane| node.filled() >> lane & 1 == 1);
        let growth = |lane: usize| {
            let own = node.bounds(lane);
            own.union(bounds).half_area() - own.half_area()
        };
        let nearest = filled.min_by(|&a, &b| growth(a).total_cmp(&growth(b)))?;
        match node.child(nearest) {
            Child::Inner(number) => node = &bvh.nodes[number as usize],
            Child::Leaf { first, count } => {
                let first = first as usize;
                let run = first..first + usize::from(count);
                return (changes.moved(&run).len() < RUN).then_some(run.end);
            }
        }
    }
}

impl Changes {
    /// The run of a leaf after the changes.
    fn moved(&self, run: &Range<usize>) -> Range<usize> {
        self.place(run.start)..self.place(run.end)
    }

    /// The start, after the changes, of a run that started at a place.
    fn place(&self, before: usize) -> usize {
        let removed = self.removed.partition_point(|place| *place < before);
        let inserted = self.inserted.partition_point(|(place, _)| *place <= before);
        before - removed + inserted
    }

    /// Whether the boxes of a leaf change.
    fn touch(&self, run: &Range<usize>) -> bool {
        let is_end = |(place, _): &(usize, u32)| *place == run.end;
        self.removed.iter().any(|place| run.contains(place)) || self.inserted.iter().any(is_end)
    }

    /// The order after the changes, with new indices of the boxes that stay; `None` once `cancelled`
    /// returns true.
    fn applied(
        &self,
        order: &[u32],
        renumbered: impl Fn(u32) -> u32,
        cancelled: IsCancelled<'_>,
    ) -> Option<Vec<u32>> {
        let mut new = Vec::with_capacity(order.len() + self.inserted.len());
        let mut removed = self.removed.iter().peekable();
        let mut inserted = self.inserted.iter().peekable();
        for (place, &index) in order.iter().enumerate() {
            if polls_at(place) && cancelled() {
                return None;
            }
            while let Some((_, inserted)) = inserted.next_if(|(before, _)| *before <= place) {
                new.push(*inserted);
            }
            if removed.next_if_eq(&&place).is_none() {
                new.push(renumbered(index));
            }
        }
        new.extend(inserted.map(|(_, index)| *index));
        Some(new)
    }
}
