//! Tests of the boxes that rays visit.

use super::super::Order;
use super::super::node::{Bounds, Child, Node};
use super::*;
use geometry::lanes::{Eight, Level, SimdBase, dispatch};
use geometry::{Ray, Rays};

/// A ray aimed at a point of a box: the centre, a corner, or the middle of an edge or a face, from
/// inside or outside, often along an axis.
fn ray_at(random: &mut Random, target: Aabb, scale: f64) -> Ray {
    let weight = DVec3::from_array([0; 3].map(|_: i32| random.pick(&[0.0, 0.5, 1.0])));
    let aim = target.min * (DVec3::ONE - weight) + target.max * weight;
    let direction = match random.bits() % 3 {
        0 => random.pick(&DVec3::AXES) * random.pick(&[1.0, -1.0]),
        1 => DVec3::new(random.signed(), random.pick(&[0.0, -0.0]), random.signed()).normalize(),
        _ => random.point().normalize(),
    };
    let back = scale * random.pick(&[0.0, 0.01, 3.0]);
    Ray {
        origin: aim - back * direction,
        direction,
    }
}

/// The interval of a ray inside a box, at distances not below 0. A slab that contains a parallel
/// ray does not bound it.
fn span(aabb: &Aabb, ray: &Ray) -> [f64; 2] {
    let (mut enter, mut exit) = (0.0, f64::INFINITY);
    for axis in 0..3 {
        let [low, high, origin] = [aabb.min, aabb.max, ray.origin].map(|v| v[axis]);
        let slope = ray.direction[axis];
        if slope == 0.0 {
            if origin < low || high < origin {
                return [f64::INFINITY, 0.0];
            }
            continue;
        }
        let (a, b) = ((low - origin) / slope, (high - origin) / slope);
        enter = a.min(b).max(enter);
        exit = a.max(b).min(exit);
    }
    [enter, exit]
}

/// Traverses with the machine's SIMD level; `visit` gets indices of boxes.
fn walk(bvh: &Bvh, ray: &Ray, limit: f64, mut visit: impl FnMut(u32) -> f64) {
    dispatch!(Level::new(), simd => bvh.traverse(simd, ray, limit, |range| {
        let mut limit = limit;
        for &index in &bvh.order()[range] {
            limit = visit(index);
        }
        limit
    }));
}

fn visits_at(level: Level, bvh: &Bvh, ray: &Ray, limit: f64) -> Vec<u32> {
    let mut seen = Vec::new();
    dispatch!(level, simd => bvh.traverse(simd, ray, limit, |range| {
        seen.extend_from_slice(&bvh.order()[range]);
        limit
    }));
    seen.sort_unstable();
    seen
}

fn visits(bvh: &Bvh, ray: &Ray, limit: f64) -> Vec<u32> {
    visits_at(Level::new(), bvh, ray, limit)
}

/// The boxes that each ray of a packet visits, sorted, whichever come first.
fn visits_together(bvh: &Bvh, rays: &[Ray], limit: f64) -> Vec<Vec<u32>> {
    let mut seen =
        [Order::NearFirst, Order::LargeFirst].map(|order| visits_in_order(bvh, rays, limit, order));
    for seen in seen.iter_mut().flatten() {
        seen.sort_unstable();
    }
    let [near_first, large_first] = seen;
    assert_eq!(near_first, large_first);
    near_first
}

/// The boxes that each ray of a packet visits, in order.
fn visits_in_order(bvh: &Bvh, rays: &[Ray], limit: f64, order: Order) -> Vec<Vec<u32>> {
    let mut seen = vec![Vec::new(); rays.len()];
    let all = (1 << rays.len()) - 1;
    dispatch!(Level::new(), simd => {
        let packet = Rays::gather(simd, rays);
        let limits = Eight::splat(simd, limit);
        bvh.traverse_packet(&packet, all, limits, order, |range, lanes, limits| {
            for (lane, seen) in seen.iter_mut().enumerate() {
                if lanes >> lane & 1 == 1 {
                    seen.extend_from_slice(&bvh.order()[range.clone()]);
                }
            }
            limits
        });
    });
    seen
}

#[test]
fn near_or_large_boxes_are_visited_first() {
    let at = |x: f64, half: f64| cube(DVec3::new(x, 0.0, 0.0), DVec3::splat(half));
    let small = (0..8).map(|i| at(f64::from(i), 0.1));
    let large = (0..8).map(|i| at(1000.0 + f64::from(i), 50.0));
    let bvh = build(&small.chain(large).collect::<Vec<_>>());
    let ray = Ray {
        origin: DVec3::new(-1.0, 0.0, 0.0),
        direction: DVec3::X,
    };
    for count in [1, 8] {
        for (order, expected) in [(Order::NearFirst, 0..8), (Order::LargeFirst, 8..16)] {
            let seen = visits_in_order(&bvh, &[ray].repeat(count), f64::INFINITY, order);
            assert!(expected.contains(&seen[0][0]), "{order:?}: {seen:?}");
        }
    }
}

