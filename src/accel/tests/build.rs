//! Tests of built trees.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::super::RUN;
use super::super::build::LEVELS;
use super::super::node::{Bounds, Child, WIDTH};
use super::super::split::{CancelCheck, Extent, Halves, Reference, by_area, by_count};
use super::*;
use geometry::lanes::{Level, dispatch};
use geometry::{IsCancelled, Ray};

/// Checks a subtree: children's boxes lie in `outer` and contain their own boxes. Returns the
/// number of levels.
fn check_node(bvh: &Bvh, boxes: &[Aabb], number: u32, outer: &Bounds, counts: &mut [u32]) -> usize {
    let node = &bvh.nodes[number as usize];
    let mut levels = 0;
    for lane in 0..WIDTH {
        let (child, bounds) = (node.child(lane), node.bounds(lane));
        if let Child::Leaf { count: 0, .. } = child {
            continue;
        }
        assert_eq!(outer.union(&bounds), *outer, "a child leaves its parent");
        match child {
            Child::Inner(child) => {
                levels = levels.max(check_node(bvh, boxes, child, &bounds, counts));
            }
            Child::Leaf { first, count } => {
                for &index in &bvh.order[first as usize..][..usize::from(count)] {
                    counts[index as usize] += 1;
                    let own = boxes[index as usize];
                    for axis in 0..3 {
                        let low = f64::from(bounds.low[axis]);
                        let high = f64::from(bounds.high[axis]);
                        assert!(low < own.min[axis] - bvh.reference[axis]);
                        assert!(own.max[axis] - bvh.reference[axis] < high);
                    }
                }
            }
        }
    }
    levels + 1
}

/// Checks the whole tree and returns its number of levels.
fn check_tree(bvh: &Bvh, boxes: &[Aabb]) -> usize {
    let mut counts = vec![0; boxes.len()];
    let everything = Bounds {
        low: [f32::NEG_INFINITY; 4],
        high: [f32::INFINITY; 4],
    };
    let levels = check_node(bvh, boxes, 0, &everything, &mut counts);
    assert!(counts.iter().all(|&count| count == 1), "each box once");
    assert!(levels <= LEVELS);
    levels
}

#[test]
fn trees_are_sound() {
    let mut random = Random(3);
    for count in [1, 2, 4, 5, 8, 9, 64, 65, 1000, 20_000] {
        let boxes = random_boxes(&mut random, count, 1.0, DVec3::ZERO);
        let bvh = build(&boxes);
        assert!(check_tree(&bvh, &boxes) <= 10, "{count} boxes");
        let bytes = memory(&bvh);
        let most = (256 + 70 * count).min(512 + 24 * count);
        assert!(bytes <= most, "{count} boxes: {bytes} bytes");
    }
}

/// Boxes of geometrically decreasing size: the heuristic splits off a few at a time.
#[test]
fn a_tree_of_nested_boxes_stays_within_its_depth() {
    let boxes: Vec<_> = (0..30_000)
        .map(|i| cube(DVec3::ZERO, DVec3::splat(10f64.powi(-(i % 30)))))
        .chain((0..3000).map(|i| {
            let size = 0.97f64.powi(i);
            cube(DVec3::splat(size), DVec3::splat(0.1 * size))
        }))
        .collect();
    let bvh = build(&boxes);
    check_tree(&bvh, &boxes);
}

#[test]
fn division_by_count_halves_along_the_widest_axis() {
    let mut random = Random(7);
    let stretch = DVec3::new(1.0, 2.0, 9.0);
    let mut references: Vec<_> = (0..1001)
        .map(|index| {
            let cube = cube(stretch * random.point(), DVec3::ONE);
            Reference::new(Bounds::around(cube, DVec3::ZERO), index)
        })
        .collect();
    let extent = Extent::of(&references, &CancelCheck(&|| false)).expect("never cancelled");
    assert_eq!(by_count(&mut references, &extent), 500);
    let heights = references
        .iter()
        .map(|reference| reference.bounds.centre()[2]);
    let (low, high): (Vec<_>, Vec<_>) = (
        heights.clone().take(500).collect(),
        heights.skip(500).collect(),
    );
    assert!(low.iter().all(|a| high.iter().all(|b| a <= b)));
}

