//! Meshes in scenes: structures, materials, normals and shadows.

use std::f64::consts::{PI, TAU};

use super::*;
use crate::world::{Search, Structures};
use geometry::lanes::{Level, dispatch};
use geometry::{Attribute, Instance, Mesh, MeshParts, Plane, SlotRun};
use scene::Objects;

/// A closed, bumpy ball of `rings` rings with separate positions for each corner; its poles are
/// fans of many needles.
fn ball(rings: u32) -> MeshParts {
    let around = 2 * rings;
    let corner = |ring: u32, step: u32| match ring {
        0 => 0,
        _ if ring == rings => 1,
        _ => 2 + (ring - 1) * around + step % around,
    };
    let mut positions = vec![DVec3::Z, DVec3::NEG_Z];
    for ring in 1..rings {
        for step in 0..around {
            let (down, turn) = (
                PI * f64::from(ring) / f64::from(rings),
                TAU * f64::from(step) / f64::from(around),
            );
            let bump = 1.0 + 0.05 * (7.0 * turn).sin() * (5.0 * down).sin();
            let flat = DVec3::new(turn.cos(), turn.sin(), 0.0);
            positions.push(bump * (down.sin() * flat + down.cos() * DVec3::Z));
        }
    }
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for step in 0..around {
            let [a, b] = [corner(ring, step), corner(ring, step + 1)];
            let [c, d] = [corner(ring + 1, step), corner(ring + 1, step + 1)];
            triangles.extend((0 < ring).then_some([a, c, b]));
            triangles.extend((ring + 1 < rings).then_some([b, c, d]));
        }
    }
    MeshParts {
        positions,
        triangles,
        ..MeshParts::default()
    }
}

pub(super) fn mesh(parts: MeshParts) -> Arc<Mesh> {
    Arc::new(Mesh::new(parts).expect("the mesh is sound"))
}

/// A ball of flat triangles that shade as a sphere.
pub(super) fn smooth_ball(rings: u32, centre: DVec3) -> Shape {
    let mut parts = ball(rings);
    for position in &mut parts.positions {
        *position = position.normalize();
    }
    parts.normals = Attribute {
        values: parts.positions.clone(),
        corners: Vec::new(),
    };
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    as_shape(&placed(&mesh(parts), axes, centre))
}

fn placed(mesh: &Arc<Mesh>, columns: [DVec3; 3], translation: DVec3) -> Instance {
    let frame = Affine::of_matrix(columns, translation).expect("the columns span a volume");
    Instance::new(Arc::clone(mesh), &frame, Vec::new())
}

fn as_shape(instance: &Instance) -> Shape {
    Shape::Mesh(Box::new(instance.clone()))
}

