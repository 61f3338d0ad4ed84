//! Tests of lines against the boxes of steps.

use crate::lanes::{Lanes, Vector};
use crate::{Aabb, Rays};

/// Lines prepared for tests against boxes.
#[derive(Clone, Copy)]
pub(super) struct Slopes<N> {
    origin: Vector<N>,
    /// The reciprocal of the direction.
    reciprocal: Vector<N>,
    /// The interval of distances that count.
    reach: [N; 2],
}

impl<N: Lanes> Slopes<N> {
    #[inline(always)]
    pub(super) fn new(rays: &Rays<N>, reach: [N; 2]) -> Self {
        let one = reach[0].all(1.0);
        let direction = rays.direction;
        Self {
            origin: rays.origin,
            reciprocal: Vector {
                x: one / direction.x,
                y: one / direction.y,
                z: one / direction.z,
            },
            reach,
        }
    }

    /// Whether lines may hit a box within reach. Conservative: three roundings of a distance are
    /// within two ulps.
    #[inline(always)]
    pub(super) fn may_hit(&self, Aabb { min, max }: &Aabb) -> N::Mask {
        let (origin, reciprocal) = (self.origin, self.reciprocal);
        let (reach, x) = narrowed(self.reach, [min.x, max.x], origin.x, reciprocal.x);
        let (reach, y) = narrowed(reach, [min.y, max.y], origin.y, reciprocal.y);
        let ([low, high], z) = narrowed(reach, [min.z, max.z], origin.z, reciprocal.z);
        low.up_to(high) & x & y & z
    }
}

/// The part of `reach` where a coordinate may be in bounds, and whether a constant coordinate is.
#[inline(always)]
fn narrowed<N: Lanes>(
    [low, high]: [N; 2],
    [min, max]: [f64; 2],
    origin: N,
    reciprocal: N,
) -> ([N; 2], N::Mask) {
    let (min, max) = (origin.all(min), origin.all(max));
    let (a, b) = ((min - origin) * reciprocal, (max - origin) * reciprocal);
    let rises = origin.all(0.0).below(reciprocal);
    let (near, far) = (N::select(rises, a, b), N::select(rises, b, a));
    let rounding = origin.all(2.0 * f64::EPSILON);
    let near = near - rounding * near.abs();
    let far = far + rounding * far.abs();
    let stays = reciprocal.abs().equals(origin.all(f64::INFINITY));
    let outside = origin.below(min) | max.below(origin);
    // NaN narrows nothing.
    let low = N::select(low.below(near) & !stays, near, low);
    let high = N::select(far.below(high) & !stays, far, high);
    ([low, high], !(stays & outside))
}
