//! Mappings from the unit square to directions and points.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use glam::{DVec2, DVec3};

/// Samples a direction uniformly in a cone around a unit vector; u = 0 gives the axis. `versine` is
/// 1 − cos of the half angle, which stays accurate for small angles.
pub(crate) fn in_cone(axis: DVec3, versine: f64, [u, v]: [f64; 2]) -> DVec3 {
    let versine = u * versine;
    let sine = (versine * (2.0 - versine)).max(0.0).sqrt();
    around(axis, 1.0 - versine, sine, v)
}

/// Samples a direction around a unit vector with density cos θ / π.
#[inline]
pub(crate) fn by_cosine(normal: DVec3, [u, v]: [f64; 2]) -> DVec3 {
    around(normal, (1.0 - u).sqrt(), u.sqrt(), v)
}

/// Samples a direction around a unit vector with density (n + 1) / 2π cosⁿ θ.
pub(crate) fn by_power_of_cosine(axis: DVec3, exponent: f64, [u, v]: [f64; 2]) -> DVec3 {
    let cosine = libm::pow(1.0 - u, 1.0 / (exponent + 1.0));
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    around(axis, cosine, sine, v)
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
    let DVec3 { x, y, z } = normal;
    let sign = 1.0f64.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [
        DVec3::new(1.0 + sign * x * x * a, sign * b, -sign * x),
        DVec3::new(b, sign + y * y * a, -y),
    ]
}

/// The unit vector at an angle to an axis, at a fraction of the turn around it.
fn around(axis: DVec3, cosine: f64, sine: f64, part: f64) -> DVec3 {
    let [x, y] = basis(axis);
    let (up, across) = libm::sincos(TAU * part);
    (sine * (across * x + up * y) + cosine * axis).normalize()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const SIDE: usize = 64;

    /// The mean of a function over the midpoints of a fine grid.
    fn mean(of: impl Fn([f64; 2]) -> f64) -> f64 {
        let middle = |i: usize| (i as f64 + 0.5) / SIDE as f64;
        let rows = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| [middle(i), middle(j)]));
        rows.map(of).sum::<f64>() / (SIDE * SIDE) as f64
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
                let turned = mean(|uv| 1.0 - axis.dot(in_cone(axis, versine, uv)));
                assert!((turned - 0.5 * versine).abs() < 1e-12 + 1e-6 * versine);
            }
            let cosine = mean(|uv| axis.dot(by_cosine(axis, uv)));
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
            let direction = in_cone(axis, 0.25, [1.0, part]);
            assert!((direction.dot(axis) - 0.75).abs() < 1e-15);
            assert_eq!(in_cone(axis, 0.25, [0.0, part]), axis.normalize());
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
