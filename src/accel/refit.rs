//! Refits a tree to a few moved boxes without changing its topology.

use super::node::{Bounds, Child, Node, WIDTH};
use super::{Bvh, polls_at};
use geometry::{Aabb, IsCancelled};

/// The maximum number of boxes moved at once: each is searched for among all.
const MAX_MOVED: usize = 16;

/// One of this many boxes may have moved since the tree was built: an outdated topology slows rays
/// down.
const BOXES_PER_MOVE: usize = 1024;

/// See [`Bvh::refitted`].
pub(super) fn refit(
    bvh: &Bvh,
    changed: &[u32],
    aabb: impl Fn(u32) -> Aabb,
    cancelled: IsCancelled<'_>,
) -> Option<Bvh> {
    if !may_change(bvh, changed.len()) {
        return None;
    }
    let bounds = |index: u32| Bounds::around(aabb(index), bvh.reference);
    let fits = |&index: &u32| !aabb(index).is_empty() && bounds(index).is_finite();
    if !changed.iter().all(fits) {
        return None;
    }
    let bounded = &bvh.order[..bvh.bounded];
    let find = |index: &u32| {
        let place = bounded.iter().position(|other| other == index);
        place.filter(|_| !cancelled())
    };
    let positions: Vec<usize> = changed.iter().map(find).collect::<Option<_>>()?;
    let mut leaves = Vec::new();
    for (number, node) in bvh.nodes.iter().enumerate() {
        if polls_at(number) && cancelled() {
            return None;
        }
        for lane in 0..WIDTH {
            if let Child::Leaf { first, count } = node.child(lane) {
                let run = first as usize..first as usize + usize::from(count);
                if positions.iter().any(|position| run.contains(position)) {
                    leaves.push((number, lane));
                }
            }
        }
    }
    let mut nodes = copied(&bvh.nodes, cancelled)?;
    let parents = Parents::of(&nodes, cancelled)?;
    for (number, lane) in leaves {
        let child = nodes[number].child(lane);
        let Child::Leaf { first, count } = child else {
            continue;
        };
        let indices = &bvh.order[first as usize..][..usize::from(count)];
        let around = |sum: Bounds, &index: &u32| sum.union(&bounds(index));
        let own = indices.iter().fold(Bounds::EMPTY, around);
        nodes[number].put(lane, &own, child);
        parents.enclose(&mut nodes, number);
    }
    Some(Bvh {
        reference: bvh.reference,
        spread: bvh.spread,
        farthest: nodes.first().map_or(0.0, Node::farthest),
        nodes,
        order: copied(&bvh.order, cancelled)?,
        bounded: bvh.bounded,
        moved: bvh.moved + changed.len(),
    })
}

/// Copies part by part; `None` once `cancelled` returns true.
pub(super) fn copied<T: Clone>(items: &[T], cancelled: IsCancelled<'_>) -> Option<Vec<T>> {
    /// Up to a few megabytes.
    const PART: usize = 1 << 14;
    let mut copy = Vec::with_capacity(items.len());
    for part in items.chunks(PART) {
        if cancelled() {
            return None;
        }
        copy.extend_from_slice(part);
    }
    Some(copy)
}

/// Whether `count` more boxes may change before a new tree is better.
pub(super) fn may_change(bvh: &Bvh, count: usize) -> bool {
    count <= MAX_MOVED && bvh.moved + count <= bvh.order.len() / BOXES_PER_MOVE
}

/// The place of each node but the root: the number of the node above it, and the lane there.
pub(super) struct Parents(Vec<(usize, usize)>);

impl Parents {
    /// `None` once `cancelled` returns true.
    pub(super) fn of(nodes: &[Node], cancelled: IsCancelled<'_>) -> Option<Self> {
        let mut places = vec![(0, 0); nodes.len()];
        for (number, node) in nodes.iter().enumerate() {
            if polls_at(number) && cancelled() {
                return None;
            }
            for lane in 0..WIDTH {
                if let Child::Inner(child) = node.child(lane) {
                    places[child as usize] = (number, lane);
                }
            }
        }
        Some(Self(places))
    }

    /// Adapts the boxes of a node whose children have changed, and of those above it.
    pub(super) fn enclose(&self, nodes: &mut [Node], mut number: usize) {
        // The root has no parent.
        while number != 0 {
            let whole = whole(&nodes[number]);
            let (above, lane) = self.0[number];
            let child = nodes[above].child(lane);
            nodes[above].put(lane, &whole, child);
            number = above;
        }
    }
}

/// The union of the children's boxes; a missing child's is empty.
fn whole(node: &Node) -> Bounds {
    let all = (0..WIDTH).map(|lane| node.bounds(lane));
    all.fold(Bounds::EMPTY, |sum, bounds| sum.union(&bounds))
}