#[test]
fn every_box_that_is_hit_is_visited() {
    let mut random = Random(1);
    for scale in [1e-6, 1.0, 1e6] {
        for around in [DVec3::ZERO, DVec3::new(1e6, -3e5, 7.0) * scale] {
            let boxes = random_boxes(&mut random, 300, scale, around);
            let bvh = build(&boxes);
            for _ in 0..1500 {
                let aim = random.pick(&boxes);
                let ray = ray_at(&mut random, aim, scale);
                let seen = visits(&bvh, &ray, f64::INFINITY);
                for (index, aabb) in (0..).zip(&boxes) {
                    let [enter, exit] = span(aabb, &ray);
                    assert!(
                        exit < enter || seen.binary_search(&index).is_ok(),
                        "{ray:?} misses {aabb:?}"
                    );
                }
            }
        }
    }
}

/// A tree of one box, a single point, not rounded outward.
fn of_point(point: DVec3, spread: f64) -> Bvh {
    let [x, y, z] = point.as_vec3().to_array();
    let planes = [x, y, z, 0.0];
    let bounds = Bounds {
        low: planes,
        high: planes,
    };
    let mut node = Node::EMPTY;
    node.put(0, &bounds, Child::Leaf { first: 0, count: 1 });
    Bvh {
        reference: DVec3::ZERO,
        spread,
        farthest: node.farthest(),
        nodes: vec![node],
        order: vec![0],
        bounded: 1,
        moved: 0,
    }
}

/// Rays with integer coordinates, hence exact, pass through a point of single precision at their
/// limits, which are multiples of a half.
#[test]
fn rounding_hides_no_box_from_a_ray() {
    let mut random = Random(24);
    let integer =
        |random: &mut Random, bits: u32| (random.signed() * 2f64.powi(bits as i32)).trunc();
    for round in 0..20_000 {
        // Down to subnormal numbers of `f32`.
        let scale = random.pick(&[1.0, 2f64.powi(-149)]);
        let point = DVec3::from_array([0; 3].map(|_: i32| integer(&mut random, 24)));
        let limit = 0.5 * integer(&mut random, 24).abs();
        let rays: Vec<_> = (0..=round % 8)
            .map(|_| {
                let bits = random.pick(&[1, 6, 20]);
                let half = DVec3::from_array([0; 3].map(|_: i32| integer(&mut random, bits)));
                let direction = 2.0 * half;
                Ray {
                    origin: scale * (point - limit * direction),
                    direction,
                }
            })
            .collect();
        // With or without advancing rays to the reference point.
        let spread = random.pick(&[0.0, f64::INFINITY]);
        let bvh = of_point(scale * point, spread);
        let limit = scale * limit;
        for (ray, together) in rays.iter().zip(visits_together(&bvh, &rays, limit)) {
            if ray.direction != DVec3::ZERO {
                assert_eq!(visits(&bvh, ray, limit), [0], "{ray:?} to {point}");
                assert_eq!(together, [0], "{ray:?} to {point}");
            }
        }
    }
}

/// Rays from a far sky toward small objects visit hardly more boxes than rays from nearby.
#[test]
fn rays_from_a_far_sky_keep_their_precision() {
    let mut random = Random(25);
    let mut boxes: Vec<_> = (0..2000)
        .map(|_| cube(4.0 * random.point(), DVec3::splat(0.05)))
        .collect();
    boxes.push(cube(DVec3::ZERO, DVec3::splat(1e9)));
    let bvh = build(&boxes);
    for _ in 0..300 {
        let target = random.pick(&boxes[..2000]).centre();
        let direction = random.point().normalize();
        let [near, far] = [10.0, 1e9].map(|back| Ray {
            origin: target - back * direction,
            direction,
        });
        let [near, alone] = [&near, &far].map(|ray| visits(&bvh, ray, f64::INFINITY).len());
        let together = visits_together(&bvh, &[far; 8], f64::INFINITY);
        for count in [alone, together[0].len()] {
            assert!(count <= near + 16, "{count} boxes, not {near}");
        }
    }
}

