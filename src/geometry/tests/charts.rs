//! Texture coordinates at known points, and their gradients against finite differences.

use std::sync::Arc;

use glam::DVec3;

use super::random::Random;
use super::{Frame, KINDS, Kind, Ray, Shape, ray};
use crate::{Csg, Hit, Node, Operation, Quadric, Solid};

/// A hit at a point, by a ray that starts there.
fn at(point: DVec3, part: u32) -> (Ray, Hit) {
    let ray = Ray {
        origin: point,
        direction: DVec3::X,
    };
    (ray, Hit { t: 0.0, part })
}

#[test]
fn texture_coordinates_match_hand_computed_values() {
    let origin = DVec3::new(10.0, 20.0, 30.0);
    let lengths = DVec3::new(2.0, 3.0, 4.0);
    let half = 0.5_f64.sqrt();
    let cases: &[(Kind, [f64; 3], u32, [f64; 2])] = &[
        (Kind::Ellipsoid, [1., 0., 0.], 0, [0.5, 0.5]),
        (Kind::Ellipsoid, [0., 1., 0.], 0, [0.75, 0.5]),
        (Kind::Ellipsoid, [0., -1., 0.], 0, [0.25, 0.5]),
        (Kind::Ellipsoid, [-1., 0., 0.], 0, [1.0, 0.5]),
        (Kind::Ellipsoid, [0., 0., 1.], 0, [0.5, 1.0]),
        (Kind::Ellipsoid, [0., 0., -1.], 0, [0.5, 0.0]),
        (Kind::Ellipsoid, [half, 0., half], 0, [0.5, 0.75]),
        (Kind::Cylinder, [0., 1., 0.25], 0, [0.75, 0.25]),
        (Kind::Cylinder, [0.5, -1., 0.], 1, [0.75, 0.0]),
        (Kind::Cylinder, [0.5, -1., 1.], 2, [0.75, 0.0]),
        (Kind::Cone, [0.75, 0., 0.25], 0, [0.5, 0.25]),
        (Kind::Cone, [0., 0.5, 0.], 1, [0.5, 0.75]),
        (Kind::Cuboid, [0., 0.25, 0.5], 0, [0.25, 0.5]),
        (Kind::Cuboid, [0.25, 1., 0.5], 3, [0.25, 0.5]),
        (Kind::Cuboid, [0.25, 0.5, 1.], 5, [0.25, 0.5]),
    ];
    let frame = Frame::upright(origin, lengths);
    for &(kind, position, part, uv) in cases {
        let (ray, hit) = at(frame.world(DVec3::from_array(position)), part);
        let found = frame.shape(kind).chart(&ray, hit).uv;
        assert!(
            (found - glam::DVec2::from_array(uv)).length() < 1e-14,
            "{kind:?} {position:?}: {found}"
        );
    }
    let ball = Frame::upright(origin, DVec3::splat(2.0)).shape(Kind::Sphere);
    let (ray, hit) = at(origin + 2.0 * DVec3::new(half, 0.0, half), 0);
    assert!((ball.chart(&ray, hit).uv - glam::DVec2::new(0.5, 0.75)).length() < 1e-14);
}

/// A random simple solid, quadric or CSG solid, by index.
fn solid(random: &mut Random, index: usize) -> (Shape, DVec3) {
    let frame = random.frame();
    let target = frame.origin;
    let shape = match KINDS.get(index % 7) {
        Some(&kind) => frame.of(kind).shape(kind),
        None if index % 7 == 5 => {
            let square = frame.lengths.recip() * frame.lengths.recip();
            let linear = -square * target;
            let constant = target.dot(square * target) - 1.0;
            let coefficients = [
                square.x, 0.0, 0.0, linear.x, square.y, 0.0, linear.y, square.z, linear.z, constant,
            ];
            let plane = (DVec3::Z, target.z + 0.1);
            Shape::Solid(Solid::Quadric(Box::new(Quadric::new(
                coefficients,
                &[plane],
            ))))
        }
        None => {
            let leaf = |kind, tag| Node::Leaf {
                solid: frame.of(kind).solid(kind),
                tag,
            };
            let difference = Node::Operation {
                operation: Operation::Difference,
                first: 0,
                second: 1,
            };
            Shape::Csg(Arc::new(Csg::new(vec![
                leaf(Kind::Ellipsoid, 0),
                leaf(Kind::Cuboid, 1),
                difference,
            ])))
        }
    };
    (shape, target)
}

#[test]
fn gradients_match_finite_differences() {
    let mut random = Random(51);
    let mut checked = 0;
    for index in 0..14_000 {
        let (shape, target) = solid(&mut random, index);
        let incoming = ray(
            target + 20.0 * random.direction(),
            target + random.in_cube(),
        );
        let Some(hit) = shape.hit(&incoming, f64::INFINITY) else {
            continue;
        };
        let normal = shape.surface(&incoming, hit).normal;
        let chart = shape.chart(&incoming, hit);
        assert!(
            chart.uv.min_element() >= -1e-9 && chart.uv.max_element() <= 1.0 + 1e-9,
            "{index}"
        );
        let point = incoming.at(hit.t);
        let tangent = normal.any_orthonormal_vector();
        for along in [tangent, normal.cross(tangent)] {
            let step = 1e-6;
            let uv = |h: f64| {
                let (ray, hit) = at(point + h * along, hit.part);
                shape.chart(&ray, hit).uv
            };
            let difference = (uv(step) - uv(-step)) / (2.0 * step);
            for k in 0..2 {
                let slope = chart.gradients[k].dot(along);
                // Differences are meaningless across the seam and close to a pole.
                if difference[k].abs() < 1e3 && chart.gradients[k].length() < 10.0 {
                    checked += 1;
                    assert!(
                        (slope - difference[k]).abs() < 1e-6,
                        "{index} {k}: {slope} {difference}"
                    );
                }
            }
        }
    }
    assert!(20_000 < checked, "{checked} checked");
}

#[test]
fn coordinates_at_poles_are_finite() {
    let frame = Frame::upright(DVec3::ZERO, DVec3::ONE);
    for (kind, point) in [
        (Kind::Sphere, DVec3::Z),
        (Kind::Ellipsoid, DVec3::NEG_Z),
        (Kind::Cone, DVec3::Z),
        (Kind::Sphere, DVec3::ZERO),
    ] {
        let (ray, hit) = at(point, 0);
        let chart = frame.shape(kind).chart(&ray, hit);
        assert!(chart.uv.is_finite() && chart.gradients.iter().all(|g| g.is_finite()));
    }
}
