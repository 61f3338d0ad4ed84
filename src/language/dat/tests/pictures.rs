//! Small pictures of solids, compared with point membership by their definitions: a ray hits a
//! solid where one of many points along it is inside.

use glam::DVec3;

use super::{scene, spelled};
use geometry::{Ray, Shape};

const SIDE: u32 = 32;

/// The shape of the object with ID 9.
fn drawn(objects: &str) -> Shape {
    let text = spelled(&format!("VIEW\nmat ID 0 MAT\n{objects}\nrender 1 ID 9"));
    let objects = scene(&text).objects;
    objects.get(0).expect("one object is drawn").shape.clone()
}

/// A signed measure: negative inside, 0 on the surface.
type Excess = fn(DVec3) -> f64;

const BALL: Excess = |p| p.length() - 3.0;
const BAR: Excess = |p| (p.x.abs() - 3.5).max(p.y.abs() - 1.0).max(p.z.abs() - 1.0);

#[test]
fn solids_are_hit_where_they_are() {
    let ball = "obj sphere ID 1 mat ID 0 0 0 0 3\n";
    let bar = "obj box ID 2 mat ID 0 0 0 0  1 0 0 0 1 0 0 0 1  7 2 2\n";
    let csg = |operation: &str| format!("{ball}{bar}obj CSG ID 9 {operation}");
    let cases: [(String, Excess); 10] = [
        ("obj sphere ID 9 mat ID 0  0 0 0 3".into(), BALL),
        ("obj ellipsoid ID 9 mat ID 0  0 0 0  1 2 3".into(), |p| {
            (p / DVec3::new(1.0, 2.0, 3.0)).length() - 1.0
        }),
        (
            "obj cylinder ID 9 mat ID 0  0 0 0  0.6 0 0.8  1 6".into(),
            |p| {
                let along = p.dot(DVec3::new(0.6, 0.0, 0.8));
                let across = (p.length_squared() - along * along).max(0.0).sqrt();
                (along.abs() - 3.0).max(across - 1.0)
            },
        ),
        (
            "obj box ID 9 mat ID 0  0 0 0  0.6 0.8 0  -0.8 0.6 0  0 0 1  2 4 5".into(),
            |p| {
                let (u, v) = (0.6 * p.x + 0.8 * p.y, 0.6 * p.y - 0.8 * p.x);
                (u.abs() - 1.0).max(v.abs() - 2.0).max(p.z.abs() - 2.5)
            },
        ),
        // A hyperboloid, x² + y² − z² ≤ 1, between z = −2 and z = 2.
        (
            "obj quadric ID 9 mat ID 0  1 0 0 0 1 0 0 -1 0 -1  2 0 0 1 2  0 0 -1 2".into(),
            |p| (p.x * p.x + p.y * p.y - p.z * p.z - 1.0).max(p.z.abs() - 2.0),
        ),
        // Its complement within a sphere: concave.
        (
            "obj quadric ID 3 mat ID 0  -1 0 0 0 -1 0 0 1 0 1  0\nobj sphere ID 1 mat ID 0 0 0 0 3\nobj CSG ID 9 intersection ID 1 ID 3".into(),
            |p| BALL(p).max(1.0 + p.z * p.z - p.x * p.x - p.y * p.y),
        ),
        (csg("union ID 1 ID 2"), |p| BALL(p).min(BAR(p))),
        (csg("intersection ID 1 ID 2"), |p| BALL(p).max(BAR(p))),
        (csg("difference ID 1 ID 2"), |p| BALL(p).max(-BAR(p))),
        (csg("difference ID 2 ID 1"), |p| BAR(p).max(-BALL(p))),
    ];
    let forward = DVec3::new(-9.0, 12.0, -14.0).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    for (objects, excess) in cases {
        let shape = drawn(&objects);
        let (mut covered, mut wrong) = (0, 0);
        for at in 0..SIDE * SIDE {
            let place = |at: u32| 8.0 * (f64::from(at) + 0.5) / f64::from(SIDE) - 4.0;
            let ray = Ray {
                origin: -20.0 * forward + place(at % SIDE) * right + place(at / SIDE) * up,
                direction: forward,
            };
            let least = (0..2_000)
                .map(|step| excess(ray.at(14.0 + f64::from(step) * 0.006)))
                .fold(f64::INFINITY, f64::min);
            let hit = shape.hit(&ray, f64::INFINITY);
            // Sampled points can miss parts thinner than their spacing.
            if 0.02 < least.abs() {
                wrong += u32::from(hit.is_none() != (0.0 < least));
            }
            covered += u32::from(least < 0.0);
            if let Some(hit) = hit {
                let surface = shape.surface(&ray, hit);
                assert!(excess(surface.point).abs() < 1e-9, "{objects}");
                let h = 1e-6;
                let slope = DVec3::AXES.map(|axis| {
                    excess(surface.point + h * axis) - excess(surface.point - h * axis)
                });
                let normal = DVec3::from_array(slope).normalize();
                // At an edge there are two normals.
                let off = (normal - surface.normal).length();
                let is_edge = excess(surface.point + 1e-3 * surface.normal) < 1e-5
                    || excess(surface.point - 1e-3 * surface.normal) > -1e-5;
                assert!(
                    off < 1e-4 || is_edge,
                    "{objects}: {normal} {}",
                    surface.normal
                );
            }
        }
        assert_eq!(wrong, 0, "{objects}");
        assert!(50 < covered, "{objects}: {covered} covered");
    }
}
