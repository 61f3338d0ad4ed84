//! Properties of spans, normals and bounds for random solids and rays.

use glam::DVec3;

use super::exact::Exact;
use super::random::{Random, excess, extremes, to_unit};
use super::{Aabb, Frame, KINDS, Kind, Ray, only_span, ray};

/// A ray toward a random solid; it may start inside or miss.
fn encounter(random: &mut Random, kind: Kind) -> (Frame, Ray) {
    let frame = random.frame().of(kind);
    let target = frame.world(1.5 * random.inside(kind));
    let origin = frame.world(random.magnitude(-1.0, 2.0) * random.direction());
    (frame, ray(origin, target))
}

#[test]
fn spans_cover_exactly_the_inside() {
    let mut random = Random(8);
    for index in 0..20_000 {
        let kind = KINDS[index % KINDS.len()];
        let (frame, ray) = encounter(&mut random, kind);
        let depth = |t: f64| excess(kind, to_unit(&frame, ray.at(t)));
        let Some(crossings) = only_span(&frame.shape(kind), &ray) else {
            let around = (frame.origin - ray.origin).dot(ray.direction);
            for step in -20..20 {
                let t = around + 0.3 * f64::from(step);
                assert!(-1e-12 < depth(t), "{kind:?} {index}: missed at {t}");
            }
            continue;
        };
        let (enter, exit) = (crossings.enter.t, crossings.exit.t);
        let length = exit - enter;
        if length < 1e-3 {
            continue;
        }
        let step = 1e-3 * length;
        for (t, inside) in [
            (enter - step, false),
            (enter + step, true),
            (0.5 * (enter + exit), true),
            (exit - step, true),
            (exit + step, false),
        ] {
            assert_eq!(depth(t) < 0.0, inside, "{kind:?} {index}: at {t}");
        }
    }
}

#[test]
fn spans_agree_with_twice_the_precision() {
    let mut random = Random(9);
    for index in 0..20_000 {
        let kind = KINDS[index % KINDS.len()];
        let (frame, ray) = encounter(&mut random, kind);
        let shape = frame.shape(kind);
        let found = only_span(&shape, &ray);
        let exact = Exact::new(kind, &frame).span(&ray);
        let (Some(found), Some([enter, exit])) = (found, exact) else {
            assert!(found.is_none() && exact.is_none(), "{kind:?} {index}");
            continue;
        };
        for (hit, exact) in [(found.enter, enter), (found.exit, exit)] {
            // An error of the coordinates becomes one of the distance, divided by the cosine.
            let cosine = shape.surface(&ray, hit).normal.dot(ray.direction).abs();
            let bound = 1e-14 * (10.0 + ray.origin.length()) / cosine;
            let error = (hit.t - exact).abs();
            assert!(
                error < bound,
                "{kind:?} {index}: {error} at {hit:?}, {bound}"
            );
        }
    }
}

#[test]
fn normals_are_gradients() {
    let mut random = Random(10);
    let mut checked = 0;
    for index in 0..5_000 {
        let kind = KINDS[index % KINDS.len()];
        let (frame, ray) = encounter(&mut random, kind);
        let shape = frame.shape(kind);
        let Some(hit) = shape.hit(&ray, f64::INFINITY) else {
            continue;
        };
        let surface = shape.surface(&ray, hit);
        let on_ray = ray.at(hit.t);
        assert!((surface.point - on_ray).length() < 1e-9 * (1.0 + hit.t));
        let value = |p: DVec3| excess(kind, to_unit(&frame, p));
        assert!(value(surface.point).abs() < 1e-12, "{kind:?} {index}");
        let step = 1e-6;
        let slope = |h: f64| {
            let along = |e: DVec3| (value(surface.point + h * e) - value(surface.point)) / h;
            DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z))
        };
        let (forward, backward) = (slope(step).normalize(), slope(-step).normalize());
        // At an edge the function has no gradient.
        if (forward - backward).length() < 1e-4 {
            checked += 1;
            let gradient = 0.5 * (forward + backward);
            assert!(
                (surface.normal - gradient).length() < 1e-4,
                "{kind:?} {index}: {} is not {gradient}",
                surface.normal
            );
        }
        assert!((surface.normal.length() - 1.0).abs() < 1e-15);
    }
    assert!(2_000 < checked, "{checked} checked");
}

