//! Planes of numbers and their convolution with separable kernels.

use scene::{Image, Size};

/// A number for each pixel, in rows from the top left.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    size: Size,
    pub(super) values: Vec<f64>,
}

impl Plane {
    /// A plane of a value for each pixel of an image.
    pub(super) fn of(image: &Image, value: impl Fn([u8; 3]) -> f64) -> Self {
        Self {
            size: image.size(),
            values: image.pixels().iter().map(|pixel| value(*pixel)).collect(),
        }
    }

    /// Combines two planes of the same size, value by value.
    pub(super) fn with(&self, other: &Self, combined: impl Fn(f64, f64) -> f64) -> Self {
        let pairs = self.values.iter().zip(&other.values);
        Self {
            size: self.size,
            values: pairs.map(|(a, b)| combined(*a, *b)).collect(),
        }
    }

    /// Convolves rows with one kernel and columns with another, both of odd length. Beyond an edge,
    /// its values go on.
    pub(super) fn convolved(&self, across: &[f64], down: &[f64]) -> Self {
        let [width, height] = [self.size.width, self.size.height].map(|side| side as usize);
        let mut rows = Self {
            size: self.size,
            values: Vec::with_capacity(self.values.len()),
        };
        for row in self.values.chunks_exact(width) {
            rows.values.extend((0..width).map(|x| {
                let taps = neighbours(x, across.len(), width);
                across
                    .iter()
                    .zip(taps)
                    .map(|(weight, at)| weight * row[at])
                    .sum::<f64>()
            }));
        }
        let mut values = vec![0.0; self.values.len()];
        for (y, row) in values.chunks_exact_mut(width).enumerate() {
            for (weight, at) in down.iter().zip(neighbours(y, down.len(), height)) {
                let source = &rows.values[at * width..][..width];
                for (sum, value) in row.iter_mut().zip(source) {
                    *sum += weight * value;
                }
            }
        }
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

/// The places that a kernel of this length covers around a place, moved to the nearest that exist.
fn neighbours(place: usize, length: usize, count: usize) -> impl Iterator<Item = usize> {
    let before = length / 2;
    (0..length).map(move |tap| (place + tap).saturating_sub(before).min(count - 1))
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
