//! The structural similarity index of Wang, Bovik, Sheikh and Simoncelli, Image Quality Assessment:
//! From Error Visibility to Structural Similarity (2004), equations 13 to 17: Gaussian weights with
//! a standard deviation of 1.5 in a window of 11 × 11 pixels, K₁ = 0.01, K₂ = 0.03, L = 255. It is
//! averaged over the windows that lie within the picture, and over red, green and blue.

use super::blur::{Plane, kernel, normalised};
use scene::Image;

/// Pixels on each side of a window's centre.
const RADIUS: usize = 5;
const DEVIATION: f64 = 1.5;
const C1: f64 = (0.01 * 255.0) * (0.01 * 255.0);
const C2: f64 = (0.03 * 255.0) * (0.03 * 255.0);

/// What is needed of one picture: a channel, its local mean and its local variance.
#[derive(Debug)]
pub(super) struct Moments {
    plane: Plane,
    mean: Plane,
    variance: Plane,
}

impl Moments {
    /// Those of a channel.
    pub(super) fn of(image: &Image, channel: usize) -> Self {
        let plane = Plane::of(image, |pixel| f64::from(pixel[channel]));
        let mean = mean_of(&plane);
        let variance = covariance([&plane, &plane], [&mean, &mean]);
        Self {
            plane,
            mean,
            variance,
        }
    }
}

/// The mean structural similarity of two pictures of the same size, given the similarity of each channel;
/// `None` if no window fits.
pub(super) fn mean(similarity: impl Fn(usize) -> Plane) -> Option<f64> {
    let means = (0..3).map(|channel| similarity(channel).inner_mean(RADIUS));
    Some(means.sum::<Option<f64>>()? / 3.0)
}

/// The similarity of the window around each pixel.
pub(super) fn of_channel(a: &Moments, b: &Moments) -> Plane {
    let deviations = a.variance.with(&b.variance, |a, b| a + b + C2);
    let both = covariance([&a.plane, &b.plane], [&a.mean, &b.mean]);
    let likeness = both.with(&deviations, |both, deviations| {
        (2.0 * both + C2) / deviations
    });
    let luminance = a
        .mean
        .with(&b.mean, |a, b| (2.0 * a * b + C1) / (a * a + b * b + C1));
    product(&luminance, &likeness)
}

fn mean_of(plane: &Plane) -> Plane {
    let weights = normalised(&kernel(RADIUS, |x| (-0.5 * (x / DEVIATION).powi(2)).exp()));
    plane.convolved(&weights, &weights)
}

/// The mean of a·b less the product of the means; of a plane with itself, its variance.
fn covariance([a, b]: [&Plane; 2], [mean_a, mean_b]: [&Plane; 2]) -> Plane {
    let both = mean_of(&product(a, b));
    both.with(&product(mean_a, mean_b), |both, apart| both - apart)
}

fn product(a: &Plane, b: &Plane) -> Plane {
    a.with(b, |a, b| a * b)
}