/// At the limits of single precision: directions almost along an axis, or as long as those in the
/// space of a mesh of any size, from near and far, toward boxes of any size.
#[test]
fn no_size_hides_a_box() {
    let mut random = Random(23);
    let power = |random: &mut Random, most: i32| {
        let exponent = random.bits() as i32 % (most + 1);
        2f64.powi(exponent)
    };
    let (mut hits, mut boxes) = (0, Vec::new());
    for round in 0..4000 {
        if round % 20 == 0 {
            let scale = power(&mut random, 150);
            boxes = random_boxes(&mut random, 20, scale, DVec3::ZERO);
        }
        let bvh = build(&boxes);
        let rays: Vec<_> = (0..=round % 8)
            .map(|_| {
                let mut direction = random.point();
                for axis in 0..3 {
                    if random.bits().is_multiple_of(2) {
                        direction[axis] *= power(&mut random, 140);
                    }
                }
                let back = power(&mut random, 140);
                Ray {
                    origin: random.pick(&boxes).centre() - back * direction,
                    direction,
                }
            })
            .collect();
        let together = visits_together(&bvh, &rays, f64::INFINITY);
        for (ray, together) in rays.iter().zip(together) {
            let alone = visits(&bvh, ray, f64::INFINITY);
            for (index, aabb) in (0..).zip(&boxes) {
                let [enter, exit] = span(aabb, ray);
                if enter <= exit {
                    hits += 1;
                    assert!(alone.contains(&index), "{ray:?} misses {aabb:?}");
                    assert!(together.contains(&index), "{ray:?} misses {aabb:?}");
                }
            }
        }
    }
    assert!(4000 < hits, "rays hit boxes: {hits}");
}

/// The rays of a packet, however different, visit every box that each of them hits.
#[test]
fn every_box_that_is_hit_is_visited_by_a_packet() {
    let mut random = Random(21);
    for scale in [1e-6, 1.0, 1e6] {
        let boxes = random_boxes(&mut random, 300, scale, DVec3::new(1e6, -3e5, 7.0) * scale);
        let bvh = build(&boxes);
        for count in (1..=8).cycle().take(800) {
            let mut aimed = || {
                let aim = random.pick(&boxes);
                ray_at(&mut random, aim, scale)
            };
            let rays: Vec<_> = (0..count).map(|_| aimed()).collect();
            for (ray, seen) in rays.iter().zip(visits_together(&bvh, &rays, f64::INFINITY)) {
                for (index, aabb) in (0..).zip(&boxes) {
                    let [enter, exit] = span(aabb, ray);
                    assert!(
                        exit < enter || seen.contains(&index),
                        "{ray:?} misses {aabb:?}"
                    );
                }
            }
        }
    }
}

/// The baseline SIMD level and this machine's own give the same visits.
#[test]
fn visits_do_not_depend_on_the_simd_level() {
    let mut random = Random(22);
    let boxes = random_boxes(&mut random, 1000, 1.0, DVec3::ZERO);
    let bvh = build(&boxes);
    for _ in 0..2000 {
        let aim = random.pick(&boxes);
        let ray = ray_at(&mut random, aim, 1.0);
        for limit in [0.3, f64::INFINITY] {
            let plain = visits_at(Level::baseline(), &bvh, &ray, limit);
            assert_eq!(visits(&bvh, &ray, limit), plain);
        }
    }
}

/// A ray along an axis with integer coordinates hits a box exactly, wherever the box is.
#[test]
fn a_ray_through_a_face_edge_or_corner_hits_the_box() {
    for offset in [0.0, 3.0, 1e9, -1e15] {
        let target = cube(DVec3::splat(offset), DVec3::new(1.0, 2.0, 0.0));
        let bvh = build(&[target, cube(DVec3::splat(offset + 5.0), DVec3::ONE)]);
        for direction in DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]) {
            for corner in [target.min, target.max] {
                let origin = corner - 8.0 * direction;
                let seen = visits(&bvh, &Ray { origin, direction }, f64::INFINITY);
                assert!(seen.contains(&0), "{direction} to {corner}");
            }
        }
    }
}

#[test]
fn boxes_up_to_the_limit_are_visited_and_none_far_beyond_it() {
    // Boxes at x = 0, 10, 20 …: their bounds are exact up to `f32` rounding only in leaves of one
    // box, as in a tree of up to eight.
    let boxes: Vec<_> = (0..8)
        .map(|i| cube(10.0 * f64::from(i) * DVec3::X, DVec3::ONE))
        .collect();
    let bvh = build(&boxes);
    let ray = Ray {
        origin: -9.0 * DVec3::X,
        direction: DVec3::X,
    };
    for count in 1..=8 {
        // Box i is entered at 8 + 10 i.
        let limit = f64::from(8 + 10 * (count - 1));
        let expected: Vec<u32> = (0..count as u32).collect();
        assert_eq!(visits(&bvh, &ray, limit), expected);
        assert_eq!(
            visits(&bvh, &ray, limit - 1e-4),
            expected[..expected.len() - 1]
        );
    }
    assert!(visits(&bvh, &ray, -1.0).is_empty());
}

