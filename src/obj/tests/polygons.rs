//! Polygons that are not convex.

use super::*;
use crate::{MAX_TRIANGLES, ears, polygons};

/// The work allowed per corner, more than any of these outlines takes that do not cross themselves.
const EFFORT: usize = 128;

/// Twice the signed area of a polygon of the plane.
fn area(corners: &[DVec2]) -> f64 {
    let pairs = corners.windows(2).map(|pair| pair[0].perp_dot(pair[1]));
    let last = corners[corners.len() - 1].perp_dot(corners[0]);
    pairs.sum::<f64>() + last
}

/// Asserts that the ears of a polygon cover its area once.
fn check(corners: &[DVec2], name: &str) {
    let mut effort = 64 * corners.len();
    let triangles = ears::triangles(corners, &mut effort);
    assert_ne!(effort, 0, "{name}");
    assert_eq!(triangles.len(), corners.len() - 2, "{name}");
    let areas = triangles
        .iter()
        .map(|ear| area(&ear.map(|corner| corners[corner as usize])));
    let areas: Vec<_> = areas.collect();
    let whole = area(corners);
    assert!(areas.iter().all(|&area| -1e-9 * whole <= area), "{name}");
    let sum: f64 = areas.iter().sum();
    assert!(
        (sum - whole).abs() < 1e-9 * whole,
        "{name}: {sum} of {whole}"
    );
}

/// The L of six corners, 0 where the fan would begin.
const L: [[f64; 2]; 6] = [[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 2.], [0., 2.]];

#[test]
fn a_concave_polygon_is_covered_from_each_corner_and_side() {
    for first in 0..6 {
        for (mirror, plane) in [(1, 0), (1, 1), (1, 2), (5, 0), (5, 1), (5, 2)] {
            let corners = (0..6).map(|at| L[(first + at * mirror) % 6]);
            let lines = corners.map(|[x, y]| match plane {
                0 => format!("v {x} {y} 5\n"),
                1 => format!("v 5 {x} {y}\n"),
                _ => format!("v {y} 5 {x}\n"),
            });
            let text = format!("{}f 1 2 3 4 5 6", lines.collect::<String>());
            let model = model(&text);
            assert_eq!((model.mesh.len(), model.warnings.len()), (4, 0));
            let shape = shape(model);
            for (x, y, is_inside) in [
                (0.5, 0.5, true),
                (1.7, 0.6, true),
                (0.6, 1.7, true),
                (1.4, 1.4, false),
                (1.2, 1.7, false),
            ] {
                let (origin, direction) = match plane {
                    0 => (DVec3::new(x, y, 9.0), DVec3::NEG_Z),
                    1 => (DVec3::new(9.0, x, y), DVec3::NEG_X),
                    _ => (DVec3::new(y, 9.0, x), DVec3::NEG_Y),
                };
                let ray = Ray { origin, direction };
                let hit = shape.hit(&ray, f64::INFINITY);
                assert_eq!(hit.is_some(), is_inside, "{text} {x} {y}");
                // The outline's own direction decides the front.
                if let Some(hit) = hit {
                    let front = if mirror == 1 { -direction } else { direction };
                    assert_eq!(shape.surface(&ray, hit).shading, front, "{text}");
                }
            }
        }
    }
}

/// Texture coordinates and normals go with their corners: u is x / 2, v is y / 2.
#[test]
fn corners_keep_their_values() {
    let corner = |[x, y]: [f64; 2]| {
        let [u, v] = [x / 2.0, y / 2.0];
        format!("v {x} {y} 0\nvt {u} {v}\nvn 0 0 1\n")
    };
    let text: String = L.map(corner).concat();
    let face = (0..6).map(|at| format!(" {0}/{0}/{0}", (at + 4) % 6 + 1));
    let shape = shape(model(&format!("{text}f{}", face.collect::<String>())));
    for (x, y) in [(0.5, 0.5), (1.7, 0.6), (0.6, 1.7)] {
        let (_, _, uv, normal) = seen(&shape, x, y).expect("it is there");
        assert!(uv.distance(DVec2::new(x, y) / 2.0) < 1e-12);
        assert_eq!(normal, DVec3::Z);
    }
}

/// Where the fan covers the polygon it stays: convex ones, and others whose first corner sees all.
#[test]
fn a_fan_that_covers_its_polygon_stays() {
    let star = "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n";
    let bent = "v 0 0 0\nv 1 0 .3\nv 1 1 0\nv 0 1 .3\n";
    let flat = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\n";
    let none = "v 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\n";
    for text in [SQUARE, star, bent, flat, none] {
        let whole = model(&format!("{text}f 1 2 3 4"));
        let fan = model(&format!("{text}f 1 2 3\nf 1 3 4"));
        assert_eq!(whole.mesh, fan.mesh, "{text}");
        let turned = model(&format!("{text}f 2 3 4 1"));
        let other = model(&format!("{text}f 2 3 4\nf 2 4 1"));
        assert_eq!(turned.mesh == other.mesh, text != star, "{text}");
    }
}

