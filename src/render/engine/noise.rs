//! Estimation of the remaining noise.
//!
//! When a pass doubles a pixel's samples, the two halves are two estimates of the same colour. The
//! standard deviation of their mean is half their difference: half the root of the sum of two equal
//! variances is the deviation of each over √2, which is that of the mean of both. With samples
//! distributed better than at random the actual error is smaller.

use super::pass_schedule::Step;
use crate::job::Settings;
use crate::picture::DisplayTransform;
use scene::Rgb;

/// The difference of means that rounding may cause, as a share of them.
const ROUNDING: f64 = 1e-10;

/// Estimates errors of displayed pixels during a pass that doubles their samples.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Doubling {
    /// Samples in each half.
    half: f64,
    display: DisplayTransform,
}

impl Doubling {
    /// Returns the estimator for a step; `None` unless it doubles samples of radiance.
    pub(crate) fn of(step: &Step, settings: &Settings) -> Option<Self> {
        let Step::Samples(indices) = step else {
            return None;
        };
        let doubles = indices.end == 2 * indices.start && settings.surface().is_none();
        doubles.then(|| Self {
            half: f64::from(indices.start),
            display: DisplayTransform::of(settings),
        })
    }

    /// Returns the squared error of a pixel in its worst channel, from its sums of radiance before
    /// and after the pass.
    pub(crate) fn squared_error(self, before: Rgb, after: Rgb) -> f64 {
        let mean = |sum: Rgb| self.display.displayed(sum / self.half);
        let error = 0.5 * (mean(before) - mean(after - before)).abs().max_element();
        error * error
    }

    /// Returns the variance of a pixel's mean radiance, as the mean of its channels, from its sums
    /// before and after the pass. What rounding makes of equal halves is 0.
    pub(crate) fn variance(self, before: Rgb, after: Rgb) -> f64 {
        let [first, second] = [before, after - before].map(|sum| sum / self.half);
        let error = 0.5 * (first - second);
        let variance = error.length_squared() / 3.0;
        let least = ROUNDING * ROUNDING * (first + second).length_squared();
        if variance <= least { 0.0 } else { variance }
    }
}
