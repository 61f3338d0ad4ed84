//! The forms of `.ray` objects: conversion between the numbers of a kind and a box that it fills.

use glam::DVec3;

use super::Source;
use super::table::{LIGHT, MATERIAL, ShapeKind};
use crate::form::{Form, Motion, PRECISE, rounded};
use crate::frame::{Lengths, frameless, straight};
use crate::slot::At;
use crate::structure::{Pose, number, replacements};
use crate::table::{Kind, numbers};
use crate::{Node, SceneText, StructureError};
use geometry::normalise;
use text::{Edit, Span};

const POSITION: At<3> = At::of(LIGHT, "position");

/// Where the numbers of a kind are: the point it stands on or around, its directions, its lengths.
struct Layout {
    point: At<3>,
    axes: Option<[At<3>; 3]>,
    lengths: [At<1>; 3],
    /// What each length measures, in halves of the form's edge.
    halves: [f64; 3],
    /// From the centre to the point, in half edges along each axis.
    offset: [f64; 3],
}

impl Layout {
    fn of(kind: ShapeKind) -> Self {
        const fn layout(
            kind: ShapeKind,
            [point, a, b, c, l, m, n]: [&str; 7],
            halves: [f64; 3],
            offset: [f64; 3],
        ) -> Layout {
            Layout {
                point: kind.at(point),
                axes: Some([kind.at(a), kind.at(b), kind.at(c)]),
                lengths: [kind.at(l), kind.at(m), kind.at(n)],
                halves,
                offset,
            }
        }
        const REVOLVED: [&str; 7] = ["base", "a1", "a2", "axis", "l1", "l2", "height"];
        const BASE: [f64; 3] = [0.0, 0.0, -1.0];
        match kind {
            ShapeKind::Sphere => Self {
                point: ShapeKind::Sphere.at("centre"),
                axes: None,
                lengths: [ShapeKind::Sphere.at("radius"); 3],
                halves: [1.0; 3],
                offset: [0.0; 3],
            },
            ShapeKind::Ellipsoid => {
                const {
                    let keys = ["centre", "v1", "v2", "v3", "l1", "l2", "l3"];
                    layout(ShapeKind::Ellipsoid, keys, [1.0; 3], [0.0; 3])
                }
            }
            ShapeKind::Box => {
                const {
                    let keys = ["corner", "vl", "vw", "vh", "length", "width", "height"];
                    layout(ShapeKind::Box, keys, [2.0; 3], [-1.0; 3])
                }
            }
            ShapeKind::Cylinder => {
                const { layout(ShapeKind::Cylinder, REVOLVED, [1.0, 1.0, 2.0], BASE) }
            }
            ShapeKind::Cone => const { layout(ShapeKind::Cone, REVOLVED, [1.0, 1.0, 2.0], BASE) },
        }
    }

    /// The form of an object with these numbers.
    fn form(&self, numbers: &[f64]) -> Form {
        let axes = self.axes.map_or(DVec3::AXES, |axes| {
            axes.map(|at| normalise(at.vector(numbers)).unwrap_or(DVec3::X))
        });
        let half =
            std::array::from_fn(|axis| self.lengths[axis].number(numbers) / self.halves[axis]);
        let offset = |axis: usize| self.offset[axis] * half[axis] * axes[axis];
        let point = self.point.vector(numbers);
        Form {
            centre: point - (0..3).map(offset).sum::<DVec3>(),
            axes,
            half,
        }
    }

    /// Writes the numbers of a form.
    fn put(&self, form: &Form, numbers: &mut [f64]) {
        let offset = |axis: usize| self.offset[axis] * form.half[axis] * form.axes[axis];
        let point = form.centre + (0..3).map(offset).sum::<DVec3>();
        self.point.put(numbers, point.to_array());
        for (at, axis) in self.axes.iter().flatten().zip(form.axes) {
            at.put(numbers, axis.to_array());
        }
        for axis in 0..3 {
            self.lengths[axis].put(numbers, [self.halves[axis] * form.half[axis]]);
        }
    }
}

/// The numbers of a new object of this form, in a plain material.
pub(super) fn new_object(kind: ShapeKind, form: &Form) -> Vec<f64> {
    let mut values = vec![0.0; numbers(kind.geometry())];
    Layout::of(kind).put(form, &mut values);
    let mut material = vec![0.0; numbers(MATERIAL)];
    At::<3>::of(MATERIAL, "ka").put(&mut material, [0.1; 3]);
    At::<3>::of(MATERIAL, "kd").put(&mut material, [0.6; 3]);
    At::<3>::of(MATERIAL, "ks").put(&mut material, [0.3; 3]);
    At::<1>::of(MATERIAL, "ns").put(&mut material, [20.0]);
    At::<1>::of(MATERIAL, "ior").put(&mut material, [1.0]);
    values.extend(material);
    values
}

