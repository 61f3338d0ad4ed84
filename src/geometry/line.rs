//! What lines and unit solids have in common: balls, slabs, roots.
//!
//! No discriminant is computed as b² − ac from its rounded terms: near a silhouette, and for
//! small or distant solids, the difference would be noise. Sources: E. Haines, J. Günther,
//! T. Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems
//! (2019), chapter 7; M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition,
//! section 6.8.

use glam::DVec3;

use super::{Crossings, Hit};

/// How many times its size a solid may be away before the line is followed toward it first. The
/// products of nearer lines lose at most these six bits, and need no fused operations.
pub(super) const FAR: f64 = 64.0;

/// Follows a line that starts far from a solid to where it passes the solid's origin closest, and
/// gives that place and the distance to it; a line that starts near stays.
///
/// `offset` is the line's start as seen from the solid's origin, `reach` the solid's size. The
/// fused product makes the new place as exact as its own, small, coordinates: an error in the
/// distance moves it along the line only, which changes nothing.
#[inline]
pub(super) fn approach(offset: DVec3, direction: DVec3, reach: f64) -> (DVec3, f64) {
    let limit = FAR * reach;
    if offset.length_squared() <= limit * limit {
        return (offset, 0.0);
    }
    let t = -offset.dot(direction) / direction.length_squared();
    let place = DVec3::new(
        t.mul_add(direction.x, offset.x),
        t.mul_add(direction.y, offset.y),
        t.mul_add(direction.z, offset.z),
    );
    (place, t)
}

/// Where a line crosses a ball around the origin, or `None` if it misses it or has no direction.
///
/// With l the point of the line closest to the centre, the discriminant is a (r − |l|) (r + |l|),
/// and its sign as exact as |l|.
#[inline]
pub(super) fn ball(origin: DVec3, direction: DVec3, radius: f64) -> Option<[f64; 2]> {
    let a = direction.length_squared();
    let b = origin.dot(direction);
    let closest = (origin - (b / a) * direction).length();
    let discriminant = a * ((radius - closest) * (radius + closest));
    if discriminant.is_nan() || discriminant < 0.0 {
        return None;
    }
    let distance = origin.length();
    let c = (distance - radius) * (distance + radius);
    Some(roots(a, b, c, discriminant.sqrt()))
}

/// Where 2 b t + c ≤ 0, between crossings of a part of a surface.
#[inline]
pub(super) fn half_line(b: f64, c: f64, part: u32) -> Option<Crossings> {
    if b == 0.0 {
        return (c <= 0.0).then_some(Crossings::EVERYWHERE);
    }
    let t = -0.5 * (c / b);
    Some(if 0.0 < b {
        between(f64::NEG_INFINITY, t, part)
    } else {
        between(t, f64::INFINITY, part)
    })
}

/// From one crossing of a part of a surface to another.
#[inline]
pub(super) fn between(enter: f64, exit: f64, part: u32) -> Crossings {
    let [enter, exit] = [enter, exit].map(|t| Hit { t, part });
    Crossings { enter, exit }
}

/// The roots of a t² + 2 b t + c = 0 in ascending order, given the square root of b² − ac; a ≠ 0.
///
/// The root of lesser magnitude is c / q, so that a line which starts on a surface (c ≈ 0) finds
/// that crossing at t ≈ 0 without cancellation, on the side that the sign of c says.
#[inline]
pub(super) fn roots(a: f64, b: f64, c: f64, root: f64) -> [f64; 2] {
    let q = -(b + root.copysign(b));
    if q == 0.0 {
        return [0.0, 0.0];
    }
    let (greater, lesser) = (q / a, c / q);
    if greater < lesser {
        [greater, lesser]
    } else {
        [lesser, greater]
    }
}

/// Where one coordinate of a line is in [0, 1], or `None` if it never is. `parts` are the surfaces
/// at 0 and at 1.
///
/// A coordinate that stays the same is inside for ever or never, and must not be divided by its
/// speed: 0 / 0 is no distance.
#[inline]
pub(super) fn slab(origin: f64, speed: f64, parts: [u32; 2]) -> Option<Crossings> {
    let [low, high] = parts;
    if speed == 0.0 {
        return (0.0..=1.0)
            .contains(&origin)
            .then_some(Crossings::EVERYWHERE);
    }
    let low = Hit {
        t: -origin / speed,
        part: low,
    };
    let high = Hit {
        t: (1.0 - origin) / speed,
        part: high,
    };
    let (enter, exit) = if 0.0 < speed {
        (low, high)
    } else {
        (high, low)
    };
    Some(Crossings { enter, exit })
}
