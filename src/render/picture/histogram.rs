//! How bright the pixels of a picture are, and how many exceed what is displayed.

use rayon::prelude::*;

use super::display::luminance;
use scene::Rgb;

/// Stops of the scale below and above 1.
pub const HISTOGRAM_STOPS: [i32; 2] = [-8, 4];

/// Bins in each stop.
const PER_STOP: i32 = 2;

/// The number of bins.
const BINS: usize = ((HISTOGRAM_STOPS[1] - HISTOGRAM_STOPS[0]) * PER_STOP) as usize;

/// The luminances of pixels in half stops, from 8 stops below 1 to 4 above.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// Pixels in each half stop.
    pub bins: [u32; BINS],
    /// The share of pixels below the scale, 0 to 1: at most the last level of 8 bits, or black.
    pub dark: f64,
    /// The share of pixels with a channel above 1, 0 to 1.
    pub clipped: f64,
}

/// Counts of some pixels.
#[derive(Clone, Copy)]
struct Counts {
    bins: [u32; BINS],
    dark: usize,
    clipped: usize,
}

impl Histogram {
    /// Counts the linear colours of pixels after an exposure in stops.
    pub fn of(values: &[[f32; 3]], stops: f64) -> Self {
        /// Pixels counted by a thread at once.
        const CHUNK: usize = 1 << 14;
        let scale = libm::exp2(stops);
        let counts = values.par_chunks(CHUNK).map(|values| {
            let mut counts = Counts::NONE;
            for value in values {
                counts.add(scale * Rgb::from(value.map(f64::from)));
            }
            counts
        });
        let Counts {
            bins,
            dark,
            clipped,
        } = counts.reduce(|| Counts::NONE, Counts::and);
        let share = |count: usize| count as f64 / values.len().max(1) as f64;
        Self {
            bins,
            dark: share(dark),
            clipped: share(clipped),
        }
    }
}

impl Counts {
    const NONE: Self = Self {
        bins: [0; BINS],
        dark: 0,
        clipped: 0,
    };

    fn add(&mut self, colour: Rgb) {
        self.clipped += usize::from(1.0 < colour.max_element());
        let stops = libm::log2(luminance(colour));
        let place = (stops - f64::from(HISTOGRAM_STOPS[0])) * f64::from(PER_STOP);
        if 0.0 <= place {
            self.bins[(place as usize).min(BINS - 1)] += 1;
        } else {
            // NaN too, which is displayed black.
            self.dark += 1;
        }
    }

    fn and(mut self, other: Self) -> Self {
        for (bin, other) in self.bins.iter_mut().zip(other.bins) {
            *bin += other;
        }
        self.dark += other.dark;
        self.clipped += other.clipped;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_counted_by_half_stops() {
        let greys = [0.0, 0.001, 0.25, 0.25, 0.75, 1.0, 1.5, 1e9].map(|grey| [grey; 3]);
        let counted = |values: &[[f32; 3]], stops| {
            let Histogram {
                bins,
                dark,
                clipped,
            } = Histogram::of(values, stops);
            let filled = (0..).zip(bins).filter(|(_, count)| 0 < *count);
            (filled.collect::<Vec<_>>(), dark, clipped)
        };
        // 0.25 is 6 stops above the scale's beginning, 1 is 8; the last bin has no end.
        assert_eq!(
            counted(&greys, 0.0),
            (
                vec![(12, 2), (15, 1), (16, 1), (17, 1), (23, 1)],
                0.25,
                0.25
            )
        );
        // A stop brighter: 0.001 enters the scale only three stops later.
        assert_eq!(
            counted(&greys[2..5], 1.0),
            (vec![(14, 2), (17, 1)], 0.0, 1.0 / 3.0)
        );
        let red = [[2.0, 0.0, 0.0], [f32::NAN; 3]];
        assert_eq!(counted(&red, 0.0), (vec![(13, 1)], 0.5, 0.5));
        assert_eq!(counted(&[], 0.0), (vec![], 0.0, 0.0));
    }
}
