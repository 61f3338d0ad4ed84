//! How alike pixels are: their surfaces, and their light given its noise.

use std::array;

use super::Mixed;
use super::features::Features;
use super::plane::Plane;
use geometry::lanes::{Simd, SimdBase, Singles, WIDTH};

/// How sharply surfaces are told apart: factors of squared differences of normals and albedos.
const NORMAL: f32 = 64.0;
const ALBEDO: f32 = 1.0;

/// Differences of nearness that count as one standard deviation: as a share of it, and of its change
/// from pixel to pixel.
const NEARNESS: f32 = 0.02;
const SLOPE: f32 = 0.5;

/// How many times noisier light may be and still count in full: a mirror that shows a lamp in some of
/// its samples would light up all around it. Any number from 4 to 32 does. With 1, each weight being
/// the best for its variance, paths with 4 samples have up to a fifth more error: what is brighter
/// by chance seems noisier too, so that all gets too dark.
const NOISIER: f32 = 16.0;

/// Most distance of light, so that its product with 0 is 0.
const MOST_DISTANCE: f32 = 1e4;

/// Keeps quotients of zeros defined.
pub(super) const TINY: f32 = 1e-30;

/// The surfaces of some pixels side by side.
pub(super) struct Surfaces<S: Simd> {
    normal: [Singles<S>; 3],
    albedo: [Singles<S>; 3],
    nearness: Singles<S>,
    slope: [Singles<S>; 2],
}

impl<S: Simd> Surfaces<S> {
    #[inline(always)]
    pub(super) fn load(simd: S, features: &Features<'_>, at: usize) -> Self {
        let three = |planes: &[Plane; 3]| planes.each_ref().map(|plane| load(simd, plane, at));
        Self {
            normal: three(&features.normal),
            albedo: three(&features.albedo),
            nearness: load(simd, &features.nearness, at),
            slope: features.slope.each_ref().map(|plane| load(simd, plane, at)),
        }
    }

    /// How alike others are that are so many pixels across and down: from 0 to 1, and 0 for those to
    /// leave out.
    #[inline(always)]
    pub(super) fn likeness(&self, other: &Self, by: [f32; 2], slack: Singles<S>) -> Singles<S> {
        let space = self.distance(other, by);
        // No number stays no number.
        let space = space - space.min_precise(slack);
        likeness(space + apart(&self.albedo, &other.albedo) * ALBEDO)
    }

    /// The largest channels of their albedos.
    #[inline(always)]
    pub(super) fn brightest(&self) -> Singles<S> {
        let [red, green, blue] = self.albedo;
        red.max_precise(green).max_precise(blue)
    }

    /// How far apart they are in space, if the others are so many pixels across and down.
    #[inline(always)]
    pub(super) fn distance(&self, other: &Self, [across, down]: [f32; 2]) -> Singles<S> {
        let normal = apart(&self.normal, &other.normal);
        let change = self.slope[0] * across + self.slope[1] * down;
        let off = other.nearness - self.nearness - change;
        let [share, change] = [self.nearness * NEARNESS, change * SLOPE];
        let depth = off * off / (share * share + change * change + TINY);
        normal * NORMAL + depth
    }
}

/// The light of some pixels side by side, and a number beside it.
pub(super) struct Lights<S: Simd> {
    pub(super) light: [Singles<S>; 3],
    pub(super) beside: Singles<S>,
}

impl<S: Simd> Lights<S> {
    #[inline(always)]
    pub(super) fn load(simd: S, mixed: &Mixed, at: usize) -> Self {
        Self {
            light: mixed.light.each_ref().map(|plane| load(simd, plane, at)),
            beside: load(simd, &mixed.beside, at),
        }
    }

    /// How far apart they are beyond what their variances make likely, negative if closer (F.
    /// Rousselle, C. Knaus, M. Zwicker, "Adaptive Rendering with Non-Local Means Filtering", 2012,
    /// equation 6).
    #[inline(always)]
    pub(super) fn distance(&self, other: &Self) -> Singles<S> {
        let light = apart(&self.light, &other.light) * (1.0 / 3.0);
        let noise = self.beside + self.beside.min_precise(other.beside);
        let distance = (light - noise) / (self.beside + other.beside + TINY);
        distance.min_precise(Singles::splat(self.beside.simd, MOST_DISTANCE))
    }

    /// How much the light of others counts: less where it is far noisier.
    #[inline(always)]
    pub(super) fn trust(&self, other: &Self) -> Singles<S> {
        let share = (self.beside * NOISIER + TINY) / (other.beside + TINY);
        share.min_precise(Singles::splat(self.beside.simd, 1.0))
    }
}

/// Close to the exponential of the distance, and 0 from 4 and for what is no number.
#[inline(always)]
pub(super) fn likeness<S: Simd>(distance: Singles<S>) -> Singles<S> {
    let zero = Singles::splat(distance.simd, 0.0);
    let near = (1.0 - distance * 0.25).max_precise(zero);
    let near = near * near;
    near * near
}

/// The squared distance of two vectors.
#[inline(always)]
fn apart<S: Simd>(one: &[Singles<S>; 3], other: &[Singles<S>; 3]) -> Singles<S> {
    let [x, y, z]: [_; 3] = array::from_fn(|axis| one[axis] - other[axis]);
    x * x + y * y + z * z
}

/// The numbers of pixels side by side, the first at this place.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, plane: &[f32], at: usize) -> Singles<S> {
    Singles::from_slice(simd, &plane[at..at + WIDTH])
}
