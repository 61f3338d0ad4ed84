//! Set operations against point membership, set identities and hand-computed values.

use std::sync::Arc;

use glam::DVec3;

use super::quadrics::spans;
use super::random::{Random, excess, to_unit};
use super::{Frame, KINDS, Kind, Ray, Shape, ray};
use crate::{Aabb, Csg, Node, Operation, ulp};

const OPERATIONS: [Operation; 3] = [
    Operation::Union,
    Operation::Intersection,
    Operation::Difference,
];

/// A node of a test's CSG tree.
#[derive(Clone, Copy, Debug)]
pub(super) enum Solid {
    Leaf(Kind, Frame),
    Made(Operation, u32, u32),
}

pub(super) fn csg(solids: &[Solid]) -> Shape {
    let nodes = (0..).zip(solids).map(|(tag, solid)| match *solid {
        Solid::Leaf(kind, frame) => Node::Leaf {
            solid: frame.solid(kind),
            tag,
        },
        Solid::Made(operation, first, second) => Node::Operation {
            operation,
            first,
            second,
        },
    });
    Shape::Csg(Arc::new(Csg::new(nodes.collect())))
}

/// Whether a point is inside; `None` if it is too close to the boundary of a leaf to decide.
fn contains(solids: &[Solid], point: DVec3) -> Option<bool> {
    let mut inside: Vec<bool> = Vec::with_capacity(solids.len());
    for solid in solids {
        inside.push(match *solid {
            Solid::Leaf(kind, frame) => {
                let depth = excess(kind, to_unit(&frame, point));
                if depth.abs() < 1e-9 {
                    return None;
                }
                depth < 0.0
            }
            Solid::Made(operation, first, second) => {
                let (a, b) = (inside[first as usize], inside[second as usize]);
                match operation {
                    Operation::Union => a || b,
                    Operation::Intersection => a && b,
                    Operation::Difference => a && !b,
                }
            }
        });
    }
    inside.last().copied()
}

/// A random simple solid; half of them are on a grid, where faces coincide.
fn leaf(random: &mut Random) -> Solid {
    let kind = KINDS[(random.bits() % 5) as usize];
    let frame = Frame {
        origin: 2.0 * random.in_cube(),
        ..random.frame()
    };
    let on_grid = random.bits().is_multiple_of(2);
    let frame = if on_grid {
        Frame::upright((2.0 * frame.origin).round() / 2.0, frame.lengths.ceil())
    } else {
        frame
    };
    Solid::Leaf(kind, frame.of(kind))
}

/// A tree of depth up to 6, in which a solid may be an operand twice.
pub(super) fn tree(random: &mut Random) -> Vec<Solid> {
    let depth = random.bits() % 6 + 1;
    let mut solids = Vec::new();
    let mut row: Vec<u32> = Vec::new();
    for _ in 0..1 << (depth - 1) {
        row.push(solids.len() as u32);
        solids.push(leaf(random));
    }
    while 1 < row.len() || solids.len() == 1 {
        let mut above = Vec::new();
        for pair in row.chunks(2) {
            let operation = OPERATIONS[(random.bits() % 3) as usize];
            let first = pair[0];
            // Everything is reachable except leaves replaced by a shared operand.
            let shared = random.bits().is_multiple_of(16);
            let second = if shared {
                first
            } else {
                *pair.last().unwrap_or(&first)
            };
            above.push(solids.len() as u32);
            solids.push(Solid::Made(operation, first, second));
        }
        row = above;
    }
    solids
}

#[test]
fn spans_cover_exactly_the_inside() {
    let mut random = Random(31);
    let mut found = 0;
    for index in 0..4_000 {
        let solids = tree(&mut random);
        let shape = csg(&solids);
        for _ in 0..250 {
            let ray = ray(8.0 * random.direction(), 3.0 * random.in_cube());
            let spans = spans(&shape, &ray);
            found += spans.len();
            let mut before = 0.0;
            for span in &spans {
                for (from, to, expected) in [
                    (before, span.enter.t, false),
                    (span.enter.t, span.exit.t, true),
                ] {
                    assert!(from <= to, "{index}");
                    let inside = contains(&solids, ray.at(0.5 * (from + to)));
                    let thin = to - from < 1e-7;
                    assert!(
                        thin || inside.is_none_or(|inside| inside == expected),
                        "{index}: {from} {to} {solids:?}"
                    );
                }
                before = span.exit.t;
            }
            let inside = contains(&solids, ray.at(0.5 * (before + 20.0)));
            assert!(
                inside.is_none_or(|inside| !inside),
                "{index}: after {before}"
            );
            if let Some(hit) = shape.hit(&ray, f64::INFINITY) {
                let ends = spans.iter().flat_map(|span| [span.enter, span.exit]);
                assert_eq!(ends.into_iter().find(|end| 0.0 < end.t), Some(hit));
            }
        }
    }
    assert!(200_000 < found, "{found} spans");
}

