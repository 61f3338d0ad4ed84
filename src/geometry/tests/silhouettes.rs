//! Hits and misses near silhouettes against twice the precision.

use glam::DVec3;

use super::exact::Exact;
use super::random::Random;
use super::{Frame, Kind, Ray, only_span, ray, unit};
use crate::{Rays, Sphere, may_meet, ulp};

const RAYS_ACROSS: u32 = 256;

/// A grid of rays from `eye` through a window around `target` with the given half edges.
fn window(eye: DVec3, target: DVec3, right: DVec3, up: DVec3) -> impl Iterator<Item = Ray> {
    let fraction = |i: u32| (2.0 * f64::from(i) + 1.0) / f64::from(RAYS_ACROSS) - 1.0;
    (0..RAYS_ACROSS * RAYS_ACROSS).map(move |i| {
        let (x, y) = (fraction(i % RAYS_ACROSS), fraction(i / RAYS_ACROSS));
        ray(eye, target + x * right + y * up)
    })
}

struct Comparison {
    hits: u32,
    wrong: u32,
    /// The largest error of a distance.
    error: f64,
}

fn compare(kind: Kind, frame: &Frame, rays: impl Iterator<Item = Ray>) -> Comparison {
    let shape = frame.shape(kind);
    let exact = Exact::new(kind, frame);
    let mut result = Comparison {
        hits: 0,
        wrong: 0,
        error: 0.0,
    };
    for ray in rays {
        match (only_span(&shape, &ray), exact.span(&ray)) {
            (None, None) => {}
            (Some(crossings), Some([enter, exit])) => {
                result.hits += 1;
                let error = (crossings.enter.t - enter).abs();
                result.error = result.error.max(error);
                result.error = result.error.max((crossings.exit.t - exit).abs());
            }
            _ => result.wrong += 1,
        }
    }
    result
}

#[test]
fn far_spheres_are_exact() {
    let mut random = Random(1);
    for exponent in 1..=9 {
        let distance = 10_f64.powi(exponent);
        let [right, up, back] = random.rotation();
        let away = distance * back;
        // The sphere is at the origin for half of the distances, the eye for the others.
        let (centre, eye) = if exponent % 2 == 0 {
            (DVec3::ZERO, away)
        } else {
            (away, DVec3::ZERO)
        };
        let frame = Frame::upright(centre, DVec3::ONE);
        let result = compare(
            Kind::Sphere,
            &frame,
            window(eye, centre, 1.05 * right, 1.05 * up),
        );
        assert_eq!(result.wrong, 0, "distance {distance}");
        assert!((40_000..60_000).contains(&result.hits), "{distance}");
        let bound = 4.0 * ulp(distance) + 1e-7;
        assert!(
            result.error < bound,
            "distance {distance}: {} of {bound}",
            result.error
        );
    }
}

/// Needles and discs of 1 : `ratio`, seen from the side and along their axis.
fn needles(kind: Kind, ratio: f64, distance: f64, seed: u64) {
    let mut random = Random(seed);
    let rod = DVec3::new(1.0 / ratio, 1.0 / ratio, 1.0);
    let disc = DVec3::new(1.0, 1.0, 1.0 / ratio);
    let views = [(0, [1, 2]), (2, [0, 1])];
    for lengths in [rod, disc] {
        for (toward, edges) in views {
            let directions = random.rotation();
            let frame = Frame {
                origin: DVec3::ZERO,
                directions,
                lengths,
            };
            let [right, up] = edges.map(|axis| 1.3 * lengths[axis] * directions[axis]);
            let target = frame.world(DVec3::new(0.0, 0.0, 0.1));
            let eye = target + distance * directions[toward];
            let result = compare(kind, &frame, window(eye, target, right, up));
            let message = format!("{kind:?} {lengths} along {toward} at {distance}");
            assert_eq!(result.wrong, 0, "{message}");
            assert!(8_000 < result.hits, "{message}: {} hits", result.hits);
        }
    }
}

