//! The forms of `.dat` objects: conversion between the numbers of a record and a box that the solid
//! fills, and motions of what has no such form.

use glam::{DMat3, DMat4, DVec3, DVec4};

use super::Source;
use super::table::{LightKind, ObjectKind, RecordKind, SOURCES};
use crate::form::{Along, Form, Motion, PRECISE, rotated, rounded};
use crate::frame::{Lengths, frameless, straight};
use crate::structure::{Pose, number, replacements};
use crate::table::Kind;
use crate::{FieldSpans, Node, SceneText, StructureError};
use geometry::{normalise, principal_axes};
use text::{Edit, Span};

/// The form of an object with these numbers, the material's ID first; `None` for a kind without
/// one.
pub(super) fn form(kind: ObjectKind, numbers: &[f64]) -> Option<Form> {
    use ObjectKind::{Box, Csg, Cylinder, Ellipsoid, Quadric, Sphere};
    Some(match kind {
        Sphere => Form {
            centre: const { Sphere.at("centre") }.vector(numbers),
            axes: DVec3::AXES,
            half: [const { Sphere.at("radius") }.number(numbers); 3],
        },
        Ellipsoid => Form {
            centre: const { Ellipsoid.at("centre") }.vector(numbers),
            axes: DVec3::AXES,
            half: const { [Ellipsoid.at("rx"), Ellipsoid.at("ry"), Ellipsoid.at("rz")] }
                .map(|at| at.number(numbers)),
        },
        Cylinder => {
            let axis = normalise(const { Cylinder.at("axis") }.vector(numbers))?;
            let radius = const { Cylinder.at("radius") }.number(numbers);
            let length = const { Cylinder.at("length") }.number(numbers);
            Form {
                centre: const { Cylinder.at("centre") }.vector(numbers),
                axes: rotated(axis),
                half: [radius, radius, 0.5 * length],
            }
        }
        Box => {
            let axes = const { [Box.at("u"), Box.at("v"), Box.at("w")] };
            let axes = axes.map(|at| at.vector(numbers));
            let widths = const { [Box.at("uw"), Box.at("vw"), Box.at("ww")] };
            let widths = widths.map(|at| at.number(numbers));
            Form {
                centre: const { Box.at("centre") }.vector(numbers),
                axes: axes.map(|axis| normalise(axis).unwrap_or(DVec3::X)),
                half: std::array::from_fn(|axis| 0.5 * widths[axis] * axes[axis].length()),
            }
        }
        Csg | Quadric => return None,
    })
}

