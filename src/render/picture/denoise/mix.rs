//! Mixing of pixels whose surroundings are alike.

use std::ops::Range;

use rayon::prelude::*;

use super::Mixed;
use super::alike::{Lights, Surfaces, TINY, likeness, load};
use super::features::Features;
use super::plane::{MARGIN, Plane};
use geometry::lanes::{Level, Simd, SimdBase, Singles, WIDTH, dispatch};

/// Rows that are mixed together: with more, fewer are compared twice, and with fewer, they stay in a
/// processor's cache.
const ROWS: usize = 16;

/// Standard deviations of light that count as one. Any number from 1.5 to 2 does.
const TOLERANCE: f32 = 1.8;

/// Keeps means over patches without alike surfaces defined.
const LEAST_WEIGHT: f32 = 1e-6;

/// How neighbours are weighted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kernel<'k> {
    /// The vector instructions to use.
    pub(super) level: Level,
    /// Weights by distance in rows or columns, from 0.
    pub(super) taps: &'k [f32],
    /// Pixels between taps.
    pub(super) step: usize,
}

/// A neighbour of pixels.
#[derive(Clone, Copy, Debug)]
struct Neighbour {
    /// Pixels across and down.
    by: [isize; 2],
    /// Its weight if it is alike.
    tap: f32,
}

impl Kernel<'_> {
    /// Row by row.
    fn neighbours(self) -> impl Iterator<Item = Neighbour> {
        let reach = self.taps.len() as isize - 1;
        let tap = move |place: isize| self.taps[place.unsigned_abs()];
        let row = move |down| (-reach..=reach).map(move |across| [across, down]);
        let places = (-reach..=reach).flat_map(row);
        places.map(move |by| Neighbour {
            by: by.map(|place| place * self.step as isize),
            tap: tap(by[0]) * tap(by[1]),
        })
    }
}

/// Mixes the light of each pixel with that of others as far as their patches, the squares of nine
/// pixels around both, are alike: a single pixel tells little of what noise hides. Where the surfaces of
/// a patch differ, it tells nothing. The numbers beside the light are its variances.
///
/// Comparing single pixels, `lamp.xml` by Whitted with 16 samples has a third more error, and paths have
/// as much. Patches of 25 pixels, or all within three to five pixels at once instead of in iterations,
/// leave more where edges are near; going back towards the input as far as Stein's unbiased estimate of
/// the error advises spoils paths and gains nothing elsewhere.
pub(super) fn mix(from: &Mixed, features: &Features<'_>, kernel: Kernel<'_>) -> Mixed {
    let layout = features.layout;
    let mut mixed = Mixed::zero(layout);
    let bands = mixed.bands(layout, ROWS).enumerate();
    bands.for_each_init(
        || Compared::new(layout.stride),
        |compared, (band, mut into)| {
            let first = band * ROWS;
            let rows = first..layout.height.min(first + ROWS);
            compared.weights.fill(0.0);
            for neighbour in kernel.neighbours() {
                if (layout.cancelled)() {
                    return;
                }
                let pictures = (from, features);
                dispatch!(kernel.level, simd => {
                    compared.compare(simd, pictures, rows.clone(), neighbour);
                    compared.add(simd, pictures, rows.clone(), neighbour, &mut into);
                });
            }
            dispatch!(kernel.level, simd => compared.divide(simd, &mut into));
        },
    );
    mixed
}

/// Rows compared with a neighbour.
struct Compared {
    /// How alike their surfaces are, from the row above the first to that below the last.
    likeness: Plane,
    /// How far apart their light is, times the likeness.
    apart: Plane,
    /// The sums of the weights so far.
    weights: Plane,
}

impl Compared {
    fn new(stride: usize) -> Self {
        Self {
            likeness: vec![0.0; (ROWS + 2) * stride],
            apart: vec![0.0; (ROWS + 2) * stride],
            weights: vec![0.0; ROWS * stride],
        }
    }

