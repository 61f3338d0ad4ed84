//! Means over the squares around pixels.

use std::array;

use rayon::prelude::*;

use super::Mixed;
use super::alike::{Lights, Surfaces, TINY, likeness, load};
use super::features::Features;
use super::neighbours::square;
use super::plane::{MARGIN, Plane};
use geometry::lanes::{Level, Simd, SimdBase, Singles, WIDTH, dispatch};

/// The pixels that a mean is over.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around {
    /// The vector instructions to use.
    pub(super) level: Level,
    /// Rows and columns on either side.
    pub(super) reach: usize,
    /// The standard deviations of light that count as one, where that is to be alike as surfaces are.
    pub(super) tolerance: Option<f32>,
}

/// The means of light and of the numbers beside it, each of which counts as at most that of `most` at
/// the middle.
pub(super) fn mean(from: &Mixed, most: &Plane, features: &Features<'_>, around: Around) -> Mixed {
    let layout = features.layout;
    let mut mean = Mixed::zero(layout);
    let rows = mean.bands(layout, 1).enumerate();
    rows.for_each(|(y, into)| {
        if (layout.cancelled)() {
            return;
        }
        let pictures = (from, most, features);
        dispatch!(around.level, simd => match around.tolerance {
            None => row::<false, _>(simd, pictures, around, y, into),
            Some(_) => row::<true, _>(simd, pictures, around, y, into),
        });
    });
    mean
}

/// The means of a row.
#[inline(always)]
fn row<const BY_LIGHT: bool, S: Simd>(
    simd: S,
    (from, most, features): (&Mixed, &Plane, &Features<'_>),
    around: Around,
    y: usize,
    into: [&mut [f32]; 4],
) {
    let layout = features.layout;
    let Around {
        reach, tolerance, ..
    } = around;
    let tolerance = tolerance.unwrap_or(1.0);
    let sharpness = 1.0 / (tolerance * tolerance);
    let [red, green, blue, beside] = into;
    let zero = Singles::splat(simd, 0.0);
    for x in (0..layout.width).step_by(WIDTH) {
        let at = layout.row(y) + x;
        let own = Surfaces::load(simd, features, at);
        let own_light = Lights::load(simd, from, at);
        let slack = load(simd, &features.slack, at);
        let most = load(simd, most, at);
        let (mut weights, mut light, mut number) = (zero, [zero; 3], zero);
        for (place, by) in square(features, reach, [x, y]) {
            let other = Lights::load(simd, from, place);
            let surfaces = Surfaces::load(simd, features, place);
            let mut weight = own.likeness(&surfaces, by, slack);
            if BY_LIGHT {
                let distance = own_light.distance(&other).max_precise(zero);
                weight *= likeness(distance * sharpness);
            }
            weights += weight;
            light = array::from_fn(|channel| light[channel] + weight * other.light[channel]);
            number += weight * other.beside.min_precise(most);
        }
        let share = 1.0 / weights.max_precise(Singles::splat(simd, TINY));
        let rows = [&mut *red, green, blue, beside];
        let [r, g, b] = light;
        for (row, sum) in rows.into_iter().zip([r, g, b, number]) {
            (sum * share).store_slice(&mut row[MARGIN + x..][..WIDTH]);
        }
    }
}
