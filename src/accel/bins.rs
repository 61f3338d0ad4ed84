//! Gathers boxes in bins along an axis, and finds the cheapest place between two bins to divide them.

use super::node::Bounds;

/// The maximum number of bins along an axis.
pub(super) const BINS: usize = 16;

/// Fewer references have half as many bins: for few, sweeping the bins is most of the work.
pub(super) const FEW: usize = 64;

/// What is known of some boxes.
pub(super) trait Gathered: Copy + Send {
    /// Of no boxes.
    const EMPTY: Self;

    /// Adds a box.
    fn add(&mut self, bounds: &Bounds);

    /// The same of the boxes of both.
    #[must_use]
    fn union(&self, other: &Self) -> Self;

    /// The smallest box that contains all.
    fn bounds(&self) -> &Bounds;
}

impl Gathered for Bounds {
    const EMPTY: Self = Self::EMPTY;

    #[inline]
    fn add(&mut self, bounds: &Bounds) {
        *self = self.union(bounds);
    }

    #[inline]
    fn union(&self, other: &Self) -> Self {
        self.union(other)
    }

    #[inline]
    fn bounds(&self) -> &Bounds {
        self
    }
}

/// Maps coordinates of centres along an axis to bins.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    low: f32,
    /// Bins per unit of length; infinite for coincident centres.
    scale: f32,
    last: usize,
}

impl Grid {
    pub(super) fn new(centres: &Bounds, axis: usize, count: usize) -> Self {
        let (low, high) = (centres.low[axis], centres.high[axis]);
        Self {
            low,
            scale: count as f32 / (high - low),
            last: count - 1,
        }
    }

    /// The bin of a coordinate; the first for 0 · ∞.
    #[inline]
    pub(super) fn bin(&self, coordinate: f32) -> usize {
        // Of all integer types the conversion to this one takes the fewest instructions.
        let bin = self.position(coordinate) as i32;
        (bin as usize).min(self.last)
    }

    /// Whether a coordinate's bin is before `bin`, which must not be the first.
    #[inline]
    pub(super) fn is_before(&self, coordinate: f32, bin: usize) -> bool {
        let position = self.position(coordinate);
        position < bin as f32 || position.is_nan()
    }

    #[inline]
    fn position(&self, coordinate: f32) -> f32 {
        (coordinate - self.low) * self.scale
    }
}

/// The boxes in each bin along an axis, and their number.
pub(super) struct Bins<G, const COUNT: usize> {
    gathered: [G; COUNT],
    counts: [u32; COUNT],
}

impl<G: Gathered, const COUNT: usize> Bins<G, COUNT> {
    pub(super) const EMPTY: Self = Self {
        gathered: [G::EMPTY; COUNT],
        counts: [0; COUNT],
    };

    #[inline]
    pub(super) fn put(&mut self, bin: usize, bounds: &Bounds) {
        let bin = bin % COUNT;
        self.gathered[bin].add(bounds);
        self.counts[bin] += 1;
    }

    pub(super) fn merge(&mut self, other: &Self) {
        for bin in 0..COUNT {
            self.gathered[bin] = self.gathered[bin].union(&other.gathered[bin]);
            self.counts[bin] += other.counts[bin];
        }
    }

    /// The boxes in the bins before one, and the others.
    pub(super) fn parts(&self, bin: usize) -> [G; 2] {
        let (first, second) = self.gathered.split_at(bin);
        [first, second].map(|bins| bins.iter().fold(G::EMPTY, |all, one| all.union(one)))
    }

    /// The number of boxes in the bins before one.
    pub(super) fn count(&self, bin: usize) -> usize {
        self.counts[..bin].iter().map(|&count| count as usize).sum()
    }

    /// The least cost of a division (infinite if all are in one bin), and its second part's first
    /// bin.
    pub(super) fn cheapest(&self) -> (f64, usize) {
        let mut after = [f64::INFINITY; COUNT];
        let (mut bounds, mut count) = (Bounds::EMPTY, 0);
        for bin in (1..COUNT).rev() {
            bounds = bounds.union(self.gathered[bin].bounds());
            count += self.counts[bin];
            after[bin] = cost(&bounds, count);
        }
        let mut best = (f64::INFINITY, 0);
        (bounds, count) = (Bounds::EMPTY, 0);
        for (bin, after) in after.into_iter().enumerate().skip(1) {
            bounds = bounds.union(self.gathered[bin - 1].bounds());
            count += self.counts[bin - 1];
            let both = cost(&bounds, count) + after;
            if both < best.0 {
                best = (both, bin);
            }
        }
        best
    }
}

/// Half area times count, proportional to the expected work; infinite for no boxes.
#[inline]
fn cost(bounds: &Bounds, count: u32) -> f64 {
    if count == 0 {
        f64::INFINITY
    } else {
        bounds.half_area() * f64::from(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coordinate_before_a_bin_is_in_an_earlier_one() {
        let ranges = [
            (0.0, 1.0),
            (-7.0, 0.1),
            (1.0, 1.0),
            (0.0, 3e-45),
            (-3e38, 3e38),
        ];
        for (low, high) in ranges {
            let centres = Bounds {
                low: [low; 4],
                high: [high; 4],
            };
            let grid = Grid::new(&centres, 0, BINS);
            for step in 0..=1000 {
                let part = step as f32 / 1000.0;
                let coordinate = ((1.0 - part) * low + part * high).clamp(low, high);
                for bin in 1..BINS {
                    let is_earlier = grid.bin(coordinate) < bin;
                    let message = format!("{coordinate} in {low} to {high}, bin {bin}");
                    assert_eq!(grid.is_before(coordinate, bin), is_earlier, "{message}");
                }
            }
        }
    }
}