#[test]
fn set_identities_hold() {
    use Operation::{Difference, Intersection, Union};
    let made = Solid::Made;
    // 0, 1, 2 are A, B, C; each pair describes the same solid in two ways.
    let pairs: &[[&[Solid]; 2]] = &[
        [
            &[made(Union, 1, 2), made(Difference, 0, 3)],
            &[
                made(Difference, 0, 1),
                made(Difference, 0, 2),
                made(Intersection, 3, 4),
            ],
        ],
        [
            &[made(Intersection, 1, 2), made(Difference, 0, 3)],
            &[
                made(Difference, 0, 1),
                made(Difference, 0, 2),
                made(Union, 3, 4),
            ],
        ],
        [
            &[made(Intersection, 0, 1)],
            &[made(Difference, 0, 1), made(Difference, 0, 3)],
        ],
        [&[made(Union, 0, 0)], &[made(Intersection, 0, 0)]],
        [&[made(Union, 0, 1)], &[made(Union, 1, 0)]],
        [&[made(Intersection, 0, 1)], &[made(Intersection, 1, 0)]],
    ];
    let mut random = Random(32);
    for index in 0..3_000 {
        let leaves = [leaf(&mut random), leaf(&mut random), leaf(&mut random)];
        for pair in pairs {
            let [ours, theirs] = pair.map(|rest| csg(&[&leaves, rest].concat()));
            for _ in 0..10 {
                let ray = ray(8.0 * random.direction(), 3.0 * random.in_cube());
                let ends = |shape| {
                    let spans = spans(shape, &ray).into_iter();
                    let thick = spans.filter(|span| 1e-9 < span.exit.t - span.enter.t);
                    thick
                        .map(|span| [span.enter.t, span.exit.t])
                        .collect::<Vec<_>>()
                };
                let (ours, theirs) = (ends(&ours), ends(&theirs));
                assert_eq!(ours.len(), theirs.len(), "{index}: {pair:?}");
                for (a, b) in ours.iter().flatten().zip(theirs.iter().flatten()) {
                    assert!(
                        (a - b).abs() < 1e-9,
                        "{index}: {pair:?}: {ours:?} {theirs:?}"
                    );
                }
            }
        }
        let nothing = csg(&[leaves[0], leaves[0], made(Difference, 0, 1)]);
        let whole = csg(&[leaves[0], made(Union, 0, 0)]);
        let Solid::Leaf(kind, frame) = leaves[0] else {
            continue;
        };
        let own = frame.shape(kind);
        for _ in 0..10 {
            let ray = ray(8.0 * random.direction(), 3.0 * random.in_cube());
            assert!(spans(&nothing, &ray).is_empty(), "{index}");
            let ends = |shape| {
                spans(shape, &ray)
                    .iter()
                    .map(|span| [span.enter.t, span.exit.t])
                    .collect::<Vec<_>>()
            };
            assert_eq!(ends(&whole), ends(&own));
        }
    }
}

