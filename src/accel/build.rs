//! Building the tree: wide nodes straight from the boxes, top down.

use arrayvec::ArrayVec;
use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::Aabb;

use super::node::{Bounds, Child, Node, WIDTH};
use super::split::{Cancelled, Extent, Patience, Reference, by_area, by_count};
use super::{Bvh, RUN};

/// Levels of nodes divided by area; good trees of 2³² boxes have fewer. Below them nodes are divided
/// by count.
const AREA_LEVELS: usize = 12;

/// The most levels of nodes: a node divided by count passes on an eighth at most, rounded up, of
/// fewer than 2³² boxes, and 8¹¹ = 2³³.
pub(super) const LEVELS: usize = AREA_LEVELS + 11;

/// The most boxes in a leaf: as many as are visited at once. Leaves of four take as long to walk, but
/// longer to build, and 65 bytes more a box.
const LEAF: usize = RUN;

/// References from which the children of a node are built as tasks.
const PARALLEL: usize = 2048;

/// Boxes that are looked at between two checks: about a millisecond.
const SORTED: usize = 65_536;

/// References below which a subtree is built without asking whether to stop: about 0.2 ms.
const QUIET: usize = 1024;

/// See [`Bvh::build`].
pub(super) fn build(
    count: usize,
    aabb: &(impl Fn(u32) -> Aabb + Sync),
    cancelled: &(impl Fn() -> bool + Sync),
) -> Result<Bvh, Cancelled> {
    let patience = Patience(cancelled);
    patience.check()?;
    let count = u32::try_from(count).unwrap_or(u32::MAX);
    let (reference, spread) = median_centre(count, aabb);
    let (mut references, unbounded) = sort_out(count, aabb, reference, &patience)?;
    let mut nodes = Vec::new();
    if !references.is_empty() {
        let extent = Extent::of(&references, &patience)?;
        let whole = Part::new(extent, 0, references.len());
        let mut spare: Vec<_> = references.par_iter().copied().collect();
        grow(
            &mut references,
            &mut spare,
            &whole,
            0,
            &patience,
            &mut nodes,
        )?;
    }
    nodes.shrink_to_fit();
    let mut order = Vec::with_capacity(references.len() + unbounded.len());
    order.par_extend(references.par_iter().map(|reference| reference.index));
    order.extend(unbounded);
    Ok(Bvh {
        reference,
        spread,
        farthest: nodes.first().map_or(0.0, Node::farthest),
        nodes,
        order,
        bounded: references.len(),
        moved: 0,
    })
}

/// The median of the boxes' centres along each axis, or of a thousand of them, which is near most boxes
/// wherever a few far ones are; and the median of the largest coordinates of their ways from there.
fn median_centre(count: u32, aabb: impl Fn(u32) -> Aabb) -> (DVec3, f64) {
    let step = count as usize / 1000 + 1;
    let centres = (0..count).step_by(step).map(|index| aabb(index).centre());
    let centres: Vec<DVec3> = centres.filter(|centre| centre.is_finite()).collect();
    let median = |of: &dyn Fn(&DVec3) -> f64| {
        let mut values: Vec<f64> = centres.iter().map(of).collect();
        values.sort_unstable_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    };
    let middle = DVec3::new(median(&|c| c.x), median(&|c| c.y), median(&|c| c.z));
    let spread = median(&|centre| (centre - middle).abs().max_element());
    (middle, spread)
}

/// The boxes to build from, and the indices of those without finite planes.
fn sort_out(
    count: u32,
    aabb: &(impl Fn(u32) -> Aabb + Sync),
    reference: DVec3,
    patience: &Patience<impl Fn() -> bool + Sync>,
) -> Result<(Vec<Reference>, Vec<u32>), Cancelled> {
    let mut references = Vec::with_capacity(count as usize);
    let mut unbounded = Vec::new();
    for first in (0..count).step_by(SORTED) {
        patience.check()?;
        let sorted = references.len();
        let part = first..count.min(first.saturating_add(SORTED as u32));
        references.par_extend(part.into_par_iter().map(|index| {
            let aabb = aabb(index);
            let bounds = if is_empty(&aabb) {
                Bounds::EMPTY
            } else {
                Bounds::around(aabb, reference)
            };
            Reference { bounds, index }
        }));
        let is_plain = |reference: &Reference| reference.bounds.is_finite();
        if references[sorted..].par_iter().all(is_plain) {
            continue;
        }
        for reference in references.split_off(sorted) {
            if is_plain(&reference) {
                references.push(reference);
            } else if !is_empty(&aabb(reference.index)) {
                unbounded.push(reference.index);
            }
        }
    }
    Ok((references, unbounded))
}

/// Whether a box holds nothing; one that is not a number may hold anything.
fn is_empty(aabb: &Aabb) -> bool {
    aabb.max.cmplt(aabb.min).any()
}

