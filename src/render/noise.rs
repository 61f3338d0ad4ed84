//! How far a picture still is from the one that more samples would give.
//!
//! Where a pass doubles a pixel's samples, its two halves are two estimates of the same colour. The
//! deviation of their mean is half their difference: half the root of the sum of two equal variances
//! is the deviation of each over √2, which is that of the mean of both. Where samples are spread
//! better than at random, both halves together are better still than this says.

use super::frame::Settings;
use super::steps::Step;
use super::tone::displayed;
use crate::scene::{Rgb, Transfer};

/// The errors of pixels that a pass doubles the samples of, as they are displayed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Doubling {
    /// Samples of each half.
    half: f64,
    transfer: Transfer,
}

impl Doubling {
    /// What a step tells, if it adds as many samples of light as there are.
    pub(crate) fn of(step: &Step, settings: &Settings) -> Option<Self> {
        let Step::Samples(indices) = step else {
            return None;
        };
        let doubles = indices.end == 2 * indices.start && settings.aov.is_none();
        doubles.then(|| Self {
            half: f64::from(indices.start),
            transfer: settings.transfer,
        })
    }

    /// The squared error of a pixel, of the channel where it is largest, by its sums of radiance
    /// before the pass and after.
    pub(crate) fn squared_error(self, before: Rgb, after: Rgb) -> f64 {
        let mean = |sum: Rgb| displayed(sum / self.half, self.transfer);
        let error = 0.5 * (mean(before) - mean(after - before)).abs().max_element();
        error * error
    }
}
