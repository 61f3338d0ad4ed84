//! Moving, rotating and scaling in `.xml`: the transforms of an object follow, and new ones are
//! written where it has none.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::Source;
use super::origins::fields::numbers;
use super::origins::{Role, insert};
use super::parameter::Parameter;
use crate::field_spans::FieldSpans;
use crate::form::digits::Lengths;
use crate::form::{self, digits};
use crate::form::{Along, Motion, rotation, rounded};
use crate::structure::{Pose, number};
use crate::view::spelled;
use crate::{Node, SceneText, StructureError};
use geometry::normalise;
use text::{Edit, Span, spell_like};

/// A transform of an object.
struct Transform {
    element: usize,
    parameter: &'static Parameter,
    placed: FieldSpans,
    /// Its numbers, as written or by default: a vector, and its factor or an angle.
    numbers: Vec<f64>,
}

impl Transform {
    fn is(&self, name: &str) -> bool {
        self.parameter.element == name
    }

    /// What its vector is multiplied by.
    fn factor(&self) -> f64 {
        let factor = self.numbers.get(3).filter(|_| !self.is("rotate"));
        factor.copied().unwrap_or(1.0)
    }

    fn vector(&self) -> DVec3 {
        self.factor() * DVec3::from_slice(&self.numbers)
    }

    fn matrix(&self) -> DAffine3 {
        let angle = self.numbers.get(3).copied().unwrap_or_default();
        self.parameter.matrix(self.vector(), angle)
    }
}

impl Source {
    /// The place of an object or a light.
    pub(super) fn pose_of(&self, node: Node) -> Option<Pose> {
        match node {
            Node::Object(_) => {
                let element = self.element(node)?;
                let world = self.outside(element) * self.local(element);
                let axes = [world.x_axis, world.y_axis, world.z_axis];
                Some(Pose {
                    centre: world.translation,
                    axes: axes.map(|axis| normalise(axis).unwrap_or(DVec3::X)),
                })
            }
            Node::Light(_) => {
                let fields = self.fields(node);
                let place = fields
                    .iter()
                    .find(|placed| placed.field.key == "position")?;
                Some(Pose {
                    centre: self.vector(place).0,
                    axes: DVec3::AXES,
                })
            }
            _ => None,
        }
    }

