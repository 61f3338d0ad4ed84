//! Builds the tree: wide nodes directly from the boxes, top down.

use arrayvec::ArrayVec;
use glam::DVec3;
use rayon::prelude::*;

use geometry::{Aabb, IsCancelled};

use super::node::{Bounds, Child, Node, WIDTH};
use super::split::{CHUNK, CancelCheck, Cancelled, Extent, Halves, Reference, by_area, by_count};
use super::{Bvh, RUN};

/// The number of levels divided by area, more than good trees of 2³² boxes have. Nodes below them
/// are divided by count.
const AREA_LEVELS: usize = 12;

/// The maximum number of levels: a node divided by count leaves each child at most an eighth of its
/// boxes, rounded up, of fewer than 2³², and 8¹¹ = 2³³.
pub(super) const LEVELS: usize = AREA_LEVELS + 11;

/// The maximum number of boxes in a leaf: those visited at once. Leaves of four are traversed as
/// fast, but take longer to build and 65 bytes more per box.
const LEAF: usize = RUN;

/// The minimum number of references for building the children of a node in parallel.
const PARALLEL: usize = 2048;

/// The maximum number of boxes. Every node of more than eight boxes has eight children, so there is at most
/// one node for seven boxes: a node's number and a lane fit into 32 bits.
const MOST_BOXES: usize = 1 << 31;

/// The number of references filled between two cancellation checks, a few milliseconds: 4 MB, more than a
/// huge page for each of two threads. Threads that first touch the same huge page wait for each other, or
/// both clear it.
const BATCH: usize = 1 << 17;

/// Subtrees of fewer references are built without cancellation checks: about 0.2 ms.
const UNCHECKED: usize = 1024;

/// See [`Bvh::build`].
pub(super) fn build(
    count: usize,
    aabb: &(impl Fn(u32) -> Aabb + Sync),
    cancelled: IsCancelled<'_>,
) -> Result<Bvh, Cancelled> {
    let cancel = CancelCheck(cancelled);
    cancel.check()?;
    let count = count.min(MOST_BOXES) as u32;
    let (reference, spread) = median_centre(count, aabb);
    let (mut references, unbounded) = collect_references(count, aabb, reference, &cancel)?;
    let bounded = references.len();
    let mut nodes = Vec::new();
    if !references.is_empty() {
        let extent = Extent::of(&references, &cancel)?;
        let whole = Subset::new(extent, 0, bounded);
        add_spare(&mut references, &cancel)?;
        let (references, spare) = references.split_at_mut(bounded);
        let pieces = pieces(references, spare, &whole, 0, &cancel)?;
        nodes = joined(&pieces, &cancel)?;
    }
    let mut order = in_batches(bounded, &cancel, |at| references[at].index())?;
    order.extend(unbounded);
    Ok(Bvh {
        reference,
        spread,
        farthest: nodes.first().map_or(0.0, Node::farthest),
        nodes,
        order,
        bounded,
        moved: 0,
    })
}

/// Returns the median of about a thousand of the boxes' centres along each axis, near most boxes
/// regardless of a few far ones, and the median of their Chebyshev distances from it.
fn median_centre(count: u32, aabb: impl Fn(u32) -> Aabb) -> (DVec3, f64) {
    let step = count as usize / 1000 + 1;
    let centres = (0..count).step_by(step).map(|index| aabb(index).centre());
    let centres: Vec<DVec3> = centres.filter(|centre| centre.is_finite()).collect();
    let [x, y, z] = [0, 1, 2].map(|axis| median(centres.iter().map(|centre| centre[axis])));
    let middle = DVec3::new(x, y, z);
    let distance = |centre: &DVec3| (centre - middle).abs().max_element();
    (middle, median(centres.iter().map(distance)))
}

