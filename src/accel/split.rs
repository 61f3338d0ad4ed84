//! Divides boxes in two by the binned surface area heuristic.
//!
//! After Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies" (RT 2007). Bins are
//! merged by minimum, maximum and integer sum, so they do not depend on the distribution of work.

use rayon::prelude::*;

use super::bins::{BINS, Bins, FEW, Gathered, Grid};
use super::node::Bounds;
use geometry::IsCancelled;

/// A box to be inserted into the tree, with its index: half a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Reference {
    /// The fourth lane of `low`, meaningless in unions, holds the bits of the index.
    pub(super) bounds: Bounds,
}

impl Reference {
    /// Changes the bits of an index below a billion to those of a normal number: subnormal numbers take
    /// long to multiply.
    const NORMAL: u32 = 1 << 30;

    /// A box with its index among all.
    pub(super) fn new(mut bounds: Bounds, index: u32) -> Self {
        bounds.low[3] = f32::from_bits(index ^ Self::NORMAL);
        Self { bounds }
    }

    /// The index of the box.
    pub(super) fn index(&self) -> u32 {
        self.bounds.low[3].to_bits() ^ Self::NORMAL
    }
}

/// The error of a cancelled build.
#[derive(Debug)]
pub(super) struct Cancelled;

/// The caller's cancellation callback, as a check that fails. A trait object, since it is called
/// once per chunk: with a type parameter, the builder would be compiled again for each caller.
pub(super) struct CancelCheck<'a>(pub(super) IsCancelled<'a>);

impl CancelCheck<'_> {
    pub(super) fn check(&self) -> Result<(), Cancelled> {
        if (self.0)() { Err(Cancelled) } else { Ok(()) }
    }
}

/// The number of references between two checks, and the smallest parallel task: about 0.2 ms.
pub(super) const CHUNK: usize = 8192;

/// With at least this many references, only the axis along which the centres spread most is considered.
/// Rejected: all three axes up to 256 references (building takes 1.5 times as long, and rays are at
/// most 0.4 % faster); all three for any number, with 64 bins (three times as long; rays are 4 %
/// faster among a million triangles, not at all among spheres).
const MANY: usize = 16;

/// The number of references above which they are partitioned in parallel.
const SHARED: usize = 65_536;

/// The bounds of some references, and of their centres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub(super) bounds: Bounds,
    pub(super) centres: Bounds,
}

impl Gathered for Extent {
    const EMPTY: Self = Self {
        bounds: Bounds::EMPTY,
        centres: Bounds::EMPTY,
    };

    #[inline]
    fn add(&mut self, bounds: &Bounds) {
        let centre = bounds.centre();
        self.bounds = self.bounds.union(bounds);
        self.centres = self.centres.union(&Bounds {
            low: centre,
            high: centre,
        });
    }

    #[inline]
    fn union(&self, other: &Self) -> Self {
        Self {
            bounds: self.bounds.union(&other.bounds),
            centres: self.centres.union(&other.centres),
        }
    }

    #[inline]
    fn bounds(&self) -> &Bounds {
        &self.bounds
    }
}

impl Extent {
    /// Computes the extent of references.
    pub(super) fn of(
        references: &[Reference],
        cancel: &CancelCheck<'_>,
    ) -> Result<Self, Cancelled> {
        if references.len() <= CHUNK {
            return Ok(Self::measure(references));
        }
        let chunks = in_chunks(references, cancel, Self::measure)?;
        Ok(chunks.iter().fold(Self::EMPTY, |all, one| all.union(one)))
    }

    fn measure(chunk: &[Reference]) -> Self {
        let mut extent = Self::EMPTY;
        for reference in chunk {
            extent.add(&reference.bounds);
        }
        extent
    }

    /// The axis of the widest spread of centres.
    fn widest(&self) -> usize {
        let width = |axis: usize| self.centres.high[axis] - self.centres.low[axis];
        let wider = usize::from(width(0) < width(1));
        if width(wider) < width(2) { 2 } else { wider }
    }
}

/// References divided in two nonempty parts.
pub(super) struct Halves {
    /// The length of the first part.
    pub(super) first: usize,
    pub(super) extents: [Extent; 2],
}

impl Halves {
    /// Computes the extents of parts.
    pub(super) fn of(
        references: &[Reference],
        first: usize,
        cancel: &CancelCheck<'_>,
    ) -> Result<Self, Cancelled> {
        let (left, right) = references.split_at(first);
        let extents = [Extent::of(left, cancel)?, Extent::of(right, cancel)?];
        Ok(Self { first, extents })
    }
}

/// Divides the references into two nonempty parts at the least cost by the heuristic, or in halves
/// if all centres coincide. `spare` is scratch space of the same length.
pub(super) fn by_area(
    references: &mut [Reference],
    spare: &mut [Reference],
    extent: &Extent,
    cancel: &CancelCheck<'_>,
) -> Result<Halves, Cancelled> {
    let count = references.len();
    let widest = [extent.widest()];
    let division = match count {
        // There is only one way.
        2 => return Halves::of(references, 1, cancel),
        0..MANY => {
            let division =
                cheapest::<Bounds, 3, { BINS / 2 }>([0, 1, 2], references, extent, cancel)?;
            let first = match division {
                Some(division) => partition(references, spare, cancel, &division)?,
                None => count / 2,
            };
            // Gathering extents along three axes would compute them three times.
            return Halves::of(references, first, cancel);
        }
        MANY..FEW => cheapest::<Extent, 1, { BINS / 2 }>(widest, references, extent, cancel)?,
        _ => cheapest::<Extent, 1, BINS>(widest, references, extent, cancel)?,
    };
    match division {
        Some(division) => Ok(Halves {
            first: partition(references, spare, cancel, &division)?,
            extents: division.parts,
        }),
        None => Halves::of(references, count / 2, cancel),
    }
}

