//! Building the tree: wide nodes straight from the boxes, top down.

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::Aabb;

use super::Bvh;
use super::node::{Bounds, Child, Node, WIDTH};
use super::split::{CHUNK, Cancelled, Extent, Patience, Reference, by_area, by_count};

/// Levels of nodes divided by area; good trees of 2³² boxes have fewer. Below them nodes are divided
/// by count.
const AREA_LEVELS: usize = 12;

/// The most levels of nodes: a node divided by count passes on an eighth at most, rounded up, of
/// fewer than 2³² boxes, and 8¹¹ = 2³³.
pub(super) const LEVELS: usize = AREA_LEVELS + 11;

/// The most boxes in a leaf. More than these get a node of their own.
const LEAF: usize = 4;

/// References from which the children of a node are built as tasks.
const PARALLEL: usize = CHUNK;

/// References below which a subtree is built without asking whether to stop: about 0.2 ms.
const QUIET: usize = 1024;

/// See [`Bvh::build`].
pub(super) fn build(
    boxes: &[Aabb],
    cancelled: &(impl Fn() -> bool + Sync),
) -> Result<Bvh, Cancelled> {
    let patience = Patience(cancelled);
    patience.check()?;
    let boxes = &boxes[..boxes.len().min(u32::MAX as usize)];
    let reference = median_centre(boxes);
    let (mut references, unbounded) = sort_out(boxes, reference, &patience)?;
    let mut nodes = Vec::new();
    if !references.is_empty() {
        let whole = Part {
            extent: Extent::of(&references, &patience)?,
            first: 0,
            count: references.len(),
        };
        grow(&mut references, &whole, 0, &patience, &mut nodes)?;
    }
    nodes.shrink_to_fit();
    let mut order = Vec::with_capacity(references.len() + unbounded.len());
    order.par_extend(references.par_iter().map(|reference| reference.index));
    order.extend(unbounded);
    Ok(Bvh {
        reference,
        nodes,
        order,
        bounded: references.len(),
    })
}

/// The median of the boxes' centres along each axis, or of a thousand of them: near most boxes,
/// wherever a few far ones are.
fn median_centre(boxes: &[Aabb]) -> DVec3 {
    let step = boxes.len() / 1000 + 1;
    let centres = boxes.iter().step_by(step).map(|aabb| aabb.centre());
    let centres: Vec<DVec3> = centres.filter(|centre| centre.is_finite()).collect();
    let median = |axis: usize| {
        let mut values: Vec<f64> = centres.iter().map(|centre| centre[axis]).collect();
        values.sort_unstable_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    };
    DVec3::new(median(0), median(1), median(2))
}

/// The boxes to build from, and the indices of those without finite planes.
fn sort_out(
    boxes: &[Aabb],
    reference: DVec3,
    patience: &Patience<impl Fn() -> bool + Sync>,
) -> Result<(Vec<Reference>, Vec<u32>), Cancelled> {
    let chunks = boxes.par_chunks(CHUNK).enumerate();
    let parts: Result<Vec<_>, Cancelled> = chunks
        .map(|(number, chunk)| {
            patience.check()?;
            let mut bounded = Vec::with_capacity(chunk.len());
            let mut unbounded = Vec::new();
            let first = number * CHUNK;
            for (index, aabb) in (first..).zip(chunk) {
                let index = index as u32;
                let bounds = Bounds::around(*aabb, reference);
                if is_empty(aabb) {
                    continue;
                }
                if bounds.is_finite() {
                    bounded.push(Reference { bounds, index });
                } else {
                    unbounded.push(index);
                }
            }
            Ok((bounded, unbounded))
        })
        .collect();
    let mut references = Vec::with_capacity(boxes.len());
    let mut unbounded = Vec::new();
    for part in parts? {
        patience.check()?;
        references.extend(part.0);
        unbounded.extend(part.1);
    }
    Ok((references, unbounded))
}

