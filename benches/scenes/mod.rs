//! Generated scenes as text.

use std::f64::consts::{FRAC_1_SQRT_2, PI};
use std::fmt::Write as _;

/// A vector of three coordinates.
type Vector = [f64; 3];

/// The sphereflake of Haines' Standard Procedural Databases ("balls"): a sphere of radius ½ with
/// nine spheres of a third its size on it, repeated for `levels`, over a floor. Level 4 has 7,381
/// spheres.
pub(crate) fn sphereflake(levels: u32) -> String {
    let lights = [[4.0, 3.0, 2.0], [1.0, -4.0, 4.0], [-3.0, 1.0, 5.0]];
    sphereflake_under(levels, &lights)
}

/// Like [`sphereflake`] with `lights` lights in a ring above it.
pub(crate) fn lit_sphereflake(levels: u32, lights: usize) -> String {
    let position = |light| {
        let turn = 2.0 * PI * light as f64 / lights as f64;
        [4.0 * turn.cos(), 4.0 * turn.sin(), 4.0]
    };
    let lights: Vec<_> = (0..lights).map(position).collect();
    sphereflake_under(levels, &lights)
}

fn sphereflake_under(levels: u32, lights: &[Vector]) -> String {
    let mut spheres = Vec::new();
    grow(
        levels,
        [0.0; 3],
        0.5,
        [0.0, 0.0, 1.0],
        &directions(),
        &mut spheres,
    );
    let mut text = String::from(
        "// view: eye 2.1 1.3 1.7 target 0 0 0 up 0 0 1 fov 45 size 1280 720\n\
         .05 .05 .05\n",
    );
    put(&mut text, format_args!("{}\n", lights.len()));
    for [x, y, z] in lights {
        put(&mut text, format_args!("{x} {y} {z}\n.5 .5 .5\n"));
    }
    let floor = "box\n-6 -6 -.7 1 0 0 0 1 0 0 0 1 12 12 .2\n\
                 .8 .6 .26\n.8 .6 .26\n0 0 0\n1 0 0 1\n";
    put(&mut text, format_args!("{}\n{floor}", spheres.len() + 1));
    for ([x, y, z], radius) in spheres {
        put(
            &mut text,
            format_args!(
                "sphere\n{x} {y} {z} {radius}\n.5 .45 .35\n.5 .45 .35\n.5 .5 .5\n30 .5 0 1\n"
            ),
        );
    }
    text
}

/// `count` small spheres in eight colours, spread uniformly over a cube of edge 2. They fill a
/// constant part of it regardless of their number. The text depends only on `count` and `seed`.
pub(crate) fn random_spheres(count: usize, seed: u64) -> String {
    const COLOURS: [&str; 8] = [
        ".8 .2 .2", ".2 .7 .2", ".2 .3 .8", ".8 .7 .2", ".7 .2 .7", ".2 .7 .7", ".8 .8 .8",
        ".8 .5 .2",
    ];
    let mut text = String::from(
        "// view: eye 2.6 -3.2 2.2 target 0 0 0 up 0 0 1 fov 36 size 1280 720\n\
         .1 .1 .1\n1\n4 -6 8\n.9 .9 .9\n",
    );
    put(&mut text, format_args!("{count}\n"));
    let mut state = seed;
    for _ in 0..count {
        let [x, y, z, size, shade] = [(); 5].map(|()| unit(&mut state));
        let [x, y, z] = [x, y, z].map(|coordinate| 2.0 * coordinate - 1.0);
        let radius = (0.2 + 0.2 * size) / (count as f64).cbrt();
        let colour = COLOURS[(shade * 8.0) as usize % 8];
        put(
            &mut text,
            format_args!(
                "sphere\n{x:.5} {y:.5} {z:.5} {radius:.6}\n{colour}\n{colour}\n.3 .3 .3\n20 0 0 1\n"
            ),
        );
    }
    text
}