/// Divides the references in halves by their centres along the widest axis, and returns the length
/// of the first.
pub(super) fn by_count(references: &mut [Reference], extent: &Extent) -> usize {
    let axis = extent.widest();
    let half = references.len() / 2;
    references.select_nth_unstable_by(half, |a, b| {
        let [a_centre, b_centre] = [a, b].map(|reference| reference.bounds.middle(axis));
        a_centre
            .total_cmp(&b_centre)
            .then(a.index().cmp(&b.index()))
    });
    half
}

/// A division: boxes with centres in the bins before `bin` go to the first part.
struct Division<G> {
    axis: usize,
    grid: Grid,
    bin: usize,
    parts: [G; 2],
    /// The number of boxes in the first part of each chunk, if there are several.
    counts: Vec<usize>,
}

impl<G> Division<G> {
    /// Whether a reference belongs to the first part.
    #[inline]
    fn is_first(&self, reference: &Reference) -> bool {
        let centre = reference.bounds.middle(self.axis);
        self.grid.is_before(centre, self.bin)
    }
}

/// The cheapest division along one of the given axes; `None` if all centres share a bin on each.
fn cheapest<G: Gathered, const AXES: usize, const COUNT: usize>(
    axes: [usize; AXES],
    references: &[Reference],
    extent: &Extent,
    cancel: &CancelCheck<'_>,
) -> Result<Option<Division<G>>, Cancelled> {
    let grids = axes.map(|axis| Grid::new(&extent.centres, axis, COUNT));
    let put = |rows: &mut [Bins<G, COUNT>; AXES], chunk: &[Reference]| {
        for Reference { bounds } in chunk {
            for (at, row) in rows.iter_mut().enumerate() {
                row.put(grids[at].bin(bounds.middle(axes[at])), bounds);
            }
        }
    };
    let mut rows = [const { Bins::EMPTY }; AXES];
    let mut chunks = Vec::new();
    if references.len() <= CHUNK {
        put(&mut rows, references);
    } else {
        chunks = in_chunks(references, cancel, |chunk| {
            let mut rows = [const { Bins::EMPTY }; AXES];
            put(&mut rows, chunk);
            rows
        })?;
        for others in &chunks {
            for (row, other) in rows.iter_mut().zip(others) {
                row.merge(other);
            }
        }
    }
    let mut least = f64::INFINITY;
    let mut best = None;
    for (at, row) in rows.iter().enumerate() {
        let (cost, bin) = row.cheapest();
        if cost < least {
            least = cost;
            best = Some((at, bin));
        }
    }
    Ok(best.map(|(at, bin)| Division {
        axis: axes[at],
        grid: grids[at],
        bin,
        parts: rows[at].parts(bin),
        counts: chunks.iter().map(|rows| rows[at].count(bin)).collect(),
    }))
}

/// Measures chunks of references in parallel, with a check before each.
fn in_chunks<T: Send>(
    references: &[Reference],
    cancel: &CancelCheck<'_>,
    measure: impl Fn(&[Reference]) -> T + Sync,
) -> Result<Vec<T>, Cancelled> {
    let chunks = references.par_chunks(CHUNK).map(|chunk| {
        cancel.check()?;
        Ok(measure(chunk))
    });
    chunks.collect()
}

/// Stably moves the references of the first part to the front, and returns their number.
fn partition<G: Sync>(
    references: &mut [Reference],
    spare: &mut [Reference],
    cancel: &CancelCheck<'_>,
    division: &Division<G>,
) -> Result<usize, Cancelled> {
    const { assert!(CHUNK <= SHARED, "larger sets are counted in chunks") };
    let is_first = |reference: &Reference| division.is_first(reference);
    if references.len() <= SHARED {
        return Ok(partition_alone(references, spare, is_first));
    }
    let count = division.counts.iter().sum();
    let mut rest = spare.split_at_mut(count);
    let mut parts = Vec::with_capacity(division.counts.len());
    for (chunk, &count) in references.chunks(CHUNK).zip(&division.counts) {
        let (front, fronts) = rest.0.split_at_mut(count);
        let (back, backs) = rest.1.split_at_mut(chunk.len() - count);
        rest = (fronts, backs);
        parts.push((chunk, front, back));
    }
    parts.into_par_iter().try_for_each(|(chunk, front, back)| {
        cancel.check()?;
        let (mut front, mut back) = (front.iter_mut(), back.iter_mut());
        for one in chunk {
            let side = if is_first(one) { &mut front } else { &mut back };
            if let Some(slot) = side.next() {
                *slot = *one;
            }
        }
        // Bins and sides agree, see `Grid::is_before`.
        assert!(front.len() == 0 && back.len() == 0);
        Ok(())
    })?;
    let moved = spare.par_chunks(CHUNK);
    let pairs = references.par_chunks_mut(CHUNK).zip(moved);
    pairs.try_for_each(|(to, from)| {
        cancel.check()?;
        to.copy_from_slice(from);
        Ok(())
    })?;
    Ok(count)
}

/// The same on one thread, without branches, half of which would be mispredicted.
fn partition_alone(
    references: &mut [Reference],
    spare: &mut [Reference],
    belongs_first: impl Fn(&Reference) -> bool,
) -> usize {
    let (mut front, mut back) = (0, 0);
    for at in 0..references.len() {
        let one = references[at];
        let is_first = belongs_first(&one);
        references[front] = one;
        spare[back] = one;
        front += usize::from(is_first);
        back += usize::from(!is_first);
    }
    references[front..].copy_from_slice(&spare[..back]);
    front
}
