//! Tests of the boxes that overlap another.

use std::ops::ControlFlow;

use super::*;

/// Each once, and no box left out.
#[test]
fn all_boxes_that_overlap_another_are_found() {
    let mut random = Random(7);
    for (count, scale, around) in [
        (0, 1.0, DVec3::ZERO),
        (1, 1.0, DVec3::ZERO),
        (400, 1.0, DVec3::ZERO),
        (400, 1e-3, DVec3::splat(1e4)),
    ] {
        let mut boxes = random_boxes(&mut random, count, scale, around);
        let everything = cube(DVec3::ZERO, DVec3::INFINITY);
        boxes.extend([everything, Aabb::EMPTY]);
        let bvh = build(&boxes);
        for _ in 0..200 {
            let half = DVec3::splat(scale * 0.2 * random.signed().abs());
            let asked = cube(around + 1.5 * scale * random.point(), half);
            let mut found = Vec::new();
            let end = bvh.overlapping(asked, |run| {
                found.extend_from_slice(&bvh.order()[run]);
                ControlFlow::<()>::Continue(())
            });
            assert!(end.is_continue());
            found.sort_unstable();
            assert!(found.is_sorted_by(|a, b| a < b), "{found:?}");
            for (number, other) in (0..).zip(&boxes) {
                let overlaps = !asked.intersection(*other).is_empty();
                assert!(!overlaps || found.contains(&number), "{number} of {count}");
            }
        }
    }
}
