//! Mappings from the unit square to directions and points.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use glam::{DVec2, DVec3};

use geometry::lanes::{Lanes, Vector};

/// Samples directions uniformly in cones around unit vectors, in each lane; u = 0 gives the axis.
/// `versine` is 1 − cos of the half angle, which stays accurate for small angles.
#[inline(always)]
pub(crate) fn in_cone<N: Lanes>(axis: Vector<N>, versine: N, [u, v]: [N; 2]) -> Vector<N> {
    let versine = u * versine;
    let square = versine * (versine.all(2.0) - versine);
    let sine = square.larger(square.all(0.0)).sqrt();
    around(axis, versine.all(1.0) - versine, sine, v)
}

/// Samples directions around unit vectors with density cos θ / π, in each lane.
#[inline(always)]
pub(crate) fn by_cosine<N: Lanes>(normal: Vector<N>, [u, v]: [N; 2]) -> Vector<N> {
    around(normal, (u.all(1.0) - u).sqrt(), u.sqrt(), v)
}

/// Samples a direction around a unit vector with density (n + 1) / 2π cosⁿ θ.
pub(crate) fn by_power_of_cosine(axis: DVec3, exponent: f64, [u, v]: [f64; 2]) -> DVec3 {
    let cosine = libm::pow(1.0 - u, 1.0 / (exponent + 1.0));
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    around(axis.into(), cosine, sine, v).into()
}

/// Maps to the unit disc, uniformly and continuously; (½, ½) maps to the centre (Shirley and Chiu,
/// "A Low Distortion Map Between Disk and Square", 1997).
pub(crate) fn in_disc([u, v]: [f64; 2]) -> DVec2 {
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let (radius, angle) = if x.abs() > y.abs() {
        (x, FRAC_PI_4 * (y / x))
    } else if y != 0.0 {
        (y, FRAC_PI_2 - FRAC_PI_4 * (x / y))
    } else {
        return DVec2::ZERO;
    };
    let (sine, cosine) = libm::sincos(angle);
    radius * DVec2::new(cosine, sine)
}

/// Two unit vectors that complete a unit vector to a right-handed basis (Duff and others, "Building
/// an Orthonormal Basis, Revisited", JCGT 6(1), 2017).
pub(crate) fn basis(normal: DVec3) -> [DVec3; 2] {
    let [x, y] = bases(normal.into());
    [x.into(), y.into()]
}

/// [`basis`] in each lane.
#[inline(always)]
fn bases<N: Lanes>(normal: Vector<N>) -> [Vector<N>; 2] {
    let Vector { x, y, z } = normal;
    let one = x.all(1.0);
    let sign = one.copysign(z);
    let a = -one / (sign + z);
    let b = x * y * a;
    let first = Vector {
        x: one + sign * x * x * a,
        y: sign * b,
        z: -sign * x,
    };
    let second = Vector {
        x: b,
        y: sign + y * y * a,
        z: -y,
    };
    [first, second]
}

/// The unit vectors at angles to axes, at fractions of the turn around them, in each lane.
#[inline(always)]
fn around<N: Lanes>(axis: Vector<N>, cosine: N, sine: N, part: N) -> Vector<N> {
    let [x, y] = bases(axis);
    let [up, across] = (part.all(TAU) * part).sincos();
    let aside = x.scaled(across) + y.scaled(up);
    (aside.scaled(sine) + axis.scaled(cosine)).unit()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const GRID: usize = 64;

    /// The mean of a function over the midpoints of a fine grid.
    fn mean(of: impl Fn([f64; 2]) -> f64) -> f64 {
        let middle = |i: usize| (i as f64 + 0.5) / GRID as f64;
        let rows = (0..GRID).flat_map(|i| (0..GRID).map(move |j| [middle(i), middle(j)]));
        rows.map(of).sum::<f64>() / (GRID * GRID) as f64
    }

    fn axes() -> impl Iterator<Item = DVec3> {
        let values = [-1.0, -0.3, 0.0, 1e-9, 0.7];
        let all = values.into_iter().flat_map(move |x| {
            values
                .into_iter()
                .flat_map(move |y| values.map(|z| [x, y, z]))
        });
        all.filter_map(|axis| DVec3::from(axis).try_normalize())
    }

    #[test]
    fn a_basis_is_orthonormal_and_right_handed() {
        for normal in axes() {
            let [x, y] = basis(normal);
            for (a, b, expected) in [(x, x, 1.0), (y, y, 1.0), (x, y, 0.0), (x, normal, 0.0)] {
                assert!((a.dot(b) - expected).abs() < 1e-15, "{normal}");
            }
            assert!((x.cross(y) - normal).length() < 1e-15, "{normal}");
        }
    }

    /// The mean cosine characterises each density: ½ (1 + cos of the half angle), ⅔, and (n + 1) /
    /// (n + 2).
    #[test]
    fn mean_cosines_match_the_densities() {
        for axis in axes() {
            for versine in [1e-12, 0.1, 1.0, 2.0] {
                let turned = mean(|uv| 1.0 - axis.dot(in_cone(axis.into(), versine, uv).into()));
                assert!((turned - 0.5 * versine).abs() < 1e-12 + 1e-6 * versine);
            }
            let cosine = mean(|uv| axis.dot(by_cosine(axis.into(), uv).into()));
            assert!((cosine - 2.0 / 3.0).abs() < 1e-3, "{cosine}");
            for exponent in [0.0, 1.0, 20.0] {
                let cosine = mean(|uv| axis.dot(by_power_of_cosine(axis, exponent, uv)));
                let expected = (exponent + 1.0) / (exponent + 2.0);
                assert!((cosine - expected).abs() < 1e-3, "{cosine}, {expected}");
            }
        }
    }

    #[test]
    fn directions_stay_within_the_cone() {
        let axis = DVec3::new(1.0, 2.0, -3.0).normalize();
        for part in [0.0, 0.2, 0.5, 0.999] {
            let in_cone = |place| DVec3::from(in_cone(axis.into(), 0.25, place));
            assert!((in_cone([1.0, part]).dot(axis) - 0.75).abs() < 1e-15);
            assert_eq!(in_cone([0.0, part]), axis.normalize());
        }
    }

    /// For a uniform disc the mean square of the radius is ½, that of each coordinate ¼.
    #[test]
    fn the_disc_is_filled_uniformly() {
        assert!((mean(|uv| in_disc(uv).length_squared()) - 0.5).abs() < 1e-3);
        assert!((mean(|uv| in_disc(uv).x.powi(2)) - 0.25).abs() < 1e-3);
        let inner = mean(|uv| f64::from(u8::from(in_disc(uv).length() < 0.5)));
        assert!((inner - 0.25).abs() < 5e-3, "{inner}");
        assert_eq!(in_disc([0.5, 0.5]), DVec2::ZERO);
        let edge = in_disc([1.0, 0.5]);
        assert!((edge - DVec2::X).length() < 1e-15);
        assert!(
            (libm::atan2(in_disc([1.0, 1.0]).y, in_disc([1.0, 1.0]).x) - PI / 4.0).abs() < 1e-15
        );
    }
}
