//! The solids of `.dat` objects.

use glam::DVec3;

use crate::dat::table::ObjectKind;
use crate::form::rotated;
use crate::table::Range;
use geometry::{Affine, Cuboid, Cylinder, Ellipsoid, Solid, Sphere, normalise};

/// A sphere.
pub(super) fn sphere(numbers: &[f64]) -> Solid {
    const SPHERE: ObjectKind = ObjectKind::Sphere;
    Solid::Sphere(Sphere {
        centre: const { SPHERE.at("centre") }.vector(numbers),
        radius: const { SPHERE.at("radius") }.number(numbers),
    })
}

/// An axis-aligned ellipsoid; `None` if it is out of range.
pub(super) fn ellipsoid(numbers: &[f64]) -> Option<Solid> {
    const ELLIPSOID: ObjectKind = ObjectKind::Ellipsoid;
    let centre = const { ELLIPSOID.at("centre") }.vector(numbers);
    let radii = DVec3::new(
        const { ELLIPSOID.at("rx") }.number(numbers),
        const { ELLIPSOID.at("ry") }.number(numbers),
        const { ELLIPSOID.at("rz") }.number(numbers),
    );
    let frame = frame(centre, DVec3::AXES, radii)?;
    Some(Solid::Ellipsoid(Box::new(Ellipsoid(frame))))
}

/// A cylinder around the middle of its axis. Its frame is the shortest rotation from +z to the
/// axis; for −z a half turn about x.
pub(super) fn cylinder(numbers: &[f64]) -> Option<Solid> {
    const CYLINDER: ObjectKind = ObjectKind::Cylinder;
    let axis = normalise(const { CYLINDER.at("axis") }.vector(numbers))?;
    let radius = const { CYLINDER.at("radius") }.number(numbers);
    let length = const { CYLINDER.at("length") }.number(numbers);
    let centre = const { CYLINDER.at("centre") }.vector(numbers);
    let base = centre - 0.5 * length * axis;
    let frame = frame(base, rotated(axis), DVec3::new(radius, radius, length))?;
    Some(Solid::Cylinder(Box::new(Cylinder(frame))))
}

/// A box around its centre. Its axes are used as given: widths are multiples of their lengths.
pub(super) fn cuboid(numbers: &[f64]) -> Option<Solid> {
    const BOX: ObjectKind = ObjectKind::Box;
    let [u, v, w] = const { [BOX.at("u"), BOX.at("v"), BOX.at("w")] }.map(|at| at.vector(numbers));
    let widths = const { [BOX.at("uw"), BOX.at("vw"), BOX.at("ww")] };
    let [wide, high, deep] = widths.map(|at| at.number(numbers));
    let centre = const { BOX.at("centre") }.vector(numbers);
    let corner = centre - 0.5 * (wide * u + high * v + deep * w);
    let lengths = DVec3::new(wide * u.length(), high * v.length(), deep * w.length());
    let frame = frame(corner, [u, v, w], lengths)?;
    Some(Solid::Cuboid(Box::new(Cuboid(frame))))
}

/// A frame; `None` if its origin overflows, or its lengths are no sizes.
fn frame(origin: DVec3, directions: [DVec3; 3], lengths: DVec3) -> Option<Affine> {
    let are_sizes = lengths
        .to_array()
        .map(|length| Range::Size.contains(length));
    let holds = origin.is_finite() && are_sizes == [true; 3];
    Affine::new(origin, directions, lengths).filter(|_| holds)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Any rotation gives a right-handed frame of unit vectors, and the shortest one fixes what is
    /// perpendicular to +z and the axis.
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
