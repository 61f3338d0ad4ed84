//! Intersections of lines with balls, half-spaces and slabs, shared by the unit solids.
//!
//! No discriminant is computed as b² − ac from rounded terms: near a silhouette, and for small or
//! distant solids, the difference would be noise. Sources: E. Haines, J. Günther,
//! T. Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems
//! (2019), chapter 7; M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition,
//! section 6.8.

use super::lanes::{Lanes, Vector};
use super::{Aabb, Rays};

/// The distance of a solid, relative to its size, above which a line is first advanced toward it.
/// The products of nearer lines lose at most six bits, and need no fused operations.
pub(super) const FAR: f64 = 64.0;

/// A line in the space of a unit solid, in each lane. Distances along it equal those along the ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<N> {
    /// The position at `start`.
    pub(super) origin: Vector<N>,
    /// The ray's direction, not of unit length in this space.
    pub(super) direction: Vector<N>,
    /// The distance of `origin` along the ray.
    pub(super) start: N,
}

/// A point where a line enters or leaves a solid, in each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct End<N> {
    /// The distance.
    pub(super) t: N,
    /// The part of the solid's surface, an integer.
    pub(super) part: N,
}

/// Where lines enter and leave a solid; valid in the lanes where `hit` is true.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ends<N: Lanes> {
    pub(super) enter: End<N>,
    pub(super) exit: End<N>,
    pub(super) hit: N::Mask,
}

impl<N: Lanes> End<N> {
    #[inline(always)]
    pub(super) fn select(mask: N::Mask, yes: Self, no: Self) -> Self {
        Self {
            t: N::select(mask, yes.t, no.t),
            part: N::select(mask, yes.part, no.part),
        }
    }

    /// Whether 0 < t < `limit`.
    #[inline(always)]
    pub(super) fn is_within(self, limit: N) -> N::Mask {
        limit.all(0.0).below(self.t) & self.t.below(limit)
    }
}

impl<N: Lanes> Ends<N> {
    /// The interval between two crossings of the same part.
    #[inline(always)]
    pub(super) fn between(enter: N, exit: N, part: u32, hit: N::Mask) -> Self {
        let part = enter.all(f64::from(part));
        Self {
            enter: End { t: enter, part },
            exit: End { t: exit, part },
            hit,
        }
    }

    /// The whole line, bounded by no surface.
    #[inline(always)]
    pub(super) fn everywhere(like: N, hit: N::Mask) -> Self {
        let (before, after) = (like.all(f64::NEG_INFINITY), like.all(f64::INFINITY));
        Self::between(before, after, 0, hit)
    }

    #[inline(always)]
    pub(super) fn select(mask: N::Mask, yes: Self, no: Self) -> Self {
        Self {
            enter: End::select(mask, yes.enter, no.enter),
            exit: End::select(mask, yes.exit, no.exit),
            hit: (mask & yes.hit) | (!mask & no.hit),
        }
    }

    /// Returns `None` if no lane has a hit.
    #[inline(always)]
    pub(super) fn if_any(self) -> Option<Self> {
        N::any(self.hit).then_some(self)
    }

    /// The interval inside both solids, if any.
    #[inline(always)]
    pub(super) fn overlap(self, other: Self) -> Option<Self> {
        let enter = End::select(self.enter.t.below(other.enter.t), other.enter, self.enter);
        let exit = End::select(other.exit.t.below(self.exit.t), other.exit, self.exit);
        let hit = self.hit & other.hit & enter.t.up_to(exit.t);
        Self { enter, exit, hit }.if_any()
    }

    /// Moves the origin of distances back by `start`. Drops lanes whose distances are not finite: a
    /// line without direction, or sizes near the limits of `f64`.
    #[inline(always)]
    pub(super) fn shifted(mut self, start: N) -> Option<Self> {
        self.enter.t = self.enter.t + start;
        self.exit.t = self.exit.t + start;
        let ordered = self.enter.t.up_to(self.exit.t);
        self.hit = self.hit & ordered & is_finite(self.enter.t) & is_finite(self.exit.t);
        self.if_any()
    }

    /// The interval inside a box that is widened by the rounding of positions, if any. An end that
    /// is clipped keeps its part.
    #[inline(always)]
    pub(super) fn clipped(self, bounds: &Aabb, rays: &Rays<N>) -> Option<Self> {
        // Above the error of a crossing, relative to the largest coordinate.
        const ROUNDING: f64 = 32.0 * f64::EPSILON;
        let Rays { origin, direction } = *rays;
        let size = origin.x.all(bounds.magnitude());
        let margin = origin.abs().largest().larger(size) * origin.x.all(ROUNDING);
        let (min, max) = (
            Vector::all(size, bounds.min) - origin,
            Vector::all(size, bounds.max) - origin,
        );
        self.overlap(range([min.x - margin, max.x + margin], direction.x))?
            .overlap(range([min.y - margin, max.y + margin], direction.y))?
            .overlap(range([min.z - margin, max.z + margin], direction.z))
    }

    /// Returns the nearer crossing with 0 < t < `limit`, and whether there is one.
    #[inline(always)]
    pub(super) fn nearest(self, limit: N) -> (End<N>, N::Mask) {
        let enters = self.enter.is_within(limit);
        let hit = self.hit & (enters | self.exit.is_within(limit));
        (End::select(enters, self.enter, self.exit), hit)
    }
}

/// Whether a number is finite, in each lane.
#[inline(always)]
fn is_finite<N: Lanes>(number: N) -> N::Mask {
    let zero = number.all(0.0);
    (zero * number).equals(zero)
}

