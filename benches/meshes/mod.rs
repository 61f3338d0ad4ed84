//! Generated meshes as `.obj` text.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

/// An `.xml` scene of `ball.obj`.
pub(crate) const BALL_SCENE: &str = "<xml>
  <scene>
    <object type=\"obj\" name=\"ball.obj\" material=\"clay\"/>
    <material type=\"blinn\" name=\"clay\"><diffuse r=\"0.7\" g=\"0.6\" b=\"0.5\"/></material>
    <light type=\"ambient\"><intensity value=\"0.1\"/></light>
    <light type=\"direct\"><intensity value=\"0.9\"/><direction x=\"-1\" y=\"1\" z=\"-1\"/></light>
  </scene>
  <camera>
    <position x=\"1.8\" y=\"-3\" z=\"1.4\"/><target/><up z=\"1\"/>
    <width value=\"400\"/><height value=\"300\"/>
  </camera>
</xml>
";

/// A bumpy ball of about `count` triangles as `.obj` text: rings of quadrilaterals, each divided
/// into two triangles.
pub(crate) fn bumpy_ball(count: usize) -> String {
    let rings = ((count / 4) as f64).sqrt() as usize;
    let around = 2 * rings;
    let mut text = String::new();
    for ring in 0..=rings {
        for step in 0..around {
            let (down, turn) = (
                PI * ring as f64 / rings as f64,
                TAU * step as f64 / around as f64,
            );
            let bumps = (23.0 * turn).sin() * (19.0 * down).sin();
            let radius = 1.0 + 0.08 * bumps + 0.004 * (397.0 * turn).sin();
            let flat = radius * down.sin();
            let [x, y, z] = [flat * turn.cos(), flat * turn.sin(), radius * down.cos()];
            put(&mut text, format_args!("v {x:.6} {y:.6} {z:.6}\n"));
        }
    }
    for ring in 0..rings {
        for step in 0..around {
            let next = (step + 1) % around;
            let [a, b] = [step, next].map(|step| 1 + ring * around + step);
            let [c, d] = [a + around, b + around];
            put(&mut text, format_args!("f {a} {c} {b}\nf {b} {c} {d}\n"));
        }
    }
    text
}

fn put(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what)
        .expect("writing to a String never fails");
}