    /// Compares rows, and those above and below, with their neighbour.
    #[inline(always)]
    fn compare<S: Simd>(
        &mut self,
        simd: S,
        (from, features): (&Mixed, &Features<'_>),
        rows: Range<usize>,
        Neighbour { by, .. }: Neighbour,
    ) {
        let layout = features.layout;
        let likeness = self.likeness.chunks_exact_mut(layout.stride);
        let into = likeness.zip(self.apart.chunks_exact_mut(layout.stride));
        for (row, (likeness, apart)) in into.take(rows.len() + 2).enumerate() {
            let y = (rows.start + row).wrapping_sub(1);
            let other = y.wrapping_add_signed(by[1]);
            if layout.height <= y || layout.height <= other {
                likeness.fill(0.0);
                apart.fill(0.0);
                continue;
            }
            for x in (0..layout.width).step_by(WIDTH) {
                let at = layout.row(y) + x;
                let place = (layout.row(other) + x).wrapping_add_signed(by[0]);
                let own = Surfaces::load(simd, features, at);
                let surfaces = Surfaces::load(simd, features, place);
                let slack = load(simd, &features.slack, at);
                let alike = own.likeness(&surfaces, by.map(|by| by as f32), slack);
                let light = Lights::load(simd, from, at);
                let distance = light.distance(&Lights::load(simd, from, place));
                alike.store_slice(&mut likeness[MARGIN + x..][..WIDTH]);
                (alike * distance).store_slice(&mut apart[MARGIN + x..][..WIDTH]);
            }
        }
    }

    /// Adds the light of the neighbour as far as it is alike.
    #[inline(always)]
    fn add<S: Simd>(
        &mut self,
        simd: S,
        (from, features): (&Mixed, &Features<'_>),
        rows: Range<usize>,
        Neighbour { by, tap }: Neighbour,
        into: &mut [&mut [f32]; 4],
    ) {
        const SHARPNESS: f32 = 1.0 / (TOLERANCE * TOLERANCE);
        let layout = features.layout;
        let zero = Singles::splat(simd, 0.0);
        for (row, y) in rows.enumerate() {
            let other = y.wrapping_add_signed(by[1]);
            if layout.height <= other {
                continue;
            }
            for x in (0..layout.width).step_by(WIDTH) {
                let place = (layout.row(other) + x).wrapping_add_signed(by[0]);
                let [alike, apart] = self.patch(simd, layout.row(row) + x);
                let distance = (apart / (alike + LEAST_WEIGHT)).max_precise(zero);
                let middle = layout.row(row + 1) + x;
                let own = Lights::load(simd, from, layout.row(y) + x);
                let neighbour = Lights::load(simd, from, place);
                let weight = load(simd, &self.likeness, middle)
                    * likeness(distance * SHARPNESS)
                    * own.trust(&neighbour)
                    * tap;
                let at = layout.row(row) + x;
                let [red, green, blue] = neighbour.light.map(|light| weight * light);
                let numbers = [red, green, blue, weight * weight * neighbour.beside];
                for (sum, number) in into.iter_mut().zip(numbers) {
                    (load(simd, sum, at) + number).store_slice(&mut sum[at..][..WIDTH]);
                }
                let weights = &mut self.weights;
                (load(simd, weights, at) + weight).store_slice(&mut weights[at..][..WIDTH]);
            }
        }
    }

    /// The sums over patches whose upper rows are at this place.
    #[inline(always)]
    fn patch<S: Simd>(&self, simd: S, above: usize) -> [Singles<S>; 2] {
        let stride = self.weights.len() / ROWS;
        [&self.likeness, &self.apart].map(|plane| {
            let row =
                |at| load(simd, plane, at - 1) + load(simd, plane, at) + load(simd, plane, at + 1);
            row(above) + row(above + stride) + row(above + 2 * stride)
        })
    }

    /// Makes means of sums.
    #[inline(always)]
    fn divide<S: Simd>(&self, simd: S, into: &mut [&mut [f32]; 4]) {
        let tiny = Singles::splat(simd, TINY);
        for at in (0..into[0].len()).step_by(WIDTH) {
            let share = 1.0 / load(simd, &self.weights, at).max_precise(tiny);
            for sum in into.iter_mut() {
                (load(simd, sum, at) * share).store_slice(&mut sum[at..][..WIDTH]);
            }
            // Twice in turn: the square of the share of no weights is infinite.
            let variances = &mut into[3];
            (load(simd, variances, at) * share).store_slice(&mut variances[at..][..WIDTH]);
        }
    }
}
