//! Meshes of few triangles against hand-computed values.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::Ray;
use crate::{
    ABSENT, Affine, Attribute, Hit, Instance, Mesh, MeshError, MeshParts, Shape, SlotRun, ulp,
};

/// Two triangles in z = 0 that share the edge from (4, 0) to (0, 4). One vertex of the second lacks
/// a normal, another its texture coordinates.
fn parts() -> MeshParts {
    MeshParts {
        positions: vec![
            DVec3::ZERO,
            DVec3::new(4.0, 0.0, 0.0),
            DVec3::new(0.0, 4.0, 0.0),
            DVec3::new(4.0, 4.0, 0.0),
        ],
        triangles: vec![[0, 1, 2], [1, 3, 2]],
        normals: Attribute {
            values: vec![
                DVec3::Z,
                DVec3::new(0.6, 0.0, 0.8),
                DVec3::new(0.0, 0.6, 0.8),
            ],
            corners: vec![[0, 1, 2], [0, 1, ABSENT]],
        },
        uvs: Attribute {
            values: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
            corners: vec![[0, 1, 2], [1, ABSENT, 2]],
        },
        slots: vec![SlotRun { first: 1, slot: 2 }],
    }
}

fn placed(parts: MeshParts, columns: [DVec3; 3], tags: &[u32]) -> Shape {
    let mesh = Arc::new(Mesh::new(parts).expect("the mesh is valid"));
    let frame = Affine::of_matrix(columns, DVec3::ZERO).expect("a volume");
    Shape::Mesh(Box::new(Instance::new(mesh, &frame, tags.to_vec())))
}

/// A ray straight down onto z = 0.
fn down(x: f64, y: f64) -> Ray {
    Ray {
        origin: DVec3::new(x, y, 2.0),
        direction: DVec3::NEG_Z,
    }
}

fn near(a: DVec3, b: DVec3) -> bool {
    a.distance(b) < 1e-14
}

#[test]
fn normals_and_texture_coordinates_are_interpolated() {
    let shape = placed(parts(), DVec3::AXES, &[]);
    // Barycentric coordinates ½, ¼, ¼.
    let incoming = down(1.0, 1.0);
    let hit = shape.hit(&incoming, f64::INFINITY).expect("it is hit");
    assert_eq!((hit.t, hit.part), (2.0, 0));
    let surface = shape.surface(&incoming, hit);
    assert_eq!(surface.point, DVec3::new(1.0, 1.0, 0.0));
    assert_eq!(surface.normal, DVec3::Z);
    assert!(near(
        surface.shading,
        DVec3::new(0.15, 0.15, 0.9).normalize()
    ));
    let chart = shape.chart(&incoming, hit);
    assert_eq!(chart.uv, DVec2::splat(0.25));
    assert!(near(chart.gradients[0], 0.25 * DVec3::X));
    assert!(near(chart.gradients[1], 0.25 * DVec3::Y));
    // The second triangle, from below: ¼ at (4, 0), ½ at (4, 4), ¼ at (0, 4).
    let incoming = Ray {
        origin: DVec3::new(3.0, 3.0, -5.0),
        direction: DVec3::Z,
    };
    let hit = shape.hit(&incoming, f64::INFINITY).expect("it is hit");
    assert_eq!((hit.t, hit.part), (5.0, 1));
    let surface = shape.surface(&incoming, hit);
    assert_eq!([surface.normal, surface.shading], [DVec3::Z; 2]);
    assert_eq!(shape.chart(&incoming, hit).uv, DVec2::splat(0.25));
}

#[test]
fn normals_are_transformed_by_the_inverse_transpose() {
    let corner = MeshParts {
        positions: DVec3::AXES.to_vec(),
        triangles: vec![[0, 1, 2]],
        normals: Attribute {
            values: vec![DVec3::ONE],
            corners: vec![[0, 0, 0]],
        },
        ..MeshParts::default()
    };
    let [x, y, z] = DVec3::AXES;
    for (columns, normal) in [
        ([x, y, z], [1.0, 1.0, 1.0]),
        ([x, y, 2.0 * z], [2.0, 2.0, 1.0]),
        ([-x, y, z], [-1.0, 1.0, 1.0]),
        ([x, x + y, z], [1.0, 0.0, 1.0]),
    ] {
        let shape = placed(corner.clone(), columns, &[]);
        let [u, v, w] = columns;
        let middle = (u + v + w) / 3.0;
        let normal = DVec3::from(normal).normalize();
        let incoming = Ray {
            origin: middle + 2.0 * normal,
            direction: -normal,
        };
        let hit = shape.hit(&incoming, f64::INFINITY).expect("it is hit");
        let surface = shape.surface(&incoming, hit);
        assert!((hit.t - 2.0).abs() < 1e-14);
        assert!(near(surface.normal, normal) && near(surface.shading, normal));
        assert!(near(surface.point, middle));
        assert!(surface.scale < 10.0 && ulp(surface.scale) < 1e-14);
    }
}

