//! The numbers of frames, found again.

use glam::DVec3;

use super::random::Random;
use crate::{Affine, FrameNumbers, direction_of, normalise};

#[test]
fn frames_give_the_numbers_that_they_were_made_of() {
    let s = 0.5_f64.sqrt();
    for (directions, lengths) in [
        (DVec3::AXES, DVec3::new(0.1, 2.0, 1e-9)),
        (
            [
                DVec3::new(0.6, 0.8, 0.0),
                DVec3::new(-0.8, 0.6, 0.0),
                DVec3::Z,
            ],
            DVec3::new(0.3, 1.7, 12.34),
        ),
        (
            [DVec3::new(s, s, 0.0), DVec3::new(-s, s, 0.0), DVec3::NEG_Z],
            DVec3::splat(0.7),
        ),
    ] {
        let numbers = FrameNumbers {
            origin: DVec3::new(1.0, -0.1, 1e6),
            directions,
            lengths,
        };
        let frame = numbers.affine().expect("it has a volume");
        let found = frame.numbers();
        assert_eq!(found.affine(), Some(frame));
        // Roots have more than fifteen digits.
        if !directions[0].to_array().contains(&s) {
            assert_eq!(found, numbers);
        }
    }
}

#[test]
fn most_frames_of_any_directions_are_found_again_to_the_last_bit() {
    let mut random = Random(5);
    let (mut found, mut vectors) = (0, 0);
    for _ in 0..1000 {
        let mut vector = || {
            let mut number = || (random.between(-1.0, 1.0) * 1e6).round() / 1e6;
            DVec3::new(number(), number(), number())
        };
        let directions = [vector(), vector(), vector()];
        let Some(frame) = Affine::new(vector(), directions, vector().abs() + 0.001) else {
            continue;
        };
        found += usize::from(frame.numbers().affine() == Some(frame));
        let unit = normalise(directions[0]).expect("it is no zero");
        vectors += usize::from(normalise(direction_of(unit)) == Some(unit));
    }
    assert!(900 < found, "{found}");
    assert!(990 < vectors, "{vectors}");
}
