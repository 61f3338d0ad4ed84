//! Lines along the surfaces of shapes, of which wireframes are made.

use std::f64::consts::TAU;

use glam::DVec3;

use super::{Aabb, Affine, Quadric, Shape, Solid, Sphere};

/// The two ends of a straight line.
type Line = [DVec3; 2];

/// How much of a shape's surface its lines show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Detail {
    /// Chords of a full circle, at least 3.
    pub chords: u32,
    /// The most triangles of a mesh; of larger ones every second, third … is shown.
    pub triangles: usize,
}

/// From this number of chords on a solid is large enough for additional lines.
const FINE: u32 = 24;

impl Shape {
    /// Adds lines: the edges of a shape, and circles and lines along its curved sides. Unbounded
    /// shapes are cut off at the box `within`. Every solid of a combination is shown whole.
    pub fn outline(&self, detail: Detail, within: Aabb, lines: &mut Vec<Line>) {
        match self {
            Self::Solid(solid) => outline(solid, detail, within, lines),
            Self::Csg(csg) => {
                for solid in csg.solids() {
                    outline(solid, detail, within, lines);
                }
            }
            Self::Plane(plane) => square(&plane.0, detail, lines),
            Self::Mesh(instance) => lines.extend(instance.edges(detail.triangles)),
        }
    }
}

fn outline(solid: &Solid, detail: Detail, within: Aabb, lines: &mut Vec<Line>) {
    match solid {
        Solid::Sphere(Sphere { centre, radius }) => {
            ball(
                *centre,
                DVec3::AXES.map(|axis| *radius * axis),
                detail,
                lines,
            );
        }
        Solid::Ellipsoid(ellipsoid) => {
            ball(ellipsoid.0.origin(), ellipsoid.0.axes(), detail, lines);
        }
        Solid::Cuboid(cuboid) => edges(&cuboid.0, lines),
        Solid::Cylinder(cylinder) => {
            let [across, up, axis] = cylinder.0.axes();
            let base = cylinder.0.origin();
            for end in [base, base + axis] {
                circle(end, across, up, detail.chords, lines);
            }
            let rim = struts(&cylinder.0, detail);
            lines.extend(rim.map(|foot| [foot, foot + axis]));
        }
        Solid::Cone(cone) => {
            let [across, up, axis] = cone.0.axes();
            let base = cone.0.origin();
            circle(base, across, up, detail.chords, lines);
            lines.extend(struts(&cone.0, detail).map(|foot| [foot, base + axis]));
        }
        Solid::Quadric(quadric) => slices(quadric, detail, within, lines),
    }
}

/// The meridians of a ball through the ends of its last axis, and its parallels.
fn ball(centre: DVec3, [x, y, z]: [DVec3; 3], detail: Detail, lines: &mut Vec<Line>) {
    let chords = detail.chords;
    circle(centre, x, y, chords, lines);
    if chords < FINE {
        circle(centre, x, z, chords, lines);
        circle(centre, y, z, chords, lines);
        return;
    }
    for meridian in 0..4 {
        let (sin, cos) = libm::sincos(f64::from(meridian) * TAU / 8.0);
        circle(centre, cos * x + sin * y, z, chords, lines);
    }
    for latitude in [-TAU / 8.0, TAU / 8.0] {
        let (sin, cos) = libm::sincos(latitude);
        circle(centre + sin * z, cos * x, cos * y, chords, lines);
    }
}

/// The image of a circle.
fn circle(centre: DVec3, x: DVec3, y: DVec3, chords: u32, lines: &mut Vec<Line>) {
    let at = |chord| around(centre, x, y, f64::from(chord) / f64::from(chords));
    lines.extend((0..chords).map(|chord| [at(chord), at((chord + 1) % chords)]));
}

/// The feet of lines along the side of a round solid.
fn struts(frame: &Affine, detail: Detail) -> impl Iterator<Item = DVec3> {
    let count = if detail.chords < FINE { 4 } else { 8 };
    let ([x, y, _], origin) = (frame.axes(), frame.origin());
    (0..count).map(move |strut| around(origin, x, y, f64::from(strut) / f64::from(count)))
}

/// A point of the image of a circle, in turns from `x`.
fn around(centre: DVec3, x: DVec3, y: DVec3, turns: f64) -> DVec3 {
    let (sin, cos) = libm::sincos(TAU * turns);
    centre + cos * x + sin * y
}

