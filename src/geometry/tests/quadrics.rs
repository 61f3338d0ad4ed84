//! Quadrics against hand-computed values, twice the precision, and equivalent shapes.

use glam::{DMat3, DVec3};

use super::random::Random;
use super::{Frame, Kind, Ray, Shape, ray};
use crate::double_double::{Double, dot, scaled, sum, vector};
use crate::{Quadric, Solid, Spans, ulp};

pub(super) const INFINITY: f64 = f64::INFINITY;

/// Half-spaces n · x ≤ d.
pub(super) type Planes<'a> = &'a [([f64; 3], f64)];

pub(super) fn quadric(coefficients: [f64; 10], planes: Planes) -> Quadric {
    let planes: Vec<_> = planes
        .iter()
        .map(|&(normal, distance)| (DVec3::from_array(normal), distance))
        .collect();
    Quadric::new(coefficients, &planes)
}

/// The coefficients of (x − centre)ᵀ M (x − centre) + 2 slope · (x − centre) + level.
pub(super) fn around(centre: DVec3, matrix: DMat3, slope: DVec3, level: f64) -> [f64; 10] {
    let m = matrix;
    let linear = slope - m * centre;
    let constant = centre.dot(m * centre) - 2.0 * slope.dot(centre) + level;
    [
        m.x_axis.x, m.y_axis.x, m.z_axis.x, linear.x, m.y_axis.y, m.z_axis.y, linear.y, m.z_axis.z,
        linear.z, constant,
    ]
}

/// The matrix of Σ sᵢ (axisᵢ · x)².
pub(super) fn squares(axes: [DVec3; 3], s: [f64; 3]) -> DMat3 {
    let columns = DMat3::from_cols_array_2d(&axes.map(|axis| axis.to_array()));
    columns * DMat3::from_diagonal(DVec3::from_array(s)) * columns.transpose()
}

pub(super) fn spans(shape: &Shape, ray: &Ray) -> Spans {
    let mut spans = Spans::new();
    shape.spans(ray, &mut spans);
    spans
}

pub(super) const BALL: [f64; 10] = [1., 0., 0., 0., 1., 0., 0., 1., 0., -1.];
pub(super) const OUTSIDE_OF_BALL: [f64; 10] = [-1., 0., 0., 0., -1., 0., 0., -1., 0., 1.];
pub(super) const CYLINDER: [f64; 10] = [1., 0., 0., 0., 1., 0., 0., 0., 0., -1.];
pub(super) const CONE: [f64; 10] = [1., 0., 0., 0., 1., 0., 0., -1., 0., 0.];
/// The region z ≥ x² + y².
pub(super) const BOWL: [f64; 10] = [1., 0., 0., 0., 1., 0., 0., 0., -0.5, 0.];
/// The region x² + y² − z² ≤ 1.
pub(super) const WAIST: [f64; 10] = [1., 0., 0., 0., 1., 0., 0., -1., 0., -1.];
/// The region x² + y² + 1 ≤ z².
pub(super) const TWO_SHEETS: [f64; 10] = [1., 0., 0., 0., 1., 0., 0., -1., 0., 1.];
/// The region x y ≤ 0.
pub(super) const QUARTERS: [f64; 10] = [0., 0.5, 0., 0., 0., 0., 0., 0., 0., 0.];
/// The region |x| ≤ 1.
pub(super) const SLAB: [f64; 10] = [1., 0., 0., 0., 0., 0., 0., 0., 0., -1.];
/// The region x ≤ 2.
pub(super) const HALF: [f64; 10] = [0., 0., 0., 0.5, 0., 0., 0., 0., 0., -2.];
pub(super) const SPACE: [f64; 10] = [0., 0., 0., 0., 0., 0., 0., 0., 0., -1.];
pub(super) const NOTHING: [f64; 10] = [0., 0., 0., 0., 0., 0., 0., 0., 0., 1.];
pub(super) const IMAGINARY: [f64; 10] = [1., 0., 0., 0., 1., 0., 0., 1., 0., 1.];
pub(super) const UNIT_HEIGHT: Planes = &[([0., 0., -2.], 0.), ([0., 0., 4.], 4.)];
pub(super) const CUBE: Planes = &[
    ([1., 0., 0.], 1.),
    ([-1., 0., 0.], 0.),
    ([0., 2., 0.], 2.),
    ([0., -1., 0.], 0.),
    ([0., 0., 1.], 1.),
    ([0., 0., -1e-3], 0.),
];

