//! Hand-computed cases: simple rays, rays along axes, and degenerate frames.

use glam::DVec3;

use super::random::Random;
use super::{Frame, KINDS, Kind, Ray, only_span, ray};
use crate::{Aabb, Affine, Hit};

/// A unit solid, a ray's origin and direction, and where it enters and leaves: distance and part.
type Case = (Kind, [f64; 3], [f64; 3], Option<[(f64, u32); 2]>);

fn check(cases: &[Case]) {
    let frame = Frame::upright(DVec3::ZERO, DVec3::ONE);
    for &(kind, origin, direction, expected) in cases {
        let ray = Ray {
            origin: DVec3::from_array(origin),
            direction: DVec3::from_array(direction),
        };
        let found = only_span(&frame.shape(kind), &ray)
            .map(|crossings| [crossings.enter, crossings.exit].map(|hit| (hit.t, hit.part)));
        let alike = match (found, expected) {
            (Some(found), Some(expected)) => (0..2).all(|i| {
                let ((t, part), (on_paper, on_part)) = (found[i], expected[i]);
                // Relative: a ray that starts on a surface must hit it at exactly 0.
                (t - on_paper).abs() <= 2.0 * f64::EPSILON * on_paper.abs() && part == on_part
            }),
            _ => found == expected,
        };
        assert!(
            alike,
            "{kind:?} from {origin:?} to {direction:?}: {found:?} is not {expected:?}"
        );
    }
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

#[test]
fn spheres_match_hand_computed_values() {
    let from_start = |enter, exit| Some([(enter, 0), (exit, 0)]);
    for kind in [Kind::Sphere, Kind::Ellipsoid] {
        check(&[
            (kind, [0.0, 0.0, -5.0], Z, from_start(4.0, 6.0)),
            (kind, [0.0, 0.0, 0.0], Z, from_start(-1.0, 1.0)),
            (kind, [0.0, 0.0, 5.0], Z, from_start(-6.0, -4.0)),
            (kind, [1.0, 0.0, 0.0], X, from_start(-2.0, 0.0)),
            (kind, [-1.0, 0.0, 0.0], X, from_start(0.0, 2.0)),
            (kind, [1.0, 0.0, -5.0], Z, from_start(5.0, 5.0)),
            (kind, [1.0, 0.0, 0.0], Z, from_start(0.0, 0.0)),
            (kind, [1.0 + 1e-15, 0.0, -5.0], Z, None),
            (kind, [1.0, 1.0, -5.0], Z, None),
            (kind, [1.0, 0.0, -128.0], Z, from_start(128.0, 128.0)),
        ]);
    }
}

#[test]
fn cuboids_match_hand_computed_values() {
    let kind = Kind::Cuboid;
    check(&[
        (kind, [-1.0, 0.5, 0.5], X, Some([(1.0, 0), (2.0, 1)])),
        (kind, [0.5, -1.0, 0.5], Y, Some([(1.0, 2), (2.0, 3)])),
        (kind, [0.5, 0.5, 3.0], DOWN, Some([(2.0, 5), (3.0, 4)])),
        (kind, [0.5, 0.5, 0.5], Z, Some([(-0.5, 4), (0.5, 5)])),
        (kind, [0.5, 0.5, 2.0], Z, Some([(-2.0, 4), (-1.0, 5)])),
        (kind, [0.0, 0.5, 0.5], X, Some([(0.0, 0), (1.0, 1)])),
        // In the plane of a face, along an edge, and beside them.
        (kind, [-1.0, 0.0, 0.5], X, Some([(1.0, 0), (2.0, 1)])),
        (kind, [-1.0, 1.0, 1.0], X, Some([(1.0, 0), (2.0, 1)])),
        (kind, [0.0, 0.0, 0.5], X, Some([(0.0, 0), (1.0, 1)])),
        (kind, [-1.0, 1.0 + f64::EPSILON, 1.0], X, None),
        (kind, [-1.0, -f64::MIN_POSITIVE, 0.5], X, None),
        (kind, [2.0, 2.0, 0.5], X, None),
    ]);
}

#[test]
fn cylinders_match_hand_computed_values() {
    let kind = Kind::Cylinder;
    let slant = [0.6, 0.0, 0.8];
    check(&[
        (kind, [-3.0, 0.0, 0.5], X, Some([(2.0, 0), (4.0, 0)])),
        (kind, [0.5, 0.5, -1.0], Z, Some([(1.0, 1), (2.0, 2)])),
        (kind, [0.5, 0.5, 3.0], DOWN, Some([(2.0, 2), (3.0, 1)])),
        (kind, [0.0, 0.0, 0.5], Z, Some([(-0.5, 1), (0.5, 2)])),
        (kind, [0.0, 0.0, 0.25], X, Some([(-1.0, 0), (1.0, 0)])),
        // Along the side, just beside it, and touching it.
        (kind, [1.0, 0.0, -1.0], Z, Some([(1.0, 1), (2.0, 2)])),
        (kind, [1.0, 1e-7, -1.0], Z, None),
        (kind, [-3.0, 1.0, 0.5], X, Some([(3.0, 0), (3.0, 0)])),
        // In the plane of a cap and beside it.
        (kind, [-3.0, 0.0, 1.0], X, Some([(2.0, 0), (4.0, 0)])),
        (kind, [-3.0, 0.0, 0.0], X, Some([(2.0, 0), (4.0, 0)])),
        (kind, [-3.0, 0.0, 1.0 + f64::EPSILON], X, None),
        // Entering through the base and leaving through the side.
        (kind, [0.25, 0.0, -1.0], slant, Some([(1.25, 1), (1.25, 0)])),
        (kind, [4.0, 0.0, -1.0], slant, None),
    ]);
}

#[test]
fn cones_match_hand_computed_values() {
    let kind = Kind::Cone;
    check(&[
        (kind, [0.0, 0.0, -1.0], Z, Some([(1.0, 1), (2.0, 0)])),
        (kind, [0.0, 0.0, 3.0], DOWN, Some([(2.0, 0), (3.0, 1)])),
        (kind, [0.5, 0.0, 3.0], DOWN, Some([(2.5, 0), (3.0, 1)])),
        (kind, [-3.0, 0.0, 0.5], X, Some([(2.5, 0), (3.5, 0)])),
        (kind, [0.0, 0.0, 0.25], X, Some([(-0.75, 0), (0.75, 0)])),
        // The second nappe is excluded, and the apex is a single point.
        (kind, [-3.0, 0.0, 1.5], X, None),
        (kind, [-3.0, 0.0, 1.0], X, Some([(3.0, 0), (3.0, 0)])),
        (kind, [0.5, 0.0, 1.0], Z, Some([(-1.0, 1), (-0.5, 0)])),
        // In the plane of the base.
        (kind, [-3.0, 0.0, 0.0], X, Some([(2.0, 0), (4.0, 0)])),
        (kind, [-3.0, 0.0, -1e-300], X, None),
        // Parallel to a generatrix, in units of its direction: through the base, and outside.
        (
            kind,
            [-1.0, 0.0, -1.0],
            [1.0, 0.0, 1.0],
            Some([(1.0, 1), (1.5, 0)]),
        ),
        (kind, [-0.5, 0.0, -1.0], [-1.0, 0.0, 1.0], None),
        (
            kind,
            [0.5, 0.0, 0.0],
            [-1.0, 0.0, 1.0],
            Some([(0.0, 1), (0.75, 0)]),
        ),
        (kind, [3.0, 0.0, 0.0], [-1.0, 0.0, 1.0], None),
        // Along a generatrix.
        (
            kind,
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 1.0],
            Some([(0.0, 1), (1.0, 0)]),
        ),
    ]);
}