/// The numbers of an object after it became one of another kind: the same form and material.
pub(super) fn retyped(old: ShapeKind, new: ShapeKind, values: &[f64]) -> Vec<f64> {
    let form = Layout::of(old).form(values);
    let mut changed = vec![0.0; numbers(new.geometry())];
    Layout::of(new).put(&form, &mut changed);
    changed.extend(&values[numbers(old.geometry())..]);
    changed
}

/// Whether a number of a kind is part of a direction, which rounding would skew.
fn is_direction(kind: ShapeKind, at: usize) -> bool {
    let fields = kind.geometry().iter();
    let components =
        fields.flat_map(|field| std::iter::repeat_n(field.kind, field.kind.components()));
    let mut kinds = components.skip(at);
    kinds.next() == Some(Kind::Direction)
}

impl Source {
    /// The kind and the numbers of an object.
    pub(super) fn object_numbers(&self, index: usize) -> Option<(ShapeKind, Vec<Span>, Vec<f64>)> {
        let kind = self.origins.objects.get(index)?.kind;
        let spans = self.origins.numbers(&self.tree, Node::Object(index));
        let values = spans.iter().map(|span| number(&self.text, *span)).collect();
        (spans.len() == kind.numbers()).then_some((kind, spans, values))
    }

    /// The place of an object or a light.
    pub(super) fn pose_of(&self, node: Node) -> Option<Pose> {
        match node {
            Node::Object(index) => {
                let (kind, _, values) = self.object_numbers(index)?;
                Some(Pose::of(&Layout::of(kind).form(&values)))
            }
            Node::Light(_) => {
                let spans = self.origins.numbers(&self.tree, node);
                let values: Vec<_> = spans.iter().map(|span| number(&self.text, *span)).collect();
                (values.len() == numbers(LIGHT)).then(|| Pose {
                    centre: POSITION.vector(&values),
                    axes: DVec3::AXES,
                })
            }
            _ => None,
        }
    }

    /// The edits that make the frame of an object orthonormal.
    pub(super) fn straightened(&self, node: Node) -> Result<Vec<Edit>, StructureError> {
        let frameless = || frameless(&self.name(node));
        let Node::Object(index) = node else {
            return Err(frameless());
        };
        let (kind, spans, old) = self.object_numbers(index).ok_or_else(frameless)?;
        let axes = Layout::of(kind).axes.ok_or_else(frameless)?;
        let new = straight(axes, &old, Lengths::Unit)?;
        Ok(replacements(&self.text, &spans, &new))
    }

    /// The edits that move one node.
    pub(super) fn moved(
        &self,
        node: Node,
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError> {
        let fixed =
            || StructureError::Inexpressible(format!("{} has no position", self.name(node)));
        match node {
            Node::Object(index) => {
                let (kind, spans, old) = self.object_numbers(index).ok_or_else(fixed)?;
                let layout = Layout::of(kind);
                let uneven = || StructureError::Inexpressible(uneven(kind).to_owned());
                let form = motion.applied(&layout.form(&old)).ok_or_else(uneven)?;
                let [a, b, c] = form.half;
                if kind == ShapeKind::Sphere && (a != b || b != c) {
                    return Err(uneven());
                }
                let mut new = old.clone();
                layout.put(&form, &mut new);
                let turns = matches!(motion, Motion::Rotate { .. });
                for (at, new) in new.iter_mut().enumerate() {
                    *new = match is_direction(kind, at) {
                        true if turns => rounded(old[at], *new, PRECISE),
                        true => old[at],
                        false => rounded(old[at], *new, decimals),
                    };
                }
                Ok(replacements(&self.text, &spans, &new))
            }
            Node::Light(_) => {
                let spans = self.origins.numbers(&self.tree, node);
                let spans = spans.get(..3).ok_or_else(fixed)?;
                let old =
                    DVec3::from_array(std::array::from_fn(|at| number(&self.text, spans[at])));
                let new = motion.point(old).to_array();
                let new: [f64; 3] = std::array::from_fn(|at| rounded(old[at], new[at], decimals));
                Ok(replacements(&self.text, spans, &new))
            }
            _ => Err(fixed()),
        }
    }
}

/// Why a solid cannot be scaled along an axis.
fn uneven(kind: ShapeKind) -> &'static str {
    match kind {
        ShapeKind::Sphere => "a sphere has a single radius: change its type to ellipsoid first",
        _ => "it can only be scaled along its own axes: press the axis key again",
    }
}
