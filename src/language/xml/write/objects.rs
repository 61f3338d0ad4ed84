//! Objects.

use glam::DVec3;

use super::transforms::{Map, placed};
use super::{open, word};
use crate::approximations::solids;
use crate::losses::{Loss, Losses, Of};
use geometry::{FrameNumbers, Shape, Solid};
use scene::Scene;

const BOX: Loss = Loss {
    keys: &[],
    lost: "a box",
    instead: "written as six squares, which enclose no solid: the same except for rounding and glass",
};

const CYLINDER: Loss = Loss {
    keys: &[],
    lost: "a cylinder",
    instead: "written as the ellipsoid of its size",
};

const CONE: Loss = Loss {
    keys: &[],
    lost: "a cone",
    instead: "written as the ellipsoid of its size",
};

/// Writes the objects of a scene. `names` are those of its materials.
pub(super) fn write(text: &mut String, scene: &Scene, names: &[String], losses: &mut Losses<'_>) {
    for (index, object) in scene.objects.iter().enumerate() {
        let label = losses.label(Of::Object(index));
        let label = label.as_deref();
        if let Shape::Plane(plane) = &object.shape {
            let material = Some(&*names[object.material as usize]);
            let map = map(&plane.0.numbers());
            one(text, 4, ("plane", label, material), map);
            continue;
        }
        let mut pieces = 0;
        solids(index, object, losses, |solid, material, losses| {
            let material = Some(&*names[material as usize]);
            pieces += solid_object(text, (index, label), solid, material, losses);
        });
        losses.stand_in(index, pieces);
    }
}

/// Writes a solid and returns the number of objects drawn for it.
fn solid_object(
    text: &mut String,
    (index, label): (usize, Option<&str>),
    solid: &Solid,
    material: Option<&str>,
    losses: &mut Losses<'_>,
) -> usize {
    let mut ball = |map| one(text, 4, ("sphere", label, material), map);
    match solid {
        Solid::Sphere(sphere) => {
            ball((DVec3::AXES.map(|axis| sphere.radius * axis), sphere.centre));
        }
        Solid::Ellipsoid(ellipsoid) => ball(map(&ellipsoid.0.numbers())),
        Solid::Cylinder(cylinder) => {
            losses.add(Of::Object(index), &CYLINDER);
            ball(filling(&cylinder.0.numbers()));
        }
        Solid::Cone(cone) => {
            losses.add(Of::Object(index), &CONE);
            ball(filling(&cone.0.numbers()));
        }
        Solid::Cuboid(cuboid) => {
            losses.add(Of::Object(index), &BOX);
            open(text, 4, "object");
            word(text, "name", label);
            text.push_str(">\n");
            let squares = squares(&cuboid.0.numbers());
            for square in squares {
                one(text, 6, ("plane", None, material), square);
            }
            text.push_str("    </object>\n");
            return squares.len();
        }
        // It has a stand-in.
        Solid::Quadric(_) => return 0,
    }
    1
}

/// Writes an object with its type, name and material.
fn one(
    text: &mut String,
    indent: usize,
    (kind, name, material): (&str, Option<&str>, Option<&str>),
    map: Map,
) {
    open(text, indent, "object");
    word(text, "type", kind);
    word(text, "name", name);
    word(text, "material", material);
    let before = text.len();
    text.push_str(">\n");
    placed(text, indent + 2, map);
    if text.len() == before + 2 {
        text.truncate(before);
        text.push_str("/>\n");
        return;
    }
    text.push_str(&" ".repeat(indent));
    text.push_str("</object>\n");
}

fn map(numbers: &FrameNumbers) -> Map {
    (numbers.columns(), numbers.origin)
}

/// The ellipsoid that fills the same box as a unit solid from z = 0 to z = 1.
fn filling(numbers: &FrameNumbers) -> Map {
    let [x, y, z] = numbers.columns();
    ([x, y, 0.5 * z], numbers.origin + 0.5 * z)
}

/// The faces of a box, each with its outward normal.
fn squares(numbers: &FrameNumbers) -> [Map; 6] {
    let half = numbers.columns().map(|column| 0.5 * column);
    let [x, y, z] = half;
    let centre = numbers.origin + x + y + z;
    let handed = x.cross(y).dot(z).signum();
    [0, 1, 2, 3, 4, 5].map(|face| {
        let (axis, side) = (face / 2, if face % 2 == 0 { -1.0 } else { 1.0 });
        let [across, up] = [half[(axis + 1) % 3], half[(axis + 2) % 3]];
        let outward = side * handed * across.cross(up).normalize_or(DVec3::Z);
        ([across, up, outward], centre + side * half[axis])
    })
}
