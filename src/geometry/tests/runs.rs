//! Runs of triangles: what is rejected in single precision is missed, and what is met is what is met
//! one by one.

use std::ops::Range;
use std::sync::Arc;

use glam::DVec3;

use super::random::Random;
use super::unit;
use crate::lanes::{Eight, Level, SimdBase, dispatch};
use crate::{Affine, Hit, Instance, Mesh, MeshParts, Ray, Rays, TriangleRuns};

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

/// The bits of a hit.
fn bits(hit: Option<Hit>) -> Option<(u64, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.part))
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
        let stored = TriangleRuns::new(&mesh, &order, &runs, &|| false).expect("nothing cancels");
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
                let unlimited = Eight::splat(simd, f64::INFINITY);
                for places in &runs {
                    let run = stored.run(&order, places.clone());
                    let mut nearest_together = together.none_before(unlimited);
                    together.meet_run(&run, 0xFF, &mut nearest_together);
                    let hits = together.hits(&nearest_together, unlimited);
                    for (lane, line) in lines.iter().enumerate() {
                        let roughly = line.roughly(simd);
                        let mut nearest = None;
                        for place in places.clone() {
                            let mut own = None;
                            line.meet(order[place], f64::INFINITY, &mut own);
                            line.meet(order[place], f64::INFINITY, &mut nearest);
                            let at = place - places.start;
                            let may_cross = run.may_be_crossed_by(&roughly) >> at & 1;
                            assert!(own.is_none() || may_cross == 1, "{line:?}");
                            met += u32::from(own.is_some());
                            passed += may_cross;
                            tested += 1;
                        }
                        let mut alone = None;
                        line.meet_run(&roughly, &run, f64::INFINITY, &mut alone);
                        assert_eq!(bits(alone), bits(nearest), "{line:?}");
                        let hit = hits.filter(|hits| hits.lanes >> lane & 1 == 1);
                        let hit = hit.map(|hits| hits.hit(lane));
                        let nearest = nearest.and_then(|hit| line.hit(hit, f64::INFINITY));
                        assert_eq!(bits(hit), bits(nearest), "{line:?}");
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