/// Coefficients, planes, a ray's origin and direction, and the spans of its line.
type Case<'a> = (
    [f64; 10],
    Planes<'a>,
    [f64; 3],
    [f64; 3],
    &'a [[(f64, u32); 2]],
);

#[test]
#[allow(clippy::too_many_lines, reason = "a table")]
fn spans_match_hand_computed_values() {
    let (x, z) = ([1., 0., 0.], [0., 0., 1.]);
    let all = [(-INFINITY, 0), (INFINITY, 0)];
    let half = 0.5_f64.sqrt();
    let cases: &[Case] = &[
        (BALL, &[], [0., 0., -5.], z, &[[(4., 0), (6., 0)]]),
        (BALL, &[], [0., 0., -500.], z, &[[(499., 0), (501., 0)]]),
        (BALL, &[], [1., 0., -500.], z, &[[(500., 0), (500., 0)]]),
        (BALL, &[], [2., 0., -500.], z, &[]),
        (
            BALL,
            &[([0., 0., -3.], 0.)],
            [0., 0., -5.],
            z,
            &[[(5., 1), (6., 0)]],
        ),
        (BALL, &[([0., 0., 1.], -2.)], [0., 0., -5.], z, &[]),
        (
            OUTSIDE_OF_BALL,
            &[],
            [0., 0., -5.],
            z,
            &[[(-INFINITY, 0), (4., 0)], [(6., 0), (INFINITY, 0)]],
        ),
        (OUTSIDE_OF_BALL, &[], [2., 0., -5.], z, &[all]),
        (
            OUTSIDE_OF_BALL,
            &[([0., 0., 1.], 2.), ([0., 0., -1.], 2.)],
            [0., 0., -5.],
            z,
            &[[(3., 2), (4., 0)], [(6., 0), (7., 1)]],
        ),
        // Along the axis: inside, on and outside the side; and across.
        (CYLINDER, &[], [0.5, 0.5, -5.], z, &[all]),
        (CYLINDER, &[], [1., 0., 7.], z, &[all]),
        (CYLINDER, &[], [1., 1e-7, 7.], z, &[]),
        (
            CYLINDER,
            UNIT_HEIGHT,
            [0.5, 0., -1e6],
            z,
            &[[(1e6, 1), (1e6 + 1., 2)]],
        ),
        (CYLINDER, &[], [-3., 0., 1e9], x, &[[(2., 0), (4., 0)]]),
        // Both nappes; along a generatrix; parallel to one; through the apex.
        (
            CONE,
            &[],
            [0.5, 0., -3.],
            z,
            &[[(-INFINITY, 0), (2.5, 0)], [(3.5, 0), (INFINITY, 0)]],
        ),
        (
            CONE,
            &[],
            [0., 0., -3.],
            [half, 0., half],
            &[[(-INFINITY, 0), (1.5 / half, 0)]],
        ),
        (CONE, &[], [1., 0., 1.], [half, 0., half], &[all]),
        (CONE, &[], [0., 0., -3.], z, &[all]),
        (CONE, &[], [-3., 0., 0.], x, &[[(3., 0), (3., 0)]]),
        (
            CONE,
            UNIT_HEIGHT,
            [-3., 0., 0.5],
            x,
            &[[(2.5, 0), (3.5, 0)]],
        ),
        (BOWL, &[], [0.5, 0., -3.], z, &[[(3.25, 0), (INFINITY, 0)]]),
        (BOWL, &[], [-3., 0., 4.], x, &[[(1., 0), (5., 0)]]),
        (WAIST, &[], [0., 0., -3.], z, &[all]),
        (WAIST, &[], [-3., 0., 0.], x, &[[(2., 0), (4., 0)]]),
        (
            TWO_SHEETS,
            &[],
            [0., 0., -3.],
            z,
            &[[(-INFINITY, 0), (2., 0)], [(4., 0), (INFINITY, 0)]],
        ),
        (
            QUARTERS,
            &[],
            [-3., 1., 0.],
            x,
            &[[(-INFINITY, 0), (3., 0)]],
        ),
        (
            QUARTERS,
            &[],
            [-3., -1., 0.],
            x,
            &[[(3., 0), (INFINITY, 0)]],
        ),
        (QUARTERS, &[], [1., 1., 0.], z, &[]),
        (SLAB, &[], [-3., 1e5, 0.], x, &[[(2., 0), (4., 0)]]),
        (SLAB, &[], [0.5, 0., 0.], z, &[all]),
        (SLAB, &[], [1.5, 0., 0.], z, &[]),
        (HALF, &[], [-3., 1., 0.], x, &[[(-INFINITY, 0), (5., 0)]]),
        (HALF, &[], [2.5, 1., 0.], z, &[]),
        (SPACE, &[], [2., 1., 0.], z, &[all]),
        (SPACE, CUBE, [-1., 0.5, 0.5], x, &[[(1., 2), (2., 1)]]),
        (SPACE, CUBE, [-1., 2.5, 0.5], x, &[]),
        (NOTHING, &[], [2., 1., 0.], z, &[]),
        (IMAGINARY, &[], [0., 0., -3.], z, &[]),
    ];
    for &(coefficients, planes, origin, direction, expected) in cases {
        let ray = Ray {
            origin: DVec3::from_array(origin),
            direction: DVec3::from_array(direction),
        };
        let shape = Shape::Solid(Solid::Quadric(Box::new(quadric(coefficients, planes))));
        let found: Vec<_> = spans(&shape, &ray)
            .iter()
            .map(|span| [span.enter, span.exit].map(|hit| (hit.t, hit.part)))
            .collect();
        let near = |a: f64, b: f64| a == b || (a - b).abs() <= 4.0 * f64::EPSILON * b.abs();
        let alike = found.len() == expected.len()
            && found.iter().flatten().zip(expected.iter().flatten()).all(
                |(&(t, part), &(on_paper, on_part))| {
                    near(t, on_paper) && (part == on_part || t.is_infinite())
                },
            );
        assert!(
            alike,
            "{coefficients:?} {planes:?} from {origin:?} to {direction:?}: {found:?} is not \
             {expected:?}"
        );
        let hit = shape.hit(&ray, INFINITY).map(|hit| hit.t);
        let nearest = expected
            .iter()
            .flatten()
            .map(|end| end.0)
            .find(|t| 0.0 < *t && *t < INFINITY);
        assert_eq!(hit.is_some(), nearest.is_some(), "{coefficients:?}");
    }
}

