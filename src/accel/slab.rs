//! Rays against the planes of boxes, in single precision: half as wide as the numbers that surfaces
//! are met with, so half the work, and boxes hold no more.
//!
//! # How nothing is missed
//!
//! A ray's origin is taken between two numbers, and each plane is tested against the one that makes
//! its box larger. With u = 2⁻²⁴, a distance (plane − origin) · (1 / direction) then carries three
//! roundings (and one of double precision, far less), so it is off by a factor of 1 ± γ₃,
//! γ₃ = 3u / (1 − 3u), and by less than the least normal number where it underflows. Entry ≤ exit
//! therefore holds for every box that is met once the exit is raised by 2γ₃ of its magnitude (Ize,
//! "Robust BVH Ray Traversal", JCGT 2013) and by that number; [`MARGIN`] leaves room for the rounding
//! of that. Distances may be negative: see [`REMOTE`].
//!
//! Along an axis where a distance might overflow, or the inverse is not a normal number, a ray is taken
//! to meet everything. A direction of 0 is well: its inverse is infinite.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use super::Bvh;
use crate::geometry::Rays;
use crate::geometry::lanes::{Lanes, Simd, SimdBase, Singles, Vector};

/// How much farther than computed a ray may leave a box, of the distance: 8u.
const MARGIN: f32 = 4.0 * f32::EPSILON;

/// The largest numbers that are computed with: room for all roundings below those of `f32`.
const MOST: f64 = (1_u128 << 126) as f64;

/// Twice the error of rounding to single precision, which makes up for those before it too.
const SLACK: f64 = f32::EPSILON as f64;

/// As many times as far from a tree's reference point as half of its boxes are, rays are followed to
/// where they pass it before their distances are counted: else all of those would be within the
/// rounding of the origin, as for rays that come from a sky around them.
const REMOTE: f64 = 64.0;

/// More than the error of all operations in double precision that lead to a place.
const DRIFT: f64 = 16.0 * f64::EPSILON;

/// Rays as a tree sees them, in each lane.
pub(super) struct Approach<N> {
    /// Where they are when distances begin to count, relative to the reference point.
    from: Vector<N>,
    /// More than the error of each coordinate, beside that of its last place.
    error: N,
    /// How far along the rays that is.
    ahead: N,
}

impl<N: Lanes> Approach<N> {
    /// Rays as this tree sees them.
    #[inline(always)]
    pub(super) fn new(rays: &Rays<N>, bvh: &Bvh) -> Self {
        let all = |value| rays.origin.x.all(value);
        let zero = all(0.0);
        let from = rays.origin - Vector::all(zero, bvh.reference);
        let size = from.abs().largest();
        let remote = all(REMOTE * bvh.spread).below(size);
        if !N::any(remote) {
            return Self {
                from,
                error: zero,
                ahead: zero,
            };
        }
        let direction = rays.direction;
        let way = -from.dot(direction) / direction.length_squared();
        // Not those that go away, nor where this is beyond all numbers.
        let moves = remote & zero.below(way) & (way * zero).equals(zero);
        let place = from + direction.scaled(way);
        let error = (size + way * direction.abs().largest()) * all(DRIFT);
        Self {
            from: Vector::select(moves, place, from),
            error: N::select(moves, error, zero),
            ahead: N::select(moves, way, zero),
        }
    }

    /// What is not above the distance at which the rays start, once it is rounded to single precision.
    #[inline(always)]
    pub(super) fn start(&self) -> N {
        let ahead = self.ahead;
        -(ahead + ahead * ahead.all(SLACK))
    }

    /// What is not below limits along the rays once it is rounded to single precision, or by less than
    /// underflow.
    #[inline(always)]
    pub(super) fn limits(&self, limits: N) -> N {
        let rest = limits - self.ahead + self.ahead * limits.all(DRIFT);
        rest + rest.abs() * rest.all(SLACK)
    }

    /// The rays along an axis as planes are tested against them that are up to `farthest` from the
    /// reference point: 1 over their directions, and numbers not below and not above where they are,
    /// and still so once they are rounded to single precision.
    #[inline(always)]
    fn against(&self, from: N, direction: N, farthest: f64) -> [N; 3] {
        /// The gap between the least numbers.
        const LEAST: f64 = f32::from_bits(1) as f64;
        let all = |value| from.all(value);
        let inverse = all(1.0) / direction;
        let slack = from.abs() * all(SLACK) + all(LEAST) + self.error;
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

    /// The same along each axis.
    #[inline(always)]
    pub(super) fn slopes(&self, direction: Vector<N>, farthest: f64) -> [[N; 3]; 3] {
        let Vector { x, y, z } = self.from;
        [
            self.against(x, direction.x, farthest),
            self.against(y, direction.y, farthest),
            self.against(z, direction.z, farthest),
        ]
    }
}

/// A ray as the boxes of a node are tested against it, in each lane the same.
pub(super) struct SlabRay<S: Simd> {
    /// Where it starts.
    pub(super) start: f32,
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
    /// A ray by what [`Approach::slopes`] says, rounded.
    #[inline(always)]
    pub(super) fn of(simd: S, start: f32, [x, y, z]: [[f32; 3]; 3]) -> Self {
        Self {
            start,
            slopes: [Slope::of(simd, x), Slope::of(simd, y), Slope::of(simd, z)],
        }
    }
}

impl<S: Simd> Slope<S> {
    /// A ray along one axis by what [`Approach::slopes`] says of it, rounded.
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
    entry <= limit + limit.abs() * MARGIN + f32::MIN_POSITIVE
}

/// The lanes whose interval may hold something.
#[inline(always)]
pub(super) fn opens<S: Simd>([entry, exit]: [Singles<S>; 2]) -> <Singles<S> as SimdBase<S>>::Mask {
    let simd = exit.simd;
    let margin = exit.abs() * Singles::splat(simd, MARGIN);
    entry.simd_le(exit + margin + Singles::splat(simd, f32::MIN_POSITIVE))
}
