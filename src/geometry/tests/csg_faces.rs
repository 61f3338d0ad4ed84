//! Coincident faces show no speckle: pictures of solids with such faces against pictures of equal
//! solids without.

use glam::DVec3;

use super::csg::{Solid, csg};
use super::random::Random;
use super::{Frame, Kind, Shape, ray};
use crate::Operation::{self, Difference, Intersection, Union};

/// The operands of a solid, which is made once with and once without coincident faces.
type Pair = [(Kind, [f64; 3], [f64; 3]); 2];

const PAIRS: &[(&str, Operation, Pair, Operation, Pair)] = &[
    (
        "a pocket with an open top",
        Difference,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 1.]),
            (Kind::Cuboid, [0.25, 0.25, 0.5], [0.5, 0.5, 0.5]),
        ],
        Difference,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 1.]),
            (Kind::Cuboid, [0.25, 0.25, 0.5], [0.5, 0.5, 2.5]),
        ],
    ),
    (
        "a step in a corner",
        Difference,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 1.]),
            (Kind::Cuboid, [0.5, 0., 0.5], [0.5, 1., 0.5]),
        ],
        Difference,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 1.]),
            (Kind::Cuboid, [0.5, -1., 0.5], [3., 3., 3.]),
        ],
    ),
    (
        "two boxes that touch",
        Union,
        [
            (Kind::Cuboid, [0., 0., 0.], [0.4, 1., 1.]),
            (Kind::Cuboid, [0.4, 0., 0.], [0.6, 1., 1.]),
        ],
        Union,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 1.]),
            (Kind::Cuboid, [0.4, 0.2, 0.2], [0.2, 0.2, 0.2]),
        ],
    ),
    (
        "a hole with the plate's faces for caps",
        Difference,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 0.3]),
            (Kind::Cylinder, [0.5, 0.5, 0.], [0.4, 0.4, 0.3]),
        ],
        Difference,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 0.3]),
            (Kind::Cylinder, [0.5, 0.5, -1.], [0.4, 0.4, 3.]),
        ],
    ),
    (
        "a pin flush with its plate",
        Union,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 0.3]),
            (Kind::Cylinder, [0.5, 0.5, 0.], [0.4, 0.4, 0.3]),
        ],
        Union,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 0.3]),
            (Kind::Cylinder, [0.5, 0.5, 0.1], [0.4, 0.4, 0.1]),
        ],
    ),
    (
        "the common part of boxes flush on three sides",
        Intersection,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 1.]),
            (Kind::Cuboid, [0., 0., 0.], [2., 2., 0.5]),
        ],
        Intersection,
        [
            (Kind::Cuboid, [0., 0., 0.], [1., 1., 0.5]),
            (Kind::Cuboid, [-1., -1., -1.], [3., 3., 3.]),
        ],
    ),
];

fn made(operation: Operation, pair: &Pair, turn: &[DVec3; 3], at: DVec3) -> Shape {
    let [first, second] = pair.map(|(kind, origin, lengths)| {
        let origin = DVec3::from_array(origin);
        let frame = Frame {
            origin: at + origin.x * turn[0] + origin.y * turn[1] + origin.z * turn[2],
            directions: *turn,
            lengths: DVec3::from_array(lengths),
        };
        Solid::Leaf(kind, frame)
    });
    csg(&[first, second, Solid::Made(operation, 0, 1)])
}

#[test]
fn coincident_faces_show_no_speckle() {
    const RAYS_ACROSS: u32 = 100;
    let mut random = Random(41);
    for (name, operation, pair, clean_operation, clean_pair) in PAIRS {
        for view in 0..12 {
            let turn = if view % 3 == 0 {
                DVec3::AXES
            } else {
                random.rotation()
            };
            let at = [0.0, 1.0, 1e3][view % 3] * random.in_cube();
            let shape = made(*operation, pair, &turn, at);
            let clean = made(*clean_operation, clean_pair, &turn, at);
            // From above, obliquely, and grazing the top.
            let top = pair[0].1[2] + pair[0].2[2].min(pair[1].1[2] + pair[1].2[2]);
            let height = [3.0, 0.5, 1e-3, 1e-5, 1e-7, -0.2][view / 2];
            let [x, y, z] = turn;
            let centre = at + 0.5 * x + 0.5 * y;
            let eye = centre + (top + height) * z + 2.0 * x - 1.5 * y;
            let mut different = Vec::new();
            for i in 0..RAYS_ACROSS * RAYS_ACROSS {
                let mut fraction = |i: u32| {
                    (f64::from(i) + random.between(0.0, 1.0)) / f64::from(RAYS_ACROSS) - 0.5
                };
                let (u, v) = (fraction(i % RAYS_ACROSS), fraction(i / RAYS_ACROSS));
                let ray = ray(eye, centre + 1.2 * u * x + 1.2 * v * y + top * z);
                let hits = [&shape, &clean].map(|shape| {
                    let hit = shape.hit(&ray, f64::INFINITY)?;
                    Some((hit.t, shape.surface(&ray, hit).normal))
                });
                let alike = match hits {
                    [None, None] => true,
                    [Some((t, normal)), Some((clean, upright))] => {
                        let sine = normal.dot(ray.direction).abs();
                        (t - clean).abs() * sine < 1e-11 && 0.999 < normal.dot(upright)
                    }
                    _ => false,
                };
                if !alike {
                    different.push((u, v, hits));
                }
            }
            assert!(
                different.is_empty(),
                "{name}, view {view}: {} differ, first {:?}",
                different.len(),
                different[0]
            );
        }
    }
}
