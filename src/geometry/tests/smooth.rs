//! Tests of how far around a point surfaces are smooth.

use super::random::Random;
use super::*;
use crate::Plane;

/// From within and without, whatever is up to 0.1 of the way above the tangent plane is free, and below
/// it is the surface, as near as promised.
#[test]
fn surfaces_are_discs_within_the_radius_promised() {
    let mut random = Random(3);
    let mut known = [0; 3];
    for round in 0..600 {
        let frame = Frame {
            origin: random.in_cube(),
            directions: random.skewed(0.1),
            lengths: DVec3::new(1.0, 2.0, 0.5),
        };
        let which = round % 3;
        let shape = match which {
            0 => frame.of(Kind::Sphere).shape(Kind::Sphere),
            1 => frame.shape(Kind::Cuboid),
            _ => Shape::Plane(Box::new(Plane(frame.affine().expect("a volume")))),
        };
        let ray = ray(
            frame.world(2.0 * random.in_cube()),
            frame.world(random.in_cube()),
        );
        let Some(hit) = shape.hit(&ray, f64::INFINITY) else {
            continue;
        };
        let surface = shape.surface(&ray, hit);
        let within = shape.smooth_within(hit, surface.point);
        let up = -ray.direction.dot(surface.normal).signum() * surface.normal;
        let right = unit(up.cross(random.direction()));
        for part in [0.1, 0.5, 0.97] {
            let flat = part * within;
            let way = flat * right + 0.1 * flat * up;
            let leaving = Ray {
                origin: surface.leave(way),
                direction: unit(way),
            };
            assert_eq!(
                shape.hit(&leaving, way.length()),
                None,
                "{shape:?} along {ray:?}"
            );
            let down = Ray {
                origin: surface.point + way,
                direction: -up,
            };
            let below = shape.hit(&down, flat).expect("the surface");
            let height = 0.1 - below.t / flat;
            assert!(
                height.abs() <= 0.075 + 1e-9,
                "{height} of {shape:?} along {ray:?}"
            );
        }
        known[which] += usize::from(0.0 < within);
    }
    assert!(known.iter().all(|&count| 50 < count), "{known:?}");
}
