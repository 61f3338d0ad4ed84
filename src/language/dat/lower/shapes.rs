//! The shapes of `.dat`'s solids.

use glam::DVec3;

use crate::geometry::{Affine, Cuboid, Cylinder, Ellipsoid, Shape, Sphere, normalise};
use crate::language::record::Gathered;

/// A sphere.
pub(super) fn sphere(said: &Gathered) -> Shape {
    Shape::Sphere(Sphere {
        centre: said.points[0],
        radius: said.numbers[0],
    })
}

/// An ellipsoid along the axes of the world; `None` where its sizes are beyond what `f64` holds.
pub(super) fn ellipsoid(said: &Gathered) -> Option<Shape> {
    let [x, y, z, ..] = said.numbers;
    let frame = frame(said.points[0], DVec3::AXES, DVec3::new(x, y, z))?;
    Some(Shape::Ellipsoid(Box::new(Ellipsoid(frame))))
}

/// A cylinder around the middle of its axis. The frame is the shortest rotation that takes +z to
/// the axis; for −z half a turn about x.
pub(super) fn cylinder(said: &Gathered) -> Option<Shape> {
    let axis = normalise(said.directions[0])?;
    let [radius, length, ..] = said.numbers;
    let base = said.points[0] - 0.5 * length * axis;
    let frame = frame(base, rotated(axis), DVec3::new(radius, radius, length))?;
    Some(Shape::Cylinder(Box::new(Cylinder(frame))))
}

/// A box around its centre. Its axes are used as given: widths are in lengths of them.
pub(super) fn cuboid(said: &Gathered) -> Option<Shape> {
    let [u, v, w] = said.directions;
    let [wide, high, deep, ..] = said.numbers;
    let corner = said.points[0] - 0.5 * (wide * u + high * v + deep * w);
    let lengths = DVec3::new(wide * u.length(), high * v.length(), deep * w.length());
    let frame = frame(corner, said.directions, lengths)?;
    Some(Shape::Cuboid(Box::new(Cuboid(frame))))
}

/// A frame with numbers; `None` where its place or its lengths are beyond what `f64` holds.
fn frame(origin: DVec3, directions: [DVec3; 3], lengths: DVec3) -> Option<Affine> {
    let holds = origin.is_finite() && lengths.is_finite() && 0.0 < lengths.min_element();
    Affine::new(origin, directions, lengths).filter(|_| holds)
}

/// Where the shortest rotation that takes +z to a unit vector takes x, y and z: Rodrigues' formula
/// with the axis z × n and the cosine n.z.
fn rotated(n: DVec3) -> [DVec3; 3] {
    let across = n.x * n.x + n.y * n.y;
    // 1 / (1 + n.z), without its cancellation below the horizon.
    let share = if 0.0 <= n.z {
        1.0 / (1.0 + n.z)
    } else if across == 0.0 {
        return [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z];
    } else {
        (1.0 - n.z) / across
    };
    [
        DVec3::new(1.0 - share * n.x * n.x, -share * n.x * n.y, -n.x),
        DVec3::new(-share * n.x * n.y, 1.0 - share * n.y * n.y, -n.y),
        n,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Any rotation is a right-handed frame of unit vectors, and the shortest one keeps what lies
    /// across both.
    #[test]
    fn the_frame_of_a_cylinder_is_the_shortest_rotation() {
        for n in [
            DVec3::Z,
            DVec3::NEG_Z,
            DVec3::X,
            DVec3::new(0.6, 0.0, -0.8),
            DVec3::new(1e-9, 0.0, -1.0),
            DVec3::new(2.0, -3.0, -6.0) / 7.0,
            DVec3::new(2.0, -3.0, 6.0) / 7.0,
        ] {
            let [x, y, z] = rotated(n);
            let unit = [x, y, z].map(|v| (v.length() - 1.0).abs());
            assert!(unit.iter().all(|off| *off < 1e-15), "{n}");
            assert!((x.cross(y) - z).length() < 1e-15, "{n}");
            let kept = DVec3::Z.cross(n);
            if let Some(kept) = kept.try_normalize() {
                let turned = kept.x * x + kept.y * y + kept.z * z;
                assert!((turned - kept).length() < 1e-15, "{n}");
            }
        }
        assert_eq!(rotated(DVec3::NEG_Z)[0], DVec3::X);
    }
}
