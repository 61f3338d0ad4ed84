//! Pixel reconstruction filters, by importance sampling: samples are placed with the density of the
//! filter's weights, so that all count alike and each belongs to one pixel. Tiles need no samples
//! of others.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use scene::Filter;

/// Radius of the filters wider than a pixel, in pixels.
const RADIUS: f64 = 1.5;

/// Standard deviation of the Gaussian, in pixels.
const DEVIATION: f64 = 0.5;

/// Coefficients of the window (Harris, "On the use of windows for harmonic analysis with the
/// discrete Fourier transform", Proceedings of the IEEE 66(1), 1978).
const TERMS: [f64; 4] = [0.35875, 0.48829, 0.14128, 0.01168];

/// Steps from the centre to the end of a filter, interpolated linearly, which changes a pixel at an
/// edge by less than 0.01 of an 8-bit level.
const STEPS: usize = 256;

/// The fraction of a filter, along one axis, within this distance of the centre, in pixels.
fn within(filter: Filter, distance: f64) -> f64 {
    match filter {
        Filter::Box => (2.0 * distance).min(1.0),
        Filter::Gaussian => {
            let normal = |distance: f64| libm::erf(distance * FRAC_1_SQRT_2 / DEVIATION);
            normal(distance) / normal(RADIUS)
        }
        Filter::BlackmanHarris => {
            let angle = PI * distance / RADIUS;
            let [even, first, second, third] = TERMS;
            let waves = first * libm::sin(angle)
                + second * libm::sin(2.0 * angle) / 2.0
                + third * libm::sin(3.0 * angle) / 3.0;
            distance / RADIUS + waves / (PI * even)
        }
    }
}

/// A filter prepared for placing samples.
#[derive(Clone, Debug)]
pub(crate) struct FilterSampler {
    /// The fraction of the filter within each step; empty for the box filter.
    shares: Vec<f64>,
}

impl FilterSampler {
    /// Prepares a filter.
    pub(crate) fn of(filter: Filter) -> Self {
        let at = |step| within(filter, RADIUS * step as f64 / STEPS as f64);
        Self {
            shares: match filter {
                Filter::Box => Vec::new(),
                Filter::Gaussian | Filter::BlackmanHarris => (0..=STEPS).map(at).collect(),
            },
        }
    }

    /// Warps a uniform place in the pixel, 0..1 from its top left, by the inverse of the filter's
    /// distribution along each axis. The centre is a fixed point.
    pub(crate) fn place(&self, even: [f64; 2]) -> [f64; 2] {
        if self.shares.is_empty() {
            return even;
        }
        even.map(|even| {
            let side = 2.0 * even - 1.0;
            0.5 + self.distance(side.abs()).copysign(side)
        })
    }

    /// The distance from the centre within which this fraction of the filter lies.
    fn distance(&self, share: f64) -> f64 {
        let after = self.shares.partition_point(|&within| within <= share);
        let after = after.clamp(1, STEPS);
        let (low, high) = (self.shares[after - 1], self.shares[after]);
        let part = (share - low) / (high - low);
        RADIUS * ((after - 1) as f64 + part) / STEPS as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDE: [Filter; 2] = [Filter::Gaussian, Filter::BlackmanHarris];

    /// Numbers in 0..1, at the midpoints of equal strata.
    fn even(count: u32) -> impl Iterator<Item = f64> {
        (0..count).map(move |k| (f64::from(k) + 0.5) / f64::from(count))
    }

    /// The warped place along one axis.
    fn place(filter_sampler: &FilterSampler, even: f64) -> f64 {
        let [across, down] = filter_sampler.place([even, 1.0 - even]);
        // Near the ends, the inverse magnifies rounding errors a thousandfold.
        assert!((across + down - 1.0).abs() < 1e-11, "{even}");
        across
    }

    #[test]
    fn the_box_filter_is_the_identity() {
        let filter_sampler = FilterSampler::of(Filter::Box);
        for even in even(1000) {
            assert_eq!(filter_sampler.place([even, 0.1]), [even, 0.1]);
        }
    }

    /// The Gaussian truncated at three deviations: sigma² (1 − 2 · 3 phi(3) / erf(3/√2)). The
    /// window: the integral of x² cos(2 pi k x) over −½..½ is (−1)^k / (2 pi² k²).
    #[test]
    fn places_have_the_mean_and_the_variance_of_the_filter() {
        let density = (-4.5f64).exp() / (2.0 * PI).sqrt();
        let gaussian = 0.25 * (1.0 - 6.0 * density / libm::erf(3.0 * FRAC_1_SQRT_2));
        let wave = |k: i32| {
            let term = TERMS[k as usize] / TERMS[0];
            (-1.0f64).powi(k) * term / (2.0 * PI * PI * f64::from(k * k))
        };
        let window = 9.0 * (1.0 / 12.0 + wave(1) + wave(2) + wave(3));
        for (filter, variance) in WIDE.into_iter().zip([gaussian, window]) {
            let filter_sampler = FilterSampler::of(filter);
            let count = 1 << 14;
            let off = || even(count).map(|even| place(&filter_sampler, even) - 0.5);
            let mean = off().sum::<f64>() / f64::from(count);
            let square = off().map(|off| off * off).sum::<f64>() / f64::from(count);
            assert!(mean.abs() < 1e-12, "{filter:?}: {mean}");
            let error = (square - variance).abs();
            assert!(error < 1e-4, "{filter:?}: {square}, not {variance}");
        }
    }

    #[test]
    fn places_increase_monotonically_and_the_centre_is_fixed() {
        for filter in WIDE {
            let filter_sampler = FilterSampler::of(filter);
            let mut last = -RADIUS;
            for even in even(10_000) {
                let off = place(&filter_sampler, even) - 0.5;
                assert!(last < off && off < RADIUS, "{filter:?} {even}: {off}");
                let share = within(filter, off.abs());
                assert!((share - (2.0 * even - 1.0).abs()).abs() < 1e-4);
                last = off;
            }
            assert_eq!(filter_sampler.place([0.5; 2]), [0.5; 2]);
            assert_eq!(
                filter_sampler.place([0.0, 1.0]),
                [0.5 - RADIUS, 0.5 + RADIUS]
            );
        }
    }
}
