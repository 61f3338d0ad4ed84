//! Scalings, rotations and translations that give an affine map.

use glam::{DMat3, DVec3};

use super::{attribute, element, xyz};
use geometry::principal_axes;

/// The largest difference of the directions of a frame from right angles that is only rounding.
const ROUNDING: f64 = 1e-12;

/// The columns of a matrix, and a translation after it.
pub(super) type Map = ([DVec3; 3], DVec3);

/// Writes the transforms that give an affine map.
pub(super) fn placed(text: &mut String, indent: usize, (columns, origin): Map) {
    let diagonal = DVec3::new(columns[0].x, columns[1].y, columns[2].z);
    if columns == [0, 1, 2].map(|at| diagonal[at] * DVec3::AXES[at]) {
        scaled(text, indent, diagonal);
    } else if is_right(columns) {
        let lengths = DVec3::from_array(columns.map(DVec3::length));
        let (scale, turn) = proper(lengths, [0, 1, 2].map(|at| columns[at] / lengths[at]));
        let scale = DVec3::from_array(scale.to_array().map(short));
        scaled(text, indent, scale);
        turned(text, indent, turn);
    } else {
        skewed(text, indent, columns);
    }
    if origin != DVec3::ZERO {
        element(text, indent, "translate", |text| xyz(text, origin));
    }
}

/// Any matrix M as a rotation, a scaling and a rotation: the singular value decomposition, from the
/// principal axes of M Mᵀ.
fn skewed(text: &mut String, indent: usize, columns: [DVec3; 3]) {
    let matrix = DMat3::from_cols_array_2d(&columns.map(|column| column.to_array()));
    let square = matrix * matrix.transpose();
    let rows = [0, 1, 2].map(|row| square.row(row).to_array());
    let (squares, axes) = principal_axes(rows);
    let sizes = squares.map(|square| libm::sqrt(square.max(0.0)));
    let rows = [0, 1, 2].map(|at| matrix.transpose() * axes[at] / sizes[at]);
    let (sign, first) = proper(DVec3::ONE, rows);
    let (scale, last) = proper(sign * DVec3::from_array(sizes), axes);
    // The first rotation has these rows.
    let first = DMat3::from_cols(first[0], first[1], first[2]).transpose();
    turned(text, indent, [first.x_axis, first.y_axis, first.z_axis]);
    scaled(text, indent, scale);
    turned(text, indent, last);
}

/// The same with a right-handed frame: the sign of the last axis is that of its scale.
fn proper(scale: DVec3, [x, y, z]: [DVec3; 3]) -> (DVec3, [DVec3; 3]) {
    if x.cross(y).dot(z) < 0.0 {
        (scale * DVec3::new(1.0, 1.0, -1.0), [x, y, -z])
    } else {
        (scale, [x, y, z])
    }
}

/// A number rounded to fifteen digits, without the rounding errors of a length.
fn short(number: f64) -> f64 {
    format!("{number:.14e}").parse().unwrap_or(number)
}

fn is_right([x, y, z]: [DVec3; 3]) -> bool {
    let is = |a: DVec3, b: DVec3| a.dot(b).abs() <= ROUNDING * a.length() * b.length();
    is(x, y) && is(x, z) && is(y, z)
}

fn scaled(text: &mut String, indent: usize, scale: DVec3) {
    if scale == DVec3::splat(scale.x) {
        if scale.x != 1.0 {
            element(text, indent, "scale", |text| super::value(text, scale.x));
        }
    } else {
        element(text, indent, "scale", |text| xyz(text, scale));
    }
}

/// Writes the rotations about x, y and z that turn the world's axes to these.
fn turned(text: &mut String, indent: usize, [x, y, z]: [DVec3; 3]) {
    /// The sine of an angle so near to 90° that the other two are not told apart.
    const UPRIGHT: f64 = 1.0 - 1e-15;
    let pitch = libm::asin((-x.z).clamp(-1.0, 1.0));
    let (roll, yaw) = if x.z.abs() < UPRIGHT {
        (libm::atan2(y.z, z.z), libm::atan2(x.y, x.x))
    } else {
        (libm::atan2(-z.y, y.y), 0.0)
    };
    for (axis, angle) in ["x", "y", "z"].into_iter().zip([roll, pitch, yaw]) {
        let degrees = angle.to_degrees();
        if degrees != 0.0 {
            element(text, indent, "rotate", |text| {
                attribute(text, axis, 1.0);
                attribute(text, "angle", degrees);
            });
        }
    }
}