#[test]
fn runs_of_triangles_select_the_material() {
    let tags = |tags: &[u32]| {
        let shape = placed(parts(), DVec3::AXES, tags);
        [down(1.0, 1.0), down(3.0, 3.0)].map(|ray| {
            let hit = shape.hit(&ray, f64::INFINITY).expect("it is hit");
            shape.tag(hit)
        })
    };
    assert_eq!(tags(&[]), [None, None]);
    assert_eq!(tags(&[7, 8, 9]), [Some(7), Some(9)]);
    assert_eq!(tags(&[7, 8]), [Some(7), None]);
}

#[test]
fn the_first_of_coincident_triangles_is_hit() {
    let mut double = parts();
    double.triangles = vec![[1, 2, 0], [0, 1, 2], [2, 1, 0]];
    double.normals = Attribute::default();
    double.uvs = Attribute::default();
    let shape = placed(double, DVec3::AXES, &[]);
    for ray in [down(0.5, 0.75), down(0.0, 0.0), down(2.0, 2.0)] {
        assert_eq!(shape.hit(&ray, f64::INFINITY).map(|hit| hit.part), Some(0));
    }
}

#[test]
fn a_box_is_tight_and_ignores_unused_positions() {
    let mut parts = parts();
    parts.positions.push(DVec3::splat(1e9));
    let shape = placed(parts, [DVec3::X, 2.0 * DVec3::Y, DVec3::NEG_Z], &[]);
    let bounds = shape.bounds();
    assert_eq!(bounds.min, DVec3::ZERO);
    assert_eq!(bounds.max, DVec3::new(4.0, 8.0, 0.0));
}

/// Triangles without area are handled.
#[test]
fn degenerate_triangles_have_a_normal() {
    let needle = MeshParts {
        positions: vec![DVec3::ZERO, DVec3::X, 0.5 * DVec3::X],
        triangles: vec![[0, 1, 2], [0, 0, 0], [0, 0, 1]],
        ..MeshParts::default()
    };
    let shape = placed(needle, DVec3::AXES, &[]);
    let hit = Hit { t: 2.0, part: 0 };
    for part in 0..3 {
        let surface = shape.surface(&down(0.25, 0.0), Hit { part, ..hit });
        assert!(surface.point.is_finite() && surface.normal.is_normalized());
        let chart = shape.chart(&down(0.25, 0.0), Hit { part, ..hit });
        assert!(chart.gradients[0].is_finite());
    }
    assert_eq!(shape.hit(&down(0.25, 1e-9), f64::INFINITY), None);
}

/// In most files normals and positions have equal indices; a million such triangles need no second
/// list.
#[test]
fn indices_equal_to_those_of_the_positions_are_stored_once() {
    let with = |corners: Vec<[u32; 3]>| {
        let mut parts = parts();
        parts.uvs.values = vec![DVec2::X; 4];
        parts.uvs.corners = corners;
        Mesh::new(parts)
    };
    assert_eq!(with(parts().triangles), with(Vec::new()));
    assert_ne!(with(vec![[0, 0, 0], [1, 3, 2]]), with(Vec::new()));
}

#[test]
fn an_invalid_mesh_is_rejected() {
    let whole = parts;
    let refused = |change: &dyn Fn(&mut MeshParts)| {
        let mut parts = whole();
        change(&mut parts);
        Mesh::new(parts).err()
    };
    assert_eq!(refused(&|_| ()), None);
    assert_eq!(
        refused(&|parts| parts.triangles.clear()),
        Some(MeshError::Empty)
    );
    assert_eq!(
        refused(&|parts| parts.slots.push(SlotRun { first: 0, slot: 1 })),
        Some(MeshError::Order)
    );
    for change in [
        (|parts| parts.triangles[0][1] = 4) as fn(&mut MeshParts),
        |parts| parts.triangles[1][2] = u32::MAX,
        |parts| parts.normals.corners[0][0] = 3,
        |parts| parts.uvs.corners.truncate(1),
        |parts| parts.normals.corners.clear(),
    ] {
        assert_eq!(refused(&change), Some(MeshError::Index));
    }
    for change in [
        (|parts| parts.positions[3].y = f64::NAN) as fn(&mut MeshParts),
        |parts| parts.normals.values[0].x = f64::INFINITY,
        |parts| parts.uvs.values[0].x = f64::NAN,
        |parts| {
            parts.positions[0].x = -f64::MAX;
            parts.positions[1].x = f64::MAX;
        },
    ] {
        assert_eq!(refused(&change), Some(MeshError::Range));
    }
}