#[test]
fn thin_ellipsoids_are_exact() {
    for (ratio, distance) in [(1e3, 1e2), (1e6, 4.0), (1e6, 60.0), (1e6, 1e5)] {
        needles(Kind::Ellipsoid, ratio, distance, 2);
    }
}

#[test]
fn thin_cylinders_and_cones_are_exact() {
    for kind in [Kind::Cylinder, Kind::Cone] {
        needles(kind, 1e6, 1e4, 3);
    }
}

#[test]
fn other_far_solids_are_exact() {
    let mut random = Random(4);
    for kind in [Kind::Ellipsoid, Kind::Cuboid, Kind::Cylinder, Kind::Cone] {
        let frame = Frame {
            origin: DVec3::ZERO,
            ..random.frame()
        };
        let [right, up, back] = random.rotation();
        let result = compare(
            kind,
            &frame,
            window(1e9 * back, DVec3::ZERO, 4.0 * right, 4.0 * up),
        );
        assert_eq!(result.wrong, 0, "{kind:?}");
        assert!(1_000 < result.hits, "{kind:?}: {} hits", result.hits);
        assert!(result.error < 4.0 * ulp(1e9), "{kind:?}: {}", result.error);
    }
}

/// Rays within 1e-12 of a tangent. If l is the least distance from the centre, computed from
/// coordinates up to D, the error of 1 − l² is at most 8 (1 + D) half ulps of 1 (three products,
/// their sums, the direction's component along itself); rays from far away are advanced first, and
/// D is 1.
#[test]
fn grazing_rays_are_decided_as_in_twice_the_precision() {
    let mut random = Random(5);
    let frame = Frame::upright(DVec3::ZERO, DVec3::ONE);
    let shape = frame.shape(Kind::Sphere);
    let exact = Exact::new(Kind::Sphere, &frame);
    let mut decided = 0;
    for index in 0..100_000 {
        let [across, along, _] = random.rotation();
        let distance = if index % 2 == 0 {
            random.between(0.0, 64.0)
        } else {
            random.between(65.0, 1e4)
        };
        let gap = random.between(-1e-12, 1e-12);
        let ray = ray(
            (1.0 + gap) * across - distance * along,
            (1.0 + gap) * across,
        );
        let loss = if distance < 64.0 { 1.0 + distance } else { 2.0 };
        let bound = 8.0 * loss * 0.5 * f64::EPSILON;
        if exact.clearance(&ray).abs() < bound {
            continue;
        }
        decided += 1;
        assert_eq!(
            only_span(&shape, &ray).is_some(),
            exact.span(&ray).is_some(),
            "gap {gap} at {distance}"
        );
    }
    assert!(80_000 < decided, "{decided} decided");
}

/// Rays past or through spheres of random sizes at random distances, many of them near the silhouette.
/// The squares of the smallest radii underflow.
#[test]
fn the_quick_test_passes_spheres_that_are_hit_and_rejects_most_others() {
    let mut random = Random(2);
    let [mut hits, mut misses] = [0; 2];
    for _ in 0..200_000 {
        let radius = random.magnitude(-180.0, 100.0);
        let distance = radius * random.magnitude(-8.0, 8.0);
        let offset = 1.0 + random.between(-1.0, 1.0) * random.magnitude(-17.0, 0.0);
        let (toward, aside) = (random.direction(), random.direction());
        let aside = unit(aside - aside.dot(toward) * toward);
        let centre = random.in_cube() * distance * random.magnitude(-20.0, 3.0);
        let ray = Ray {
            origin: centre + offset * radius * aside - distance * toward,
            direction: toward,
        };
        let is_hit = Sphere { centre, radius }.hit(&ray, f64::INFINITY).is_some();
        let passes = may_meet(centre.into(), radius, &Rays::from(&ray));
        assert!(passes || !is_hit, "{centre} {radius} {ray:?}");
        let is_tiny = radius < 1e-100;
        assert!(
            !passes || offset < 1.001 || is_tiny,
            "{centre} {radius} {ray:?}"
        );
        hits += u32::from(is_hit);
        misses += u32::from(!passes);
    }
    assert!(40_000 < hits.min(misses), "{hits} {misses}");
}
