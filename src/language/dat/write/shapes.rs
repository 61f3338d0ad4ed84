//! Solids.

use std::fmt::Write;

use glam::DVec3;

use super::camera::near;
use crate::frame::aligned;
use crate::losses::{Loss, Losses, Of};
use crate::spelling::groups;
use geometry::{FrameNumbers, Solid, Sphere, normalise};

/// The largest difference, relative to its size, of what counts as a circle or a right angle.
const ROUNDING: f64 = 1e-12;

const CONE: Loss = Loss {
    keys: &[],
    lost: "a cone",
    instead: "written as a quadric between two planes: the same but for rounding",
};

const TURNED: Loss = Loss {
    keys: &[],
    lost: "an ellipsoid that is turned",
    instead: "written as a quadric: the same but for rounding",
};

const ELLIPTIC: Loss = Loss {
    keys: &[],
    lost: "a cylinder that is not circular or not right",
    instead: "written as a quadric between two planes: the same but for rounding",
};

/// Writes a solid that belongs to an object of the scene. `ids` are its own and its material's.
pub(super) fn write(
    text: &mut String,
    (index, solid): (usize, &Solid),
    ids: [usize; 2],
    losses: &mut Losses<'_>,
) {
    let mut head = |word: &str| {
        let [id, material] = ids;
        // Writing to a string cannot fail.
        let _ = write!(text, "obj {word} ID {id} mat ID {material}");
    };
    let mut lose = |loss: &Loss| losses.add(Of::Object(index), loss);
    match solid {
        Solid::Sphere(Sphere { centre, radius }) => {
            head("sphere");
            groups(text, &[&centre.to_array(), &[*radius]]);
        }
        Solid::Ellipsoid(ellipsoid) => {
            let frame = ellipsoid.0.numbers();
            if let Some(lengths) = aligned(&frame) {
                head("ellipsoid");
                groups(text, &[&frame.origin.to_array(), &lengths.to_array()]);
            } else {
                lose(&TURNED);
                head("quadric");
                quadric(text, &frame, Side::Ball);
            }
        }
        Solid::Cuboid(cuboid) => {
            head("box");
            self::cuboid(text, &cuboid.0.numbers());
        }
        Solid::Cylinder(cylinder) => {
            let frame = cylinder.0.numbers();
            if is_right(&frame) {
                head("cylinder");
                self::cylinder(text, &frame);
            } else {
                lose(&ELLIPTIC);
                head("quadric");
                quadric(text, &frame, Side::Straight);
            }
        }
        Solid::Cone(cone) => {
            lose(&CONE);
            head("quadric");
            quadric(text, &cone.0.numbers(), Side::Pointed);
        }
        // What it was made of is not known; it has a stand-in.
        Solid::Quadric(_) => return,
    }
    text.push('\n');
}

/// Whether a cylinder is circular and its axis perpendicular to its base.
fn is_right(frame: &FrameNumbers) -> bool {
    let [x, y, axis] = frame.directions;
    let DVec3 { x: a, y: b, .. } = frame.lengths;
    let is_circular = (a - b).abs() <= ROUNDING * a;
    is_circular
        && [x.dot(y), x.dot(axis), y.dot(axis)]
            .iter()
            .all(|dot| dot.abs() <= ROUNDING)
}

fn cylinder(text: &mut String, frame: &FrameNumbers) {
    let direction = frame.directions[2];
    let (radius, length) = (frame.lengths.x, frame.lengths.z);
    let axis = normalise(direction).unwrap_or(direction);
    let centre = middle(frame.origin, 0.5 * length * axis);
    let parts = [centre, direction].map(|part| part.to_array());
    groups(text, &[&parts[0], &parts[1], &[radius, length]]);
}

fn cuboid(text: &mut String, frame: &FrameNumbers) {
    let [u, v, w] = frame.directions;
    let width = |direction: DVec3, length: f64| {
        let size = direction.length();
        let found = near(length / size).find(|width| width * size == length);
        found.unwrap_or(length / size)
    };
    let DVec3 { x, y, z } = frame.lengths;
    let [wide, high, deep] = [width(u, x), width(v, y), width(w, z)];
    let half = 0.5 * (wide * u + high * v + deep * w);
    let centre = middle(frame.origin, half);
    let widths = DVec3::new(wide, high, deep);
    let parts = [centre, u, v, w, widths].map(|part| part.to_array());
    groups(text, &parts.each_ref().map(|part| &part[..]));
}

/// The point that, less `half`, is the origin, to the last bit if there is one.
fn middle(origin: DVec3, half: DVec3) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| {
        let (origin, half) = (origin[axis], half[axis]);
        let found = near(origin + half).find(|middle| middle - half == origin);
        found.unwrap_or(origin + half)
    }))
}

/// The curved side of a unit solid.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    /// x² + y² + z² = 1.
    Ball,
    /// x² + y² = 1, between z = 0 and z = 1.
    Straight,
    /// x² + y² = (1 − z)², between z = 0 and z = 1.
    Pointed,
}

/// The coefficients of the image of a unit solid, and its half-spaces.
fn quadric(text: &mut String, frame: &FrameNumbers, side: Side) {
    let Some(duals) = duals(frame) else {
        return;
    };
    let [_, _, axis] = frame.columns();
    // Of a cone, relative to its apex.
    let origin = match side {
        Side::Pointed => frame.origin + axis,
        Side::Ball | Side::Straight => frame.origin,
    };
    let (signs, constant) = match side {
        Side::Ball => ([1.0, 1.0, 1.0], -1.0),
        Side::Straight => ([1.0, 1.0, 0.0], -1.0),
        Side::Pointed => ([1.0, 1.0, -1.0], 0.0),
    };
    let along = duals.map(|dual| dual.dot(origin));
    let sum = |term: &dyn Fn(usize) -> f64| (0..3).map(|at| signs[at] * term(at)).sum::<f64>();
    let square = |i: usize, j: usize| sum(&|at| duals[at][i] * duals[at][j]);
    let linear = |i: usize| -sum(&|at| duals[at][i] * along[at]);
    groups(
        text,
        &[&[
            square(0, 0),
            square(0, 1),
            square(0, 2),
            linear(0),
            square(1, 1),
            square(1, 2),
            linear(1),
            square(2, 2),
            linear(2),
            sum(&|at| along[at] * along[at]) + constant,
        ]],
    );
    if side == Side::Ball {
        text.push_str("  0");
        return;
    }
    let dual = duals[2];
    let base = dual.dot(frame.origin);
    let cuts = [(-dual).extend(-base), dual.extend(base + 1.0)].map(|cut| cut.to_array());
    groups(text, &[&[2.0], &cuts[0], &cuts[1]]);
}

/// The rows of the world-to-unit matrix.
fn duals(frame: &FrameNumbers) -> Option<[DVec3; 3]> {
    let [u, v, w] = frame.directions;
    let volume = u.dot(v.cross(w));
    let DVec3 { x, y, z } = frame.lengths;
    let duals = [
        v.cross(w) / (volume * x),
        w.cross(u) / (volume * y),
        u.cross(v) / (volume * z),
    ];
    duals.iter().all(|dual| dual.is_finite()).then_some(duals)
}