/// A run of the references.
#[derive(Clone, Copy)]
struct Part {
    extent: Extent,
    /// Half the surface of its box.
    half_area: f64,
    first: usize,
    count: usize,
}

impl Part {
    fn new(extent: Extent, first: usize, count: usize) -> Self {
        Self {
            half_area: extent.bounds.half_area(),
            extent,
            first,
            count,
        }
    }
}

/// Appends the node of `part`, whose references are given, and all below it. What is in `spare`, of
/// the same length, is of no account.
fn grow(
    references: &mut [Reference],
    spare: &mut [Reference],
    part: &Part,
    level: usize,
    patience: &Patience<impl Fn() -> bool + Sync>,
    nodes: &mut Vec<Node>,
) -> Result<(), Cancelled> {
    if QUIET <= part.count {
        patience.check()?;
    }
    let number = nodes.len();
    nodes.push(Node::EMPTY);
    // With a lane for each there is nothing to choose.
    if part.count <= WIDTH {
        for (lane, reference) in references.iter().enumerate() {
            let leaf = Child::Leaf {
                first: (part.first + lane) as u32,
                count: 1,
            };
            nodes[number].put(lane, &reference.bounds, leaf);
        }
        return Ok(());
    }
    let parts = divide(references, spare, part, level, patience)?;
    let mut rest = (references, spare);
    let mut inner = ArrayVec::<_, WIDTH>::new();
    for (lane, part) in parts.iter().enumerate() {
        let (own, references) = rest.0.split_at_mut(part.count);
        let (own_spare, spare) = rest.1.split_at_mut(part.count);
        rest = (references, spare);
        if part.count <= LEAF {
            let leaf = Child::Leaf {
                first: part.first as u32,
                count: part.count as u8,
            };
            nodes[number].put(lane, &part.extent.bounds, leaf);
        } else {
            inner.push((lane, part, own, own_spare));
        }
    }
    if PARALLEL <= part.count {
        let inner: Vec<_> = inner.into_iter().collect();
        let trees: Result<Vec<_>, Cancelled> = inner
            .into_par_iter()
            .map(|(lane, part, own, spare)| {
                let mut nodes = Vec::new();
                grow(own, spare, part, level + 1, patience, &mut nodes)?;
                Ok((lane, part, nodes))
            })
            .collect();
        let trees = trees?;
        let mut ends = Vec::with_capacity(trees.len());
        let mut end = nodes.len();
        for (lane, part, tree) in &trees {
            let child = Child::Inner(end as u32);
            nodes[number].put(*lane, &part.extent.bounds, child);
            end += tree.len();
            ends.push(end);
        }
        patience.check()?;
        nodes.par_extend((nodes.len()..end).into_par_iter().map(|at| {
            let of = ends.partition_point(|&end| end <= at);
            let tree = &trees[of].2;
            let first = ends[of] - tree.len();
            let mut node = tree[at - first].clone();
            node.shift(first as u32);
            node
        }));
    } else {
        for (lane, part, own, spare) in inner {
            let child = Child::Inner(nodes.len() as u32);
            nodes[number].put(lane, &part.extent.bounds, child);
            grow(own, spare, part, level + 1, patience, nodes)?;
        }
    }
    Ok(())
}

/// Divides a part into up to [`WIDTH`], in order. Empty lanes cost a ray nothing, so parts are
/// divided as long as there is room, down to single boxes, those of the largest area first.
fn divide(
    references: &mut [Reference],
    spare: &mut [Reference],
    whole: &Part,
    level: usize,
    patience: &Patience<impl Fn() -> bool + Sync>,
) -> Result<ArrayVec<Part, WIDTH>, Cancelled> {
    let mut parts = ArrayVec::new();
    parts.push(*whole);
    while parts.len() < WIDTH {
        let Some(at) = next_to_divide(&parts, level) else {
            break;
        };
        let Part {
            extent,
            first,
            count,
            ..
        } = parts[at];
        let start = first - whole.first;
        let own = &mut references[start..start + count];
        let half = if level < AREA_LEVELS {
            by_area(own, &mut spare[start..start + count], &extent, patience)?
        } else {
            by_count(own, &extent)
        };
        let (left, right) = own.split_at(half);
        parts[at] = Part::new(Extent::of(left, patience)?, first, half);
        let right = Part::new(Extent::of(right, patience)?, first + half, count - half);
        parts.insert(at + 1, right);
    }
    Ok(parts)
}

/// The part that gains most by being divided: of those with more than one box, the one with the
/// largest area, then the most boxes; only the most boxes where the tree is too deep.
fn next_to_divide(parts: &[Part], level: usize) -> Option<usize> {
    let key = |part: &Part| {
        let area = if level < AREA_LEVELS {
            part.half_area
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
