//! Rays that leave a surface do not hit it again, modelled on the test in
//! M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition, section 6.8.6.

use glam::DVec3;

use super::exact::Exact;
use super::random::{Random, extremes};
use super::{Frame, KINDS, Kind, Ray, only_span, ray};
use crate::{Shape, Surface};

const SURFACES: u64 = 1000;
const DIRECTIONS: u64 = 1000;

/// A frame of any size, position and skew that `f64` can resolve: a flat one loses digits in
/// proportion to its small determinant, and stays near the origin.
pub(super) fn frame(random: &mut Random, index: u64) -> Frame {
    let size = random.magnitude(-4.0, 4.0);
    let aspect = random.magnitude(-1.0, 0.0);
    let farthest = size * random.magnitude(0.0, 1.0);
    let (directions, farthest) = match index % 4 {
        0 => (DVec3::AXES, random.magnitude(-8.0, 8.0)),
        1 => (random.rotation(), random.magnitude(-8.0, 8.0)),
        2 => (random.skewed(0.1), random.magnitude(-8.0, 8.0)),
        _ => {
            let volume = random.magnitude(-5.0, 0.0);
            (random.skewed(volume), farthest)
        }
    };
    Frame {
        origin: farthest * random.in_cube(),
        directions,
        lengths: size * DVec3::new(1.0, aspect, random.between(0.3, 1.0)),
    }
}

/// A surface of a random solid, hit by a ray from outside, near or far, or from inside. Every fifth
/// ray aims at an edge, and may pass it on either side.
fn surface(random: &mut Random, kind: Kind, index: u64) -> Option<(Shape, Surface)> {
    let frame = frame(random, index).of(kind);
    let shape = frame.shape(kind);
    let target = frame.world(if index.is_multiple_of(5) {
        let edges = extremes(kind);
        edges[(random.bits() % edges.len() as u64) as usize]
    } else {
        random.inside(kind)
    });
    let origin = match index % 3 {
        0 => frame.world(random.inside(kind)),
        1 => frame.world(10.0 * random.direction()),
        _ => random.magnitude(-8.0, 8.0) * random.direction(),
    };
    let incoming = ray(origin, target);
    let hit = shape.hit(&incoming, f64::INFINITY)?;
    let surface = shape.surface(&incoming, hit);
    Some((shape, surface))
}

#[test]
fn leaving_rays_do_not_return() {
    for kind in KINDS {
        let mut random = Random(kind as u64);
        let mut surfaces = 0;
        let mut returned = Vec::new();
        for index in 0..2 * SURFACES {
            let Some((shape, surface)) = surface(&mut random, kind, index) else {
                continue;
            };
            surfaces += 1;
            for _ in 0..DIRECTIONS {
                let direction = random.direction();
                let leaving = Ray {
                    origin: surface.leave(direction),
                    direction,
                };
                let crossings = only_span(&shape, &leaving);
                let outward = 0.0 <= direction.dot(surface.normal);
                let hit_again = crossings.is_some_and(|crossings| {
                    0.0 < crossings.enter.t || (outward && 0.0 < crossings.exit.t)
                });
                if hit_again {
                    returned.push((index, crossings, outward));
                }
            }
            if surfaces == SURFACES {
                break;
            }
        }
        assert_eq!(surfaces, SURFACES, "{kind:?}");
        assert!(
            returned.is_empty(),
            "{kind:?}: {} returned, first {:?}",
            returned.len(),
            returned[0]
        );
    }
}

/// The shadow of a ball of radius 1e-3 on a floor of 2e6: a ray that starts too far off the floor
/// would pass under the ball or beside the tip of its shadow.
#[test]
fn a_tiny_ball_casts_an_exact_shadow_on_a_vast_floor() {
    let floor = Frame::upright(DVec3::splat(-1e6), DVec3::new(2e6, 2e6, 1e6)).shape(Kind::Cuboid);
    let radius = 1e-3;
    let ball_frame = Frame::upright(radius * DVec3::Z, DVec3::splat(radius));
    let ball = ball_frame.shape(Kind::Sphere);
    let exact = Exact::new(Kind::Sphere, &ball_frame);
    let light = DVec3::new(5.0, 3.0, 10.0);
    let mut random = Random(12);
    let mut shadowed = 0;
    for index in 0..100_000 {
        let point = 4.0 * radius * random.in_cube().with_z(0.0);
        let eye = 10_f64.powi(index % 6) * DVec3::new(-1.0, 0.5, 1.0);
        let incoming = ray(eye, point);
        let hit = floor
            .hit(&incoming, f64::INFINITY)
            .expect("the ray hits the floor");
        let surface = floor.surface(&incoming, hit);
        // The ideal ray starts at the same point, exactly on the floor.
        let ideal = ray(surface.point.with_z(0.0), light);
        if exact.clearance(&ideal).abs() < 1e-4 {
            continue;
        }
        let start = surface.leave(light - surface.point);
        let in_shadow = ball.hit(&ray(start, light), f64::INFINITY).is_some();
        assert_eq!(in_shadow, exact.span(&ideal).is_some(), "at {point}");
        shadowed += u32::from(in_shadow);
    }
    assert!((1_000..50_000).contains(&shadowed), "{shadowed} shadowed");
}