#[test]
fn an_inverted_cone_matches_hand_computed_values() {
    let cone = Frame {
        origin: DVec3::new(0.0, -100.0, 0.0),
        directions: [DVec3::X, DVec3::Z, DVec3::Y],
        lengths: DVec3::splat(100.0),
    };
    let slanted = DVec3::new(-0.5, -1.0, 1.0);
    let incoming = Ray {
        origin: DVec3::new(1.0, 1.0, -5.0),
        direction: slanted.normalize(),
    };
    let crossings = only_span(&cone.shape(Kind::Cone), &incoming);
    let crossings = crossings.expect("the line crosses the cone");
    // Roots of (1 − t/2)² + (t − 5)² = (1 − t)²: t² − 36 t + 100 = 0.
    let root = 224_f64.sqrt();
    for (hit, expected) in [
        (crossings.enter, 18.0 - root),
        (crossings.exit, 18.0 + root),
    ] {
        assert!((hit.t - 1.5 * expected).abs() < 1e-13 * hit.t);
        assert_eq!(hit.part, 0);
    }
    assert!((crossings.enter.t - 4.55006).abs() < 5e-6);
    assert!((crossings.exit.t - 49.44994).abs() < 5e-6);
}

#[test]
fn the_nearest_hit_is_ahead_and_within_the_limit() {
    let sphere = Frame::upright(DVec3::ZERO, DVec3::ONE).shape(Kind::Sphere);
    for (z, limit, expected) in [
        (-5.0, f64::INFINITY, Some(4.0)),
        (-5.0, 4.5, Some(4.0)),
        (-5.0, 4.0, None),
        (0.0, f64::INFINITY, Some(1.0)),
        (-1.0, f64::INFINITY, Some(2.0)),
        (1.0, f64::INFINITY, None),
        (5.0, f64::INFINITY, None),
    ] {
        let origin = DVec3::new(0.0, 0.0, z);
        let along_z = Ray {
            origin,
            direction: DVec3::Z,
        };
        let found = sphere.hit(&along_z, limit).map(|hit| hit.t);
        assert_eq!(found, expected, "from {z} to {limit}");
    }
}

