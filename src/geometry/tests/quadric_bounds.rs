//! Bounding boxes of quadrics against hand-computed values and points on rays.

use glam::{DMat3, DVec3};

use super::quadrics::{
    BALL, BOWL, CONE, CUBE, CYLINDER, HALF, IMAGINARY, INFINITY, NOTHING, OUTSIDE_OF_BALL, Planes,
    QUARTERS, SLAB, SPACE, TWO_SHEETS, UNIT_HEIGHT, WAIST, around, quadric, random_quadric,
    squares,
};
use super::random::Random;
use super::ray;
use crate::{Aabb, Quadric};

/// Coefficients, planes, and the minimum and maximum corners.
type Case<'a> = ([f64; 10], Planes<'a>, [f64; 3], [f64; 3]);

#[test]
fn bounds_match_hand_computed_values() {
    let (inf, root) = (INFINITY, 2_f64.sqrt());
    let tilted = [0.5, 0.5, 0., 0., 0.5, 0., 0., 0., 0., -1.];
    let shifted = around(DVec3::new(1., 2., 3.), DMat3::IDENTITY, DVec3::ZERO, -4.0);
    let cases: &[Case] = &[
        (BALL, &[], [-1.; 3], [1.; 3]),
        (shifted, &[], [-1., 0., 1.], [3., 4., 5.]),
        (BALL, &[([0., 0., 1.], 0.)], [-1.; 3], [1., 1., 0.]),
        (
            BALL,
            &[([0., 0., 1.], -0.6)],
            [-0.8, -0.8, -1.],
            [0.8, 0.8, -0.6],
        ),
        (
            BALL,
            &[([1., 1., 0.], 0.)],
            [-1.; 3],
            [0.5 * root, 0.5 * root, 1.],
        ),
        (OUTSIDE_OF_BALL, &[], [-inf; 3], [inf; 3]),
        (OUTSIDE_OF_BALL, CUBE, [0.; 3], [1.; 3]),
        (CYLINDER, &[], [-1., -1., -inf], [1., 1., inf]),
        (CYLINDER, UNIT_HEIGHT, [-1., -1., 0.], [1.; 3]),
        (tilted, &[], [-inf; 3], [inf; 3]),
        (CONE, &[], [-inf; 3], [inf; 3]),
        (CONE, UNIT_HEIGHT, [-1., -1., 0.], [1.; 3]),
        (
            CONE,
            &[([0., 0., -1.], -1.), ([0., 0., 1.], 2.)],
            [-2., -2., 1.],
            [2.; 3],
        ),
        (BOWL, &[], [-inf, -inf, 0.], [inf; 3]),
        (BOWL, &[([0., 0., 1.], 4.)], [-2., -2., 0.], [2., 2., 4.]),
        (WAIST, UNIT_HEIGHT, [-root, -root, 0.], [root, root, 1.]),
        (
            TWO_SHEETS,
            &[([0., 0., -1.], 0.)],
            [-inf, -inf, 1.],
            [inf; 3],
        ),
        (
            TWO_SHEETS,
            &[([0., 0., -1.], 0.), ([0., 0., 1.], root)],
            [-1., -1., 1.],
            [1., 1., root],
        ),
        (SLAB, &[], [-1., -inf, -inf], [1., inf, inf]),
        (SLAB, UNIT_HEIGHT, [-1., -inf, 0.], [1., inf, 1.]),
        (HALF, &[], [-inf; 3], [2., inf, inf]),
        (SPACE, CUBE, [0.; 3], [1.; 3]),
        (SPACE, &[([1., 1., 0.], 1.)], [-inf; 3], [inf; 3]),
        (QUARTERS, CUBE, [0.; 3], [1.; 3]),
    ];
    for &(coefficients, planes, min, max) in cases {
        let quadric = quadric(coefficients, planes);
        let bounds = quadric.bounds();
        let near =
            |a: DVec3, b: [f64; 3]| (0..3).all(|k| a[k] == b[k] || (a[k] - b[k]).abs() < 2e-8);
        assert!(
            near(bounds.min, min) && near(bounds.max, max),
            "{coefficients:?} {planes:?}: {bounds:?} is not {min:?} {max:?}"
        );
        assert!(!quadric.is_empty());
    }
    let empty: &[([f64; 10], Planes)] = &[
        (NOTHING, &[]),
        (IMAGINARY, &[]),
        (BALL, &[([0., 0., 1.], -1.001)]),
        (SPACE, &[([0., 0., 1.], -1.), ([0., 0., -1.], -1.)]),
        (TWO_SHEETS, &[([0., 0., -1.], 0.9), ([0., 0., 1.], 0.9)]),
    ];
    for &(coefficients, planes) in empty {
        assert!(
            quadric(coefficients, planes).is_empty(),
            "{coefficients:?} {planes:?}"
        );
        assert_eq!(quadric(coefficients, planes).bounds(), Aabb::EMPTY);
    }
}