#[test]
fn parts_have_the_extents_of_their_boxes() {
    let mut random = Random(8);
    let cancel = CancelCheck(&|| false);
    for count in [2, 3, 15, 16, 63, 64, 1000, 100_000] {
        let mut references: Vec<_> = (0..count)
            .map(|index| {
                let cube = cube(random.point(), DVec3::splat(0.1));
                Reference::new(Bounds::around(cube, DVec3::ZERO), index)
            })
            .collect();
        let mut spare = references.clone();
        let extent = Extent::of(&references, &cancel).expect("never cancelled");
        let halves = by_area(&mut references, &mut spare, &extent, &cancel);
        let halves = halves.expect("never cancelled");
        let again = Halves::of(&references, halves.first, &cancel).expect("never cancelled");
        for (extent, again) in halves.extents.iter().zip(&again.extents) {
            let corners = |extent: &Extent| {
                let Extent { bounds, centres } = extent;
                let all = [bounds.low, bounds.high, centres.low, centres.high];
                all.map(|[x, y, z, _]| [x, y, z])
            };
            assert_eq!(corners(extent), corners(again), "{count}");
        }
        let mut indices: Vec<_> = references.iter().map(Reference::index).collect();
        indices.sort_unstable();
        assert!(indices.into_iter().eq(0..count), "{count}");
    }
}

#[test]
fn coincident_boxes_make_a_shallow_tree() {
    let boxes = vec![cube(DVec3::ONE, DVec3::ONE); 1_000_000];
    let bvh = build(&boxes);
    // Eight to the seventh is two million.
    assert!(check_tree(&bvh, &boxes) <= 7);
}

#[test]
fn thread_count_does_not_change_the_tree() {
    let boxes = random_boxes(&mut Random(4), 150_000, 1.0, DVec3::ZERO);
    let [one, two] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads start").install(|| build(&boxes))
    });
    check_tree(&one, &boxes);
    assert_eq!(one.nodes, two.nodes);
    assert_eq!(one.order, two.order);
}

#[test]
fn a_tree_follows_boxes_that_move() {
    let mut random = Random(8);
    let mut boxes = random_boxes(&mut random, 20_000, 1.0, DVec3::ZERO);
    let mut bvh = build(&boxes);
    for turn in 0..19 {
        let moved = random.bits() as u32 % 20_000;
        boxes[moved as usize] = cube(3.0 * random.point(), random.point().abs());
        let refitted = bvh.refitted(&[moved], |index| boxes[index as usize], &|| false);
        bvh = refitted.unwrap_or_else(|| panic!("box {turn} is not refitted"));
        check_tree(&bvh, &boxes);
    }
    assert!(
        bvh.refitted(&[1], |index| boxes[index as usize], &|| false)
            .is_none()
    );
    let bvh = build(&boxes);
    assert!(bvh.refitted(&[1], |_| Aabb::EMPTY, &|| false).is_none());
    let endless = cube(DVec3::ZERO, DVec3::INFINITY);
    assert!(bvh.refitted(&[1], |_| endless, &|| false).is_none());
    assert!(
        bvh.refitted(&[0; 17], |index| boxes[index as usize], &|| false)
            .is_none()
    );
}

#[test]
fn a_tree_follows_boxes_that_come_and_go() {
    let mut random = Random(11);
    let mut boxes = random_boxes(&mut random, 20_000, 1.0, DVec3::ZERO);
    let mut bvh = build(&boxes);
    let mut followed = 0;
    for (removed, inserted) in [
        (1, 0),
        (0, 1),
        (3, 0),
        (0, 3),
        (2, 2),
        (1, 1),
        (1, 0),
        (0, 1),
    ] {
        let start = random.bits() as usize % 19_000;
        let new = random_boxes(&mut random, inserted, 1.0, DVec3::ZERO);
        boxes.splice(start..start + removed, new);
        let places = start as u32..(start + removed) as u32;
        let spliced = bvh.spliced(
            places,
            inserted as u32,
            |index| boxes[index as usize],
            &|| false,
        );
        followed += u32::from(spliced.is_some());
        // Near a full leaf, a new tree is needed.
        bvh = spliced.unwrap_or_else(|| build(&boxes));
        check_tree(&bvh, &boxes);
        let runs = bvh.runs(&|| false).expect("never cancelled");
        assert!(runs.is_sorted_by_key(|run| run.start));
        assert!(runs.iter().all(|run| (1..=RUN).contains(&run.len())));
    }
    assert!(6 < followed, "{followed}");
}

#[test]
fn a_tree_is_built_anew_where_boxes_have_no_room() {
    let mut random = Random(12);
    let mut boxes = random_boxes(&mut random, 20_000, 1.0, DVec3::ZERO);
    let mut bvh = build(&boxes);
    let at = boxes[7];
    let mut room = 0;
    loop {
        boxes.insert(8, at);
        let Some(spliced) = bvh.spliced(8..8, 1, |index| boxes[index as usize], &|| false) else {
            break;
        };
        check_tree(&spliced, &boxes);
        bvh = spliced;
        room += 1;
    }
    assert!(room < RUN, "{room}");
    let bvh = build(&boxes);
    let spliced = |places: std::ops::Range<u32>, inserted, aabb: Aabb| {
        bvh.spliced(places, inserted, |_| aabb, &|| false).is_some()
    };
    assert!(spliced(0..16, 0, at));
    assert!(!spliced(0..17, 0, at));
    assert!(!spliced(0..0, 1, Aabb::EMPTY));
    assert!(!spliced(0..0, 1, cube(DVec3::ZERO, DVec3::INFINITY)));
    assert!(
        build(&boxes[..1000])
            .spliced(0..1, 0, |_| at, &|| false)
            .is_none(),
        "too few"
    );
}

