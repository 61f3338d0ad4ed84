//! Mirrors, glass, depth and the ray budget.

use super::*;
use crate::material::{power, power_each, refract};
use geometry::lanes::{Level, Row, WIDTH, dispatch};

/// Between two mirrors with emission a and reflectance r, a ray sees a Σ rᵏ, k from 0 to the depth.
#[test]
fn depth_counts_bounces() {
    let glow = Coefficients {
        reflection: 0.5,
        ..grey(0.25)
    };
    let mirrors = [
        (cuboid([-9.0, -9.0, -2.0], [18.0, 18.0, 1.0]), glow),
        (cuboid([-9.0, -9.0, 1.0], [18.0, 18.0, 1.0]), glow),
    ];
    for depth in [0, 1, 2, 8, 60] {
        let expected: f64 = (0..=depth).map(|k| 0.25 * 0.5f64.powi(k)).sum();
        let seen = level(
            scene(&mirrors, &[]),
            depth as u32,
            ray([0.0; 3], [0.0, 0.01, 1.0]),
        );
        assert_near(seen, expected, 1e-15);
    }
}

/// R = d − 2(d·N)N: a ray that hits a mirror floor at 45° leaves at 45°, to a wall as high as far.
#[test]
fn reflected_rays_leave_at_the_angle_of_incidence() {
    let floor = (
        cuboid([-50.0, -1.0, -50.0], [100.0, 1.0, 100.0]),
        Coefficients {
            reflection: 1.0,
            ..BLACK
        },
    );
    let strip = |from: f64, to: f64| {
        (
            cuboid([10.0, from, -5.0], [1e-4, to - from, 10.0]),
            grey(0.5),
        )
    };
    let seen = |strip| {
        level(
            scene(&[floor.clone(), strip], &[]),
            1,
            ray([-1.0, 1.0, 0.0], [0.0; 3]),
        )
    };
    assert_near(seen(strip(9.99, 10.01)), 0.5, 0.0);
    assert_near(seen(strip(9.0, 9.99)), 0.0, 0.0);
    assert_near(seen(strip(10.01, 11.0)), 0.0, 0.0);
}

#[test]
fn refraction_follows_snells_law() {
    for (ratio, degrees) in [
        (1.0 / 1.5, 30.0),
        (1.0 / 1.5, 80.0),
        (1.5, 30.0),
        (1.33, 0.0),
        (1.0, 45.0f64),
    ] {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let refracted = refract(DVec3::new(sine, -cosine, 0.0), DVec3::Y, ratio)
            .expect("below the critical angle");
        assert_near(refracted.x, ratio * sine, 1e-15);
        assert_near(refracted.length(), 1.0, 1e-15);
        assert!(refracted.y < 0.0);
    }
}

/// The critical angle from glass to air is asin(1/1.5).
#[test]
fn total_internal_reflection_begins_at_the_critical_angle() {
    let critical = (1.0f64 / 1.5).asin();
    let at = |angle: f64| refract(DVec3::new(angle.sin(), -angle.cos(), 0.0), DVec3::Y, 1.5);
    assert!(at(critical - 1e-9).is_some());
    assert!(at(critical + 1e-9).is_none());
}

/// A slab of thickness T displaces a ray by T (tan a − tan b), sin b = sin a / n, and preserves its
/// direction.
#[test]
fn a_slab_displaces_the_view_through_it() {
    let glass = Coefficients {
        transmission: 1.0,
        index: 1.5,
        ..BLACK
    };
    let slab = (cuboid([-50.0, -1.0, -50.0], [100.0, 1.0, 100.0]), glass);
    let (a, b) = (45f64.to_radians(), (45f64.to_radians().sin() / 1.5).asin());
    // The ray enters at x = 0 and hits the plane y = −3 two units below the slab.
    let arrives = b.tan() + 2.0 * a.tan();
    for (offset, expected) in [(0.0, 0.5), (0.02, 0.0), (-0.02, 0.0)] {
        let mark = (
            cuboid([arrives + offset - 0.005, -3.0001, -1.0], [0.01, 1e-4, 2.0]),
            grey(0.5),
        );
        let seen = level(
            scene(&[slab.clone(), mark], &[]),
            8,
            ray([-1.0, 1.0, 0.0], [0.0; 3]),
        );
        assert_near(seen, expected, 0.0);
    }
}

