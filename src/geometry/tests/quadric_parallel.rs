//! Lines parallel or nearly parallel to generatrices, where the quadratic term is 0 or rounding,
//! against twice the precision.

use glam::{DMat3, DVec3};

use super::quadrics::{around, exact_hit, quadric, spans, squares};
use super::random::Random;
use super::{Ray, Shape, unit};
use crate::Solid;

/// The coefficients of the squares along the axes, the slope along the third, and the constant.
const KINDS: [([f64; 3], f64, f64); 6] = [
    // A cylinder, an elliptic cylinder, a cone, a hyperboloid, a paraboloid and a slab.
    ([1.0, 1.0, 0.0], 0.0, -1.0),
    ([1.0, 4.0, 0.0], 0.0, -1.0),
    ([1.0, 1.0, -1.0], 0.0, 0.0),
    ([1.0, 1.0, -1.0], 0.0, -1.0),
    ([1.0, 1.0, 0.0], -0.5, 0.0),
    ([1.0, 0.0, 0.0], 0.0, -1.0),
];

#[test]
fn lines_along_the_sides_hit_as_in_twice_the_precision() {
    let mut random = Random(27);
    let (mut hits, mut misses) = (0, 0);
    for index in 0..120_000 {
        let (s, slope, constant) = KINDS[index % 6];
        let upright = random.bits().is_multiple_of(2);
        let axes = if upright {
            DVec3::AXES
        } else {
            random.rotation()
        };
        let [x, _, z] = axes;
        let matrix: DMat3 = squares(axes, s);
        let coefficients = around(DVec3::ZERO, matrix, slope * z, constant);
        let shape = Shape::Solid(Solid::Quadric(Box::new(quadric(coefficients, &[]))));
        // The axis, or a generatrix of the cone.
        let along = if s[2] < 0.0 { unit(x + z) } else { z };
        let off = match index % 4 {
            0 => 0.0,
            _ => random.magnitude(-12.0, 0.0),
        };
        let direction = unit(along + off * random.in_cube());
        let near = 1.5 * random.in_cube();
        let ray = Ray {
            origin: near - random.magnitude(0.0, 8.0) * direction,
            direction,
        };
        let expected = exact_hit(coefficients, &ray);
        hits += usize::from(expected);
        misses += usize::from(!expected);
        assert_eq!(
            !spans(&shape, &ray).is_empty(),
            expected,
            "{index}: {s:?} {coefficients:?} {ray:?}"
        );
    }
    assert!(
        10_000 < hits && 10_000 < misses,
        "{hits} hits, {misses} misses"
    );
}