#[test]
fn changes_of_a_tree_can_be_cancelled() {
    let boxes = random_boxes(&mut Random(14), 100_000, 1.0, DVec3::ZERO);
    let bvh = build(&boxes);
    let aabb = |index: u32| boxes[index as usize];
    check_cancelling(|cancelled| bvh.refitted(&[7], aabb, cancelled).is_some());
    check_cancelling(|cancelled| bvh.spliced(7..8, 1, aabb, cancelled).is_some());
    check_cancelling(|cancelled| bvh.runs(cancelled).is_some());
}

/// Whenever work is cancelled, it returns nothing and does not poll again.
fn check_cancelling(is_done: impl Fn(IsCancelled<'_>) -> bool) {
    let polls = AtomicUsize::new(0);
    let cancelled_at = |last: usize| {
        polls.store(0, Ordering::Relaxed);
        is_done(&|| polls.fetch_add(1, Ordering::Relaxed) + 1 == last)
    };
    assert!(cancelled_at(usize::MAX));
    let all = polls.load(Ordering::Relaxed);
    assert!(1 < all, "{all}");
    for last in 1..=all {
        assert!(!cancelled_at(last), "{last} of {all}");
        assert_eq!(polls.load(Ordering::Relaxed), last);
    }
}

/// All boxes of some leaves are removed.
#[test]
fn leaves_may_become_empty() {
    let mut boxes = random_boxes(&mut Random(13), 20_000, 1.0, DVec3::ZERO);
    // Sixteen that share two leaves of their own.
    for (at, aabb) in boxes[..16].iter_mut().enumerate() {
        *aabb = cube(DVec3::splat(50.0 + (at / 8) as f64), DVec3::splat(0.1));
    }
    let bvh = build(&boxes);
    boxes.drain(..16);
    let spliced = bvh.spliced(0..16, 0, |index| boxes[index as usize], &|| false);
    let spliced = spliced.expect("few boxes are removed");
    check_tree(&spliced, &boxes);
    assert!(spliced.farthest < 10.0, "{}", spliced.farthest);
    let runs = spliced.runs(&|| false).expect("never cancelled");
    let lengths = runs.iter().map(ExactSizeIterator::len).sum::<usize>();
    assert_eq!(lengths, boxes.len());
}

#[test]
fn a_build_checks_often_and_stops_when_cancelled() {
    let boxes = random_boxes(&mut Random(6), 100_000, 1.0, DVec3::ZERO);
    let calls = AtomicUsize::new(0);
    assert!(Bvh::build(&boxes, &|| true).is_none());
    let whole = Bvh::build(&boxes, &|| {
        calls.fetch_add(1, Ordering::Relaxed);
        false
    });
    assert!(whole.is_some());
    // Each chunk of 8192 boxes is checked several times.
    let calls = calls.into_inner();
    assert!(5 * 12 < calls, "{calls} calls");
    for checks in [1, 10, calls / 2, calls - 1] {
        let left = AtomicUsize::new(checks);
        let cancelled = || {
            left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |n| n.checked_sub(1))
                .is_err()
        };
        assert!(
            Bvh::build(&boxes, &cancelled).is_none(),
            "after {checks} checks"
        );
    }
}

#[test]
fn runs_are_the_leaves_in_order() {
    let mut random = Random(9);
    let infinite = Aabb {
        min: DVec3::NEG_INFINITY,
        max: DVec3::INFINITY,
    };
    for count in [0, 1, 7, 9, 100, 3000] {
        let mut boxes = random_boxes(&mut random, count, 1.0, DVec3::ZERO);
        boxes.extend([infinite; 3]);
        let bvh = build(&boxes);
        let runs = bvh.runs(&|| false).expect("never cancelled");
        let joined: Vec<usize> = runs.iter().cloned().flatten().collect();
        let all: Vec<usize> = (0..bvh.order().len()).collect();
        assert_eq!(joined, all);
        assert!(runs.iter().all(|run| (1..=RUN).contains(&run.len())));
        // Rays visit no other ranges.
        let ray = Ray {
            origin: DVec3::new(-9.0, 0.0, 0.0),
            direction: DVec3::X,
        };
        dispatch!(Level::new(), simd => bvh.traverse(simd, &ray, f64::INFINITY, |run| {
            assert!(runs.contains(&run), "{run:?}");
            f64::INFINITY
        }));
    }
}
