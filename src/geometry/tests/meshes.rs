//! Meshes are watertight, and rays that leave them do not return.

use std::sync::Arc;

use glam::DVec3;

use super::leaving::frame;
use super::random::Random;
use super::{Ray, ray};
use crate::{Affine, Hit, Instance, Mesh, MeshParts, Shape, Surface};

/// A mesh without normals and texture coordinates.
fn mesh(positions: &[DVec3], triangles: &[[u32; 3]]) -> Arc<Mesh> {
    let parts = MeshParts {
        positions: positions.to_vec(),
        triangles: triangles.to_vec(),
        ..MeshParts::default()
    };
    Arc::new(Mesh::new(parts).expect("the mesh is valid"))
}

fn placed(mesh: &Arc<Mesh>, frame: &Affine) -> Shape {
    Shape::Mesh(Box::new(Instance::new(Arc::clone(mesh), frame, Vec::new())))
}

fn identity() -> Affine {
    Affine::of_matrix(DVec3::AXES, DVec3::ZERO).expect("the axes span a volume")
}

/// Twelve triangles; every ray along an axis is parallel to some, and many hit a diagonal.
fn cube() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let corner = |i: u32| DVec3::from_array([0, 1, 2].map(|axis| f64::from(i >> axis & 1) - 0.5));
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = quads.map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    ((0..8).map(corner).collect(), halves.concat())
}

/// Twenty triangles in general position.
fn ball(random: &mut Random) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (long, short) = (0.85, 0.525);
    let corners = [
        (short, long),
        (-short, long),
        (short, -long),
        (-short, -long),
    ];
    let positions = (0..3).flat_map(|axis: usize| {
        corners.map(|(a, b)| {
            let mut corner = DVec3::ZERO;
            corner[(axis + 1) % 3] = a;
            corner[(axis + 2) % 3] = b;
            corner
        })
    });
    let positions: Vec<_> = positions.map(|p| p + 0.05 * random.in_cube()).collect();
    let is_near = |i: usize, j: usize| positions[i].distance(positions[j]) < 1.4;
    let mut triangles = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if is_near(i, j) && is_near(j, k) && is_near(k, i) {
                    let [a, b, c] = [i, j, k].map(|corner| positions[corner]);
                    let inverted = (b - a).cross(c - a).dot(a) < 0.0;
                    let [j, k] = if inverted { [k, j] } else { [j, k] };
                    triangles.push([i, j, k].map(|corner| corner as u32));
                }
            }
        }
    }
    assert_eq!(triangles.len(), 20);
    (positions, triangles)
}

/// A frame for an instance: the identity, scaled by a power of two, moved far away, of unequal
/// lengths, mirrored, or sheared.
fn image(random: &mut Random, index: u64) -> Affine {
    let [x, y, z] = DVec3::AXES;
    let (columns, translation) = match index % 6 {
        0 => ([x, y, z], DVec3::ZERO),
        1 => {
            let size = 2_f64.powi(random.between(-40.0, 40.0) as i32);
            ([x, y, z].map(|axis| size * axis), DVec3::ZERO)
        }
        2 => (random.rotation(), 1e6 * random.in_cube()),
        3 => ([1e-3 * x, y, 1e3 * z], 10.0 * random.in_cube()),
        4 => ([-x, y, 0.5 * z], random.in_cube()),
        _ => {
            let [u, v, w] = random.skewed(0.1);
            ([u, 3.0 * v, 0.2 * w], random.in_cube())
        }
    };
    Affine::of_matrix(columns, translation).expect("the columns span a volume")
}

/// Maps a point to the world.
fn world(frame: &Affine, point: DVec3) -> DVec3 {
    let [x, y, z] = frame.axes();
    frame.origin() + (point.x * x + point.y * y + point.z * z)
}

/// A million rays, from inside or through the inside: in random directions, and at vertices and
/// edges.
#[test]
fn closed_meshes_are_watertight() {
    let mut random = Random(21);
    let mut rays = 0;
    for index in 0..120 {
        let (positions, triangles) = if index % 4 == 0 {
            cube()
        } else {
            ball(&mut random)
        };
        // Every fifth is flattened to slivers.
        let (squeeze, farthest) = if index % 5 == 0 {
            (DVec3::new(1.0, 1e-7, 30.0), 1.0)
        } else {
            (DVec3::ONE, 6.0)
        };
        // The mesh may be anywhere in its own coordinates.
        let away =
            [DVec3::ZERO, DVec3::splat(100.0), DVec3::new(0.0, -1e5, 7.0)][index as usize % 3];
        let moved: Vec<_> = positions.iter().map(|p| squeeze * p + away).collect();
        let frame = image(&mut random, index);
        let shape = placed(&mesh(&moved, &triangles), &frame);
        for number in 0..8400 {
            let inside = world(&frame, away + 0.3 * squeeze * random.in_cube());
            let [a, b, c] = triangles[(random.bits() % triangles.len() as u64) as usize]
                .map(|corner| moved[corner as usize]);
            let incoming = match number % 4 {
                0 => ray(inside, world(&frame, a)),
                1 => {
                    let along = [0.5, 0.25, random.between(0.0, 1.0)][number / 4 % 3];
                    ray(inside, world(&frame, a + along * (b - a)))
                }
                2 => ray(
                    inside,
                    world(&frame, (a + b + c) / 3.0 + 0.2 * random.in_cube()),
                ),
                _ => {
                    let far = random.magnitude(0.5, farthest) * random.direction();
                    ray(world(&frame, away + far), inside)
                }
            };
            // Skip rays whose origin overflows.
            let aimed = incoming.origin.is_finite();
            rays += u32::from(aimed);
            assert!(
                !aimed || shape.hit(&incoming, f64::INFINITY).is_some(),
                "image {index}, ray {number} leaks: {incoming:?}"
            );
        }
    }
    assert!(1_000_000 < rays);
}

