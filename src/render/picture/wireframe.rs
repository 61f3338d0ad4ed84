//! Wireframes: the outlines of a scene's objects as lines in the picture, without tracing a ray.

use rayon::prelude::*;

use crate::world::Projection;
use geometry::{Aabb, Detail};
use scene::{Camera, Object, Objects, Size};

/// The most lines of a wireframe. More would fill the screen, and take longer than a user waits for
/// a step of the camera.
const MOST_LINES: usize = 20_000;

/// The diameter in pixels below which an object is a dot.
const DOT: f64 = 1.0;

/// The limits of the chords of a circle, and pixels of its diameter per chord.
const CHORDS: (f64, f64) = (8.0, 48.0);
const PIXELS_PER_CHORD: f64 = 1.5;

/// Distances from the eye to the target up to which unbounded shapes are shown around the target.
const REACH: f64 = 3.0;

/// The lines of the objects in a picture, the largest objects first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wireframe {
    /// The lines inside the picture.
    pub lines: Vec<WireLine>,
    /// The number of objects that have lines.
    pub drawn: usize,
    /// The number of objects in the picture, at least as many.
    pub seen: usize,
}

/// A line of an object in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WireLine {
    /// Its ends, in pixels from the top left corner.
    pub ends: [[f64; 2]; 2],
    /// The index of the object.
    pub object: u32,
}

/// Computes the wireframe of objects in a picture of this size. There is a limit to its lines: if
/// there are too many objects, those that look smallest are left out.
pub fn wireframe(objects: &Objects, camera: &Camera, raster: Size) -> Wireframe {
    let projection = Projection::new(camera, raster);
    let mut seen: Vec<(f64, u32)> = objects
        .par_numbered()
        .filter_map(|(number, object)| Some((diameter(object, &projection)?, number as u32)))
        .collect();
    let count = seen.len();
    let largest_first =
        |a: &(f64, u32), b: &(f64, u32)| b.0.total_cmp(&a.0).then_with(|| a.1.cmp(&b.1));
    if MOST_LINES < count {
        seen.select_nth_unstable_by(MOST_LINES, largest_first);
        seen.truncate(MOST_LINES);
    }
    seen.sort_unstable_by(largest_first);
    let reach = REACH * (camera.eye - camera.target).length();
    let within = Aabb {
        min: camera.target - reach,
        max: camera.target + reach,
    };
    let mut wireframe = Wireframe {
        seen: count,
        ..Wireframe::default()
    };
    let mut outline = Vec::new();
    for (diameter, number) in seen {
        if MOST_LINES <= wireframe.lines.len() {
            break;
        }
        let shape = &objects[number as usize].shape;
        if diameter < DOT {
            outline.push([shape.bounds().centre(); 2]);
        } else {
            shape.outline(detail(diameter), within, &mut outline);
        }
        let lines = outline.drain(..).filter_map(|ends| projection.line(ends));
        wireframe.lines.extend(lines.map(|ends| WireLine {
            ends,
            object: number,
        }));
        wireframe.drawn += 1;
    }
    wireframe
}

/// The diameter of an object in pixels; `None` if it is not in the picture.
fn diameter(object: &Object, projection: &Projection) -> Option<f64> {
    let bounds = object.shape.bounds();
    if bounds.is_empty() {
        return None;
    }
    projection.diameter(bounds.centre(), bounds.half_diagonal())
}

