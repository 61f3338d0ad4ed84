//! Rays against the planes of boxes, in single precision: half as wide as the numbers that surfaces
//! are met with, so half the work, and boxes hold no more.
//!
//! # How nothing is missed
//!
//! A ray's origin is taken between two numbers, and each plane is tested against the one that makes
//! its box larger. With u = 2⁻²⁴, a distance (plane − origin) · (1 / direction) then carries three
//! roundings (and one of double precision, far less), so it is off by a factor of 1 ± γ₃,
//! γ₃ = 3u / (1 − 3u), and by less than the least normal number where it underflows. Entry ≤ exit therefore holds for every box that is met once
//! the exit is scaled by 1 + 2γ₃ (Ize, "Robust BVH Ray Traversal", JCGT 2013) and raised by that
//! number; [`WIDEN`] leaves room for the rounding of that.
//!
//! Along an axis where a distance might overflow, or the inverse is no normal number, a ray is taken
//! to meet everything. A direction of 0 is well: its inverse is infinite.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use crate::geometry::Ray;
use crate::geometry::lanes::{Lanes, Simd, SimdBase, Singles};

/// How much farther than computed a ray may leave a box: 1 + 8u.
const WIDEN: f32 = 1.0 + 4.0 * f32::EPSILON;

/// The largest numbers that are computed with: room for all roundings below those of `f32`.
const MOST: f64 = (1_u128 << 126) as f64;

/// Twice the error of rounding to single precision, which makes up for those before it too.
const SLACK: f64 = f32::EPSILON as f64;

/// A ray along one axis as planes are tested against it that are up to `farthest` from a reference
/// point: 1 over its direction, and numbers not below and not above its origin relative to that
/// point, and still so once they are rounded to single precision.
#[inline(always)]
pub(super) fn against<N: Lanes>(origin: N, direction: N, reference: f64, farthest: f64) -> [N; 3] {
    /// The gap between the least numbers.
    const LEAST: f64 = f32::from_bits(1) as f64;
    let all = |value| origin.all(value);
    let inverse = all(1.0) / direction;
    let from = origin - all(reference);
    let slack = from.abs() * all(SLACK) + all(LEAST);
    // An infinite inverse makes no distance larger that is not infinite or 0 anyway.
    let zero = direction.equals(all(0.0));
    let size = N::select(zero, all(1.0), inverse.abs());
    let most = from.abs() + all(farthest);
    let largest = most.larger(all(1.0)) * size.larger(all(1.0));
    let tells = all(1.0 / MOST).up_to(size) & largest.up_to(all(MOST));
    [
        N::select(tells, inverse, all(1.0)),
        N::select(tells, from + slack, all(f64::INFINITY)),
        N::select(tells, from - slack, all(f64::NEG_INFINITY)),
    ]
}

/// The same for one ray, rounded.
#[inline(always)]
fn against_one(origin: f64, direction: f64, reference: f64, farthest: f64) -> [f32; 3] {
    let [inverse, above, below] = against(origin, direction, reference, farthest);
    [inverse as f32, above as f32, below as f32]
}

/// A ray as the boxes of a node are tested against it, in each lane the same.
pub(super) struct SlabRay<S: Simd> {
    pub(super) slopes: [Slope<S>; 3],
}

/// A ray along one axis.
pub(super) struct Slope<S: Simd> {
    /// 1 over the direction; infinite for 0, with its sign.
    pub(super) inverse: Singles<S>,
    /// The origin against planes where the ray comes in, such that they are not too far.
    pub(super) near_origin: Singles<S>,
    /// The origin against planes where the ray goes out, such that they are not too near.
    pub(super) far_origin: Singles<S>,
    /// Where the ray comes in: 0 for low planes, 1 for high ones.
    pub(super) near_side: usize,
}

impl<S: Simd> SlabRay<S> {
    /// The ray relative to the reference point of a tree.
    #[inline(always)]
    pub(super) fn new(simd: S, ray: &Ray, reference: DVec3, farthest: f64) -> Self {
        let Ray { origin, direction } = ray;
        Self {
            slopes: [
                Slope::of(
                    simd,
                    against_one(origin.x, direction.x, reference.x, farthest),
                ),
                Slope::of(
                    simd,
                    against_one(origin.y, direction.y, reference.y, farthest),
                ),
                Slope::of(
                    simd,
                    against_one(origin.z, direction.z, reference.z, farthest),
                ),
            ],
        }
    }

    /// A ray by what [`against`] says of each axis.
    #[inline(always)]
    pub(super) fn of(simd: S, [x, y, z]: [[f32; 3]; 3]) -> Self {
        Self {
            slopes: [Slope::of(simd, x), Slope::of(simd, y), Slope::of(simd, z)],
        }
    }
}

impl<S: Simd> Slope<S> {
    /// A ray by what [`against`] says.
    #[inline(always)]
    fn of(simd: S, [inverse, above, below]: [f32; 3]) -> Self {
        let rises = inverse.is_sign_positive();
        let [near, far] = if rises {
            [above, below]
        } else {
            [below, above]
        };
        Self {
            inverse: Singles::splat(simd, inverse),
            near_origin: Singles::splat(simd, near),
            far_origin: Singles::splat(simd, far),
            near_side: usize::from(!rises),
        }
    }
}

/// What is not below a limit once it is rounded to single precision, or by less than underflow.
#[inline(always)]
pub(super) fn raised<N: Lanes>(limit: N) -> N {
    limit + limit.abs() * limit.all(SLACK)
}

/// The part of an interval that is beyond the `near` and before the `far`. A NaN, 0 · ∞ of a ray that
/// runs in a face, cuts nothing.
#[inline(always)]
pub(super) fn cut<S: Simd>(
    [entry, exit]: [Singles<S>; 2],
    near: Singles<S>,
    far: Singles<S>,
) -> [Singles<S>; 2] {
    [entry.max_precise(near), exit.min_precise(far)]
}

/// Whether a box entered there by computation may be met up to a limit.
#[inline(always)]
pub(super) fn is_open(entry: f32, limit: f32) -> bool {
    entry <= limit * WIDEN + f32::MIN_POSITIVE
}

/// The lanes whose interval may hold something.
#[inline(always)]
pub(super) fn opens<S: Simd>([entry, exit]: [Singles<S>; 2]) -> <Singles<S> as SimdBase<S>>::Mask {
    let simd = exit.simd;
    entry.simd_le(exit * Singles::splat(simd, WIDEN) + Singles::splat(simd, f32::MIN_POSITIVE))
}