/// The twelve edges of a box.
fn edges(frame: &Affine, lines: &mut Vec<Line>) {
    let axes = frame.axes();
    for along in 0..3 {
        let [next, last] = [axes[(along + 1) % 3], axes[(along + 2) % 3]];
        for offset in [DVec3::ZERO, next, last, next + last] {
            let start = frame.origin() + offset;
            lines.push([start, start + axes[along]]);
        }
    }
}

/// A square with a grid.
fn square(frame: &Affine, detail: Detail, lines: &mut Vec<Line>) {
    let [x, y, _] = frame.axes();
    let half = if detail.chords < FINE { 1 } else { 4 };
    for line in -half..=half {
        let share = f64::from(line) / f64::from(half);
        for (along, across) in [(x, y), (y, x)] {
            let middle = frame.origin() + share * across;
            lines.push([middle - along, middle + along]);
        }
    }
}

/// Curves in planes across the world's axes.
fn slices(quadric: &Quadric, detail: Detail, within: Aabb, lines: &mut Vec<Line>) {
    let bounds = quadric.bounds().intersection(within);
    if bounds.is_empty() {
        return;
    }
    // Beyond the planes that bound it, so that curves close there.
    let margin = 0.01 * bounds.size();
    let shares: &[f64] = if detail.chords < FINE {
        &[0.5]
    } else {
        &[0.2, 0.5, 0.8]
    };
    for across in 0..3 {
        for share in shares {
            let mut slice = Aabb {
                min: bounds.min - margin,
                max: bounds.max + margin,
            };
            let level = bounds.min[across] + share * bounds.size()[across];
            (slice.min[across], slice.max[across]) = (level, level);
            contour(quadric, slice, across, detail.chords / 2, lines);
        }
    }
}