#[test]
fn degenerate_frames_are_rejected() {
    let frame = |directions| Affine::new(DVec3::ZERO, directions, DVec3::ONE);
    let [x, y, z] = DVec3::AXES;
    for directions in [
        [x, y, DVec3::ZERO],
        [x, x, z],
        [x, y, x + y],
        [x, -x, z],
        [x, y, DVec3::new(1.0, 0.0, 0.9e-6)],
        [x, y, DVec3::NAN],
        [x, y, DVec3::INFINITY],
    ] {
        assert_eq!(frame(directions), None, "{directions:?}");
    }
    for directions in [
        [x, y, z],
        [x, z, y],
        [x, y, DVec3::new(1.0, 0.0, 1.1e-6)],
        [1e200 * x, 1e-200 * y, 5e-324 * z],
    ] {
        assert!(frame(directions).is_some(), "{directions:?}");
    }
    assert_eq!(frame([1e300 * x, 1e-310 * y, z]), frame([x, y, z]));
}

#[test]
fn extreme_sizes_give_finite_hits_or_none() {
    let mut random = Random(6);
    let sizes = [5e-324, 1e-310, 1e-300, 1e-150, 1.0, 1e150, 1e300, f64::MAX];
    for index in 0..20_000 {
        let mut pick = || sizes[(random.bits() % 8) as usize];
        let lengths = DVec3::new(pick(), pick(), pick());
        let (offset, distance) = (pick(), pick());
        let frame = Frame {
            origin: offset * random.in_cube(),
            directions: random.rotation(),
            lengths,
        };
        let shape = frame.shape(KINDS[index % KINDS.len()]);
        let incoming = Ray {
            origin: distance * random.in_cube(),
            direction: random.direction(),
        };
        let Some(crossings) = only_span(&shape, &incoming) else {
            continue;
        };
        assert!(crossings.enter.t.is_finite() && crossings.exit.t.is_finite());
        let _ = shape.surface(&incoming, crossings.enter).leave(DVec3::X);
        assert!(!shape.bounds().is_empty());
    }
}

#[test]
fn the_apex_has_a_normal() {
    let shape = Frame::upright(DVec3::ZERO, DVec3::ONE).shape(Kind::Cone);
    let incoming = ray(DVec3::new(0.0, 0.0, 3.0), DVec3::ZERO);
    let surface = shape.surface(&incoming, Hit { t: 2.0, part: 0 });
    assert!((surface.point - DVec3::Z).length() < 1e-13);
    assert!((surface.normal.length() - 1.0).abs() < 1e-15);
    assert!(surface.normal.dot(incoming.direction) < 0.0);
}

#[test]
fn box_operations_handle_unbounded_boxes() {
    let [low, high] = [-1.0, 3.0].map(DVec3::splat);
    let finite = Aabb {
        min: low,
        max: high,
    };
    let half = Aabb {
        max: high.with_x(f64::INFINITY),
        min: low,
    };
    let slab = Aabb {
        min: low.with_x(f64::NEG_INFINITY),
        ..half
    };
    assert!(finite.is_bounded() && !half.is_bounded() && !slab.is_bounded());
    assert!(!Aabb::EMPTY.is_bounded());
    assert_eq!(finite.intersection(slab), finite);
    assert_eq!(slab.centre(), DVec3::new(0.0, 1.0, 1.0));
    assert_eq!(slab.size(), DVec3::new(f64::INFINITY, 4.0, 4.0));
    assert_eq!(half.centre().x, f64::INFINITY);
    let apart = Aabb {
        min: high + 1.0,
        max: high + 2.0,
    };
    assert_eq!(finite.intersection(apart), Aabb::EMPTY);
    let touching = Aabb {
        min: high,
        max: high + 2.0,
    };
    assert!(!finite.intersection(touching).is_empty());
}