/// Whether F is at most 0 anywhere on the line, in twice the precision. The line is first advanced
/// to the extremum of F, where b is nearly 0 and b² − ac does not cancel.
pub(super) fn exact_hit(coefficients: [f64; 10], ray: &Ray) -> bool {
    let [xx, xy, xz, x, yy, yz, y, zz, z, k] = coefficients;
    let rows = [
        vector(DVec3::new(xx, xy, xz)),
        vector(DVec3::new(xy, yy, yz)),
        vector(DVec3::new(xz, yz, zz)),
    ];
    let linear = vector(DVec3::new(x, y, z));
    let of = |v| rows.map(|row| dot(row, v));
    let d = vector(ray.direction);
    let a = dot(d, of(d));
    let b = |o| dot(o, of(d)) + dot(linear, d);
    let origin = vector(ray.origin);
    if a.round() == 0.0 {
        let c = dot(origin, of(origin)) + dot(linear, origin) + dot(linear, origin);
        return b(origin).round() != 0.0 || (c + Double::of(k)).round() <= 0.0;
    }
    let o = sum(origin, scaled(-b(origin) / a, d));
    let c = dot(o, of(o)) + dot(linear, o) + dot(linear, o) + Double::of(k);
    a.round() <= 0.0 || 0.0 <= (b(o) * b(o) - a * c).round()
}

#[test]
fn quadrics_hit_as_in_twice_the_precision() {
    const RAYS_ACROSS: u32 = 256;
    let mut random = Random(21);
    let needle = 1e6;
    let kinds = [
        [1.0, 1.0, 1.0],
        [1.0, 4.0, 0.3],
        [needle * needle, needle * needle, 1.0],
        [1.0, 1.0, needle * needle],
        [1.0, 0.5, -0.7],
        [1.0, 2.0, 0.0],
    ];
    let mut hits = 0;
    for exponent in 1..=8 {
        for s in kinds {
            let axes = random.rotation();
            let matrix = squares(axes, s);
            let distance = 10_f64.powi(exponent);
            // The solid, the eye or both are far from the origin.
            let needles = s.iter().any(|s| needle < *s);
            let away = if needles { 0.0 } else { distance };
            let centre = [0.0, away, 0.3 * away][exponent as usize % 3] * random.direction();
            let coefficients = around(centre, matrix, DVec3::ZERO, -1.0);
            let shape = Shape::Solid(Solid::Quadric(Box::new(quadric(coefficients, &[]))));
            // Across the longest and the shortest axis.
            let [right, back, up] = axes;
            let width = |i: usize| 1.3 / s[i].abs().sqrt().max(1e-3);
            let eye = centre + distance * back;
            for i in 0..RAYS_ACROSS * RAYS_ACROSS {
                let fraction = |i: u32| (2.0 * f64::from(i) + 1.0) / f64::from(RAYS_ACROSS) - 1.0;
                let (x, y) = (fraction(i % RAYS_ACROSS), fraction(i / RAYS_ACROSS));
                let target = centre + x * width(0) * right + y * width(2).min(3.0) * up;
                let ray = ray(eye, target);
                let hit = !spans(&shape, &ray).is_empty();
                hits += u32::from(hit);
                assert_eq!(
                    hit,
                    exact_hit(coefficients, &ray),
                    "{s:?} at {distance}, {x} {y}"
                );
            }
        }
    }
    assert!(500_000 < hits, "{hits} hits");
}

