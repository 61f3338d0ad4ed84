//! Solids that stand for shapes which a language lacks.

use glam::DVec3;

use super::losses::{Loss, Losses, Of};
use geometry::{Affine, Cuboid, Ellipsoid, Plane, Quadric, Shape, Solid, normalise};
use scene::Object;

/// The thickness of a box that stands for a square, as a fraction of its shorter edge.
const THIN: f64 = 1e-4;

const COMBINED: Loss = Loss {
    keys: &["operator"],
    lost: "a combination of solids",
    instead: "written without the cuts: both operands of a union, the first of a difference, the \
              smaller of an intersection",
};

const SQUARE: Loss = Loss {
    keys: &["type"],
    lost: "a square without thickness",
    instead: "written as a thin box behind it",
};

const MESH: Loss = Loss {
    keys: &["name"],
    lost: "a mesh",
    instead: "left out",
};

const QUADRIC: Loss = Loss {
    keys: &[],
    lost: "a quadric",
    instead: "written as the ellipsoid that fills its box",
};

const UNBOUNDED: Loss = Loss {
    keys: &[],
    lost: "an unbounded or empty quadric",
    instead: "left out",
};

/// Passes the solids that make up or stand for an object of the scene to `write`, each with its
/// material.
pub(super) fn solids(
    index: usize,
    object: &Object,
    losses: &mut Losses<'_>,
    mut write: impl FnMut(&Solid, u32, &mut Losses<'_>),
) {
    let mut pieces = 0;
    let mut one = |solid: &Solid, material: u32, losses: &mut Losses<'_>| {
        let Solid::Quadric(quadric) = solid else {
            write(solid, material, losses);
            pieces += 1;
            return;
        };
        match filling(quadric) {
            Some(ellipsoid) => {
                losses.add(Of::Object(index), &QUADRIC);
                write(&Solid::Ellipsoid(Box::new(ellipsoid)), material, losses);
                pieces += 1;
            }
            None => losses.add(Of::Object(index), &UNBOUNDED),
        }
    };
    match &object.shape {
        Shape::Solid(solid) => one(solid, object.material, losses),
        Shape::Csg(csg) => {
            losses.add(Of::Object(index), &COMBINED);
            for (solid, material) in csg.uncut() {
                one(solid, material, losses);
            }
        }
        Shape::Plane(plane) => {
            losses.add(Of::Object(index), &SQUARE);
            if let Some(cuboid) = thin(plane) {
                one(&Solid::Cuboid(Box::new(cuboid)), object.material, losses);
            }
        }
        Shape::Mesh(_) => losses.add(Of::Object(index), &MESH),
    }
    losses.stand_in(index, pieces);
}

/// The ellipsoid that fills the box of a bounded quadric.
fn filling(quadric: &Quadric) -> Option<Ellipsoid> {
    let bounds = quadric.bounds();
    let half = 0.5 * bounds.size();
    let fits = bounds.is_bounded() && 0.0 < half.min_element();
    let frame = Affine::new(bounds.centre(), DVec3::AXES, half).filter(|_| fits)?;
    Some(Ellipsoid(frame))
}

/// A thin box whose face is the square and whose rest is behind it.
fn thin(Plane(frame): &Plane) -> Option<Cuboid> {
    let numbers = frame.numbers();
    let [across, up, ahead] = numbers.columns();
    let [x, y, _] = numbers.directions;
    let normal = normalise(x.cross(y))?;
    let (width, height) = (2.0 * numbers.lengths.x, 2.0 * numbers.lengths.y);
    let thickness = THIN * width.min(height);
    // Right-handed, with the last edge away from the face.
    let (directions, sizes) = if 0.0 < normal.dot(ahead) {
        ([y, x, -normal], DVec3::new(height, width, thickness))
    } else {
        ([x, y, normal], DVec3::new(width, height, thickness))
    };
    let corner = numbers.origin - across - up;
    Some(Cuboid(Affine::new(corner, directions, sizes)?))
}