/// Writes the numbers of a form; fails with the reason if the kind cannot take it.
pub(super) fn put(kind: ObjectKind, form: &Form, numbers: &mut [f64]) -> Result<(), &'static str> {
    use ObjectKind::{Box, Csg, Cylinder, Ellipsoid, Quadric, Sphere};
    let [a, b, c] = form.half;
    let is_near = |one: f64, other: f64| (one - other).abs() <= 1e-9 * one.abs();
    match kind {
        Sphere if is_near(a, b) && is_near(b, c) => {
            const { Sphere.at("centre") }.put(numbers, form.centre.to_array());
            const { Sphere.at("radius") }.put(numbers, [a]);
        }
        Sphere => return Err("a sphere has a single radius: change its type to ellipsoid first"),
        Ellipsoid => {
            if !is_aligned(form) {
                return Err(
                    "a .dat ellipsoid is always axis-aligned: change its type to quadric first",
                );
            }
            const { Ellipsoid.at("centre") }.put(numbers, form.centre.to_array());
            let radii = const { [Ellipsoid.at("rx"), Ellipsoid.at("ry"), Ellipsoid.at("rz")] };
            for (at, radius) in radii.into_iter().zip(form.aligned()) {
                at.put(numbers, [radius]);
            }
        }
        Cylinder if is_near(a, b) => {
            const { Cylinder.at("centre") }.put(numbers, form.centre.to_array());
            const { Cylinder.at("axis") }.put(numbers, form.axes[2].to_array());
            const { Cylinder.at("radius") }.put(numbers, [a]);
            const { Cylinder.at("length") }.put(numbers, [2.0 * c]);
        }
        Cylinder => return Err("a .dat cylinder has a circular base"),
        Box => {
            let axes: [_; 3] = const { [Box.at("u"), Box.at("v"), Box.at("w")] };
            let widths = const { [Box.at("uw"), Box.at("vw"), Box.at("ww")] };
            const { Box.at("centre") }.put(numbers, form.centre.to_array());
            for axis in 0..3 {
                // Widths are multiples of the axes' lengths, which stay as they are.
                let length = match axes[axis].vector(numbers).length() {
                    0.0 => 1.0,
                    length => length,
                };
                axes[axis].put(numbers, (length * form.axes[axis]).to_array());
                widths[axis].put(numbers, [2.0 * form.half[axis] / length]);
            }
        }
        Quadric => {
            let scale = |axis: usize| form.axes[axis] / form.half[axis];
            let rows = DMat4::from_cols(
                scale(0).extend(-scale(0).dot(form.centre)),
                scale(1).extend(-scale(1).dot(form.centre)),
                scale(2).extend(-scale(2).dot(form.centre)),
                DVec4::ZERO,
            );
            let mut matrix = rows * rows.transpose();
            matrix.w_axis.w -= 1.0;
            put_matrix(&matrix, numbers);
        }
        Csg => return Err("a combination has no size of its own"),
    }
    Ok(())
}

/// Whether the axes of a form are those of the world, in any order.
fn is_aligned(form: &Form) -> bool {
    let is_world = |axis: &DVec3| 1.0 - axis.abs().max_element() < 1e-9;
    form.axes.iter().all(is_world)
}

/// The keys of a quadric's coefficients, with their places in its symmetric matrix.
const COEFFICIENTS: [(&str, usize, usize); 10] = [
    ("A", 0, 0),
    ("B", 0, 1),
    ("C", 0, 2),
    ("D", 0, 3),
    ("E", 1, 1),
    ("F", 1, 2),
    ("G", 1, 3),
    ("H", 2, 2),
    ("I", 2, 3),
    ("J", 3, 3),
];

/// The first of a quadric's coefficients, which follow each other.
const FIRST_COEFFICIENT: usize = ObjectKind::Quadric.at::<1>("A").index();

fn matrix(numbers: &[f64]) -> DMat4 {
    let mut matrix = DMat4::ZERO;
    for (at, (_, row, column)) in COEFFICIENTS.into_iter().enumerate() {
        let number = numbers[FIRST_COEFFICIENT + at];
        matrix.col_mut(row)[column] = number;
        matrix.col_mut(column)[row] = number;
    }
    matrix
}

fn put_matrix(matrix: &DMat4, numbers: &mut [f64]) {
    for (at, (_, row, column)) in COEFFICIENTS.into_iter().enumerate() {
        numbers[FIRST_COEFFICIENT + at] = matrix.col(row)[column];
    }
}

/// An eigenvalue below this fraction of the largest is due to rounding.
const WEAK: f64 = 1e-9;