/// The quadric equivalent to a unit solid in an orthogonal frame.
fn as_quadric(kind: Kind, frame: &Frame) -> Shape {
    let axes = frame.directions;
    let [x, y, z] = axes;
    let DVec3 { x: l, y: m, z: n } = frame.lengths;
    let flat = squares(axes, [l.powi(-2), m.powi(-2), 0.0]);
    let at = frame.origin;
    let faces = |u: DVec3, length: f64| [(-u, -u.dot(at)), (u, u.dot(at) + length)];
    let (coefficients, planes) = match kind {
        Kind::Sphere => (around(at, DMat3::IDENTITY, DVec3::ZERO, -l * l), vec![]),
        Kind::Ellipsoid => (
            around(
                at,
                flat + squares(axes, [0.0, 0.0, n.powi(-2)]),
                DVec3::ZERO,
                -1.0,
            ),
            vec![],
        ),
        Kind::Cylinder => (around(at, flat, DVec3::ZERO, -1.0), faces(z, n).to_vec()),
        Kind::Cone => (
            around(
                at + n * z,
                flat - squares(axes, [0.0, 0.0, n.powi(-2)]),
                DVec3::ZERO,
                0.0,
            ),
            faces(z, n).to_vec(),
        ),
        Kind::Cuboid => (SPACE, [faces(x, l), faces(y, m), faces(z, n)].concat()),
    };
    Shape::Solid(Solid::Quadric(Box::new(Quadric::new(
        coefficients,
        &planes,
    ))))
}

#[test]
fn simple_solids_and_equivalent_quadrics_agree() {
    let mut random = Random(22);
    let mut different = 0;
    let rays = 100_000;
    for index in 0..rays {
        let kind = super::KINDS[index % 5];
        let frame = Frame {
            directions: random.rotation(),
            ..random.frame()
        }
        .of(kind);
        let (shape, as_quadric) = (frame.shape(kind), as_quadric(kind, &frame));
        for _ in 0..10 {
            let target = frame.world(1.2 * random.inside(kind));
            let incoming = ray(
                frame.world(random.magnitude(0.0, 3.0) * random.direction()),
                target,
            );
            let (Some(hit), Some(other)) = (
                shape.hit(&incoming, INFINITY),
                as_quadric.hit(&incoming, INFINITY),
            ) else {
                different += usize::from(
                    shape.hit(&incoming, INFINITY).is_some()
                        != as_quadric.hit(&incoming, INFINITY).is_some(),
                );
                continue;
            };
            let (ours, theirs) = (
                shape.surface(&incoming, hit),
                as_quadric.surface(&incoming, other),
            );
            let scale = incoming
                .origin
                .length()
                .max(frame.origin.length())
                .max(hit.t);
            let cosine = ours.normal.dot(incoming.direction).abs();
            if ours.normal.dot(theirs.normal) < 1.0 - 1e-9 || cosine < 1e-4 {
                // At an edge, or close to a silhouette.
                different += usize::from(1e-4 <= cosine);
                continue;
            }
            // The quadric's coefficients are rounded at |origin|².
            let bound = 64.0 * ulp(scale) * scale / cosine;
            let apart = (ours.point - theirs.point).length();
            assert!(apart < bound, "{kind:?} {index}: {apart} {bound}");
        }
    }
    assert!(different * 10_000 <= 10 * rays, "{different} differ");
}

