//! Weighted means over the neighbours of each pixel.

use std::array;

use rayon::prelude::*;

use super::features::Features;
use super::plane::{MARGIN, Plane};
use crate::geometry::lanes::{Level, Simd, SimdBase, Singles, WIDTH, dispatch};

/// How sharply surfaces are told apart: factors of squared differences of normals and albedos.
const NORMAL: f32 = 64.0;
const ALBEDO: f32 = 1.0;

/// Differences of nearness that count as one standard deviation: as a share of it, and of its change
/// from pixel to pixel.
const NEARNESS: f32 = 0.02;
const SLOPE: f32 = 0.5;

/// How many times noisier light may be and still count in full: a mirror that shows a lamp in some of
/// its samples would light up all around it. Any number from 8 to 32 does; without this, the root
/// mean square error of `caustic.xml` with 16 samples is four times as large. With 1, each weight being
/// the best for its variance, paths with 4 samples have up to a fifth more error: what is brighter
/// by chance seems noisier too, so that all gets too dark.
const NOISIER: f32 = 16.0;

/// Most slack.
const MOST_SLACK: f32 = 1e3;

/// Keeps quotients of zeros defined.
const TINY: f32 = 1e-30;

/// What is mixed: light divided by albedo, and a number beside it.
#[derive(Clone, Debug)]
pub(super) struct Mixed {
    pub(super) light: [Plane; 3],
    /// The variance of the light, as the mean of its channels, or another number.
    pub(super) beside: Plane,
}

/// How neighbours are weighted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kernel<'k> {
    /// The vector instructions to use.
    pub(super) level: Level,
    /// Weights by distance in rows or columns, from 0.
    pub(super) taps: &'k [f32],
    /// Pixels between taps.
    pub(super) step: usize,
    pub(super) alike: Alike,
}

/// What must be alike to mix.
#[derive(Clone, Copy, Debug)]
pub(super) enum Alike {
    /// Surfaces; the numbers beside the light are averaged.
    Surfaces,
    /// Light too, given the standard deviations that count as one; its variances are averaged.
    Variances(f32),
    /// The same; its variances become those of the mixed light.
    Light(f32),
}

/// Mixes the pixels of a picture.
pub(super) fn mix(from: &Mixed, features: &Features<'_>, kernel: Kernel<'_>) -> Mixed {
    let layout = features.layout;
    let plane = || layout.plane(0.0);
    let mut mixed = Mixed {
        light: [plane(), plane(), plane()],
        beside: plane(),
    };
    let [red, green, blue] = &mut mixed.light;
    let planes = [red, green, blue, &mut mixed.beside];
    let [red, green, blue, beside] = planes.map(|plane| plane.par_chunks_exact_mut(layout.stride));
    let rows = (red, green, blue, beside).into_par_iter().enumerate();
    rows.for_each(|(y, (red, green, blue, beside))| {
        if (layout.cancelled)() {
            return;
        }
        let into = [red, green, blue, beside];
        let pictures = (from, features);
        dispatch!(kernel.level, simd => match kernel.alike {
            Alike::Surfaces => row::<false, false, _>(simd, pictures, kernel, y, into),
            Alike::Variances(_) => row::<true, false, _>(simd, pictures, kernel, y, into),
            Alike::Light(_) => row::<true, true, _>(simd, pictures, kernel, y, into),
        });
    });
    mixed
}