    /// The edits that move one node.
    pub(super) fn moved(
        &self,
        node: Node,
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError> {
        match node {
            Node::Object(_) => self.moved_object(node, motion, decimals),
            Node::Light(_) => Ok(self.moved_light(node, motion, decimals)),
            _ => Err(refused(&format!("{} has no position", self.name(node)))),
        }
    }

    fn moved_light(&self, node: Node, motion: &Motion, decimals: usize) -> Vec<Edit> {
        let fields = self.fields(node).into_iter();
        let edits = fields.filter_map(|placed| {
            let key = placed.field.key;
            if !matches!(key, "position" | "direction") {
                return None;
            }
            let (vector, factor) = self.vector(&placed);
            let old = self.numbers(&placed);
            let new = if key == "position" {
                let moved = with_factor(motion.point(vector), factor);
                let pairs = old.iter().zip(moved);
                pairs
                    .map(|(old, new)| rounded(*old, new, decimals))
                    .collect()
            } else {
                let mut moved = with_factor(motion.direction(vector), factor);
                let [before, wanted] = [&old[..], &moved].map(DVec3::from_slice);
                let within = form::tolerance(motion);
                let written = digits::direction(before, wanted, Lengths::Unit, within);
                moved[..3].copy_from_slice(&written.to_array());
                moved.to_vec()
            };
            let changed = self.changed(&placed, &old, &new, spelled);
            Some(self.edits(&[(&placed, changed)]))
        });
        edits.flatten().collect()
    }

    /// The vector of a field, times its factor, and the factor.
    fn vector(&self, placed: &FieldSpans) -> (DVec3, f64) {
        let numbers = self.numbers(placed);
        let factor = numbers.get(3).copied().unwrap_or(1.0);
        (factor * DVec3::from_slice(&numbers), factor)
    }

    /// The numbers of a field, as written or by default.
    fn numbers(&self, placed: &FieldSpans) -> Vec<f64> {
        let number = |(at, span): (usize, &Span)| match placed.default_of(at) {
            Some(default) => default.parse().unwrap_or_default(),
            None => number(&self.text, *span),
        };
        placed.spans.iter().enumerate().map(number).collect()
    }

    /// The values that change numbers of a field. `spelled` spells those that are missing in the text.
    pub(super) fn changed(
        &self,
        placed: &FieldSpans,
        old: &[f64],
        new: &[f64],
        spelled: fn(f64) -> String,
    ) -> Vec<(usize, String)> {
        let changed = old.iter().zip(new).enumerate();
        let changed = changed.filter(|(_, (old, new))| old != new);
        let values = changed.map(|(at, (_, &new))| match placed.default_of(at) {
            Some(_) => (at, spelled(new)),
            None => (at, spell_like(placed.spans[at].of(&self.text).trim(), new)),
        });
        values.collect()
    }

    fn moved_object(
        &self,
        node: Node,
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError> {
        let fixed = || refused(&format!("{} has no position", self.name(node)));
        let element = self.element(node).ok_or_else(fixed)?;
        let outside = self.outside(element);
        let inside = outside.inverse();
        let transforms = self.transforms(element);
        let last = transforms.last().filter(|last| last.is("translate"));
        let linear = transforms.len() - usize::from(last.is_some());
        let linear = transforms[..linear].last();
        let origin = last.map_or(DVec3::ZERO, Transform::vector);
        let mut edits = match *motion {
            Motion::Move(_) => Vec::new(),
            Motion::Rotate { axis, angle, .. } => {
                let uneven =
                    || refused("its group is scaled non-uniformly: rotate the group instead");
                let local = conformal(outside.matrix3).ok_or_else(uneven)?;
                let axis = normalise(inside.matrix3 * axis).ok_or_else(uneven)?;
                let turn = rotation(axis, local.signum() * angle);
                self.turned(element, (linear, last), turn, form::tolerance(motion))
            }
            Motion::Scale { factor, along, .. } => {
                let mut factors = DVec3::ONE;
                match along {
                    Along::All => factors = DVec3::splat(factor),
                    Along::Own(axis) => {
                        factors[axis] = factor;
                        let first = transforms.first();
                        return Ok(self.scaled(element, (first, first), factors, decimals));
                    }
                    Along::World(axis) => {
                        let local = inside.matrix3 * DVec3::AXES[axis];
                        let local = normalise(local).unwrap_or(DVec3::X).abs();
                        let own = (0..3).find(|&own| 1.0 - local[own] < 1e-9);
                        let turned =
                            "its group is rotated: press the axis key again for its own axis";
                        factors[own.ok_or_else(|| refused(turned))?] = factor;
                    }
                }
                self.scaled(element, (linear, last), factors, decimals)
            }
        };
        let point = inside.transform_point3(motion.point(outside.transform_point3(origin)));
        edits.extend(self.placed(element, last, point, decimals)?);
        Ok(edits)
    }

    /// The edits that put an object's last translation at a point.
    fn placed(
        &self,
        element: usize,
        last: Option<&Transform>,
        point: DVec3,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError> {
        if !point.is_finite() {
            return Err(refused("the position is out of range"));
        }
        if let Some(last) = last {
            return Ok(self.set(last, point, decimals));
        }
        let point = point.to_array();
        let point = point.map(|number| rounded(0.0, number, decimals));
        if point == [0.0; 3] {
            return Ok(Vec::new());
        }
        let attributes = attributes(&["x", "y", "z"], &point, 0.0);
        let markup = format!("<translate{attributes}/>");
        Ok(vec![self.inserted(element, None, &markup)])
    }

    /// The edits that rotate an object by a rotation, or write one before another transform; what they
    /// write points where it is to within this angle.
    fn turned(
        &self,
        element: usize,
        (old, before): (Option<&Transform>, Option<&Transform>),
        turn: DMat3,
        within: f64,
    ) -> Vec<Edit> {
        let old = old.filter(|old| old.is("rotate"));
        let known = old.map_or(DMat3::IDENTITY, |old| old.matrix().matrix3);
        let turn = DQuat::from_mat3(&(turn * known)).normalize();
        let (axis, angle) = turn.to_axis_angle();
        let (axis, degrees) = digits::turn(axis, angle.to_degrees(), within);
        let axis = axis.to_array();
        let [x, y, z] = axis;
        if let Some(old) = old {
            self.set_exactly(old, &[x, y, z, degrees])
        } else {
            let mut text = attributes(&["x", "y", "z"], &axis, 0.0);
            text.push_str(&attributes(&["angle"], &[degrees], f64::NAN));
            vec![self.inserted(element, before, &format!("<rotate{text}/>"))]
        }
    }

    /// The edits that multiply a scale, or write one before another transform.
    fn scaled(
        &self,
        element: usize,
        (scale, before): (Option<&Transform>, Option<&Transform>),
        factors: DVec3,
        decimals: usize,
    ) -> Vec<Edit> {
        // A factor needs digits that a short distance does not.
        let least = factors.abs().min_element();
        let decimals = digits::of_length(least, decimals.max(2) + 1);
        let is_uniform = factors.x == factors.y && factors.y == factors.z;
        match scale.filter(|scale| scale.is("scale")) {
            Some(scale) if is_uniform => self.scaled_evenly(scale, factors.x, decimals),
            Some(scale) => self.set(scale, factors * scale.vector(), decimals),
            None => {
                let parts = factors.to_array();
                let parts = parts.map(|factor| rounded(1.0, factor, decimals));
                let text = if is_uniform {
                    attributes(&["value"], &parts[..1], f64::NAN)
                } else {
                    attributes(&["x", "y", "z"], &parts, 1.0)
                };
                vec![self.inserted(element, before, &format!("<scale{text}/>"))]
            }
        }
    }

    /// The edits that multiply all parts of a scale, by its factor if it has one.
    fn scaled_evenly(&self, scale: &Transform, factor: f64, decimals: usize) -> Vec<Edit> {
        let mut new = scale.numbers.clone();
        if let Some(own) = new.get_mut(3) {
            *own *= factor;
            return self.set_numbers(scale, &new, decimals);
        }
        let end = self.tree.elements[scale.element].attributes_end as usize;
        vec![Edit {
            span: Span::at(end),
            text: attributes(&["value"], &[rounded(1.0, factor, decimals)], 1.0),
        }]
    }

    /// The edits that set the vector of a transform, keeping its factor.
    fn set(&self, transform: &Transform, vector: DVec3, decimals: usize) -> Vec<Edit> {
        let numbers = with_factor(vector, transform.factor());
        self.set_numbers(transform, &numbers, decimals)
    }

    fn set_numbers(&self, transform: &Transform, new: &[f64], decimals: usize) -> Vec<Edit> {
        let old = &transform.numbers;
        let new = old
            .iter()
            .zip(new)
            .map(|(old, new)| rounded(*old, *new, decimals));
        self.set_exactly(transform, &new.collect::<Vec<_>>())
    }

    fn set_exactly(&self, transform: &Transform, new: &[f64]) -> Vec<Edit> {
        let old = &transform.numbers;
        let changed = self.changed(&transform.placed, old, new, |new| new.to_string());
        self.edits(&[(&transform.placed, changed)])
    }

    /// The edit that writes a transform before another one, or after the last.
    fn inserted(&self, element: usize, before: Option<&Transform>, markup: &str) -> Edit {
        let tree = &self.tree;
        if let Some(before) = before {
            let next = &tree.elements[before.element];
            return Edit {
                span: Span::at(next.whole.start()),
                text: format!("{markup}{}", next.lead.of(&self.text)),
            };
        }
        let place = match self.transforms(element).last() {
            Some(last) => insert::after(tree, last.element),
            None => insert::first(tree, element),
        };
        place.edit(&self.text, &[markup.to_owned()])
    }

    /// The transforms of an element, in order.
    fn transforms(&self, element: usize) -> Vec<Transform> {
        let children = self.tree.children(element);
        let transforms = children.filter_map(|child| match self.origins.roles.get(child)? {
            Role::Transform(parameter) => {
                let placed = numbers(&self.text, &self.tree, child, parameter);
                Some(Transform {
                    element: child,
                    parameter,
                    numbers: self.numbers(&placed),
                    placed,
                })
            }
            _ => None,
        });
        transforms.collect()
    }

    /// The product of an element's own transforms.
    fn local(&self, element: usize) -> DAffine3 {
        let transforms = self.transforms(element);
        let matrices = transforms.iter().map(Transform::matrix);
        matrices.fold(DAffine3::IDENTITY, |before, next| next * before)
    }

    /// The product of the transforms of all groups around an element.
    pub(super) fn outside(&self, element: usize) -> DAffine3 {
        let mut product = DAffine3::IDENTITY;
        let parent = |element: usize| self.tree.elements.get(element)?.parent;
        let mut next = parent(element);
        while let Some(around) = next {
            product = self.local(around as usize) * product;
            next = parent(around as usize);
        }
        product
    }
}

/// The determinant of a matrix that keeps angles; `None` for one that does not.
fn conformal(matrix: DMat3) -> Option<f64> {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let size = x.length();
    let is_small = |value: f64| value.abs() < 1e-9 * size * size;
    let is_even = is_small(y.length_squared() - size * size)
        && is_small(z.length_squared() - size * size)
        && [x.dot(y), x.dot(z), y.dot(z)].into_iter().all(is_small);
    is_even.then(|| matrix.determinant())
}

/// Attributes with these numbers; those equal to the default are left out.
fn attributes(names: &[&str], numbers: &[f64], default: f64) -> String {
    let pairs = names.iter().zip(numbers);
    let stated = pairs.filter(|(_, number)| **number != default);
    let written: Vec<_> = stated
        .map(|(name, number)| format!(" {name}=\"{number}\""))
        .collect();
    written.concat()
}

fn refused(reason: &str) -> StructureError {
    StructureError::Inexpressible(reason.to_owned())
}

/// The numbers of a vector and a factor of it. A factor of 0, which would leave nothing of it, becomes 1.
fn with_factor(vector: DVec3, factor: f64) -> [f64; 4] {
    let factor = if factor == 0.0 { 1.0 } else { factor };
    let DVec3 { x, y, z } = vector / factor;
    [x, y, z, factor]
}
