//! How much of a picture exceeds what is displayed, and by how much; or how dark it is.

use rayon::prelude::*;

use scene::Rgb;

/// Half stops above 1 that are told apart: more than exposures permit.
const HALVES: usize = 256;

/// How much of a picture has a channel above 1, where displays clip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Overexposure {
    /// The share of pixels with a channel above 1, 0 to 1.
    pub share: f64,
    /// By how many stops a darker exposure brings the 99th percentile of the pixels' largest channels
    /// to at most 1, rounded up to half stops, 0 to 128.
    pub stops: f64,
    /// The largest finite channel of all pixels; 0 if none is above 0.
    pub brightest: f64,
}

impl Overexposure {
    /// The overexposure of linear colours after the exposure.
    pub fn of(values: &[[f32; 3]]) -> Self {
        Self::of_all(values, |value| Rgb::from(value.map(f64::from)))
    }

    /// The overexposure of values, which `linear` turns into linear colours after the exposure.
    pub(crate) fn of_all<T: Sync>(values: &[T], linear: impl Fn(&T) -> Rgb + Sync) -> Self {
        /// Pixels counted by a thread at once.
        const CHUNK: usize = 1 << 14;
        let parts = values.par_chunks(CHUNK);
        let parts = parts.map(|values| Excess::of(values.iter().map(&linear)));
        Excess::sum(parts).over(values.len())
    }
}

/// What [`Overexposure`] is computed from.
#[derive(Clone, Debug)]
pub(crate) struct Excess {
    /// The numbers of pixels whose largest channel is above 1, by half stops rounded up.
    counts: [usize; HALVES],
    brightest: f64,
}

impl Excess {
    /// Counts linear colours after the exposure.
    pub(crate) fn of(values: impl Iterator<Item = Rgb>) -> Self {
        let mut excess = Self::NONE;
        for value in values.map(Rgb::max_element) {
            if excess.brightest < value && value < f64::INFINITY {
                excess.brightest = value;
            }
            if 1.0 < value {
                let halves = (2.0 * libm::log2(value)).ceil() as usize;
                excess.counts[halves.clamp(1, HALVES) - 1] += 1;
            }
        }
        excess
    }

    /// The counts of no pixels.
    const NONE: Self = Self {
        counts: [0; HALVES],
        brightest: 0.0,
    };

    /// The sum of counts of parts of a picture.
    pub(crate) fn sum(parts: impl ParallelIterator<Item = Self>) -> Self {
        let none = || Self::NONE;
        parts.reduce(none, |mut sum, part| {
            for (sum, part) in sum.counts.iter_mut().zip(part.counts) {
                *sum += part;
            }
            sum.brightest = sum.brightest.max(part.brightest);
            sum
        })
    }

    /// The overexposure of a picture of so many pixels.
    pub(crate) fn over(&self, pixels: usize) -> Overexposure {
        let above: usize = self.counts.iter().sum();
        // A darker exposure takes the lowest bins below 1.
        let mut left = above;
        let enough = self.counts.iter().position(|count| {
            let is_enough = 100 * left <= pixels;
            left -= count;
            is_enough
        });
        Overexposure {
            share: above as f64 / pixels.max(1) as f64,
            stops: 0.5 * enough.unwrap_or(HALVES) as f64,
            brightest: self.brightest,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hundredth_of_the_pixels_may_stay_above_1() {
        let with = |bright: &[f32]| {
            let mut values = vec![[0.5; 3]; 200 - bright.len()];
            values.extend(bright.iter().map(|red| [*red, 0.0, 0.0]));
            let Overexposure { share, stops, .. } = Overexposure::of(&values);
            (200.0 * share, stops)
        };
        assert_eq!(with(&[]), (0.0, 0.0));
        assert_eq!(with(&[1.0, f32::NAN]), (0.0, 0.0));
        assert_eq!(with(&[1e9, f32::INFINITY]), (2.0, 0.0), "one in a hundred");
        assert_eq!(with(&[1e9, 1e9, 1.0001]), (3.0, 0.5));
        assert_eq!(with(&[1e9, 1e9, 2.0, 4.0]), (4.0, 2.0));
        assert_eq!(with(&[1e9, 1e9, 4.001]), (3.0, 2.5));
        assert_eq!(with(&[f32::INFINITY; 3]), (3.0, 128.0));
        assert_eq!(Overexposure::of(&[]), Overexposure::default());
    }

    #[test]
    fn the_brightest_channel_is_the_largest_finite_one() {
        let brightest = |values: &[[f32; 3]]| Overexposure::of(values).brightest;
        assert_eq!(brightest(&[[0.0; 3], [-1.0, 0.25, 0.0], [0.125; 3]]), 0.25);
        assert_eq!(brightest(&[[f32::INFINITY; 3], [0.5, 4.0, 1.0]]), 4.0);
        assert_eq!(brightest(&[[f32::NAN; 3], [-1.0; 3]]), 0.0);
    }
}
