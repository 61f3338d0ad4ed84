//! Slab tests of rays against boxes, in single precision: half the work of double precision, and
//! boxes are stored in single precision anyway.
//!
//! # Why no box is missed
//!
//! A ray's origin is enclosed in an interval, and each plane is tested against the end that
//! enlarges its box. With u = 2⁻²⁴, a distance (plane − origin) · (1 / direction) then has three
//! roundings (and one of double precision, far smaller), so it is off by a factor of 1 ± γ₃ with
//! γ₃ = 3u / (1 − 3u), and by less than the least normal number if it underflows. Entry ≤ exit
//! therefore holds for every box that is hit if the exit is raised by 2γ₃ of its magnitude (Ize,
//! "Robust BVH Ray Traversal", JCGT 2013) and by that number; [`MARGIN`] leaves room for the
//! rounding of this. Distances may be negative: see [`REMOTE`].
//!
//! Along an axis where a distance might overflow, or the inverse is not a normal number, a ray hits
//! everything. A direction of 0 is no such case: its inverse is infinite.

use super::Bvh;
use geometry::Rays;
use geometry::lanes::{Lanes, Simd, SimdBase, Singles, Vector};

/// The relative extension of the distance at which a ray leaves a box: 8u.
const MARGIN: f32 = 4.0 * f32::EPSILON;

/// The largest magnitude in computations: it leaves room for all roundings below that of `f32`.
const LARGEST: f64 = (1_u128 << 126) as f64;

/// Twice the error of rounding to single precision, which covers earlier roundings too.
const SLACK: f64 = f32::EPSILON as f64;

/// Rays that start farther than this from a tree's reference point, relative to the median distance
/// of its boxes, are first advanced to their closest point: otherwise all distances would be within
/// the rounding of the origin, as for rays from a surrounding sky.
const REMOTE: f64 = 64.0;

/// Above the relative error of all operations in double precision that lead to a position.
const DRIFT: f64 = 16.0 * f64::EPSILON;

/// Rays relative to a tree, in each lane.
pub(super) struct Approach<N> {
    /// The points from which distances count, relative to the reference point.
    origin: Vector<N>,
    /// Above the error of each coordinate, in addition to its own rounding.
    error: N,
    /// The distances of `origin` along the rays.
    advance: N,
}

impl<N: Lanes> Approach<N> {
    /// Converts rays, advancing those that start far away.
    #[inline(always)]
    pub(super) fn new(rays: &Rays<N>, bvh: &Bvh) -> Self {
        let all = |value| rays.origin.x.all(value);
        let zero = all(0.0);
        let origin = rays.origin - Vector::all(zero, bvh.reference);
        let size = origin.abs().largest();
        let remote = all(REMOTE * bvh.spread).below(size);
        if !N::any(remote) {
            return Self {
                origin,
                error: zero,
                advance: zero,
            };
        }
        let direction = rays.direction;
        let distance = -origin.dot(direction) / direction.length_squared();
        // Not rays that point away, nor if the distance is not finite.
        let moves = remote & zero.below(distance) & (distance * zero).equals(zero);
        let position = origin + direction.scaled(distance);
        let error = (size + distance * direction.abs().largest()) * all(DRIFT);
        Self {
            origin: Vector::select(moves, position, origin),
            error: N::select(moves, error, zero),
            advance: N::select(moves, distance, zero),
        }
    }

    /// Lower bounds, even after rounding to `f32`, of the distances at which rays start.
    #[inline(always)]
    pub(super) fn start(&self) -> N {
        let advance = self.advance;
        -(advance + advance * advance.all(SLACK))
    }

    /// Upper bounds, even after rounding to `f32` but up to underflow, of limits along the rays.
    #[inline(always)]
    pub(super) fn limits(&self, limits: N) -> N {
        let rest = limits - self.advance + self.advance * limits.all(DRIFT);
        rest + rest.abs() * rest.all(SLACK)
    }