/// Whether a point is inside a region by more than rounding.
fn is_inside(coefficients: [f64; 10], planes: &[(DVec3, f64)], p: DVec3) -> bool {
    let [xx, xy, xz, x, yy, yz, y, zz, z, constant] = coefficients;
    let terms = [
        xx * p.x * p.x,
        2.0 * xy * p.x * p.y,
        2.0 * xz * p.x * p.z,
        2.0 * x * p.x,
        yy * p.y * p.y,
        2.0 * yz * p.y * p.z,
        2.0 * y * p.y,
        zz * p.z * p.z,
        2.0 * z * p.z,
        constant,
    ];
    let rounding = 1e-9 * terms.iter().map(|term| term.abs()).sum::<f64>();
    terms.iter().sum::<f64>() < -rounding
        && planes.iter().all(|&(normal, distance)| {
            let rounding = 1e-9 * (normal.length() * p.length() + distance.abs());
            normal.dot(p) < distance - rounding
        })
}

/// The box contains all points of the region, near and far.
#[test]
fn bounds_contain_the_region() {
    let mut random = Random(23);
    let (mut bounded, mut inside) = (0, 0);
    for index in 0..3_000 {
        let (mut coefficients, planes) = random_quadric(&mut random);
        if index % 2 == 0 {
            // A slab, which only planes can bound.
            let axes = [DVec3::AXES, random.rotation()][index / 2 % 2];
            let matrix = squares(axes, [0.0, 0.1, 0.0]);
            coefficients = around(3.0 * random.in_cube(), matrix, DVec3::ZERO, -1.0);
        }
        let bounds = Quadric::new(coefficients, &planes).bounds();
        bounded += u32::from(bounds.is_bounded());
        for _ in 0..100 {
            let ray = ray(5.0 * random.in_cube(), 5.0 * random.in_cube());
            for step in -20..=20 {
                let point = ray.at(0.05 * f64::from(step * step * step));
                if is_inside(coefficients, &planes, point) {
                    inside += 1;
                    let slack = 1e-8 * (1.0 + point.length());
                    assert!(
                        (bounds.min - slack).cmple(point).all()
                            && point.cmple(bounds.max + slack).all(),
                        "{index}: {point} is outside {bounds:?}: {coefficients:?} {planes:?}"
                    );
                }
            }
        }
    }
    assert!(200 < bounded, "{bounded} bounded");
    assert!(100_000 < inside, "{inside} points");
}

#[test]
fn coefficients_too_imprecise_for_a_shape_are_detected() {
    let ball = |distance: f64| around(distance * DVec3::X, DMat3::IDENTITY, DVec3::ZERO, -1.0);
    assert!(!Quadric::new(ball(5e5), &[]).has_lost_its_shape());
    assert!(Quadric::new(ball(1e6), &[]).has_lost_its_shape());
    for coefficients in [HALF, SLAB, BOWL, CONE, SPACE, NOTHING, CYLINDER] {
        assert!(!Quadric::new(coefficients, &[]).has_lost_its_shape());
    }
}