/// Advances lines that start far from a solid to the point closest to the solid's origin. Returns
/// that point and its distance along the line; a line that starts near is unchanged.
///
/// `offset` is the line's start relative to the solid's origin, `reach` the solid's size. With the
/// fused product the error is relative to the new, small, coordinates: an error in the distance
/// only moves the point along the line, which changes nothing.
#[inline(always)]
pub(super) fn approach<N: Lanes>(
    offset: Vector<N>,
    direction: Vector<N>,
    reach: N,
) -> (Vector<N>, N) {
    let limit = reach.all(FAR) * reach;
    let near = offset.length_squared().up_to(limit * limit);
    let stays = reach.all(0.0);
    if !N::any(!near) {
        return (offset, stays);
    }
    let t = -offset.dot(direction) / direction.length_squared();
    let position = Vector {
        x: t.mul_add(direction.x, offset.x),
        y: t.mul_add(direction.y, offset.y),
        z: t.mul_add(direction.z, offset.z),
    };
    (
        Vector::select(near, offset, position),
        N::select(near, stays, t),
    )
}

/// Intersects lines with a ball around the origin; a line without direction misses it.
///
/// If l is the point of the line closest to the centre, the discriminant is a (r − |l|) (r + |l|),
/// with a sign as exact as |l|.
#[inline(always)]
pub(super) fn ball<N: Lanes>(
    origin: Vector<N>,
    direction: Vector<N>,
    radius: N,
) -> Option<Ends<N>> {
    let a = direction.length_squared();
    let b = origin.dot(direction);
    let offset_squared = (origin - direction.scaled(b / a)).length_squared();
    let square = radius * radius;
    // Most lines pass at more than the radius plus rounding, and need no square root.
    let bound = square + square.all(1e-9) * square + square.all(f64::MIN_POSITIVE);
    if !N::any(!bound.below(offset_squared)) {
        return None;
    }
    let closest = offset_squared.sqrt();
    let discriminant = a * ((radius - closest) * (radius + closest));
    let hit = discriminant.all(0.0).up_to(discriminant);
    if !N::any(hit) {
        return None;
    }
    let distance = origin.length_squared().sqrt();
    let c = (distance - radius) * (distance + radius);
    let [enter, exit] = roots(a, b, c, discriminant.sqrt());
    Some(Ends::between(enter, exit, 0, hit))
}

/// The half-line where 2 b t + c ≤ 0, bounded by a crossing of `part`.
#[inline(always)]
pub(super) fn half_line<N: Lanes>(b: N, c: N, part: u32) -> Option<Ends<N>> {
    let t = b.all(-0.5) * (c / b);
    let (before, after) = (b.all(f64::NEG_INFINITY), b.all(f64::INFINITY));
    let zero = b.all(0.0);
    let rises = zero.below(b);
    let level = b.equals(zero);
    let crossed = Ends::between(
        N::select(rises, before, t),
        N::select(rises, t, after),
        part,
        !level,
    );
    Ends::select(level, Ends::everywhere(b, c.up_to(zero)), crossed).if_any()
}

/// The roots of a t² + 2 b t + c = 0 in ascending order, given the square root of b² − ac; a ≠ 0.
///
/// The root of lesser magnitude is c / q, so that a line which starts on a surface (c ≈ 0) has
/// that crossing at t ≈ 0 without cancellation, on the side given by the sign of c.
#[inline(always)]
pub(super) fn roots<N: Lanes>(a: N, b: N, c: N, root: N) -> [N; 2] {
    let q = -(b + root.copysign(b));
    let (greater, lesser) = (q / a, c / q);
    let ordered = greater.below(lesser);
    let zero = q.all(0.0);
    let both_zero = q.equals(zero);
    let first = N::select(ordered, greater, lesser);
    let second = N::select(ordered, lesser, greater);
    [
        N::select(both_zero, zero, first),
        N::select(both_zero, zero, second),
    ]
}

/// The interval where one coordinate is in [0, 1]. `parts` are the surfaces at 0 and 1.
///
/// A constant coordinate is always or never inside: 0 / 0 is not a distance.
#[inline(always)]
pub(super) fn slab<N: Lanes>(origin: N, speed: N, parts: [u32; 2]) -> Option<Ends<N>> {
    let (zero, one) = (origin.all(0.0), origin.all(1.0));
    let low = End {
        t: -origin / speed,
        part: origin.all(f64::from(parts[0])),
    };
    let high = End {
        t: (one - origin) / speed,
        part: origin.all(f64::from(parts[1])),
    };
    let rises = zero.below(speed);
    let stays = speed.equals(zero);
    let crossed = Ends {
        enter: End::select(rises, low, high),
        exit: End::select(rises, high, low),
        hit: !stays,
    };
    if !N::any(stays) {
        return Some(crossed);
    }
    let inside = zero.up_to(origin) & origin.up_to(one);
    Ends::select(stays, Ends::everywhere(origin, inside), crossed).if_any()
}

/// The interval where one coordinate, 0 at the line's start, is in a range that may be unbounded.
#[inline(always)]
fn range<N: Lanes>([low, high]: [N; 2], speed: N) -> Ends<N> {
    let zero = speed.all(0.0);
    let rises = zero.below(speed);
    let stays = speed.equals(zero);
    let (near, far) = (N::select(rises, low, high), N::select(rises, high, low));
    let crossed = Ends::between(near / speed, far / speed, 0, !stays);
    let inside = low.up_to(zero) & zero.up_to(high);
    Ends::select(stays, Ends::everywhere(zero, inside), crossed)
}