/// A random quadric of any kind, clipped by a few random planes, some of them parallel.
pub(super) fn random_quadric(random: &mut Random) -> ([f64; 10], Vec<(DVec3, f64)>) {
    let mut pick = || [-1.0, 0.0, 0.3, 1.0, 2.0][(random.bits() % 5) as usize];
    let s = [pick(), pick(), pick()];
    let slope = 0.5 * DVec3::new(pick(), pick(), pick());
    let level = -pick();
    let centre = 3.0 * random.in_cube();
    let axes = random.rotation();
    let coefficients = around(centre, squares(axes, s), slope, level);
    let planes = (0..random.bits() % 8)
        .map(|_| {
            let normal = if random.bits().is_multiple_of(2) {
                axes[(random.bits() % 3) as usize]
            } else {
                random.direction()
            };
            let side = if random.bits().is_multiple_of(2) {
                normal
            } else {
                -normal
            };
            (
                2.0 * side,
                2.0 * (side.dot(centre) + random.between(0.0, 2.0)),
            )
        })
        .collect();
    (coefficients, planes)
}

#[test]
fn leaving_rays_do_not_return() {
    let mut random = Random(24);
    let mut surfaces = 0;
    for index in 0..20_000 {
        let (coefficients, planes) = random_quadric(&mut random);
        let shape = Shape::Solid(Solid::Quadric(Box::new(Quadric::new(
            coefficients,
            &planes,
        ))));
        let incoming = ray(
            random.magnitude(0.0, 4.0) * random.direction(),
            4.0 * random.in_cube(),
        );
        let Some(hit) = shape.hit(&incoming, INFINITY) else {
            continue;
        };
        let surface = shape.surface(&incoming, hit);
        if 1e6 < surface.point.length() {
            continue;
        }
        surfaces += 1;
        let off = (surface.point - incoming.at(hit.t)).length();
        assert!(
            off < 1e-7 * (1.0 + hit.t),
            "{index}: {off} {hit:?} {coefficients:?}"
        );
        for _ in 0..50 {
            let direction = random.direction();
            let leaving = Ray {
                origin: surface.leave(direction),
                direction,
            };
            let again = shape.hit(&leaving, 4.0 * ulp(surface.scale));
            assert_eq!(again, None, "{index} {coefficients:?} {planes:?}");
        }
    }
    assert!(5_000 < surfaces, "{surfaces} surfaces");
}

#[test]
fn extreme_coefficients_give_ordered_spans_or_none() {
    let mut random = Random(25);
    let sizes = [
        0.0,
        5e-324,
        1e-300,
        1e-150,
        1.0,
        -1.0,
        -1e-150,
        1e150,
        f64::MAX,
    ];
    for _ in 0..5_000 {
        let coefficients = std::array::from_fn(|_| sizes[(random.bits() % 9) as usize]);
        let plane = (
            random.magnitude(-300.0, 300.0) * random.direction(),
            random.magnitude(-300.0, 300.0),
        );
        let quadric = Quadric::new(coefficients, &[plane]);
        let bounds = quadric.bounds();
        assert!(
            !bounds.min.is_nan() && !bounds.max.is_nan(),
            "{coefficients:?}"
        );
        let incoming = Ray {
            origin: random.magnitude(-200.0, 200.0) * random.in_cube(),
            direction: random.direction(),
        };
        let shape = Shape::Solid(Solid::Quadric(Box::new(quadric)));
        for span in spans(&shape, &incoming) {
            assert!(span.enter.t <= span.exit.t);
        }
        if let Some(hit) = shape.hit(&incoming, INFINITY) {
            let _ = shape.surface(&incoming, hit);
        }
    }
}

#[test]
fn powers_of_two_scale_exactly() {
    let mut random = Random(26);
    for _ in 0..2_000 {
        let (coefficients, planes) = random_quadric(&mut random);
        let shape = Shape::Solid(Solid::Quadric(Box::new(Quadric::new(
            coefficients,
            &planes,
        ))));
        let incoming = ray(
            random.magnitude(0.0, 4.0) * random.direction(),
            4.0 * random.in_cube(),
        );
        let found = spans(&shape, &incoming);
        for exponent in [1, -1, 7, -20, 40] {
            let size = 2_f64.powi(exponent);
            let mut scaled = coefficients;
            for linear in [3, 6, 8] {
                scaled[linear] *= size;
            }
            scaled[9] *= size * size;
            let planes: Vec<_> = planes.iter().map(|(n, d)| (*n, size * d)).collect();
            let shape = Shape::Solid(Solid::Quadric(Box::new(Quadric::new(scaled, &planes))));
            let ray = Ray {
                origin: size * incoming.origin,
                ..incoming
            };
            let again = spans(&shape, &ray);
            assert_eq!(again.len(), found.len());
            for (ours, theirs) in again.iter().zip(&found) {
                assert_eq!(ours.enter.t, size * theirs.enter.t);
                assert_eq!(ours.exit.t, size * theirs.exit.t);
            }
        }
    }
}