/// A `.dat` scene of `count` CSG objects over a floor, alternately a box minus a ball and a rod,
/// and the intersection of a ball, a box and a cylinder, each with a random rotation and colour.
pub(crate) fn set_operations(count: usize) -> String {
    let mut text = String::from(
        "camera perspective 2.6 -6 5  0 0 0  0 0 1  1 .01 100\n\
         resolution .0010110 .0010110\nviewport 1280 720\n\
         light ID 1 pnt 4 -6 8  0 0 0  .9 .9 .9  1 0 0 0 shadow_on\n\
         light ID 2 amb 0 0 0  0 0 0  .1 .1 .1  1 0 0 0 shadow_off\n\
         mat ID 0 .6 .6 .6  1 1 0 1  0 0 1\n\
         obj box ID 0 mat ID 0 0 0 -.7  1 0 0 0 1 0 0 0 1 20 20 .2\n",
    );
    let mut state = 5;
    for index in 0..count {
        let (column, row) = ((index % 20) as f64, (index / 20) as f64);
        let (x, y) = ((column - 9.5) * 0.4, (row - 4.5) * 0.55);
        let [red, green, blue] = [(); 3].map(|()| 0.2 + 0.7 * unit(&mut state));
        let turn = 2.0 * PI * unit(&mut state);
        let towards = [0.0, turn.sin(), turn.cos()];
        let [u, v, w] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            .map(|axis| rotate(lean(axis, towards), [0.0, 0.0, 1.0], 3.0 * turn));
        let coordinates = |axis: Vector| format!("{:.9} {:.9} {:.9}", axis[0], axis[1], axis[2]);
        let placement = format!("mat ID {} {x} {y} 0", index + 1);
        let id = 1 + 5 * index;
        put(
            &mut text,
            format_args!(
                "mat ID {} {red:.3} {green:.3} {blue:.3}  1 1 .4 30  0 .15 1\n\
                 obj box ID {} {placement}  {} {} {}  .3 .3 .3\n\
                 obj sphere ID {} {placement}  .19\n",
                index + 1,
                id,
                coordinates(u),
                coordinates(v),
                coordinates(w),
                id + 1
            ),
        );
        let (axis, radius, length, word) = if index % 2 == 0 {
            (w, 0.06, 0.4, "difference")
        } else {
            (u, 0.16, 0.6, "intersection")
        };
        put(
            &mut text,
            format_args!(
                "obj cylinder ID {} {placement}  {}  {radius} {length}\n\
                 obj CSG ID {} {word} ID {} ID {}\nobj CSG ID {} {word} ID {} ID {}\n",
                id + 2,
                coordinates(axis),
                id + 3,
                id,
                id + 1,
                id + 4,
                id + 3,
                id + 2
            ),
        );
    }
    text
}

/// The nine directions of the children of a sphere that points along +z.
fn directions() -> Vec<Vector> {
    let d = FRAC_1_SQRT_2;
    let axis = [d, -d, 0.0];
    let tilt = (2.0 / 6f64.sqrt()).asin();
    let triple = [[d, d, 0.0], [d, 0.0, -d], [0.0, d, -d]].map(|v| rotate(v, axis, tilt));
    let turns = [0.0, 2.0, 4.0].map(|thirds| thirds * PI / 3.0);
    turns
        .iter()
        .flat_map(|&angle| triple.map(|v| rotate(v, [0.0, 0.0, 1.0], angle)))
        .collect()
}

/// Adds a sphere that points along `up`, and `levels` of children.
fn grow(
    levels: u32,
    centre: Vector,
    radius: f64,
    up: Vector,
    directions: &[Vector],
    spheres: &mut Vec<(Vector, f64)>,
) {
    spheres.push((centre, radius));
    if levels == 0 {
        return;
    }
    for &direction in directions {
        let out = lean(direction, up);
        let reach = radius + radius / 3.0;
        let position = [0, 1, 2].map(|i| centre[i] + reach * out[i]);
        grow(levels - 1, position, radius / 3.0, out, directions, spheres);
    }
}

/// Rotates `v` by the shortest rotation that maps +z to `up`.
fn lean(v: Vector, up: Vector) -> Vector {
    let sine = up[0].hypot(up[1]);
    if sine < 1e-9 {
        let sign = up[2].signum();
        return [v[0], sign * v[1], sign * v[2]];
    }
    rotate(v, [-up[1] / sine, up[0] / sine, 0.0], sine.atan2(up[2]))
}

/// Rodrigues' rotation about a unit axis.
fn rotate(v: Vector, axis: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    let [x, y, z] = axis;
    let across = [
        y * v[2] - z * v[1],
        z * v[0] - x * v[2],
        x * v[1] - y * v[0],
    ];
    let along = x * v[0] + y * v[1] + z * v[2];
    [0, 1, 2].map(|i| v[i] * cos + across[i] * sin + axis[i] * along * (1.0 - cos))
}

/// The next number in 0..1 of `SplitMix64` (Steele, Lea and Flood 2014).
fn unit(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 * 2f64.powi(-53)
}

/// Appends formatted text.
fn put(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what)
        .expect("writing to a String never fails");
}
