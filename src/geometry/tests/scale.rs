//! No absolute lengths: a scene scaled by a power of two gives the same bits.

use super::random::Random;
use super::{Frame, KINDS, Ray, only_span, ray};
use crate::{Crossings, Hit, Surface, ulp};

#[test]
fn powers_of_two_scale_exactly() {
    let mut random = Random(7);
    for index in 0..5_000 {
        let kind = KINDS[index % KINDS.len()];
        let frame = random.frame();
        let shape = frame.shape(kind);
        let target = frame.world(1.2 * random.inside(kind));
        let incoming = ray(random.magnitude(0.0, 4.0) * random.direction(), target);
        let crossings = only_span(&shape, &incoming);
        let direction = random.direction();
        for exponent in [1, -1, 7, -7, 20, -20, 40, -40] {
            let size = 2_f64.powi(exponent);
            let scaled_shape = Frame {
                origin: size * frame.origin,
                lengths: size * frame.lengths,
                ..frame
            }
            .shape(kind);
            let scaled_ray = Ray {
                origin: size * incoming.origin,
                ..incoming
            };
            let scaled_crossings = only_span(&scaled_shape, &scaled_ray);
            assert_eq!(scaled_crossings, crossings.map(|c| scaled(c, size)));
            if let (Some(ours), Some(theirs)) = (crossings, scaled_crossings) {
                let surface = shape.surface(&incoming, ours.enter);
                let scaled_surface = scaled_shape.surface(&scaled_ray, theirs.enter);
                assert_eq!(
                    scaled_surface,
                    Surface {
                        point: size * surface.point,
                        scale: size * surface.scale,
                        ..surface
                    }
                );
                let start = size * surface.leave(direction);
                assert_eq!(scaled_surface.leave(direction), start);
            }
            assert_eq!(scaled_shape.bounds().min, size * shape.bounds().min);
            assert_eq!(scaled_shape.bounds().max, size * shape.bounds().max);
        }
    }
}

fn scaled(crossings: Crossings, size: f64) -> Crossings {
    let scaled = |hit: Hit| Hit {
        t: size * hit.t,
        ..hit
    };
    Crossings {
        enter: scaled(crossings.enter),
        exit: scaled(crossings.exit),
    }
}

#[test]
fn ulps_match_hand_computed_values() {
    for (x, expected) in [
        (1.0, f64::EPSILON),
        (-1.0, f64::EPSILON),
        (1.999, f64::EPSILON),
        (2.0, 2.0 * f64::EPSILON),
        (0.0, 5e-324),
        (1e9, 2_f64.powi(-23)),
    ] {
        assert!(ulp(x).to_bits() == expected.to_bits(), "{x}");
    }
}