/// Axis-parallel rays through vertices, edges and diagonals, at multiples of 1/16.
#[test]
fn a_cube_is_watertight_along_its_axes() {
    let (positions, triangles) = cube();
    let shape = placed(&mesh(&positions, &triangles), &identity());
    for direction in DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]) {
        for x in -8..=8 {
            for y in -8..=8 {
                let [u, v] = [direction.any_orthonormal_vector(), DVec3::ZERO];
                let v = v + direction.cross(u);
                let across = f64::from(x) / 16.0 * u + f64::from(y) / 16.0 * v;
                for back in [0.0, 3.0, 1e9] {
                    let origin = across - back * direction;
                    let hit = shape.hit(&Ray { origin, direction }, f64::INFINITY);
                    assert!(hit.is_some(), "{direction} at {across} from {back}");
                }
            }
        }
    }
}

/// A ray that passes beside an edge misses, however close.
#[test]
fn edges_are_sharp() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let shape = placed(&mesh(&corners, &[[0, 1, 2]]), &identity());
    let hits = |x: f64, y: f64| {
        let origin = DVec3::new(x, y, 1.0);
        let direction = DVec3::NEG_Z;
        shape
            .hit(&Ray { origin, direction }, f64::INFINITY)
            .is_some()
    };
    let tiny = f64::EPSILON;
    assert!(hits(0.0, 0.0) && hits(1.0, 0.0) && hits(0.0, 1.0) && hits(0.5, 0.5));
    assert!(hits(0.25, tiny) && hits(0.5 - tiny, 0.5 - tiny));
    assert!(!hits(0.25, -tiny) && !hits(-tiny, 0.25) && !hits(0.5 + tiny, 0.5));
}

/// A ball squeezed along two axes: needles and sharp edges.
fn needles(random: &mut Random) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (mut positions, triangles) = ball(random);
    let squeeze = DVec3::new(
        random.magnitude(-5.0, 0.0),
        random.magnitude(-5.0, 0.0),
        1.0,
    );
    for position in &mut positions {
        *position *= squeeze;
    }
    (positions, triangles)
}

/// A flat sheet of eight triangles, which leaving rays may graze.
fn sheet() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let at = |i: u32| DVec3::new(f64::from(i % 3) - 1.0, f64::from(i / 3) - 1.0, 0.0);
    let quads = [0, 1, 3, 4].map(|i| [[i, i + 1, i + 4], [i, i + 4, i + 3]]);
    ((0..9).map(at).collect(), quads.concat())
}

/// The surface of an instance hit by a ray that aims at a triangle, or one of its vertices.
fn surface(
    random: &mut Random,
    (positions, triangles): &(Vec<DVec3>, Vec<[u32; 3]>),
    index: u64,
) -> Option<(Shape, Hit, Surface)> {
    let frame = frame(random, index)
        .affine()
        .expect("the frame spans a volume");
    let shape = placed(&mesh(positions, triangles), &frame);
    let [a, b, c] = triangles[(random.bits() % triangles.len() as u64) as usize]
        .map(|corner| positions[corner as usize]);
    let target = if index.is_multiple_of(5) {
        a
    } else {
        let [u, v] = [random.between(0.0, 0.5), random.between(0.0, 0.5)];
        a + u * (b - a) + v * (c - a)
    };
    let origin = match index % 3 {
        0 => world(&frame, random.in_cube()),
        1 => world(&frame, 10.0 * random.direction()),
        _ => random.magnitude(-8.0, 8.0) * random.direction(),
    };
    let incoming = ray(origin, world(&frame, target));
    let hit = shape.hit(&incoming, f64::INFINITY)?;
    let surface = shape.surface(&incoming, hit);
    Some((shape, hit, surface))
}