/// What is worth showing of an object with this diameter in pixels.
fn detail(diameter: f64) -> Detail {
    let chords = (diameter / PIXELS_PER_CHORD).clamp(CHORDS.0, CHORDS.1);
    Detail {
        // Circles have points on both axes.
        chords: (chords / 4.0).ceil() as u32 * 4,
        triangles: (chords * chords) as usize,
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use geometry::{Affine, Cuboid, Shape, Solid, Sphere};
    use scene::{Focus, Lens};

    const RASTER: Size = Size {
        width: 80,
        height: 60,
    };

    /// Looks along −z at the origin; 1 unit is 10 pixels there.
    fn camera(lens: Lens) -> Camera {
        Camera {
            eye: DVec3::new(0.0, 0.0, 3.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            lens,
            pixel_aspect: 1.0,
            depths: Camera::ALL_DEPTHS,
            focus: Focus::PINHOLE,
            size: RASTER,
        }
    }

    fn cube(corner: DVec3) -> Object {
        let frame = Affine::new(corner, DVec3::AXES, DVec3::ONE).expect("a frame");
        Object {
            shape: Shape::Solid(Solid::Cuboid(Box::new(Cuboid(frame)))),
            material: 0,
        }
    }

    fn sphere(centre: DVec3, radius: f64) -> Object {
        Object {
            shape: Shape::Solid(Solid::Sphere(Sphere { centre, radius })),
            material: 0,
        }
    }

    fn of(objects: impl IntoIterator<Item = Object>, lens: Lens) -> Wireframe {
        wireframe(&objects.into_iter().collect(), &camera(lens), RASTER)
    }

    #[test]
    fn the_edges_of_a_unit_cube_match_those_computed_by_hand() {
        let parallel = of([cube(DVec3::ZERO)], Lens::Orthographic(6.0));
        let diverging = of([cube(DVec3::ZERO)], Lens::Perspective(90.0));
        // In the picture the origin is at 40, 30; at z = 1 a unit is 15 pixels.
        for (wireframe, near) in [(parallel, 10.0), (diverging, 15.0)] {
            assert_eq!(wireframe.lines.len(), 12);
            for (depth, unit) in [("far", 10.0), ("near", near)] {
                let corner = |x: f64, y: f64| [40.0 + unit * x, 30.0 - unit * y];
                for (a, b) in [
                    (corner(0.0, 0.0), corner(1.0, 0.0)),
                    (corner(0.0, 1.0), corner(1.0, 1.0)),
                    (corner(0.0, 0.0), corner(0.0, 1.0)),
                    (corner(1.0, 0.0), corner(1.0, 1.0)),
                ] {
                    let is_near = |line: &WireLine| {
                        let pairs = line.ends.iter().flatten().zip([a, b].concat());
                        pairs.into_iter().all(|(is, want)| (is - want).abs() < 1e-9)
                    };
                    let found = wireframe.lines.iter().any(is_near);
                    assert!(found, "{depth} {a:?} {b:?} in {wireframe:?}");
                }
            }
        }
    }

    #[test]
    fn lines_end_at_the_edges_of_the_picture_and_before_the_eye() {
        let camera = camera(Lens::Perspective(90.0));
        let projection = Projection::new(&camera, RASTER);
        let line = |a: [f64; 3], b: [f64; 3]| projection.line([a, b].map(DVec3::from));
        let across = line([-100.0, 0.0, 0.0], [100.0, 0.0, 0.0]);
        assert_eq!(across, Some([[0.0, 30.0], [80.0, 30.0]]));
        let past_the_eye = line([1.0, 0.0, 0.0], [1.0, 0.0, 9.0]).expect("its start is seen");
        assert_eq!(past_the_eye, [[50.0, 30.0], [80.0, 30.0]]);
        assert_eq!(line([0.0, 0.0, 4.0], [1.0, 0.0, 9.0]), None);
        assert_eq!(line([9.0, 0.0, 0.0], [9.0, 1.0, 0.0]), None);
        assert_eq!(line([0.0; 3], [0.0; 3]), Some([[40.0, 30.0]; 2]));
        let up = line([0.0; 3], [0.0, 1.0, 0.0]);
        assert_eq!(up, Some([[40.0, 30.0], [40.0, 20.0]]));
    }

    #[test]
    fn objects_outside_the_picture_have_no_lines_and_tiny_ones_are_dots() {
        let lens = Lens::Perspective(90.0);
        for hidden in [
            DVec3::new(0.0, 0.0, 9.0),
            DVec3::new(9.0, 0.0, 0.0),
            DVec3::new(0.0, -9.0, 0.0),
        ] {
            assert_eq!(of([cube(hidden)], lens), Wireframe::default(), "{hidden}");
        }
        let dot = of([sphere(DVec3::ZERO, 0.01)], lens);
        let ends = [[40.0, 30.0]; 2];
        assert_eq!(dot.lines, [WireLine { ends, object: 0 }]);
    }

    #[test]
    fn of_too_many_objects_the_largest_are_drawn() {
        let small = |at: u32| {
            let angle = f64::from(at) * 0.001;
            sphere(0.5 * DVec3::new(angle.cos(), angle.sin(), 0.0), 0.001)
        };
        let count = MOST_LINES as u32 + 500;
        let objects = (0..count).map(small).chain([cube(DVec3::ZERO)]);
        let wireframe = of(objects, Lens::Perspective(90.0));
        assert_eq!(wireframe.seen, count as usize + 1);
        assert_eq!(wireframe.lines.len(), MOST_LINES);
        // The cube has twelve lines, the others one each.
        assert_eq!(wireframe.drawn, MOST_LINES - 11);
        assert!(
            wireframe.lines[..12]
                .iter()
                .all(|line| line.object == count)
        );
    }
}
