//! Refits a tree to a few moved boxes without changing its topology.

use super::Bvh;
use super::node::{Bounds, Child, Node, WIDTH};
use crate::geometry::Aabb;

/// The maximum number of boxes moved at once: each is searched for among all.
const MAX_MOVED: usize = 16;

/// One of this many boxes may have moved since the tree was built: an outdated topology slows rays
/// down.
const BOXES_PER_MOVE: usize = 1024;

/// See [`Bvh::refitted`].
pub(super) fn refit(bvh: &Bvh, changed: &[u32], aabb: impl Fn(u32) -> Aabb) -> Option<Bvh> {
    let moved = bvh.moved + changed.len();
    if MAX_MOVED < changed.len() || bvh.order.len() / BOXES_PER_MOVE < moved {
        return None;
    }
    let bounds = |index: u32| Bounds::around(aabb(index), bvh.reference);
    let fits = |&index: &u32| !aabb(index).is_empty() && bounds(index).is_finite();
    if !changed.iter().all(fits) {
        return None;
    }
    let bounded = &bvh.order[..bvh.bounded];
    let find = |index: &u32| bounded.iter().position(|other| other == index);
    let positions: Vec<usize> = changed.iter().map(find).collect::<Option<_>>()?;
    let mut parents = vec![(0, 0); bvh.nodes.len()];
    let mut leaves = Vec::new();
    for (number, node) in bvh.nodes.iter().enumerate() {
        for lane in 0..WIDTH {
            match node.child(lane) {
                Child::Inner(child) => parents[child as usize] = (number, lane),
                Child::Leaf { first, count } => {
                    let run = first as usize..first as usize + usize::from(count);
                    if positions.iter().any(|position| run.contains(position)) {
                        leaves.push((number, lane));
                    }
                }
            }
        }
    }
    let mut nodes = bvh.nodes.clone();
    for (mut number, mut lane) in leaves {
        let child = nodes[number].child(lane);
        let Child::Leaf { first, count } = child else {
            continue;
        };
        let indices = &bvh.order[first as usize..][..usize::from(count)];
        let around = |sum: Bounds, &index: &u32| sum.union(&bounds(index));
        let own = indices.iter().fold(Bounds::EMPTY, around);
        nodes[number].put(lane, &own, child);
        // The root has no parent.
        while number != 0 {
            let whole = whole(&nodes[number]);
            (number, lane) = parents[number];
            let child = nodes[number].child(lane);
            nodes[number].put(lane, &whole, child);
        }
    }
    Some(Bvh {
        reference: bvh.reference,
        spread: bvh.spread,
        farthest: nodes.first().map_or(0.0, Node::farthest),
        nodes,
        order: bvh.order.clone(),
        bounded: bvh.bounded,
        moved,
    })
}

/// The union of the children's boxes; a missing child's is empty.
fn whole(node: &Node) -> Bounds {
    let all = (0..WIDTH).map(|lane| node.bounds(lane));
    all.fold(Bounds::EMPTY, |sum, bounds| sum.union(&bounds))
}