#[test]
fn bounds_are_tight() {
    let mut random = Random(11);
    for kind in KINDS {
        let extremes = extremes(kind);
        for _ in 0..20 {
            let frame = random.frame().of(kind);
            let bounds = frame.shape(kind).bounds();
            let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for extreme in &extremes {
                min = min.min(frame.world(*extreme));
                max = max.max(frame.world(*extreme));
            }
            let tolerance = 1e-12;
            assert!((min - bounds.min).min_element() > -tolerance, "{kind:?}");
            assert!((bounds.max - max).min_element() > -tolerance, "{kind:?}");
            let slack = (min - bounds.min).max(bounds.max - max) / bounds.size();
            assert!(slack.max_element() < 1e-3, "{kind:?}: {slack}");
        }
    }
}

/// All hits are in the box up to rounding, however thin the solid.
#[test]
fn hits_are_in_the_box() {
    let mut random = Random(12);
    let mut hits = 0;
    for index in 0..4_000 {
        let kind = KINDS[index % KINDS.len()];
        let mut frame = random.frame();
        let thin = 1 + random.bits() as usize % 6;
        for axis in (0..3).filter(|axis| thin >> axis & 1 == 1) {
            frame.lengths[axis] *= random.magnitude(-20.0, 0.0);
        }
        let frame = frame.of(kind);
        let shape = frame.shape(kind);
        let Aabb { min, max } = shape.bounds();
        for _ in 0..20 {
            let origin = random.magnitude(0.0, 3.0) * random.direction();
            let ray = ray(origin, frame.world(1.5 * random.inside(kind)));
            if let Some(hit) = shape.hit(&ray, f64::INFINITY) {
                hits += 1;
                let outside = (min - ray.at(hit.t)).max(ray.at(hit.t) - max);
                let rounding = 1e-13 * (origin.length() + hit.t);
                assert!(
                    outside.max_element() <= rounding,
                    "{kind:?} {index}: {} of {} outside",
                    outside.max_element(),
                    frame.lengths
                );
            }
        }
    }
    assert!(20_000 < hits, "{hits} hits");
}

/// The nearby part of a solid is hit, however long the solid and however far away its origin.
#[test]
fn long_solids_are_hit_at_their_ends() {
    let mut random = Random(13);
    let mut hits = 0;
    for index in 0..20_000 {
        let kind = KINDS[1 + index % (KINDS.len() - 1)];
        let mut frame = random.frame();
        if index % 3 == 0 {
            frame.directions = DVec3::AXES;
        }
        frame.lengths[index % 3] = random.magnitude(2.0, 6.0);
        // Moves a point of the surface near the origin of the world.
        let middle = random.inside(kind);
        let outward = random.direction();
        let (mut inside, mut outside) = (0.0, 4.0);
        for _ in 0..60 {
            let reach = 0.5 * (inside + outside);
            if excess(kind, middle + reach * outward) < 0.0 {
                inside = reach;
            } else {
                outside = reach;
            }
        }
        let point = middle + inside * outward;
        frame.origin += random.in_cube() - frame.world(point);
        let target = frame.world(point);
        let ray = ray(
            target + random.magnitude(-1.0, 1.0) * random.direction(),
            target,
        );
        if let Some([enter, exit]) = Exact::new(kind, &frame).span(&ray)
            && 1e-6 < exit - enter
        {
            hits += 1;
            let found = only_span(&frame.shape(kind), &ray);
            assert!(found.is_some(), "{kind:?} {index}: {enter} to {exit}");
        }
    }
    assert!(5_000 < hits, "{hits} hits");
}