/// Whether a box holds nothing; one that is not a number may hold anything.
fn is_empty(aabb: &Aabb) -> bool {
    aabb.max.cmplt(aabb.min).any()
}

/// A run of the references.
struct Part {
    extent: Extent,
    first: usize,
    count: usize,
}

/// Appends the node of `part`, whose references are given, and all below it.
fn grow(
    references: &mut [Reference],
    part: &Part,
    level: usize,
    patience: &Patience<impl Fn() -> bool + Sync>,
    nodes: &mut Vec<Node>,
) -> Result<(), Cancelled> {
    if QUIET <= part.count {
        patience.check()?;
    }
    let parts = divide(references, part, level, patience)?;
    let number = nodes.len();
    nodes.push(Node::EMPTY);
    let mut rest = references;
    let mut inner = Vec::with_capacity(WIDTH);
    for (lane, part) in parts.iter().enumerate() {
        let (own, after) = rest.split_at_mut(part.count);
        rest = after;
        if part.count <= LEAF {
            let leaf = Child::Leaf {
                first: part.first as u32,
                count: part.count as u8,
            };
            nodes[number].put(lane, &part.extent.bounds, leaf);
        } else {
            inner.push((lane, part, own));
        }
    }
    if PARALLEL <= part.count {
        let trees: Result<Vec<_>, Cancelled> = inner
            .into_par_iter()
            .map(|(lane, part, own)| {
                let mut nodes = Vec::new();
                grow(own, part, level + 1, patience, &mut nodes)?;
                Ok((lane, part, nodes))
            })
            .collect();
        for (lane, part, mut tree) in trees? {
            patience.check()?;
            let child = nodes.len() as u32;
            nodes[number].put(lane, &part.extent.bounds, Child::Inner(child));
            for node in &mut tree {
                node.shift(child);
            }
            nodes.append(&mut tree);
        }
    } else {
        for (lane, part, own) in inner {
            let child = Child::Inner(nodes.len() as u32);
            nodes[number].put(lane, &part.extent.bounds, child);
            grow(own, part, level + 1, patience, nodes)?;
        }
    }
    Ok(())
}

/// Divides a part into up to [`WIDTH`], in order. Empty lanes cost a ray nothing, so parts are
/// divided as long as there is room, down to single boxes, those of the largest area first.
fn divide(
    references: &mut [Reference],
    whole: &Part,
    level: usize,
    patience: &Patience<impl Fn() -> bool + Sync>,
) -> Result<Vec<Part>, Cancelled> {
    let mut parts = Vec::with_capacity(WIDTH);
    parts.push(Part { ..*whole });
    while parts.len() < WIDTH {
        let Some(at) = next_to_divide(&parts, level) else {
            break;
        };
        let Part {
            extent,
            first,
            count,
        } = parts[at];
        let start = first - whole.first;
        let own = &mut references[start..start + count];
        let half = if level < AREA_LEVELS {
            by_area(own, &extent, patience)?
        } else {
            by_count(own, &extent)
        };
        let (left, right) = own.split_at(half);
        parts[at] = Part {
            extent: Extent::of(left, patience)?,
            first,
            count: half,
        };
        let right = Part {
            extent: Extent::of(right, patience)?,
            first: first + half,
            count: count - half,
        };
        parts.insert(at + 1, right);
    }
    Ok(parts)
}

/// The part that gains most by being divided: of those with more than one box, the one with the
/// largest area, then the most boxes; only the most boxes where the tree is too deep.
fn next_to_divide(parts: &[Part], level: usize) -> Option<usize> {
    let key = |part: &Part| {
        let area = if level < AREA_LEVELS {
            part.extent.bounds.half_area()
        } else {
            0.0
        };
        (area, part.count)
    };
    let candidates = (0..parts.len()).filter(|&at| 1 < parts[at].count);
    candidates.max_by(|&a, &b| {
        let (a, b) = (key(&parts[a]), key(&parts[b]));
        a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
    })
}
