//! Reflection, refraction and highlights: directions and Fresnel weights.

use std::cmp::Ordering;

use glam::DVec3;

use crate::sampling::warp;
use geometry::lanes::{Eight, Lanes, Simd, Vector, WIDTH, each_bit, mask};
use scene::{Reflectance, Rgb};

/// Reflects unit directions, in each lane: R = d − 2(d·N)N.
#[inline(always)]
pub(crate) fn mirror<N: Lanes>(direction: Vector<N>, normal: Vector<N>) -> Vector<N> {
    let along = direction.dot(normal);
    (direction - normal.scaled(along.all(2.0) * along)).unit()
}

/// Reflects one unit direction.
#[inline]
pub(crate) fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    mirror(direction.into(), normal.into()).into()
}

/// Refracts unit directions by Snell's law at surfaces whose normals face them, with `ratio` =
/// n1/n2; the mask selects lanes without total internal reflection.
#[inline(always)]
pub(crate) fn refract_all<N: Lanes>(
    direction: Vector<N>,
    normal: Vector<N>,
    ratio: N,
) -> (Vector<N>, N::Mask) {
    let (zero, one) = (ratio.all(0.0), ratio.all(1.0));
    let cosine = -direction.dot(normal);
    let squared = one - ratio * ratio * (one - cosine * cosine);
    let along = normal.scaled(ratio * cosine - squared.sqrt());
    let refracted = (direction.scaled(ratio) + along).unit();
    (refracted, !squared.below(zero))
}

/// Refracts one unit direction; `None` on total internal reflection.
pub(crate) fn refract(direction: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    let (refracted, passes) = refract_all(direction.into(), normal.into(), ratio);
    passes.then(|| refracted.into())
}

/// The effective index of refraction: values of 0 or less count as 1.
pub(crate) fn index(said: f64) -> f64 {
    if 0.0 < said { said } else { 1.0 }
}

/// The reflectance at normal incidence between two indices: ((n1 − n2) / (n1 + n2))².
pub(crate) fn normal_reflectance(first: f64, second: f64) -> f64 {
    let root = (first - second) / (first + second);
    root * root
}

/// Schlick's interpolation from normal reflectance to 1: (1 − c)⁵ (Schlick, "An Inexpensive BRDF
/// Model for Physically-based Rendering", 1994).
pub(crate) fn schlick(cosine: f64) -> f64 {
    let rest = 1.0 - cosine.clamp(0.0, 1.0);
    let square = rest * rest;
    square * square * rest
}

/// The reflectance of glass by Schlick's approximation: `incident` and `refracted` are the cosines
/// on the sides of the indices `first` and `second`; the one on the side of the smaller index is
/// used. Zero where the indices are equal; otherwise 1 where the normal looks away from the incident
/// side, as an interpolated one may: what passed there would come back on the same side of it, on a
/// way that no photon takes the other way round.
pub(crate) fn fresnel(first: f64, incident: f64, second: f64, refracted: f64) -> f64 {
    let cosine = match first.total_cmp(&second) {
        Ordering::Equal => return 0.0,
        _ if incident < 0.0 => 0.0,
        Ordering::Less => incident,
        Ordering::Greater => refracted,
    };
    let f0 = normal_reflectance(first, second);
    f0 + (1.0 - f0) * schlick(cosine)
}

/// Light at the boundary of a transparent solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Refraction {
    /// Reflected fraction; 1 on total internal reflection.
    pub(crate) reflectance: f64,
    /// Refracted direction; `None` on total internal reflection.
    pub(crate) refracted: Option<DVec3>,
}

impl Refraction {
    /// Computes the refraction of light with unit `direction` between two indices, at a surface
    /// whose `normal` faces it.
    pub(crate) fn new(
        direction: DVec3,
        normal: DVec3,
        indices: [f64; 2],
        reflectance: Reflectance,
    ) -> Self {
        let [from, to] = indices;
        let refracted = refract(direction, normal, from / to);
        let short_of_total = |refracted: DVec3| match reflectance {
            Reflectance::TotalOnly => 0.0,
            Reflectance::Schlick => {
                let incident = -direction.dot(normal);
                fresnel(from, incident, to, -refracted.dot(normal))
            }
        };
        Self {
            reflectance: refracted.map_or(1.0, short_of_total),
            refracted,
        }
    }
}

/// The transmittance along a path (Beer, Lambert): e^(−absorption · length).
#[inline]
pub(crate) fn transmitted(absorption: Rgb, length: f64) -> Rgb {
    if absorption == Rgb::ZERO {
        return Rgb::ONE;
    }
    absorption.map(|lost| libm::exp(-lost * length))
}

/// Spreads a direction in a cone whose half angle has this tangent; the part of the cone beyond the
/// surface is folded back to the side that `outward` points to.
pub(crate) fn spread(
    direction: DVec3,
    tangent: f64,
    outward: DVec3,
    numbers: impl FnOnce() -> Option<[f64; 2]>,
) -> DVec3 {
    if tangent == 0.0 {
        return direction;
    }
    let Some(numbers) = numbers() else {
        return direction;
    };
    let secant = (1.0 + tangent * tangent).sqrt();
    let versine = tangent * tangent / (secant * (secant + 1.0));
    let versine = if versine.is_finite() { versine } else { 1.0 };
    let spread = DVec3::from(warp::in_cone(direction.into(), versine, numbers));
    let height = spread.dot(outward);
    if height < 0.0 && 0.0 <= direction.dot(outward) {
        spread - 2.0 * height * outward
    } else {
        spread
    }
}

