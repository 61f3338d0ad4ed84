//! What the immediate neighbours of each pixel tell about it.

use rayon::prelude::*;

use super::alike::{Surfaces, load};
use super::features::Features;
use super::plane::{MARGIN, Plane};
use geometry::lanes::{Level, Select, Simd, SimdBase, Singles, WIDTH, dispatch};

/// Most slack.
const MOST_SLACK: f32 = 1e3;

/// Rows and columns on either side whose variances bound each other.
pub(super) const REACH: usize = 2;

/// Which of their largest, from 1, bounds them: on surfaces without diffuse reflection, and on others.
/// What is noisier in fewer pixels of a mirror is the image of a lamp, not noise of all around: with the
/// second largest, `caustic.xml` with 4 samples has a fifth more error. Light on diffuse surfaces is
/// smooth: few pixels with noise tell that others would have it with more samples. With the fourth
/// largest, caustics by paths have a fifth more error.
const RANKS: [usize; 2] = [4, 2];

/// The largest albedo of surfaces that count as without diffuse reflection.
const DARK: f32 = 0.1;

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
    for x in (0..features.layout.width).step_by(WIDTH) {
        let own = Surfaces::load(simd, features, features.layout.row(y) + x);
        let mut least = Singles::splat(simd, MOST_SLACK);
        for (place, by) in square(features, 1, [x, y]) {
            if by == [0.0; 2] {
                continue;
            }
            let other = Surfaces::load(simd, features, place);
            least = least.min_precise(own.distance(&other, by));
        }
        least.store_slice(&mut slack[MARGIN + x..][..WIDTH]);
    }
}

/// The most that variances count around each pixel: one of the largest of those of alike
/// surfaces.
pub(super) fn bounds(variances: &Plane, features: &Features<'_>, level: Level) -> Plane {
    let layout = features.layout;
    let mut bounds = layout.plane(0.0);
    let rows = bounds.par_chunks_exact_mut(layout.stride).enumerate();
    rows.for_each(|(y, bounds)| {
        if (layout.cancelled)() {
            return;
        }
        dispatch!(level, simd => bounds_of_row(simd, variances, features, y, bounds));
    });
    bounds
}

#[inline(always)]
fn bounds_of_row<S: Simd>(
    simd: S,
    variances: &Plane,
    features: &Features<'_>,
    y: usize,
    bounds: &mut [f32],
) {
    for x in (0..features.layout.width).step_by(WIDTH) {
        let at = features.layout.row(y) + x;
        let own = Surfaces::load(simd, features, at);
        let slack = load(simd, &features.slack, at);
        let mut largest = [Singles::splat(simd, 0.0); RANKS[0]];
        for (place, by) in square(features, REACH, [x, y]) {
            let other = Surfaces::load(simd, features, place);
            let mut rest = own.likeness(&other, by, slack) * load(simd, variances, place);
            for largest in &mut largest {
                let less = largest.min_precise(rest);
                *largest = largest.max_precise(rest);
                rest = less;
            }
        }
        let [dark, lit] = RANKS.map(|rank| largest[rank - 1]);
        let is_lit = own.brightest().simd_gt(Singles::splat(simd, DARK));
        let bound = is_lit.select(lit, dark);
        bound.store_slice(&mut bounds[MARGIN + x..][..WIDTH]);
    }
}

/// The places of the pixels in the square around one, itself among them, and how far across and down
/// they are.
#[inline(always)]
pub(super) fn square(
    features: &Features<'_>,
    reach: usize,
    [x, y]: [usize; 2],
) -> impl Iterator<Item = (usize, [f32; 2])> {
    let layout = features.layout;
    let rows = y.saturating_sub(reach)..layout.height.min(y + reach + 1);
    rows.flat_map(move |row| {
        (0..=2 * reach).map(move |column| {
            let place = layout.row(row) + x + column - reach;
            let by = [column as f32 - reach as f32, row as f32 - y as f32];
            (place, by)
        })
    })
}