/// The upper median; 0 of none.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// Returns the nonempty boxes with finite planes, and the indices of those without.
fn collect_references(
    count: u32,
    aabb: &(impl Fn(u32) -> Aabb + Sync),
    reference: DVec3,
    cancel: &CancelCheck<'_>,
) -> Result<(Vec<Reference>, Vec<u32>), Cancelled> {
    // With room for scratch, see `add_spare`.
    let mut references = Vec::with_capacity(2 * count as usize);
    let mut unbounded = Vec::new();
    let referred = |index| {
        let aabb = aabb(index);
        let bounds = if is_empty(&aabb) {
            Bounds::EMPTY
        } else {
            Bounds::around(aabb, reference)
        };
        Reference::new(bounds, index)
    };
    for first in (0..count).step_by(BATCH) {
        cancel.check()?;
        let start = references.len();
        let part = first..count.min(first.saturating_add(BATCH as u32));
        let empty = Reference::new(Bounds::EMPTY, 0);
        references.par_extend(rayon::iter::repeat_n(empty, part.len()));
        let chunks = references[start..].par_chunks_mut(CHUNK).enumerate();
        // Boxes may take long to compute.
        chunks.try_for_each(|(chunk, references)| {
            cancel.check()?;
            let indices = first + (chunk * CHUNK) as u32..;
            for (reference, index) in references.iter_mut().zip(indices) {
                *reference = referred(index);
            }
            Ok(())
        })?;
        let is_bounded = |reference: &Reference| reference.bounds.is_finite();
        if references[start..].par_iter().all(is_bounded) {
            continue;
        }
        for reference in references.split_off(start) {
            if is_bounded(&reference) {
                references.push(reference);
            } else if !is_empty(&aabb(reference.index())) {
                unbounded.push(reference.index());
            }
        }
    }
    Ok((references, unbounded))
}

/// Adds as many references again, as scratch. One allocation for both is large enough, for a million
/// boxes, for glibc to return it to the system at once.
fn add_spare(references: &mut Vec<Reference>, cancel: &CancelCheck<'_>) -> Result<(), Cancelled> {
    let (count, any) = (references.len(), references[0]);
    for first in (0..count).step_by(BATCH) {
        cancel.check()?;
        let size = BATCH.min(count - first);
        references.par_extend(rayon::iter::repeat_n(any, size));
    }
    Ok(())
}

/// Whether a box is empty; a box with NaN may contain anything.
fn is_empty(aabb: &Aabb) -> bool {
    aabb.max.cmplt(aabb.min).any()
}

/// Computes items from their indices, in parallel batches with a cancellation check before each.
fn in_batches<T: Send>(
    count: usize,
    cancel: &CancelCheck<'_>,
    item: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>, Cancelled> {
    let mut items = Vec::with_capacity(count);
    // As many bytes as a batch of references.
    let batch = BATCH * size_of::<Reference>() / size_of::<T>();
    for first in (0..count).step_by(batch) {
        cancel.check()?;
        let part = first..count.min(first + batch);
        items.par_extend(part.into_par_iter().map(&item));
    }
    Ok(items)
}

/// A run of references.
#[derive(Clone, Copy)]
struct Subset {
    extent: Extent,
    /// Half the surface area of its box.
    half_area: f64,
    first: usize,
    count: usize,
}

impl Subset {
    fn new(extent: Extent, first: usize, count: usize) -> Self {
        Self {
            half_area: extent.bounds.half_area(),
            extent,
            first,
            count,
        }
    }
}

/// A run of consecutive nodes of the tree. Their inner children are numbered from its first node.
struct Piece {
    /// The number of its first node.
    first: usize,
    nodes: Vec<Node>,
}

/// Builds the subtree of `part` from its references, as consecutive pieces. `spare` is scratch of equal
/// length.
///
/// Pieces are joined once, at the end, so that nodes are not copied again at each level.
fn pieces(
    references: &mut [Reference],
    spare: &mut [Reference],
    part: &Subset,
    level: usize,
    cancel: &CancelCheck<'_>,
) -> Result<Vec<Piece>, Cancelled> {
    if part.count < PARALLEL {
        let mut nodes = Vec::new();
        grow(references, spare, part, level, cancel, &mut nodes)?;
        return Ok(vec![Piece { first: 0, nodes }]);
    }
    cancel.check()?;
    let mut root = Node::EMPTY;
    let parts = divide(references, spare, part, level, cancel)?;
    let inner = inner_parts(&mut root, &parts, references, spare);
    let trees: Result<Vec<_>, Cancelled> = inner
        .into_iter()
        .collect::<Vec<_>>()
        .into_par_iter()
        .map(|(lane, part, own, spare)| {
            let pieces = pieces(own, spare, part, level + 1, cancel)?;
            Ok((lane, part, pieces))
        })
        .collect();
    let mut all = vec![Piece {
        first: 0,
        nodes: Vec::new(),
    }];
    let mut end = 1;
    for (lane, part, pieces) in trees? {
        root.put(lane, &part.extent.bounds, Child::Inner(end as u32));
        let start = end;
        for piece in pieces {
            let first = start + piece.first;
            end = first + piece.nodes.len();
            all.push(Piece { first, ..piece });
        }
    }
    all[0].nodes.push(root);
    Ok(all)
}

/// The nodes of all pieces.
fn joined(pieces: &[Piece], cancel: &CancelCheck<'_>) -> Result<Vec<Node>, Cancelled> {
    let end = pieces
        .last()
        .map_or(0, |piece| piece.first + piece.nodes.len());
    let node = |number| {
        let after = pieces.partition_point(|piece| piece.first <= number);
        let Piece { first, nodes } = &pieces[after - 1];
        let mut node = nodes[number - first].clone();
        node.shift(*first as u32);
        node
    };
    in_batches(end, cancel, node)
}

/// Appends the subtree of `part`, as [`pieces`].
fn grow(
    references: &mut [Reference],
    spare: &mut [Reference],
    part: &Subset,
    level: usize,
    cancel: &CancelCheck<'_>,
    nodes: &mut Vec<Node>,
) -> Result<(), Cancelled> {
    if UNCHECKED <= part.count {
        cancel.check()?;
    }
    let number = nodes.len();
    nodes.push(Node::EMPTY);
    // Each box has its own lane: there is nothing to choose.
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
    let parts = divide(references, spare, part, level, cancel)?;
    let inner = inner_parts(&mut nodes[number], &parts, references, spare);
    for (lane, part, own, spare) in inner {
        let child = Child::Inner(nodes.len() as u32);
        nodes[number].put(lane, &part.extent.bounds, child);
        grow(own, spare, part, level + 1, cancel, nodes)?;
    }
    Ok(())
}

/// A part that needs a node of its own: its lane, and its references and scratch.
type Inner<'p> = (usize, &'p Subset, &'p mut [Reference], &'p mut [Reference]);