/// Mixes the pixels of a row.
#[inline(always)]
fn row<const BY_LIGHT: bool, const MIXES_LIGHT: bool, S: Simd>(
    simd: S,
    (from, features): (&Mixed, &Features<'_>),
    kernel: Kernel<'_>,
    y: usize,
    into: [&mut [f32]; 4],
) {
    let layout = features.layout;
    let reach = kernel.taps.len() - 1;
    let step = kernel.step;
    let tolerance = match kernel.alike {
        Alike::Surfaces => 1.0,
        Alike::Variances(tolerance) | Alike::Light(tolerance) => tolerance,
    };
    let sharpness = 1.0 / (tolerance * tolerance);
    let above = reach.min(y / step);
    let below = reach.min((layout.height - 1 - y) / step);
    let [red, green, blue, beside] = into;
    for x in (0..layout.width).step_by(WIDTH) {
        let at = y * layout.stride + MARGIN + x;
        let own = Surfaces::load(simd, features, at);
        let own_light = Lights::load(simd, from, at);
        let slack = load(simd, &features.slack, at);
        let zero = Singles::splat(simd, 0.0);
        let (mut weights, mut light, mut number) = (zero, [zero; 3], zero);
        for row in 0..=above + below {
            let (first, down) = (at + row * step * layout.stride, row as f32 - above as f32);
            let tap_down = kernel.taps[above.abs_diff(row)];
            for column in 0..=2 * reach {
                let place = first - above * step * layout.stride + column * step - reach * step;
                let across = column as f32 - reach as f32;
                let surfaces = Surfaces::load(simd, features, place);
                let by = [across * step as f32, down * step as f32];
                let other = Lights::load(simd, from, place);
                let space = own.distance(&surfaces, by);
                // No number stays no number.
                let mut distance = space - space.min_precise(slack);
                distance += own.albedo_distance(&surfaces);
                if BY_LIGHT {
                    distance += own_light.distance(&other).max_precise(zero) * sharpness;
                }
                // Close to the exponential of the distance, and 0 from 4 and for what is no number.
                let near = (1.0 - distance * 0.25).max_precise(zero);
                let near = near * near;
                let tap = tap_down * kernel.taps[reach.abs_diff(column)];
                let mut weight = near * near * tap;
                if MIXES_LIGHT {
                    weight *= own_light.trust(&other);
                }
                weights += weight;
                light = array::from_fn(|channel| light[channel] + weight * other.light[channel]);
                let share = if MIXES_LIGHT { weight * weight } else { weight };
                number += share * other.beside;
            }
        }
        let share = 1.0 / weights.max_precise(Singles::splat(simd, TINY));
        number *= if MIXES_LIGHT { share * share } else { share };
        for (row, sum) in [&mut *red, green, blue].into_iter().zip(light) {
            (sum * share).store_slice(&mut row[MARGIN + x..][..WIDTH]);
        }
        number.store_slice(&mut beside[MARGIN + x..][..WIDTH]);
    }
}

/// The surfaces of some pixels side by side.
struct Surfaces<S: Simd> {
    normal: [Singles<S>; 3],
    albedo: [Singles<S>; 3],
    nearness: Singles<S>,
    slope: [Singles<S>; 2],
}

impl<S: Simd> Surfaces<S> {
    #[inline(always)]
    fn load(simd: S, features: &Features<'_>, at: usize) -> Self {
        let three = |planes: &[Plane; 3]| planes.each_ref().map(|plane| load(simd, plane, at));
        Self {
            normal: three(&features.normal),
            albedo: three(&features.albedo),
            nearness: load(simd, &features.nearness, at),
            slope: features.slope.each_ref().map(|plane| load(simd, plane, at)),
        }
    }

    /// How far apart they are in space, if the others are so many pixels across and down.
    #[inline(always)]
    fn distance(&self, other: &Self, [across, down]: [f32; 2]) -> Singles<S> {
        let normal = apart(&self.normal, &other.normal);
        let change = self.slope[0] * across + self.slope[1] * down;
        let off = other.nearness - self.nearness - change;
        let [share, change] = [self.nearness * NEARNESS, change * SLOPE];
        let depth = off * off / (share * share + change * change + TINY);
        normal * NORMAL + depth
    }

    /// How far apart their albedos are.
    #[inline(always)]
    fn albedo_distance(&self, other: &Self) -> Singles<S> {
        apart(&self.albedo, &other.albedo) * ALBEDO
    }
}

/// The light of some pixels side by side.
struct Lights<S: Simd> {
    light: [Singles<S>; 3],
    beside: Singles<S>,
}

impl<S: Simd> Lights<S> {
    #[inline(always)]
    fn load(simd: S, from: &Mixed, at: usize) -> Self {
        Self {
            light: from.light.each_ref().map(|plane| load(simd, plane, at)),
            beside: load(simd, &from.beside, at),
        }
    }

    /// How far apart they are beyond what their variances make likely, negative if closer (F.
    /// Rousselle, C. Knaus, M. Zwicker, "Adaptive Rendering with Non-Local Means Filtering", 2012,
    /// equation 6).
    #[inline(always)]
    fn distance(&self, other: &Self) -> Singles<S> {
        let light = apart(&self.light, &other.light) * (1.0 / 3.0);
        let noise = self.beside + self.beside.min_precise(other.beside);
        (light - noise) / (self.beside + other.beside + TINY)
    }

    /// How much the light of others counts: less where it is far noisier.
    #[inline(always)]
    fn trust(&self, other: &Self) -> Singles<S> {
        let share = (self.beside * NOISIER + TINY) / (other.beside + TINY);
        share.min_precise(Singles::splat(self.beside.simd, 1.0))
    }
}

/// How far the surfaces of each pixel are in space from the closest beside it: far where a pixel shows
/// parts of several. Albedos allow none: the brightest part of a pixel matters most.
pub(super) fn slack(features: &Features<'_>, level: Level) -> Plane {
    let layout = features.layout;
    let mut slack = layout.plane(0.0);
    let rows = slack.par_chunks_exact_mut(layout.stride).enumerate();
    rows.for_each(|(y, slack)| {
        if (layout.cancelled)() {
            return;
        }
        dispatch!(level, simd => slack_of_row(simd, features, y, slack));
    });
    slack
}

#[inline(always)]
fn slack_of_row<S: Simd>(simd: S, features: &Features<'_>, y: usize, slack: &mut [f32]) {
    let layout = features.layout;
    let rows = y.saturating_sub(1)..layout.height.min(y + 2);
    for x in (0..layout.width).step_by(WIDTH) {
        let own = Surfaces::load(simd, features, y * layout.stride + MARGIN + x);
        let mut least = Singles::splat(simd, MOST_SLACK);
        for row in rows.clone() {
            for column in 0..3 {
                if row == y && column == 1 {
                    continue;
                }
                let place = row * layout.stride + MARGIN + x + column - 1;
                let other = Surfaces::load(simd, features, place);
                let by = [column as f32 - 1.0, row as f32 - y as f32];
                least = least.min_precise(own.distance(&other, by));
            }
        }
        least.store_slice(&mut slack[MARGIN + x..][..WIDTH]);
    }
}

/// The squared distance of two vectors.
#[inline(always)]
fn apart<S: Simd>(one: &[Singles<S>; 3], other: &[Singles<S>; 3]) -> Singles<S> {
    let [x, y, z]: [_; 3] = array::from_fn(|axis| one[axis] - other[axis]);
    x * x + y * y + z * z
}

#[inline(always)]
fn load<S: Simd>(simd: S, plane: &Plane, at: usize) -> Singles<S> {
    Singles::from_slice(simd, &plane[at..at + WIDTH])
}
