//! Planes of numbers and their convolution with separable kernels. Each value is a sum in a fixed order,
//! so that it is the same whatever the number of threads.

use rayon::prelude::*;

use scene::{Image, Size};

/// How many values a thread takes at least at once.
pub(super) const BLOCK: usize = 4096;

/// A number for each pixel, in rows from the top left.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    size: Size,
    pub(super) values: Vec<f64>,
}

impl Plane {
    /// A plane of a value for each pixel of an image.
    pub(super) fn of(image: &Image, value: impl Fn([u8; 3]) -> f64 + Sync) -> Self {
        let pixels = image.pixels().par_iter().with_min_len(BLOCK);
        Self {
            size: image.size(),
            values: pixels.map(|pixel| value(*pixel)).collect(),
        }
    }

    /// Combines two planes of the same size, value by value.
    pub(super) fn with(&self, other: &Self, combined: impl Fn(f64, f64) -> f64 + Sync) -> Self {
        let values = self.values.par_iter().with_min_len(BLOCK);
        let pairs = values.zip(&other.values);
        Self {
            size: self.size,
            values: pairs.map(|(a, b)| combined(*a, *b)).collect(),
        }
    }

    /// Convolves rows with one kernel and columns with another, both of odd length. Beyond an edge,
    /// its values go on.
    pub(super) fn convolved(&self, across: &[f64], down: &[f64]) -> Self {
        let [width, height] = [self.size.width, self.size.height].map(|side| side as usize);
        let mut rows = vec![0.0; self.values.len()];
        let few = BLOCK.div_ceil(width.max(1));
        let pairs = rows
            .par_chunks_exact_mut(width)
            .zip(self.values.par_chunks_exact(width));
        pairs
            .with_min_len(few)
            .for_each_init(Vec::new, |padded, (sums, row)| {
                padded.clear();
                padded
                    .extend((0..width + across.len() - 1).map(|at| row[before(at, across, width)]));
                add(sums, across, |tap| &padded[tap..]);
            });
        let mut values = vec![0.0; self.values.len()];
        let sums = values.par_chunks_exact_mut(width).with_min_len(few);
        sums.enumerate().for_each(|(y, sums)| {
            add(sums, down, |tap| {
                &rows[before(y + tap, down, height) * width..]
            });
        });
        Self {
            size: self.size,
            values,
        }
    }

    /// The mean of all values that are at least `margin` from every edge; `None` if none is.
    pub(super) fn inner_mean(&self, margin: usize) -> Option<f64> {
        let [width, height] = [self.size.width, self.size.height].map(|side| side as usize);
        let columns = margin..width.checked_sub(margin)?;
        let rows = margin..height.checked_sub(margin)?;
        let count = columns.len() * rows.len();
        let inner = rows.flat_map(|y| &self.values[y * width..][columns.clone()]);
        (0 < count).then(|| inner.sum::<f64>() / count as f64)
    }
}

/// The place that the first tap of a kernel covers around a place, moved to the nearest that exists.
fn before(place: usize, kernel: &[f64], count: usize) -> usize {
    place.saturating_sub(kernel.len() / 2).min(count - 1)
}

/// Adds the values of each tap, weighted, to as many sums. Several taps at once, as the sums are then less
/// often read and written, but in order.
fn add<'v>(sums: &mut [f64], kernel: &[f64], values: impl Fn(usize) -> &'v [f64]) {
    let count = sums.len();
    let groups = kernel.chunks_exact(4);
    let rest = groups.remainder();
    for (group, weights) in groups.enumerate() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|tap| values(4 * group + tap)[..count].iter());
        let taps = a.zip(b).zip(c).zip(d);
        for (sum, (((a, b), c), d)) in sums.iter_mut().zip(taps) {
            *sum = *sum + weights[0] * a + weights[1] * b + weights[2] * c + weights[3] * d;
        }
    }
    for (tap, weight) in rest.iter().enumerate() {
        let values = values(kernel.len() - rest.len() + tap);
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += weight * value;
        }
    }
}

/// The values of a function at the whole numbers from −`radius` to `radius`.
pub(super) fn kernel(radius: usize, weight: impl Fn(f64) -> f64) -> Vec<f64> {
    let radius = radius as i32;
    (-radius..=radius).map(|at| weight(f64::from(at))).collect()
}

/// A kernel whose weights add up to 1.
pub(super) fn normalised(kernel: &[f64]) -> Vec<f64> {
    let sum: f64 = kernel.iter().sum();
    kernel.iter().map(|weight| weight / sum).collect()
}
