//! A tree whose boxes follow the few that moved, divided as it was.

use super::Bvh;
use super::node::{Bounds, Child, Node, WIDTH};
use crate::geometry::Aabb;

/// The most boxes that are followed at once: each is looked for among all.
const MOST: usize = 16;

/// Of so many boxes one may have moved since the tree was built: what is divided as if things were
/// elsewhere costs rays time.
const MOVED: usize = 1024;

/// See [`Bvh::refitted`].
pub(super) fn refit(bvh: &Bvh, changed: &[u32], aabb: impl Fn(u32) -> Aabb) -> Option<Bvh> {
    let moved = bvh.moved + changed.len();
    if MOST < changed.len() || bvh.order.len() / MOVED < moved {
        return None;
    }
    let bounds = |index: u32| Bounds::around(aabb(index), bvh.reference);
    let fits = |&index: &u32| !aabb(index).is_empty() && bounds(index).is_finite();
    if !changed.iter().all(fits) {
        return None;
    }
    let bounded = &bvh.order[..bvh.bounded];
    let place = |index: &u32| bounded.iter().position(|held| held == index);
    let places: Vec<usize> = changed.iter().map(place).collect::<Option<_>>()?;
    let mut parents = vec![(0, 0); bvh.nodes.len()];
    let mut leaves = Vec::new();
    for (number, node) in bvh.nodes.iter().enumerate() {
        for lane in 0..WIDTH {
            match node.child(lane) {
                Child::Inner(child) => parents[child as usize] = (number, lane),
                Child::Leaf { first, count } => {
                    let run = first as usize..first as usize + usize::from(count);
                    if places.iter().any(|place| run.contains(place)) {
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
        let held = &bvh.order[first as usize..][..usize::from(count)];
        let around = |sum: Bounds, &index: &u32| sum.union(&bounds(index));
        let own = held.iter().fold(Bounds::EMPTY, around);
        nodes[number].put(lane, &own, child);
        // A root is not below any node.
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

/// The box around all that is in a node; a missing child's is empty.
fn whole(node: &Node) -> Bounds {
    let all = (0..WIDTH).map(|lane| node.bounds(lane));
    all.fold(Bounds::EMPTY, |sum, bounds| sum.union(&bounds))
}
