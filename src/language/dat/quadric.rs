//! Quadrics, which can take any form but have no frame of their own: their place, and their motions.

use glam::{DMat3, DMat4, DVec3, DVec4};

use super::schema::QUADRIC;
use crate::form::{Along, Form, Motion};
use crate::schema::position::At;
use crate::structure::Pose;
use geometry::principal_axes;

/// The places of the coefficients A to J in the symmetric matrix.
const PLACES: [(usize, usize); 10] = [
    (0, 0),
    (0, 1),
    (0, 2),
    (0, 3),
    (1, 1),
    (1, 2),
    (1, 3),
    (2, 2),
    (2, 3),
    (3, 3),
];

/// The first of the coefficients, which follow each other.
const FIRST: At<1> = QUADRIC.at("A");

fn matrix(numbers: &[f64]) -> DMat4 {
    let mut matrix = DMat4::ZERO;
    for ((row, column), number) in PLACES.into_iter().zip(&numbers[FIRST.index()..]) {
        matrix.col_mut(row)[column] = *number;
        matrix.col_mut(column)[row] = *number;
    }
    matrix
}

fn put_matrix(matrix: &DMat4, numbers: &mut [f64]) {
    for ((row, column), number) in PLACES.into_iter().zip(&mut numbers[FIRST.index()..]) {
        *number = matrix.col(row)[column];
    }
}

/// An eigenvalue below this fraction of the largest is due to rounding.
const WEAK: f64 = 1e-9;

/// The place and the principal axes of a quadric; `None` for a plane. Each axis has the number of the
/// world's axis that it is nearest to. Along an axis without curvature, as of a cylinder, the place is
/// in the middle of what the cuts leave.
pub(super) fn pose(numbers: &[f64]) -> Option<Pose> {
    let matrix = matrix(numbers);
    let rows = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|row| row.truncate().to_array());
    let (mut values, mut axes) = principal_axes(rows);
    let largest = values
        .iter()
        .fold(0.0, |most: f64, value| most.max(value.abs()));
    if largest == 0.0 {
        return None;
    }
    for world in 0..3 {
        let share = |own: &usize| axes[*own][world].abs();
        let nearest = (world..3).max_by(|a, b| share(a).total_cmp(&share(b)).then(b.cmp(a)));
        let nearest = nearest.unwrap_or(world);
        axes.swap(world, nearest);
        values.swap(world, nearest);
        if axes[world][world] < 0.0 {
            axes[world] = -axes[world];
        }
    }
    let slope = matrix.w_axis.truncate();
    let mut centre = DVec3::ZERO;
    for (value, axis) in values.into_iter().zip(axes) {
        if WEAK * largest < value.abs() {
            centre -= slope.dot(axis) / value * axis;
        }
    }
    for (value, axis) in values.into_iter().zip(axes) {
        if value.abs() <= WEAK * largest {
            centre += middle(cuts(numbers), centre, axis) * axis;
        }
    }
    Some(Pose { centre, axes })
}

/// The middle, from a point along an axis, of what the cuts across the axis leave; 0 if that has no
/// end.
fn middle(cuts: &[[f64; 4]], point: DVec3, axis: DVec3) -> f64 {
    let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
    for &[x, y, z, distance] in cuts {
        let normal = DVec3::new(x, y, z);
        let along = normal.dot(axis);
        let end = (distance - normal.dot(point)) / along;
        if (1.0 - WEAK) * normal.length() <= along {
            ends[1] = ends[1].min(end);
        } else if along <= -(1.0 - WEAK) * normal.length() {
            ends[0] = ends[0].max(end);
        }
    }
    let middle = 0.5 * ends[0] + 0.5 * ends[1];
    if middle.is_finite() { middle } else { 0.0 }
}

/// The half-spaces that cut a quadric, each as n, d of n · x ≤ d.
fn cuts(numbers: &[f64]) -> &[[f64; 4]] {
    numbers[QUADRIC.numbers()..].as_chunks().0
}

/// Moves a quadric and the half-spaces that cut it: with the inverse B of the motion its matrix
/// becomes Bᵀ Q B, and a normal (n, −d) becomes (n, −d) B.
pub(super) fn moved(numbers: &[f64], motion: &Motion) -> Vec<f64> {
    let (mut to_world, mut origin) = (motion.linear(), motion.point(DVec3::ZERO));
    if let Motion::Scale {
        factor,
        along: Along::Own(axis),
        about,
    } = *motion
        && let Some(pose) = pose(numbers)
    {
        let axis = pose.axes[axis];
        let stretch = |v: DVec3| v + (factor - 1.0) * axis.dot(v) * axis;
        to_world = DMat3::from_cols(stretch(DVec3::X), stretch(DVec3::Y), stretch(DVec3::Z));
        origin = about - to_world * about;
    }
    let inverse = to_world.inverse();
    let back = DMat4 {
        w_axis: (-(inverse * origin)).extend(1.0),
        ..DMat4::from_mat3(inverse)
    };
    let mut new = numbers.to_vec();
    put_matrix(&(back.transpose() * matrix(numbers) * back), &mut new);
    let cuts = new[QUADRIC.numbers()..].as_chunks_mut::<4>().0;
    for cut in cuts {
        let [x, y, z, d] = *cut;
        let moved = back.transpose() * DVec4::new(x, y, z, -d);
        *cut = [moved.x, moved.y, moved.z, -moved.w];
    }
    new
}

/// Writes the coefficients of the ellipsoid of a form.
pub(super) fn put(form: &Form, numbers: &mut [f64]) {
    let column = |axis: usize| {
        let scale = form.axes[axis] / form.half[axis];
        scale.extend(-scale.dot(form.centre))
    };
    let columns = DMat4::from_cols(column(0), column(1), column(2), DVec4::ZERO);
    let mut matrix = columns * columns.transpose();
    matrix.w_axis.w -= 1.0;
    put_matrix(&matrix, numbers);
}