    /// Returns the rays along an axis for tests against planes up to `farthest` from the reference
    /// point: 1 over their directions, and upper and lower bounds of their origins, valid even
    /// after rounding to single precision.
    #[inline(always)]
    fn against(&self, origin: N, direction: N, farthest: f64) -> [N; 3] {
        /// The least positive number of `f32`.
        const LEAST: f64 = f32::from_bits(1) as f64;
        let all = |value| origin.all(value);
        let inverse = all(1.0) / direction;
        let slack = origin.abs() * all(SLACK) + all(LEAST) + self.error;
        // With an infinite inverse every distance is infinite or NaN anyway.
        let zero = direction.equals(all(0.0));
        let size = N::select(zero, all(1.0), inverse.abs());
        let most = origin.abs() + all(farthest);
        let largest = most.larger(all(1.0)) * size.larger(all(1.0));
        let is_valid = all(1.0 / LARGEST).up_to(size) & largest.up_to(all(LARGEST));
        [
            N::select(is_valid, inverse, all(1.0)),
            N::select(is_valid, origin + slack, all(f64::INFINITY)),
            N::select(is_valid, origin - slack, all(f64::NEG_INFINITY)),
        ]
    }

    /// The same along all axes.
    #[inline(always)]
    pub(super) fn slopes(&self, direction: Vector<N>, farthest: f64) -> [[N; 3]; 3] {
        let Vector { x, y, z } = self.origin;
        [
            self.against(x, direction.x, farthest),
            self.against(y, direction.y, farthest),
            self.against(z, direction.z, farthest),
        ]
    }
}

/// A ray prepared for tests against the boxes of a node, the same in all lanes.
pub(super) struct SlabRay<S: Simd> {
    /// The distance at which the ray starts.
    pub(super) start: f32,
    pub(super) slopes: [Slope<S>; 3],
}

/// A ray along one axis.
pub(super) struct Slope<S: Simd> {
    /// 1 over the direction; infinite for 0, with its sign.
    pub(super) inverse: Singles<S>,
    /// The origin for tests against entry planes, never too late.
    pub(super) near_origin: Singles<S>,
    /// The origin for tests against exit planes, never too early.
    pub(super) far_origin: Singles<S>,
    /// The side where the ray enters: 0 for low planes, 1 for high ones.
    pub(super) near_side: usize,
}

impl<S: Simd> SlabRay<S> {
    /// Rounds and converts a ray from [`Approach::slopes`].
    #[inline(always)]
    pub(super) fn rounded(simd: S, start: f64, [x, y, z]: [[f64; 3]; 3]) -> Self {
        Self::of(simd, start as f32, [rounded(x), rounded(y), rounded(z)])
    }

    /// Converts a ray from [`Approach::slopes`], rounded to `f32`.
    #[inline(always)]
    pub(super) fn of(simd: S, start: f32, [x, y, z]: [[f32; 3]; 3]) -> Self {
        Self {
            start,
            slopes: [Slope::of(simd, x), Slope::of(simd, y), Slope::of(simd, z)],
        }
    }
}

#[inline(always)]
fn rounded([inverse, above, below]: [f64; 3]) -> [f32; 3] {
    [inverse as f32, above as f32, below as f32]
}

impl<S: Simd> Slope<S> {
    /// Converts one axis from [`Approach::slopes`], rounded to `f32`.
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

/// Clips an interval to `near..far`. NaN, from 0 · ∞ for a ray in a face, clips nothing.
#[inline(always)]
pub(super) fn clip<S: Simd>(
    [entry, exit]: [Singles<S>; 2],
    near: Singles<S>,
    far: Singles<S>,
) -> [Singles<S>; 2] {
    [entry.max_precise(near), exit.min_precise(far)]
}

/// The largest computed entry of a box that may be hit up to a limit.
#[inline(always)]
pub(super) fn last_entry(limit: f32) -> f32 {
    limit + limit.abs() * MARGIN + f32::MIN_POSITIVE
}

/// The lanes whose interval may be nonempty.
#[inline(always)]
pub(super) fn is_open_in_lanes<S: Simd>(
    [entry, exit]: [Singles<S>; 2],
) -> <Singles<S> as SimdBase<S>>::Mask {
    let simd = exit.simd;
    let margin = exit.abs() * Singles::splat(simd, MARGIN);
    entry.simd_le(exit + margin + Singles::splat(simd, f32::MIN_POSITIVE))
}