/// A thousand rays leave each of a thousand points: outward from a convex mesh none hits anything,
/// inward none hits the triangle it leaves; from a flat sheet none returns at all.
#[test]
fn rays_that_leave_a_mesh_do_not_return() {
    for kind in 0..4 {
        let mut random = Random(31 + kind);
        let mut points = 0;
        let mut returned = Vec::new();
        for index in 0..2000 {
            let parts = match kind {
                0 => cube(),
                1 => ball(&mut random),
                2 => sheet(),
                _ => needles(&mut random),
            };
            let Some((shape, own, surface)) = surface(&mut random, &parts, index) else {
                continue;
            };
            points += 1;
            let Shape::Mesh(instance) = &shape else {
                unreachable!("a mesh was placed")
            };
            for _ in 0..1000 {
                let direction = random.direction();
                let origin = surface.leave(direction);
                let leaving = Ray { origin, direction };
                let outward = 0.0 <= direction.dot(surface.normal);
                let again = if outward || kind == 2 {
                    shape.hit(&leaving, f64::INFINITY)
                } else {
                    instance.line(&leaving).and_then(|line| {
                        let mut nearest = None;
                        line.meet(own.part, f64::INFINITY, &mut nearest);
                        nearest
                    })
                };
                returned.extend(again.map(|hit| (index, outward, own.part, hit)));
            }
            if points == 1000 {
                break;
            }
        }
        assert_eq!(points, 1000, "kind {kind}");
        assert!(
            returned.is_empty(),
            "kind {kind}: {} returned, first {:?}",
            returned.len(),
            returned[0]
        );
    }
}

/// A ray refracted at a vertex or an edge continues inside the mesh.
#[test]
fn rays_that_enter_at_an_edge_are_inside() {
    let mut random = Random(41);
    for index in 0..2000 {
        let parts = if index % 2 == 0 {
            cube()
        } else {
            ball(&mut random)
        };
        let Some((shape, _, surface)) = surface(&mut random, &parts, 5 * index) else {
            continue;
        };
        let inward = -surface.normal;
        let leaving = Ray {
            origin: surface.leave(inward),
            direction: inward,
        };
        assert!(shape.hit(&leaving, f64::INFINITY).is_some(), "{index}");
    }
}

#[test]
fn scaling_by_a_power_of_two_changes_no_bit() {
    let mut random = Random(51);
    for index in 0..500 {
        let (positions, triangles) = ball(&mut random);
        let frame = frame(&mut random, index);
        let affine = frame.affine().expect("the frame spans a volume");
        let shape = placed(&mesh(&positions, &triangles), &affine);
        let incoming = ray(
            world(&affine, 3.0 * random.direction()),
            world(&affine, 0.5 * random.in_cube()),
        );
        let hit = shape.hit(&incoming, f64::INFINITY).expect("aimed inside");
        let direction = random.direction();
        let start = shape.surface(&incoming, hit).leave(direction);
        for exponent in [1, -1, 7, -20, 40] {
            let size = 2_f64.powi(exponent);
            let in_file: Vec<_> = positions.iter().map(|p| size * *p).collect();
            let origin = size * frame.origin;
            let by_file = Affine::new(origin, frame.directions, frame.lengths);
            let by_frame = Affine::new(origin, frame.directions, size * frame.lengths);
            for (positions, affine) in [(&in_file, by_file), (&positions, by_frame)] {
                let affine = affine.expect("the frame spans a volume");
                let scaled = placed(&mesh(positions, &triangles), &affine);
                let far = Ray {
                    origin: size * incoming.origin,
                    ..incoming
                };
                let found = scaled.hit(&far, f64::INFINITY).expect("aimed inside");
                let expected = Hit {
                    t: size * hit.t,
                    ..hit
                };
                assert_eq!(found, expected);
                assert_eq!(scaled.surface(&far, found).leave(direction), size * start);
            }
        }
    }
}

/// An instance equals a mesh of the transformed vertices.
#[test]
fn an_instance_equals_the_mesh_baked_into_the_world() {
    let mut random = Random(61);
    let mut hits = 0;
    for index in 0..60 {
        let (positions, triangles) = ball(&mut random);
        let frame = image(&mut random, 6 * index + [0, 2, 3, 4, 5][index as usize % 5]);
        let instance = placed(&mesh(&positions, &triangles), &frame);
        let baked: Vec<_> = positions.iter().map(|p| world(&frame, *p)).collect();
        let baked = placed(&mesh(&baked, &triangles), &identity());
        let [x, y, z] = frame.axes();
        let mirrored = x.cross(y).dot(z) < 0.0;
        for _ in 0..200 {
            let incoming = ray(
                world(&frame, 4.0 * random.direction()),
                world(&frame, random.in_cube()),
            );
            let [a, b] = [&instance, &baked].map(|shape| shape.hit(&incoming, f64::INFINITY));
            let (Some(a), Some(b)) = (a, b) else {
                assert_eq!(a.is_some(), b.is_some(), "{index}");
                continue;
            };
            hits += 1;
            assert_eq!(a.part, b.part, "{index}");
            let [a, b] = [(&instance, a), (&baked, b)].map(|(s, hit)| s.surface(&incoming, hit));
            // Mirroring reverses the winding; a normal stays outward.
            let normal = if mirrored { -b.normal } else { b.normal };
            assert!(a.normal.distance(normal) < 1e-6, "{index}: {a:?} {b:?}");
            let scale = a.scale.max(b.scale).max(incoming.origin.length());
            assert!(
                a.point.distance(b.point) < 1e-9 * scale,
                "{index}: {a:?} {b:?}"
            );
        }
    }
    assert!(4000 < hits, "{hits} hits");
}
