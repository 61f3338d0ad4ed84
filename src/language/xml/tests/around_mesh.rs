//! New scenes around meshes.

use glam::DVec3;

use super::meshes::meshes;
use super::{read_with, shown};
use crate::xml::{ShownMesh, Up, around_mesh};
use geometry::{Aabb, Shape};
use scene::{Camera, Size};

/// How far the corners of a box reach from the middle of the picture: 1 at its edges.
fn reach(camera: &Camera, bounds: &Aabb) -> f64 {
    let back = (camera.eye - camera.target).normalize();
    let right = camera.up.cross(back).normalize();
    let above = back.cross(right);
    let Size { width, height } = camera.size;
    let slope = libm::tan(0.5 * 34_f64.to_radians());
    let corners = (0..8).map(|corner| {
        let pick = |axis: usize| [bounds.min[axis], bounds.max[axis]][corner >> axis & 1];
        let at = DVec3::new(pick(0), pick(1), pick(2)) - camera.eye;
        let depth = -at.dot(back);
        assert!(0.0 < depth, "{corner}");
        let aspect = f64::from(width) / f64::from(height);
        let [x, y] = [at.dot(right) / aspect, at.dot(above)];
        x.abs().max(y.abs()) / (slope * depth)
    });
    corners.fold(0.0, f64::max)
}

/// Boxes of every size, far from the origin, and flat ones.
#[test]
fn the_mesh_stands_on_a_ground_and_fills_most_of_the_picture() {
    for (size, centre) in [
        ([2.0, 2.0, 2.0], [0.0; 3]),
        ([0.155, 0.154, 0.12], [-0.017, 0.11, -0.001]),
        ([1e-7, 3e-7, 2e-7], [0.0; 3]),
        ([3e9, 2e9, 4e9], [1e9, -2e9, 5e9]),
        ([10.0, 0.0, 10.0], [100.0, 200.0, 300.0]),
        ([0.1, 9.0, 0.1], [0.0; 3]),
    ] {
        let (half, centre) = (0.5 * DVec3::from_array(size), DVec3::from_array(centre));
        let bounds = Aabb {
            min: centre - half,
            max: centre + half,
        };
        for (up, axis) in [(Up::Y, 1), (Up::Z, 2)] {
            let text = around_mesh(&ShownMesh {
                name: "a.obj",
                bounds: Some(bounds),
                has_materials: false,
                up,
            });
            let corner = |at: DVec3| format!("v {:e} {:e} {:e}\n", at.x, at.y, at.z);
            let corners = [bounds.min, bounds.max, bounds.min.with_x(bounds.max.x)].map(corner);
            let mesh = format!("{}f 1 2 3\n", corners.concat());
            let (_, lowered) = read_with(&text, &meshes("a.obj", &mesh, ""));
            assert_eq!(shown(&text, &lowered), [""; 0], "{text}");
            let scene = lowered.scene.expect("there are no errors");
            assert_eq!((scene.objects.len(), scene.lights.len()), (2, 3));
            let reach = reach(&scene.camera, &bounds);
            assert!((0.85..1.0).contains(&reach), "{reach} {text}");
            let ground = scene.objects[1].shape.bounds();
            let gap = bounds.min[axis] - ground.max[axis];
            assert!(matches!(scene.objects[0].shape, Shape::Mesh(_)));
            assert!(
                (0.0..=0.01 * bounds.half_diagonal()).contains(&gap),
                "{gap} {text}"
            );
            assert_eq!(scene.camera.up, DVec3::AXES[axis]);
        }
    }
}

/// Meshes that cannot be read, of no size, or too large, and names that are not plain.
#[test]
fn a_scene_around_anything_has_no_errors() {
    let point = Aabb {
        min: DVec3::ONE,
        max: DVec3::ONE,
    };
    let huge = Aabb {
        min: DVec3::splat(-1e300),
        max: DVec3::splat(1e300),
    };
    for bounds in [None, Some(point), Some(huge)] {
        for name in ["a.obj", "a \"b\" <c> & 'd'\t\n\u{1}\u{202E}.ply", ""] {
            for has_materials in [false, true] {
                let text = around_mesh(&ShownMesh {
                    name,
                    bounds,
                    has_materials,
                    up: Up::Z,
                });
                let (source, lowered) = read_with(&text, &scene::Meshes::default());
                assert_eq!(lowered.diagnostics.errors() != 0, name.is_empty(), "{text}");
                assert_eq!(text.contains("clay"), !has_materials);
                if let "a.obj" = name {
                    assert_eq!(source.files()[0].path, name);
                }
            }
        }
    }
}
