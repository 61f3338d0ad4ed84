//! What single precision rejects, double precision misses.

use std::ops::Range;
use std::sync::Arc;

use glam::DVec3;

use super::random::Random;
use super::unit;
use crate::geometry::lanes::{Level, dispatch};
use crate::geometry::{Affine, Instance, Mesh, MeshParts, Pretest, Ray, Rays};

const COUNT: u32 = 40;

/// Random triangles, given the decimal logarithms of the least size and the least relative width.
fn soup(random: &mut Random, [size, width]: [f64; 2]) -> Arc<Mesh> {
    let mut positions = Vec::new();
    for _ in 0..COUNT {
        let centre = random.in_cube();
        let size = random.magnitude(size, 0.0);
        let squeeze = DVec3::new(1.0, random.magnitude(width, 0.0), 1.0);
        positions.extend([(); 3].map(|()| centre + size * (squeeze * random.in_cube())));
    }
    let parts = MeshParts {
        positions,
        triangles: (0..COUNT).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..MeshParts::default()
    };
    Arc::new(Mesh::new(parts).expect("the mesh is valid"))
}

/// A ray at a vertex, an edge, the inside of a triangle, or just beside it, from near or far.
fn ray_at(random: &mut Random, [a, b, c]: [DVec3; 3]) -> Ray {
    let [u, v] = match random.bits() % 4 {
        0 => [0.0, 0.0],
        1 => [random.between(0.0, 1.0), 0.0],
        2 => [random.between(0.0, 0.5), random.between(0.0, 0.5)],
        _ => [random.between(0.0, 1.0), random.magnitude(-16.0, -2.0)],
    };
    let aim = a + u * (b - a) + v * (c - a);
    let direction = if random.bits().is_multiple_of(4) {
        DVec3::AXES[(random.bits() % 3) as usize]
    } else {
        random.direction()
    };
    let distance = random.magnitude(-8.0, 3.0);
    Ray {
        origin: aim - distance * direction,
        direction: unit(direction),
    }
}

/// How many triangles are tested, pass, and are met.
fn tested(least: [f64; 2]) -> [u32; 3] {
    let mut random = Random(1);
    let frame = Affine::of_matrix(DVec3::AXES, DVec3::ZERO).expect("the axes");
    let (mut met, mut tested, mut passed) = (0, 0, 0);
    for _ in 0..30 {
        let mesh = soup(&mut random, least);
        let order: Vec<u32> = (0..COUNT).rev().collect();
        let runs: Vec<Range<usize>> = [0..8, 8..11, 11..12, 12..20, 20..27, 27..33, 33..40].into();
        let pretest = Pretest::new(&mesh, &order, &runs, &|| false).expect("nothing cancels");
        let instance = Instance::new(Arc::clone(&mesh), &frame, Vec::new());
        for _ in 0..100 {
            let target = (random.bits() % u64::from(COUNT)) as u32;
            let corners = mesh.vertices(target);
            let corners = corners.map(|corner| {
                instance.frame().origin() + {
                    let [x, y, z] = instance.frame().axes();
                    corner.x * x + corner.y * y + corner.z * z
                }
            });
            let rays = [(); 8].map(|()| ray_at(&mut random, corners));
            let lines = rays.map(|ray| instance.line(&ray).expect("the mesh is not behind"));
            dispatch!(Level::new(), simd => {
                let together = instance.lines(&Rays::gather(simd, &rays), 0xFF);
                let together = together.expect("the mesh is not behind all");
                for run in &runs {
                    for (lane, line) in lines.iter().enumerate() {
                        let alone = pretest.of_line(&line.roughly(simd), run);
                        for place in run.clone() {
                            let mut nearest = None;
                            line.meet(order[place], f64::INFINITY, &mut nearest);
                            let both = together.may_meet(&pretest, run, place, 0xFF);
                            let may_meet = [alone >> (place - run.start) & 1, both >> lane & 1];
                            assert!(nearest.is_none() || may_meet == [1, 1], "{line:?}");
                            met += u32::from(nearest.is_some());
                            passed += alone >> (place - run.start) & 1;
                            tested += 1;
                        }
                    }
                }
            });
        }
    }
    [tested, passed, met]
}

#[test]
fn no_triangle_that_is_met_is_rejected() {
    let [tested, _, met] = tested([-7.0, -6.0]);
    assert!(15_000 < met, "{met} of {tested} are met");
}

#[test]
fn most_others_are_rejected() {
    let [tested, passed, met] = tested([-3.0, -1.0]);
    let others = passed - met;
    assert!(others < tested / 100, "{others} of {tested}");
}