/// Puts the parts that are leaves into their lanes of a node, and returns the others.
fn inner_parts<'p>(
    node: &mut Node,
    parts: &'p [Subset],
    references: &'p mut [Reference],
    spare: &'p mut [Reference],
) -> ArrayVec<Inner<'p>, WIDTH> {
    let mut rest = (references, spare);
    let mut inner = ArrayVec::new();
    for (lane, part) in parts.iter().enumerate() {
        let (own, references) = rest.0.split_at_mut(part.count);
        let (own_spare, spare) = rest.1.split_at_mut(part.count);
        rest = (references, spare);
        if part.count <= LEAF {
            let leaf = Child::Leaf {
                first: part.first as u32,
                count: part.count as u8,
            };
            node.put(lane, &part.extent.bounds, leaf);
        } else {
            inner.push((lane, part, own, own_spare));
        }
    }
    inner
}

/// Divides a part into up to [`WIDTH`] parts, in order. Empty lanes cost a ray nothing, so parts
/// are divided, largest area first, until all lanes are used or all parts are single boxes.
///
/// Rejected: keeping eight boxes or fewer together unless both parts have less area than the whole (a
/// third fewer leaves among a million triangles, and camera and shadow rays take 4 % less time, but
/// whole frames do not).
fn divide(
    references: &mut [Reference],
    spare: &mut [Reference],
    whole: &Subset,
    level: usize,
    cancel: &CancelCheck<'_>,
) -> Result<ArrayVec<Subset, WIDTH>, Cancelled> {
    let mut parts = ArrayVec::new();
    parts.push(*whole);
    while parts.len() < WIDTH {
        let Some(at) = next_to_divide(&parts, level) else {
            break;
        };
        let Subset {
            extent,
            first,
            count,
            ..
        } = parts[at];
        let start = first - whole.first;
        let own = &mut references[start..start + count];
        let halves = if level < AREA_LEVELS {
            by_area(own, &mut spare[start..start + count], &extent, cancel)?
        } else {
            let half = by_count(own, &extent);
            Halves::of(own, half, cancel)?
        };
        let half = halves.first;
        let [left, right] = halves.extents;
        parts[at] = Subset::new(left, first, half);
        parts.insert(at + 1, Subset::new(right, first + half, count - half));
    }
    Ok(parts)
}

/// The part that gains most by a division: of those with more than one box, the one with the
/// largest area, then the most boxes; beyond [`AREA_LEVELS`], the one with the most boxes.
fn next_to_divide(parts: &[Subset], level: usize) -> Option<usize> {
    let key = |part: &Subset| {
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
