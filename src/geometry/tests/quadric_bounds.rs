//! The boxes of quadrics against paper and against what rays find.

use glam::{DMat3, DVec3};

use super::quadrics::{
    BALL, BOWL, CONE, CUBE, CYLINDER, HALF, IMAGINARY, INFINITY, NOTHING, OUTSIDE_OF_BALL, Planes,
    QUARTERS, SLAB, SPACE, TWO_SHEETS, UNIT_HEIGHT, WAIST, around, cut, quadric, spans,
};
use super::random::Random;
use super::{Shape, ray};
use crate::geometry::{Aabb, Quadric};

/// Coefficients, planes, and the least and the greatest coordinates.
type Case<'a> = ([f64; 10], Planes<'a>, [f64; 3], [f64; 3]);

#[test]
fn bounds_on_paper() {
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

/// What rays find inside is in the box, and, where there are ends, some of it is near each side.
#[test]
fn bounds_hold_the_region() {
    let mut random = Random(23);
    let mut bounded = 0;
    for index in 0..1_500 {
        let (coefficients, planes) = cut(&mut random);
        let quadric = Quadric::new(coefficients, &planes);
        let bounds = quadric.bounds();
        bounded += u32::from(bounds.is_bounded());
        let shape = Shape::Quadric(Box::new(quadric));
        for _ in 0..100 {
            let ray = ray(5.0 * random.in_cube(), 5.0 * random.in_cube());
            for span in spans(&shape, &ray) {
                for t in [span.enter.t, span.exit.t] {
                    let (low, high) = if t.is_finite() {
                        (ray.at(t), ray.at(t))
                    } else {
                        let toward = 1e12 * ray.direction * t.signum();
                        (toward, toward)
                    };
                    let slack = 1e-8 * (1.0 + low.length());
                    assert!(
                        (bounds.min - slack).cmple(low).all()
                            && high.cmple(bounds.max + slack).all(),
                        "{index}: {low} is outside {bounds:?}: {coefficients:?} {planes:?}"
                    );
                }
            }
        }
    }
    assert!(200 < bounded, "{bounded} bounded");
}

#[test]
fn coefficients_that_cannot_hold_a_shape_are_known() {
    let ball = |distance: f64| around(distance * DVec3::X, DMat3::IDENTITY, DVec3::ZERO, -1.0);
    assert!(!Quadric::new(ball(5e5), &[]).has_lost_its_shape());
    assert!(Quadric::new(ball(1e6), &[]).has_lost_its_shape());
    for coefficients in [HALF, SLAB, BOWL, CONE, SPACE, NOTHING, CYLINDER] {
        assert!(!Quadric::new(coefficients, &[]).has_lost_its_shape());
    }
}