/// The fate of a boundary of one operand, inside or outside the other, by Roth's table, in either
/// direction.
#[test]
fn boundaries_follow_roths_table() {
    use Operation::{Difference, Intersection, Union};
    #[derive(Clone, Copy, PartialEq)]
    enum Fate {
        Gone,
        Kept,
        Inverted,
    }
    use Fate::{Gone, Inverted, Kept};
    let slab = |from: f64, to: f64| {
        Solid::Leaf(
            Kind::Cuboid,
            Frame::upright(DVec3::new(from, 0.0, 0.0), DVec3::new(to - from, 1.0, 1.0)),
        )
    };
    let along = Ray {
        origin: DVec3::new(-10.0, 0.5, 0.5),
        direction: DVec3::X,
    };
    for (operation, crossed, other_inside, fate) in [
        (Union, 0, false, Kept),
        (Union, 0, true, Gone),
        (Union, 1, false, Kept),
        (Union, 1, true, Gone),
        (Intersection, 0, false, Gone),
        (Intersection, 0, true, Kept),
        (Intersection, 1, false, Gone),
        (Intersection, 1, true, Kept),
        (Difference, 0, false, Kept),
        (Difference, 0, true, Gone),
        (Difference, 1, false, Gone),
        (Difference, 1, true, Inverted),
    ] {
        for entering in [true, false] {
            let own = if entering {
                slab(0.0, 2.0)
            } else {
                slab(-2.0, 0.0)
            };
            let other = if other_inside {
                slab(-1.0, 1.0)
            } else {
                slab(5.0, 6.0)
            };
            let operands = if crossed == 0 {
                [own, other]
            } else {
                [other, own]
            };
            let shape = csg(&[operands[0], operands[1], Solid::Made(operation, 0, 1)]);
            let spans = spans(&shape, &along);
            let found = spans.iter().find_map(|span| {
                [(span.enter, true), (span.exit, false)]
                    .into_iter()
                    .find(|end| end.0.t == 10.0)
            });
            let message = format!("{operation:?} {crossed} {other_inside} {entering}");
            assert_eq!(found.is_some(), fate != Gone, "{message}");
            if let Some((hit, enters)) = found {
                assert_eq!(enters, entering == (fate == Kept), "{message}");
                assert_eq!(shape.tag(hit), Some(crossed), "{message}");
                let normal = shape.surface(&along, hit).normal;
                assert_eq!(
                    normal,
                    if enters { DVec3::NEG_X } else { DVec3::X },
                    "{message}"
                );
            }
        }
    }
}

#[test]
fn boxes_are_combined_by_the_operation() {
    let cube = |at: f64| {
        Solid::Leaf(
            Kind::Cuboid,
            Frame::upright(DVec3::splat(at), DVec3::splat(2.0)),
        )
    };
    for (operation, min, max) in [
        (Operation::Union, 0.0, 3.0),
        (Operation::Intersection, 1.0, 2.0),
        (Operation::Difference, 0.0, 2.0),
    ] {
        let shape = csg(&[cube(0.0), cube(1.0), Solid::Made(operation, 0, 1)]);
        let [min, max] = [min, max].map(DVec3::splat);
        assert_eq!(shape.bounds(), Aabb { min, max });
    }
    let apart = csg(&[
        cube(0.0),
        cube(5.0),
        Solid::Made(Operation::Intersection, 0, 1),
    ]);
    assert_eq!(apart.bounds(), Aabb::EMPTY);
}

#[test]
fn leaving_rays_do_not_return() {
    let mut random = Random(33);
    let mut surfaces = 0;
    for index in 0..5_000 {
        let solids = tree(&mut random);
        let shape = csg(&solids);
        for _ in 0..4 {
            let incoming = ray(
                random.magnitude(1.0, 4.0) * random.direction(),
                3.0 * random.in_cube(),
            );
            let Some(hit) = shape.hit(&incoming, f64::INFINITY) else {
                continue;
            };
            surfaces += 1;
            let surface = shape.surface(&incoming, hit);
            assert!(
                (surface.point - incoming.at(hit.t)).length() < 1e-8,
                "{index}"
            );
            for _ in 0..10 {
                let direction = random.direction();
                let origin = surface.leave(direction);
                let leaving = Ray { origin, direction };
                assert_eq!(
                    shape.hit(&leaving, 4.0 * ulp(surface.scale)),
                    None,
                    "{index}: {solids:?}"
                );
            }
        }
    }
    assert!(3_000 < surfaces, "{surfaces} surfaces");
}

#[test]
fn long_chains_and_repeated_sharing_take_bounded_time() {
    let ball = |at: DVec3| Solid::Leaf(Kind::Sphere, Frame::upright(at, DVec3::ONE));
    let across = ray(DVec3::new(-9.0, 0.0, 0.0), DVec3::ZERO);
    for forward in [true, false] {
        let mut solids = vec![ball(DVec3::ZERO)];
        for index in 0..100_000_u32 {
            let (made, leaf) = (2 * index, 2 * index + 1);
            solids.push(ball(DVec3::new(0.0, 3.0 * f64::from(index + 1), 0.0)));
            let (first, second) = if forward { (made, leaf) } else { (leaf, made) };
            solids.push(Solid::Made(Operation::Union, first, second));
        }
        let found = spans(&csg(&solids), &across);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].enter.t, found[0].exit.t), (8.0, 10.0));
    }
    for operation in OPERATIONS {
        let mut solids = vec![ball(DVec3::ZERO)];
        for index in 0..40 {
            solids.push(Solid::Made(operation, index, index));
        }
        let found = spans(&csg(&solids), &across);
        assert_eq!(found.len(), usize::from(operation != Operation::Difference));
    }
}