/// An upright square of two triangles around the origin, with edge 2 and slots 0 and 1.
pub(super) fn square() -> MeshParts {
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    MeshParts {
        positions: vec![
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        slots: vec![SlotRun { first: 1, slot: 1 }],
        ..MeshParts::default()
    }
}

/// Columns and translations of test transforms: identity, large and distant, mirrored and sheared.
fn images() -> [([DVec3; 3], DVec3); 3] {
    let [x, y, z] = DVec3::AXES;
    [
        ([x, y, z], DVec3::ZERO),
        ([0.01 * x, 3.0 * z, y], DVec3::new(1e6, -3e5, 2.0)),
        ([-x, y + 0.5 * x, 0.3 * z], DVec3::splat(0.7)),
    ]
}

#[test]
fn the_structure_matches_brute_force() {
    let mut random = Random(1);
    let mesh = mesh(ball(12));
    for (columns, translation) in images() {
        let instance = placed(&mesh, columns, translation);
        let world = world(scene(&[(as_shape(&instance), grey(1.0))], &[]));
        let bounds = instance.bounds();
        let [centre, half] = [bounds.centre(), 0.5 * bounds.size()];
        for number in 0..1000 {
            let distance = [1.5, 0.5, 1e4][number % 3];
            let origin = centre + distance * half * random.point(1.0);
            let toward = centre + half * random.point(1.0);
            let direction = (toward - origin).normalize();
            let ray = Ray { origin, direction };
            for limit in [f64::INFINITY, half.length()] {
                let found = world.nearest(&ray, limit).map(|nearest| nearest.hit);
                assert_eq!(found, instance.hit(&ray, limit), "{ray:?}");
            }
        }
    }
}

/// Rays from inside, in random directions and through corners and edges.
#[test]
fn a_closed_mesh_has_no_gaps() {
    let mut random = Random(2);
    let parts = ball(48);
    let mesh = mesh(parts.clone());
    for (columns, translation) in images() {
        let instance = placed(&mesh, columns, translation);
        let object = Object {
            shape: as_shape(&instance),
            material: 0,
        };
        let objects = Objects::from_iter([object]);
        let structures = Structures::build(&objects, None, &|| false).expect("nobody cancels");
        let [x, y, z] = columns;
        let at = |place: DVec3| translation + (place.x * x + place.y * y + place.z * z);
        for number in 0..60_000 {
            let triangle = (random.next() * parts.triangles.len() as f64) as usize;
            let [a, b, _] = parts.triangles[triangle].map(|i| parts.positions[i as usize]);
            let target = match number % 3 {
                0 => a,
                1 => 0.5 * (a + b),
                _ => random.point(1.0),
            };
            let origin = at(0.5 * random.point(1.0));
            let direction = (at(target) - origin).normalize();
            let ray = Ray { origin, direction };
            for search in [Search::Nearest, Search::Blocker] {
                let hit = dispatch!(Level::new(), simd => {
                    structures.hit(simd, 0, &instance, &ray, f64::INFINITY, search)
                });
                assert!(hit.is_some(), "{ray:?} leaks");
            }
        }
    }
}

#[test]
fn instances_share_a_structure_and_edits_keep_it() {
    let [round, other] = [mesh(ball(4)), mesh(ball(5))];
    let at = |mesh, x| as_shape(&placed(mesh, DVec3::AXES, x * DVec3::X));
    let objects = |shapes: Vec<Shape>| {
        let object = |shape| Object { shape, material: 0 };
        shapes.into_iter().map(object).collect::<Objects>()
    };
    let build = |objects: &Objects, known: Option<&Structures>| {
        Structures::build(objects, known, &|| false).expect("nobody cancels")
    };
    let none = build(&objects(vec![sphere([0.0; 3], 1.0)]), None);
    assert_eq!(none.trees().count(), 0);
    let first = build(
        &objects(vec![
            sphere([0.0; 3], 1.0),
            at(&round, 0.0),
            at(&round, 5.0),
            at(&other, 9.0),
        ]),
        None,
    );
    let trees: Vec<_> = first.trees().cloned().collect();
    assert_eq!(trees.len(), 2);
    // Moved and reordered; the other mesh has gone.
    let edited = build(&objects(vec![at(&round, 1.0)]), Some(&first));
    let kept: Vec<_> = edited.trees().collect();
    assert!(kept.len() == 1 && Arc::ptr_eq(kept[0], &trees[0]));
    let back = build(
        &objects(vec![at(&other, 1.0), at(&round, 1.0)]),
        Some(&edited),
    );
    let back: Vec<_> = back.trees().collect();
    assert!(!Arc::ptr_eq(back[0], &trees[1]) && Arc::ptr_eq(back[1], &trees[0]));
    assert!(Structures::build(&objects(vec![at(&round, 0.0)]), None, &|| true).is_none());
}

#[test]
fn each_triangle_has_its_material() {
    let frame = Affine::of_matrix(DVec3::AXES, DVec3::ZERO).expect("the axes");
    let lone = sphere([50.0, 0.0, 0.0], 1.0);
    for (tags, below, above) in [
        (vec![], 0.25, 0.25),
        (vec![1, 2], 0.5, 0.75),
        (vec![2, 1], 0.75, 0.5),
        (vec![1], 0.5, 0.25),
    ] {
        let shape = Shape::Mesh(Box::new(Instance::new(mesh(square()), &frame, tags)));
        let objects = [
            (shape, grey(0.25)),
            (lone.clone(), grey(0.5)),
            (lone.clone(), grey(0.75)),
        ];
        for (place, expected) in [([0.5, -0.5, 0.0], below), ([-0.5, 0.5, 0.0], above)] {
            let seen = level(scene(&objects, &[]), 0, ray([0.0, 0.0, 5.0], place));
            assert_eq!(seen, expected);
        }
    }
}

/// A flat square whose normals are all tilted by 60°: the cosine is ½ for a light straight ahead,
/// and on the back face, where the normal is flipped, for a light straight behind.
#[test]
fn light_uses_the_normals_of_the_corners() {
    let mut parts = square();
    parts.normals = Attribute {
        values: vec![DVec3::new(0.75_f64.sqrt(), 0.0, 0.5)],
        corners: vec![[0; 3]; 2],
    };
    let matte = Coefficients {
        diffuse: Rgb::ONE,
        ..BLACK
    };
    let shape = as_shape(&placed(&mesh(parts), DVec3::AXES, DVec3::ZERO));
    for z in [1e6, -1e6] {
        let scene = scene(&[(shape.clone(), matte)], &[white_light([0.0, 0.0, z])]);
        let seen = level(
            scene,
            0,
            ray([0.0, 0.0, 5.0_f64.copysign(z)], [0.1, 0.2, 0.0]),
        );
        assert_near(seen, 0.5, 1e-6);
    }
}

/// An opaque mesh blocks light with any of its triangles; a transparent one attenuates it once.
#[test]
fn meshes_cast_shadows() {
    let floor = Affine::of_matrix([4.0 * DVec3::X, 4.0 * DVec3::Y, DVec3::Z], -DVec3::Z);
    let floor = Shape::Plane(Box::new(Plane(floor.expect("a volume"))));
    let matte = Coefficients {
        diffuse: Rgb::ONE,
        ..BLACK
    };
    let mesh = mesh(ball(8));
    for (transmission, expected) in [(0.0, 0.0), (0.5, 0.5)] {
        let veil = Coefficients {
            transmission,
            ..BLACK
        };
        let shape = as_shape(&placed(
            &mesh,
            DVec3::AXES.map(|axis| 0.5 * axis),
            DVec3::ZERO,
        ));
        let scene = scene(
            &[(floor.clone(), matte), (shape, veil)],
            &[white_light([0.0, 0.0, 1e6])],
        );
        assert_near(
            level(scene, 0, ray([3.0, 0.0, 0.0], [0.1, 0.2, -1.0])),
            expected,
            1e-6,
        );
    }
}

/// Equal except at outlines.
#[test]
fn an_instance_looks_like_a_transformed_mesh() {
    let columns = [DVec3::X, 0.6 * DVec3::Y - 0.8 * DVec3::Z, 0.8 * DVec3::Y];
    let moved = DVec3::new(0.3, -0.2, 0.1);
    let parts = ball(10);
    let mut baked = parts.clone();
    for place in &mut baked.positions {
        let [x, y, z] = columns;
        *place = moved + place.x * x + place.y * y + place.z * z;
    }
    let material = Coefficients {
        diffuse: Rgb::splat(0.7),
        specular: Rgb::splat(0.3),
        exponent: 20.0,
        reflection: 0.2,
        ..grey(0.1)
    };
    let pictures = [
        placed(&mesh(parts), columns, moved),
        placed(&mesh(baked), DVec3::AXES, DVec3::ZERO),
    ]
    .map(|instance| {
        let scene = scene(
            &[(as_shape(&instance), material)],
            &[white_light([3.0, 4.0, 9.0])],
        );
        let (mut renderer, woken) = renderer(1);
        let generation = restart(&mut renderer, job(&Arc::new(scene), settings(120, 90, 1)));
        finish(&renderer, &woken, generation)
    });
    let [a, b] = &pictures;
    let differ = |(a, b): (&[u8; 3], &[u8; 3])| (0..3).any(|i| 1 < a[i].abs_diff(b[i]));
    let differing = a
        .pixels
        .iter()
        .zip(&b.pixels)
        .filter(|&pair| differ(pair))
        .count();
    let covered = a.objects.iter().filter(|&&object| object == 0).count();
    assert!(
        1000 < covered && differing <= 2,
        "{differing} of {covered} differ"
    );
}