/// The distance at which a ray hits the inscribed sphere of a cube.
fn sphere(aabb: &Aabb, ray: &Ray) -> f64 {
    let (from, radius) = (ray.origin - aabb.centre(), 0.5 * aabb.size().x);
    let toward = -from.dot(ray.direction);
    let across = radius * radius - (from + toward * ray.direction).length_squared();
    let t = toward - across.max(0.0).sqrt();
    if across < 0.0 || t < 0.0 {
        f64::INFINITY
    } else {
        t
    }
}

#[test]
fn a_shrinking_limit_finds_the_nearest_sphere() {
    let mut random = Random(2);
    let boxes: Vec<_> = (0..2000)
        .map(|_| cube(random.point(), DVec3::splat(0.05 * random.signed().abs())))
        .collect();
    let bvh = build(&boxes);
    let (mut hits, mut visited) = (0, 0);
    for _ in 0..2000 {
        let ray = Ray {
            origin: 2.0 * random.point(),
            direction: random.point().normalize(),
        };
        let mut nearest = f64::INFINITY;
        walk(&bvh, &ray, nearest, |index| {
            visited += 1;
            nearest = nearest.min(sphere(&boxes[index as usize], &ray));
            nearest
        });
        let expected = boxes
            .iter()
            .map(|aabb| sphere(aabb, &ray))
            .fold(f64::INFINITY, f64::min);
        assert_eq!(nearest.to_bits(), expected.to_bits());
        hits += usize::from(nearest < f64::INFINITY);
    }
    assert!(200 < hits, "rays hit spheres");
    assert!(visited < 2000 * 20, "most boxes are culled");
}

#[test]
fn a_negative_limit_ends_the_traversal() {
    let boxes = vec![cube(DVec3::ZERO, DVec3::ONE); 100];
    let ray = Ray {
        origin: DVec3::ZERO,
        direction: DVec3::X,
    };
    let mut runs = 0;
    let bvh = build(&boxes);
    dispatch!(Level::new(), simd => bvh.traverse(simd, &ray, 1.0, |_| {
        runs += 1;
        -1.0
    }));
    assert_eq!(runs, 1);
}

#[test]
fn scaling_by_a_power_of_two_keeps_the_visits() {
    let mut random = Random(5);
    let boxes = random_boxes(&mut random, 500, 1.0, DVec3::ONE);
    let rays: Vec<_> = (0..300)
        .map(|_| {
            let aim = random.pick(&boxes);
            ray_at(&mut random, aim, 1.0)
        })
        .collect();
    let bvh = build(&boxes);
    for factor in [-70, -1, 1, 70].map(|k| 2f64.powi(k)) {
        let scaled: Vec<_> = boxes
            .iter()
            .map(|aabb| Aabb {
                min: factor * aabb.min,
                max: factor * aabb.max,
            })
            .collect();
        let scaled = build(&scaled);
        for ray in &rays {
            let far = Ray {
                origin: factor * ray.origin,
                ..*ray
            };
            assert_eq!(visits(&scaled, &far, 2.0 * factor), visits(&bvh, ray, 2.0));
        }
    }
}

#[test]
fn degenerate_boxes_and_rays_are_handled() {
    let ray = Ray {
        origin: DVec3::splat(-4.0),
        direction: DVec3::ONE.normalize(),
    };
    let all = f64::INFINITY;
    assert!(visits(&build(&[]), &ray, all).is_empty());
    assert_eq!(memory(&build(&[])), 0);
    assert!(visits(&build(&[Aabb::EMPTY]), &ray, all).is_empty());
    let nan = Aabb {
        min: DVec3::NAN,
        max: DVec3::ONE,
    };
    let everywhere = Aabb {
        min: DVec3::NEG_INFINITY,
        max: DVec3::INFINITY,
    };
    let half_space = Aabb {
        max: DVec3::new(-9.0, all, all),
        ..everywhere
    };
    let huge = cube(DVec3::ZERO, DVec3::splat(1e300));
    let aside = cube(DVec3::new(9.0, -9.0, 0.0), DVec3::ONE);
    let hit = cube(DVec3::ONE, DVec3::ONE);
    let bvh = build(&[Aabb::EMPTY, nan, everywhere, half_space, huge, aside, hit]);
    assert_eq!(visits(&bvh, &ray, all), [1, 2, 3, 4, 6]);
    for broken in [DVec3::NAN, DVec3::INFINITY, DVec3::ZERO] {
        let direction = broken;
        visits(&bvh, &Ray { direction, ..ray }, all);
        visits(
            &bvh,
            &Ray {
                origin: broken,
                direction,
            },
            f64::NAN,
        );
    }
}