/// The place and the principal axes of a quadric; `None` for a plane. Each axis has the number of the
/// world's axis that it is nearest to. Along an axis without curvature, as of a cylinder, the place is
/// in the middle of what the cuts leave.
fn quadric_pose(numbers: &[f64], cuts: &[[f64; 4]]) -> Option<Pose> {
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
            centre += middle(cuts, centre, axis) * axis;
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
fn cuts(numbers: &[f64]) -> Vec<[f64; 4]> {
    let count = RecordKind::Object(ObjectKind::Quadric).numbers();
    let cuts = numbers[count..].chunks_exact(4);
    cuts.map(|cut| [cut[0], cut[1], cut[2], cut[3]]).collect()
}

/// Moves a quadric and the half-spaces that cut it: with the inverse B of the motion its matrix
/// becomes Bᵀ Q B, and a normal (n, −d) becomes (n, −d) B.
fn move_quadric(motion: &Motion, numbers: &mut [f64], cuts: &mut [[f64; 4]]) {
    let (mut to_world, mut origin) = (motion.linear(), motion.point(DVec3::ZERO));
    if let Motion::Scale {
        factor,
        along: Along::Own(axis),
        about,
    } = *motion
        && let Some(pose) = quadric_pose(numbers, cuts)
    {
        let axis = pose.axes[axis];
        let stretch = |v: DVec3| v + (factor - 1.0) * axis.dot(v) * axis;
        to_world = DMat3::from_cols(stretch(DVec3::X), stretch(DVec3::Y), stretch(DVec3::Z));
        origin = about - to_world * about;
    }
    let inverse = to_world.inverse();
    let back = DMat4::from_mat3(inverse);
    let back = DMat4 {
        w_axis: (-(inverse * origin)).extend(1.0),
        ..back
    };
    put_matrix(&(back.transpose() * matrix(numbers) * back), numbers);
    for cut in cuts {
        let [x, y, z, d] = *cut;
        let moved = back.transpose() * DVec4::new(x, y, z, -d);
        *cut = [moved.x, moved.y, moved.z, -moved.w];
    }
}

impl Source {
    /// The kind, the fields and the numbers of an object.
    pub(super) fn object_numbers(&self, index: usize) -> Option<(ObjectKind, Vec<Span>, Vec<f64>)> {
        let kind = self.origins.objects.get(index)?.kind;
        let (spans, numbers) = self.numbers(Node::Object(index));
        (RecordKind::Object(kind).numbers() <= numbers.len()).then_some((kind, spans, numbers))
    }

    /// The tokens and the numbers of a node's fields; 0 for a word.
    fn numbers(&self, node: Node) -> (Vec<Span>, Vec<f64>) {
        let fields = self.fields(node);
        let spans: Vec<_> = fields
            .iter()
            .flat_map(|placed| placed.spans.clone())
            .collect();
        let numbers = spans.iter().map(|span| number(&self.text, *span)).collect();
        (spans, numbers)
    }

    /// The place of an object or a light.
    pub(super) fn pose_of(&self, node: Node) -> Option<Pose> {
        match node {
            Node::Object(index) => {
                let (kind, _, numbers) = self.object_numbers(index)?;
                match kind {
                    ObjectKind::Quadric => quadric_pose(&numbers, &cuts(&numbers)),
                    _ => form(kind, &numbers).map(|form| Pose::of(&form)),
                }
            }
            Node::Light(_) => {
                let fields = self.fields(node);
                let is_placed = matches!(self.light_kind(&fields)?, LightKind::Point);
                is_placed.then_some(Pose {
                    centre: self.vector(&fields, "position")?,
                    axes: DVec3::AXES,
                })
            }
            _ => None,
        }
    }

    /// The kind of a light with these fields.
    fn light_kind(&self, fields: &[FieldSpans]) -> Option<LightKind> {
        let word = fields.first()?.spans.first()?.of(&self.text);
        let kind = SOURCES.iter().find(|(known, _)| *known == word);
        kind.map(|(_, kind)| *kind)
    }

    /// The vector of a field.
    fn vector(&self, fields: &[FieldSpans], key: &str) -> Option<DVec3> {
        let placed = fields.iter().find(|placed| placed.field.key == key)?;
        let spans: [Span; 3] = placed.spans.as_slice().try_into().ok()?;
        Some(DVec3::from_array(
            spans.map(|span| number(&self.text, span)),
        ))
    }

    /// The edits that make the frame of a box orthogonal.
    pub(super) fn straightened(&self, node: Node) -> Result<Vec<Edit>, StructureError> {
        let frameless = || frameless(&self.name(node));
        let Node::Object(index) = node else {
            return Err(frameless());
        };
        let numbers = self.object_numbers(index);
        let (_, spans, old) = numbers
            .filter(|(kind, ..)| *kind == ObjectKind::Box)
            .ok_or_else(frameless)?;
        let axes = const {
            let kind = ObjectKind::Box;
            [kind.at("u"), kind.at("v"), kind.at("w")]
        };
        let new = straight(axes, &old, Lengths::Kept)?;
        Ok(replacements(&self.text, &spans, &new))
    }

    /// The form of an ellipsoid after a rotation by which it is no longer aligned with the axes.
    pub(super) fn turned_ellipsoid(&self, index: usize, motion: &Motion) -> Option<Form> {
        let (kind, _, numbers) = self.object_numbers(index)?;
        if kind != ObjectKind::Ellipsoid || !matches!(motion, Motion::Rotate { .. }) {
            return None;
        }
        let turned = motion.applied(&form(kind, &numbers)?)?;
        (!is_aligned(&turned)).then_some(turned)
    }

    /// The edits that move one node.
    pub(super) fn moved(
        &self,
        node: Node,
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError> {
        let refused = |reason: &str| StructureError::Inexpressible(reason.to_owned());
        let fixed =
            || StructureError::Inexpressible(format!("{} has no position", self.name(node)));
        match node {
            Node::Object(index) => {
                let (kind, spans, old) = self.object_numbers(index).ok_or_else(fixed)?;
                let count = RecordKind::Object(kind).numbers();
                let mut new = old.clone();
                if kind == ObjectKind::Quadric {
                    let mut cuts = cuts(&old);
                    move_quadric(motion, &mut new, &mut cuts);
                    new.truncate(count);
                    new.extend(cuts.concat());
                    let kept = old.iter().zip(&new);
                    let new: Vec<_> = kept.map(|(old, new)| rounded(*old, *new, 17)).collect();
                    return Ok(replacements(&self.text, &spans, &new));
                }
                let form = form(kind, &old).ok_or_else(fixed)?;
                let along = "it can only be scaled along its own axes: press the axis key again";
                let form = motion.applied(&form).ok_or_else(|| refused(along))?;
                put(kind, &form, &mut new).map_err(refused)?;
                let fields = RecordKind::Object(kind).fields();
                let kinds = fields
                    .flat_map(|field| std::iter::repeat_n(field.kind, field.kind.components()));
                for ((new, old), kind) in new.iter_mut().zip(&old).zip(kinds) {
                    let is_direction = matches!(kind, Kind::Direction | Kind::Axis);
                    *new = match (is_direction, motion) {
                        (true, Motion::Rotate { .. }) => rounded(*old, *new, PRECISE),
                        (true, _) => *old,
                        (false, _) => rounded(*old, *new, decimals),
                    };
                }
                Ok(replacements(&self.text, &spans, &new))
            }
            Node::Light(_) => {
                use LightKind::{Distant, Point};
                let fields = self.fields(node);
                let kind = self.light_kind(&fields).ok_or_else(fixed)?;
                // Then a distant light shines from its position.
                let is_undirected = self.vector(&fields, "direction") == Some(DVec3::ZERO);
                let mut edits = Vec::new();
                for placed in &fields {
                    let Some(old) = self.vector(&fields, placed.field.key) else {
                        continue;
                    };
                    let (new, decimals) = match (placed.field.key, kind) {
                        ("position", Point) => (motion.point(old), decimals),
                        ("position", Distant) if is_undirected => (motion.direction(old), PRECISE),
                        ("direction", Point | Distant) => (motion.direction(old), PRECISE),
                        _ => continue,
                    };
                    let (old, new) = (old.to_array(), new.to_array());
                    let new: [f64; 3] =
                        std::array::from_fn(|at| rounded(old[at], new[at], decimals));
                    edits.extend(replacements(&self.text, &placed.spans, &new));
                }
                Ok(edits)
            }
            _ => Err(fixed()),
        }
    }
}
