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

/// The mean structural similarity of two pictures of the same size; `None` if no window fits.
pub(super) fn mean(a: &Image, b: &Image) -> Option<f64> {
    let means = (0..3).map(|channel| {
        let plane = |image| Plane::of(image, |pixel| f64::from(pixel[channel]));
        of_channel(&plane(a), &plane(b)).inner_mean(RADIUS)
    });
    Some(means.sum::<Option<f64>>()? / 3.0)
}

/// The similarity of the window around each pixel.
fn of_channel(a: &Plane, b: &Plane) -> Plane {
    let weights = normalised(&kernel(RADIUS, |x| (-0.5 * (x / DEVIATION).powi(2)).exp()));
    let mean = |plane: &Plane| plane.convolved(&weights, &weights);
    let product = |a: &Plane, b: &Plane| a.with(b, |a, b| a * b);
    let (mean_a, mean_b) = (mean(a), mean(b));
    // E[ab] − E[a] E[b]; of a plane with itself, its variance.
    let covariance = |a: &Plane, b: &Plane, mean_a: &Plane, mean_b: &Plane| {
        mean(&product(a, b)).with(&product(mean_a, mean_b), |both, apart| both - apart)
    };
    let deviations = covariance(a, a, &mean_a, &mean_a)
        .with(&covariance(b, b, &mean_b, &mean_b), |a, b| a + b + C2);
    let likeness = covariance(a, b, &mean_a, &mean_b).with(&deviations, |both, deviations| {
        (2.0 * both + C2) / deviations
    });
    let luminance = mean_a.with(&mean_b, |a, b| (2.0 * a * b + C1) / (a * a + b * b + C1));
    product(&luminance, &likeness)
}