/// The curve around a quadric in a box that is flat along the axis `across`, by marching squares on
/// a grid of `cells` × `cells`.
fn contour(quadric: &Quadric, slice: Aabb, across: usize, cells: u32, lines: &mut Vec<Line>) {
    let [right, up] = [(across + 1) % 3, (across + 2) % 3];
    let size = slice.size();
    let point = |column: u32, row: u32| {
        let mut point = slice.min;
        point[right] += size[right] * f64::from(column) / f64::from(cells);
        point[up] += size[up] * f64::from(row) / f64::from(cells);
        (point, quadric.excess(point))
    };
    let line_of = |row: u32| (0..=cells).map(|column| point(column, row)).collect();
    let mut below: Vec<_> = line_of(0);
    for row in 1..=cells {
        let above: Vec<_> = line_of(row);
        for column in 0..cells as usize {
            let corners = [
                below[column],
                below[column + 1],
                above[column + 1],
                above[column],
            ];
            let sides = (0..4).map(|side| (corners[side], corners[(side + 1) % 4]));
            let mut crossed = sides.filter_map(|((a, low), (b, high))| {
                let share = low / (low - high);
                ((low <= 0.0) != (high <= 0.0) && share.is_finite()).then(|| a + share * (b - a))
            });
            while let (Some(start), Some(end)) = (crossed.next(), crossed.next()) {
                lines.push([start, end]);
            }
        }
        below = above;
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{
        Cone, Csg, Cuboid, Cylinder, Ellipsoid, Instance, Mesh, MeshParts, Node, Operation, Plane,
    };

    const COARSE: Detail = Detail {
        chords: 12,
        triangles: 100,
    };
    const FINER: Detail = Detail {
        chords: 24,
        triangles: 100,
    };
    const WITHIN: Aabb = Aabb {
        min: DVec3::splat(-4.0),
        max: DVec3::splat(4.0),
    };

    fn frame() -> Affine {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        Affine::new(DVec3::new(1.0, 2.0, 3.0), axes, DVec3::new(1.0, 2.0, 0.5)).expect("a frame")
    }

    fn sphere() -> Solid {
        Solid::Sphere(Sphere {
            centre: DVec3::X,
            radius: 2.0,
        })
    }

    fn lines(shape: &Shape, detail: Detail) -> Vec<Line> {
        let mut lines = Vec::new();
        shape.outline(detail, WITHIN, &mut lines);
        lines
    }

    /// The unit sphere as a quadric, at the origin.
    fn quadric(squares: [f64; 3], constant: f64) -> Solid {
        let [x, y, z] = squares;
        let coefficients = [x, 0.0, 0.0, 0.0, y, 0.0, 0.0, z, 0.0, constant];
        Solid::Quadric(Box::new(Quadric::new(coefficients, &[])))
    }

    #[test]
    fn shapes_have_few_lines_and_large_ones_more() {
        let combined = |solids: [Solid; 2]| {
            let mut nodes: Vec<_> = solids.map(|solid| Node::Leaf { solid, tag: 0 }).into();
            nodes.push(Node::Operation {
                operation: Operation::Difference,
                first: 0,
                second: 1,
            });
            Shape::Csg(Arc::new(Csg::new(nodes)))
        };
        let cuboid = || Solid::Cuboid(Box::new(Cuboid(frame())));
        let cylinder = Solid::Cylinder(Box::new(Cylinder(frame())));
        let cone = Solid::Cone(Box::new(Cone(frame())));
        let ellipsoid = Solid::Ellipsoid(Box::new(Ellipsoid(frame())));
        for (shape, coarse, fine) in [
            (Shape::Solid(sphere()), 3 * 12, 7 * 24),
            (Shape::Solid(ellipsoid), 3 * 12, 7 * 24),
            (Shape::Solid(cuboid()), 12, 12),
            (Shape::Solid(cylinder), 2 * 12 + 4, 2 * 24 + 8),
            (Shape::Solid(cone), 12 + 4, 24 + 8),
            (Shape::Plane(Box::new(Plane(frame()))), 6, 18),
            (combined([cuboid(), sphere()]), 12 + 36, 12 + 168),
        ] {
            let count = |detail| lines(&shape, detail).len();
            assert_eq!((count(COARSE), count(FINER)), (coarse, fine), "{shape:?}");
        }
    }

    #[test]
    fn lines_are_on_the_surface() {
        for line in lines(&Shape::Solid(sphere()), FINER) {
            assert!(
                line.iter()
                    .all(|end| ((end - DVec3::X).length() - 2.0).abs() < 1e-12)
            );
        }
        let within = WITHIN.max + 1e-12;
        for (squares, constant) in [
            ([1.0; 3], -1.0),
            ([1.0, 1.0, 0.0], -1.0),
            ([1.0, 1.0, -1.0], 0.0),
        ] {
            let found = lines(&Shape::Solid(quadric(squares, constant)), FINER);
            assert!(20 < found.len(), "{squares:?}: {}", found.len());
            for point in found.as_flattened() {
                let value = DVec3::from_array(squares).dot(point * point) + constant;
                assert!(value.abs() < 0.3, "{squares:?} {point}: {value}");
                assert!((point.abs() / 1.02).cmple(within).all(), "{point}");
            }
        }
        assert!(lines(&Shape::Solid(quadric([1.0; 3], 1.0)), FINER).is_empty());
    }

    #[test]
    fn a_box_has_each_edge_once() {
        let found = lines(
            &Shape::Solid(Solid::Cuboid(Box::new(Cuboid(frame())))),
            COARSE,
        );
        let mut edges: Vec<_> = found
            .iter()
            .map(|[a, b]| (a.min(*b).to_array(), (b - a).abs().to_array()))
            .collect();
        edges.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
        edges.dedup();
        assert_eq!(edges.len(), 12);
        assert!(edges.contains(&([1.0, 2.0, 3.0], [0.0, 2.0, 0.0])));
    }

    #[test]
    fn of_a_large_mesh_some_triangles_are_shown() {
        let corner = |at: u32| DVec3::new(f64::from(at % 2), f64::from(at / 2), f64::from(at));
        let mesh = Mesh::new(MeshParts {
            positions: (0..12).map(corner).collect(),
            triangles: (0..10).map(|at| [at, at + 1, at + 2]).collect(),
            ..MeshParts::default()
        });
        let identity = Affine::new(DVec3::ZERO, DVec3::AXES, DVec3::ONE).expect("a frame");
        let mesh = Arc::new(mesh.expect("a mesh"));
        let shape = Shape::Mesh(Box::new(Instance::new(mesh, &identity, Vec::new())));
        for (most, shown) in [(10, 10), (5, 5), (4, 4), (1, 1), (0, 1)] {
            let detail = Detail {
                triangles: most,
                ..COARSE
            };
            assert_eq!(lines(&shape, detail).len(), 3 * shown, "{most}");
        }
        let first = lines(&shape, COARSE)[0];
        assert_eq!(first, [corner(0), corner(1)]);
    }
}