/// Outlines of many corners, some of which touch themselves.
#[test]
fn ears_cover_large_outlines() {
    let around = |count: usize, radius: &dyn Fn(usize) -> f64| -> Vec<_> {
        let place = |at: usize| {
            let angle = std::f64::consts::TAU * at as f64 / count as f64;
            radius(at) * DVec2::new(libm::cos(angle), libm::sin(angle))
        };
        (0..count).map(place).collect()
    };
    let count = 4_000;
    check(&around(count, &|at| [1.0, 0.3][at % 2]), "star");
    check(
        &around(count, &|at| 1.0 + 0.5 * libm::sin(at as f64 * 0.37)),
        "waves",
    );
    // A band that winds inward five times, out along one side and back along the other.
    let turns = |at: usize| {
        let angle = 10.0 * std::f64::consts::PI * at as f64 / (count / 2) as f64;
        (12.0 - angle / 4.0) * DVec2::new(libm::cos(angle), libm::sin(angle))
    };
    let inner = (0..count / 2).map(|at| turns(at) * 0.97).rev();
    check(
        &(0..count / 2).map(turns).chain(inner).collect::<Vec<_>>(),
        "spiral",
    );
    let teeth = (0..count / 2)
        .rev()
        .map(|at| DVec2::new(at as f64, [1.0, 9.0][at % 2]));
    let base = [DVec2::ZERO, DVec2::new((count / 2 - 1) as f64, 0.0)];
    check(&base.into_iter().chain(teeth).collect::<Vec<_>>(), "comb");
    // A square with a round bite: hardly a corner is convex.
    let bite = (0..count).rev().map(|at| {
        let angle = std::f64::consts::PI * (at as f64 + 0.5) / count as f64;
        DVec2::new(2.0 + libm::cos(angle), libm::sin(angle))
    });
    let square = [[4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0]].map(DVec2::from);
    check(&bite.chain(square).collect::<Vec<_>>(), "bite");
    // A square with a square hole, joined by a cut that is passed twice.
    let ring = [
        [0, 0],
        [9, 0],
        [9, 9],
        [0, 9],
        [0, 0],
        [3, 3],
        [3, 6],
        [6, 6],
        [6, 3],
        [3, 3],
    ];
    let ring = ring.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)));
    for first in 0..ring.len() {
        let turned: Vec<_> = (0..ring.len())
            .map(|at| ring[(first + at) % ring.len()])
            .collect();
        check(&turned, "ring");
    }
}

/// Corners that are repeated cover nothing, wherever they stand.
#[test]
fn repeated_corners_change_nothing() {
    let corners = L.map(DVec2::from);
    for first in 0..6 {
        let turned = (0..6).map(|at| corners[(first + at) % 6]);
        check(
            &turned.flat_map(|corner| [corner; 3]).collect::<Vec<_>>(),
            "L",
        );
    }
    let mut effort = 0;
    assert_eq!(ears::triangles(&[DVec2::ONE; 100], &mut effort).len(), 98);
}

/// An outline that crosses itself everywhere: as many triangles, for the work allowed.
#[test]
fn outlines_that_cross_themselves_end() {
    let mut state = 1_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 40) as f64
    };
    for count in [4, 5, 100, 3_000] {
        let corners: Vec<_> = (0..count).map(|_| DVec2::new(next(), next())).collect();
        for effort in [0, 1, count, EFFORT * count] {
            let mut left = effort;
            assert_eq!(ears::triangles(&corners, &mut left).len(), count - 2);
            assert!(left == 0 || count < 3_000, "{left} of {effort}");
        }
        let same = vec![DVec2::ONE; count];
        let mut left = EFFORT;
        assert_eq!(ears::triangles(&same, &mut left).len(), count - 2);
        assert_eq!(left, EFFORT);
    }
}

/// However many polygons a mesh has, and of how many corners each.
#[test]
fn the_work_for_a_mesh_is_limited() {
    for (corners, count) in [
        (4, 1),
        (4, 1 << 23),
        (5, 1 << 20),
        (100, 60_000),
        (1_000, 1),
        (100_000, 1),
        (100_000, 160),
        (1_000_000, 1),
        (MAX_TRIANGLES + 2, 1),
    ] {
        let effort = polygons::effort(corners, corners * count);
        assert!(effort * count <= 1 << 26, "{count} of {corners}: {effort}");
        let least = if corners * count < 500_000 { 64 } else { 2 };
        assert!(least * corners <= effort, "{count} of {corners}: {effort}");
    }
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn no_outline_makes_the_cutter_panic(
        corners in prop::collection::vec((0..6_i32, 0..6_i32), 3..40),
    ) {
        let corners: Vec<_> = corners.iter().map(|&(x, y)| DVec2::new(x.into(), y.into())).collect();
        let triangles = ears::triangles(&corners, &mut (EFFORT * corners.len()));
        prop_assert_eq!(triangles.len(), corners.len() - 2);
        let sum: f64 = triangles.iter().map(|ear| area(&ear.map(|at| corners[at as usize]))).sum();
        prop_assert_eq!(sum, area(&corners));
    }
}