/// In glass beyond the critical angle, the transmitted part is reflected too: kr + kt times the
/// radiance of the reflected ray.
#[test]
fn total_internal_reflection_carries_both_weights() {
    let glass = Coefficients {
        reflection: 0.25,
        transmission: 0.5,
        index: 1.5,
        ..BLACK
    };
    // The ray starts inside, hits the block's top at 60°, and is reflected to the lamp inside.
    let block = (cuboid([-50.0, -9.0, -50.0], [100.0, 9.0, 100.0]), glass);
    let lamp = (sphere([3f64.sqrt() * 2.0, -2.0, 0.0], 0.1), grey(1.0));
    let seen = level(
        scene(&[block, lamp], &[]),
        1,
        ray([-(3f64.sqrt()), -1.0, 0.0], [0.0; 3]),
    );
    assert_near(seen, 0.75, 1e-15);
}

/// An index of 0 or less counts as 1: rays are not refracted.
#[test]
fn an_index_of_0_or_less_does_not_refract() {
    for index in [0.0, -2.0, 1.0] {
        let glass = Coefficients {
            transmission: 1.0,
            index,
            ..BLACK
        };
        let objects = [
            (sphere([0.0; 3], 1.0), glass),
            (sphere([3.0, 0.0, 0.0], 1e-3), grey(0.5)),
        ];
        assert_near(
            level(
                scene(&objects, &[]),
                8,
                ray([-3.0, 0.6, 0.0], [3.0, 0.0, 0.0]),
            ),
            0.5,
            0.0,
        );
    }
}

/// At depth 30 this would be a tree of 2³¹ rays. Each ray sees at most the balls' own grey of 1, so
/// the sum counts those that hit: at most the budget of 4096.
#[test]
fn a_ray_tree_ends_with_its_budget() {
    let ray = || ray([0.0, 0.0, 9.0], [0.1, 0.2, 0.0]);
    let (seen, over_budget) = look(splitting_glass(), 30, ray());
    assert_eq!(over_budget, 1);
    assert!(
        1000.0 < seen.radiance.x && seen.radiance.x <= 4096.0,
        "{}",
        seen.radiance.x
    );
    let (_, over_budget) = look(splitting_glass(), 8, ray());
    assert_eq!(over_budget, 0);
}

/// Repeated squaring against exact products of small powers of two, and against the general power.
#[test]
fn integer_powers() {
    for exponent in 0..=64 {
        assert_eq!(
            power(0.5, f64::from(exponent)),
            1.0 / (1u128 << exponent) as f64
        );
    }
    for exponent in [3.0, 255.0, 4096.0] {
        let (ours, general) = (power(0.999, exponent), 0.999f64.powf(exponent));
        assert!((ours / general - 1.0).abs() < 1e-12);
    }
    assert_eq!(power(0.0, 0.0), 1.0);
}

#[test]
fn powers_in_lanes_are_the_same() {
    let cosines = [0.999, 1e-9, 0.0, -0.5, 1.0, 0.25, f64::NAN, 0.7];
    let exponents = [0.0, 1.0, 40.0, 4095.0, 4096.0, 4097.0, 2.5, -3.0];
    for turn in 0..WIDTH {
        let mut exponents = exponents;
        exponents.rotate_left(turn);
        for level in [Level::baseline(), Level::new()] {
            let powers: Row = dispatch!(level, simd => {
                power_each(Row(cosines).load(simd), &exponents, 0b1111_1111).into()
            });
            for lane in 0..WIDTH {
                let alone = power(cosines[lane], exponents[lane]);
                let is_same = powers.0[lane] == alone || powers.0[lane].is_nan() && alone.is_nan();
                assert!(is_same, "{} to the {}", cosines[lane], exponents[lane]);
            }
        }
    }
}