/// The normal of a facet of a surface with this `normal`: of density (g+1)/2π (N·H)^g for an exponent
/// g, by two numbers in 0..1. The surface's own without numbers, and for facets that face away from
/// the viewer.
pub(crate) fn facet(normal: DVec3, view: DVec3, exponent: f64, numbers: Option<[f64; 2]>) -> DVec3 {
    let Some(numbers) = numbers else {
        return normal;
    };
    let halfway = warp::by_power_of_cosine(normal, exponent.max(0.0), numbers);
    if view.dot(halfway) <= 0.0 {
        normal
    } else {
        halfway
    }
}

/// A direction that a facet leads to, folded back to the side of the surface that `outward` points
/// to, unless the viewer sees the surface from behind.
pub(crate) fn folded(direction: DVec3, outward: DVec3, (view, normal): (DVec3, DVec3)) -> DVec3 {
    let height = direction.dot(outward);
    if height < 0.0 && 0.0 <= view.dot(normal) {
        direction - 2.0 * height * outward
    } else {
        direction
    }
}

/// The power of a highlight: cosineⁿ, 0 for a negative cosine; 0⁰ = 1, and n < 0 counts as 0.
/// Integer exponents up to 4096 use repeated squaring, which is exact to a few ulp, equal on all
/// machines and ten times as fast as the general power.
#[inline]
pub(crate) fn power(cosine: f64, exponent: f64) -> f64 {
    if cosine < 0.0 {
        return 0.0;
    }
    let exponent = exponent.max(0.0);
    let Some(mut rest) = whole(exponent) else {
        return libm::pow(cosine, exponent);
    };
    let (mut power, mut square) = (1.0, cosine);
    while rest != 0 {
        if rest & 1 == 1 {
            power *= square;
        }
        square *= square;
        rest >>= 1;
    }
    power
}

/// The same in several lanes; others are undefined.
#[inline(always)]
pub(crate) fn power_each<S: Simd>(
    cosines: Eight<S>,
    exponents: &[f64; WIDTH],
    lanes: u32,
) -> Eight<S> {
    /// Binary digits of [`MOST_SQUARED`].
    const DIGITS: usize = 13;
    let simd = cosines.simd;
    // For each digit, the lanes in whose exponent it is 1.
    let mut digits = [0; DIGITS];
    let (mut all, mut others) = (0, 0);
    for lane in each_bit(lanes) {
        if let Some(whole) = whole(exponents[lane].max(0.0)) {
            all |= whole;
            for digit in each_bit(whole) {
                digits[digit] |= 1 << lane;
            }
        } else {
            others |= 1 << lane;
        }
    }
    let (zero, one) = (cosines.all(0.0), cosines.all(1.0));
    let (mut powers, mut square) = (one, cosines);
    let used = (u32::BITS - all.leading_zeros()) as usize;
    for &lanes in &digits[..used] {
        powers = Lanes::select(mask(simd, lanes), powers * square, powers);
        square = square * square;
    }
    powers = Lanes::select(cosines.below(zero), zero, powers);
    for lane in each_bit(others) {
        powers[lane] = power(cosines[lane], exponents[lane]);
    }
    powers
}

/// The largest exponent whose power is computed by repeated squaring.
const MOST_SQUARED: u32 = 4096;

/// An exponent of 0 or more that is an integer for which repeated squaring pays.
#[inline]
fn whole(exponent: f64) -> Option<u32> {
    let whole = exponent as u32;
    (f64::from(whole) == exponent && whole <= MOST_SQUARED).then_some(whole)
}

/// Scalar weight of a colour, used for probabilities.
pub(crate) fn strength(colour: Rgb) -> f64 {
    let strength = colour.abs().max_element();
    if strength.is_finite() { strength } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: ((1 − 1.5) / 2.5)² = .04; at 60° 0.04 + 0.96 / 32 = .07. Leaving glass at an angle
    /// whose sine is ⅓ the ray is in air at 30°: 1 − cos 30° = 0.133975, to the fifth 4.316e-5.
    #[test]
    fn schlick_matches_values_computed_by_hand() {
        let from_air = |cosine| fresnel(1.0, cosine, 1.5, 0.9);
        for (cosine, share) in [(1.0, 0.04), (0.5, 0.07), (0.0, 1.0)] {
            assert!((from_air(cosine) - share).abs() < 1e-15, "{cosine}");
        }
        let from_glass = fresnel(1.5, 8.0f64.sqrt() / 3.0, 1.0, 0.75f64.sqrt());
        assert!((from_glass - (0.04 + 0.96 * 4.316_307e-5)).abs() < 1e-9);
        assert_eq!(fresnel(1.5, 0.1, 1.5, 0.1), 0.0);
        // A normal that looks away has no cosine, on either side of the boundary.
        assert_eq!(
            [fresnel(1.0, -0.1, 1.5, 0.7), fresnel(1.5, -0.1, 1.0, 0.3)],
            [1.0; 2]
        );
        assert_eq!(fresnel(1.5, -0.1, 1.5, 0.1), 0.0);
        // Toward an index below that of air, the inside cosine is used.
        assert!((fresnel(1.0, 0.9, 0.5, 0.5) - (1.0 / 9.0 + 8.0 / 9.0 / 32.0)).abs() < 1e-15);
    }

    #[test]
    fn an_index_of_0_or_less_counts_as_1() {
        assert_eq!([1.5, 0.0, -2.0].map(index), [1.5, 1.0, 1.0]);
    }
}
