//! Squares against hand-computed values, and rays that leave them.

use glam::{DVec2, DVec3};

use super::leaving::frame;
use super::random::Random;
use super::{Ray, Spans, ray};
use crate::{Affine, Ellipsoid, Plane, Shape, Solid};

fn plane(columns: [DVec3; 3], translation: DVec3) -> Shape {
    let frame = Affine::of_matrix(columns, translation).expect("the columns span a volume");
    Shape::Plane(Box::new(Plane(frame)))
}

#[test]
fn a_square_is_hit_from_both_sides_up_to_its_edges() {
    // Twice as wide, rotated to face +y, and moved up by 1.
    let shape = plane(
        [2.0 * DVec3::X, DVec3::NEG_Z, DVec3::Y],
        DVec3::new(0.0, 1.0, 0.0),
    );
    for (x, z, uv) in [
        (0.0, 0.0, Some([0.5, 0.5])),
        (2.0, 1.0, Some([1.0, 0.0])),
        (-2.0, -1.0, Some([0.0, 1.0])),
        (1.0, 0.5, Some([0.75, 0.25])),
        (2.0_f64.next_up(), 0.0, None),
        (0.0, 1.0_f64.next_up(), None),
        (-1.0, -1.0_f64.next_up(), None),
    ] {
        for from in [4.0, -2.0] {
            let origin = DVec3::new(x, from, z);
            let direction = if from < 1.0 { DVec3::Y } else { DVec3::NEG_Y };
            let incoming = Ray { origin, direction };
            let hit = shape.hit(&incoming, f64::INFINITY);
            assert_eq!(hit.map(|hit| hit.t), uv.map(|_| 3.0), "{x} {z} from {from}");
            assert_eq!(shape.hit(&incoming, 3.0), None);
            if let (Some(hit), Some(uv)) = (hit, uv) {
                let surface = shape.surface(&incoming, hit);
                assert_eq!(surface.normal, DVec3::Y);
                assert_eq!(surface.point, DVec3::new(x, 1.0, z));
                let chart = shape.chart(&incoming, hit);
                assert!(chart.uv.distance(DVec2::from(uv)) < 1e-15, "{x} {z}");
            }
        }
    }
    let bounds = shape.bounds();
    assert_eq!(bounds.min, DVec3::new(-2.0, 1.0, -1.0));
    assert_eq!(bounds.max, DVec3::new(2.0, 1.0, 1.0));
}

#[test]
fn a_square_is_missed_in_its_plane_and_has_no_inside() {
    let shape = plane(DVec3::AXES, DVec3::ZERO);
    let along = Ray {
        origin: DVec3::new(-5.0, 0.0, 0.0),
        direction: DVec3::X,
    };
    assert_eq!(shape.hit(&along, f64::INFINITY), None);
    let mut spans = Spans::new();
    shape.spans(&ray(DVec3::Z, DVec3::ZERO), &mut spans);
    assert!(spans.is_empty());
}

#[test]
fn rays_that_leave_a_square_do_not_return() {
    let mut random = Random(71);
    let mut surfaces = 0;
    for index in 0..1200 {
        let frame = frame(&mut random, index);
        let shape = Shape::Plane(Box::new(Plane(frame.affine().expect("a volume"))));
        let target = frame.world(0.99 * random.in_cube().with_z(0.0));
        let origin = if index % 2 == 0 {
            frame.world(10.0 * random.direction())
        } else {
            random.magnitude(-8.0, 8.0) * random.direction()
        };
        let incoming = ray(origin, target);
        let Some(hit) = shape.hit(&incoming, f64::INFINITY) else {
            continue;
        };
        surfaces += 1;
        let surface = shape.surface(&incoming, hit);
        for _ in 0..1000 {
            let direction = random.direction();
            let origin = surface.leave(direction);
            let again = shape.hit(&Ray { origin, direction }, f64::INFINITY);
            assert_eq!(again, None, "{index}");
        }
    }
    assert!(1000 < surfaces, "{surfaces} surfaces");
}

/// The unit sphere scaled by (2, 1, 1), sheared x += y and mirrored: (x, y, z) → (2x + y, y, −z).
#[test]
fn an_ellipsoid_may_be_sheared_and_mirrored() {
    let columns = [2.0 * DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::NEG_Z];
    let frame = Affine::of_matrix(columns, DVec3::ZERO).expect("a volume");
    let shape = Shape::Solid(Solid::Ellipsoid(Box::new(Ellipsoid(frame))));
    let incoming = Ray {
        origin: DVec3::new(9.0, 0.0, 0.0),
        direction: DVec3::NEG_X,
    };
    let hit = shape
        .hit(&incoming, f64::INFINITY)
        .expect("it is in the way");
    assert!((hit.t - 7.0).abs() < 1e-12);
    // The gradient of ((x − y) / 2)² + y² + z² at (2, 0, 0) is (1, −1, 0).
    let normal = shape.surface(&incoming, hit).normal;
    assert!(normal.distance(DVec3::new(1.0, -1.0, 0.0).normalize()) < 1e-12);
    assert!(shape.chart(&incoming, hit).uv.distance(DVec2::splat(0.5)) < 1e-12);
    // Mirrored in z, its north pole is below.
    let below = Ray {
        origin: DVec3::new(0.0, 0.0, -3.0),
        direction: DVec3::Z,
    };
    let hit = shape.hit(&below, f64::INFINITY).expect("it is in the way");
    assert!((shape.chart(&below, hit).uv.y - 1.0).abs() < 1e-7);
    assert!(shape.surface(&below, hit).normal.distance(DVec3::NEG_Z) < 1e-12);
}

#[test]
fn a_matrix_must_span_a_volume() {
    let [x, y, z] = DVec3::AXES;
    let makes = |columns| Affine::of_matrix(columns, DVec3::ZERO).is_some();
    assert!(makes([1e-9 * x, y, 1e9 * z]));
    assert!(makes([x, x + 1e-11 * y, z]));
    assert!(!makes([x, x + 1e-13 * y, z]));
    assert!(!makes([x, y, DVec3::ZERO]));
    assert!(!makes([x, y, f64::INFINITY * z]));
    assert!(!makes([x, y, DVec3::NAN]));
    assert_eq!(Affine::of_matrix([x, y, z], DVec3::NAN), None);
}
