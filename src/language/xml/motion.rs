//! Moving, rotating and scaling in `.xml`: the transforms of an object follow, and new ones are
//! written where it has none.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::Source;
use super::origins::Role;
use super::table::Parameter;
use crate::form::{Along, Motion, PRECISE, rotation, rounded};
use crate::structure::{Pose, number, replacements};
use crate::view::spelled;
use crate::{Node, SceneText, StructureError};
use geometry::normalise;
use text::{Edit, Span, spell_like};

/// A transform of an object.
struct Transform {
    element: usize,
    parameter: &'static Parameter,
}

/// The numbers of a transform, as written or by default.
struct Numbers {
    /// Each with the name of its attribute and its place.
    written: Vec<(&'static str, Option<Span>, f64)>,
    factor: f64,
}

impl Source {
    /// The place of an object or a light.
    pub(super) fn pose_of(&self, node: Node) -> Option<Pose> {
        match node {
            Node::Object(_) => {
                let element = self.origins.element(&self.tree, node)?;
                let world = self.outside(element) * self.local(element);
                let axes = [
                    world.matrix3.x_axis,
                    world.matrix3.y_axis,
                    world.matrix3.z_axis,
                ];
                Some(Pose {
                    centre: world.translation,
                    axes: axes.map(|axis| normalise(axis).unwrap_or(DVec3::X)),
                })
            }
            Node::Light(_) => Some(Pose {
                centre: self.field_vector(node, "position")?,
                axes: DVec3::AXES,
            }),
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
            _ => Err(refused(format!("{} has no position", self.name(node)))),
        }
    }

    fn moved_light(&self, node: Node, motion: &Motion, decimals: usize) -> Vec<Edit> {
        let fields = self.fields(node);
        let wanted = fields.iter().filter_map(|placed| {
            let old = self.field_vector(node, placed.field.key)?;
            let (new, decimals) = match placed.field.key {
                "position" => (motion.point(old), decimals),
                "direction" => (motion.direction(old), PRECISE),
                _ => return None,
            };
            let factor = placed
                .spans
                .get(3)
                .map_or(1.0, |span| number(&self.text, *span));
            let values = (0..3).filter_map(|at| {
                let (old, new) = (old[at] / factor, new[at] / factor);
                let new = rounded(old, new, decimals);
                let spelled = match placed.default_of(at) {
                    Some(_) => spelled(new),
                    None => spell_like(placed.spans[at].of(&self.text).trim(), new),
                };
                (old != new).then_some((at, spelled))
            });
            Some((placed, values.collect()))
        });
        let wanted: Vec<_> = wanted.collect();
        self.edits(&wanted)
    }

    /// The vector of a field, times its factor; `None` if the node has no such field.
    fn field_vector(&self, node: Node, key: &str) -> Option<DVec3> {
        let fields = self.fields(node);
        let placed = fields.iter().find(|placed| placed.field.key == key)?;
        let component = |at: usize| match placed.default_of(at) {
            Some(default) => default.parse().unwrap_or_default(),
            None => placed
                .spans
                .get(at)
                .map_or(0.0, |span| number(&self.text, *span)),
        };
        let factor = if 3 < placed.spans.len() {
            component(3)
        } else {
            1.0
        };
        Some(factor * DVec3::new(component(0), component(1), component(2)))
    }

    fn moved_object(
        &self,
        node: Node,
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError> {
        let fixed = || refused(format!("{} has no position", self.name(node)));
        let element = self.origins.element(&self.tree, node).ok_or_else(fixed)?;
        let outside = self.outside(element);
        let inside = outside.inverse();
        let transforms = self.transforms(element);
        let last = transforms
            .last()
            .filter(|last| last.parameter.element == "translate");
        let before = last.map(|last| self.numbers(last).vector());
        let origin = before.unwrap_or(DVec3::ZERO);
        let point =
            |point: DVec3| inside.transform_point3(motion.point(outside.transform_point3(point)));
        match *motion {
            Motion::Move(_) => self.placed(element, last, point(origin), decimals),
            Motion::Rotate { axis, angle, .. } => {
                let uneven = || {
                    refused(
                        "its group is scaled non-uniformly: rotate the group instead".to_owned(),
                    )
                };
                let local = conformal(outside.matrix3).ok_or_else(uneven)?;
                let axis = normalise(inside.matrix3 * axis).ok_or_else(uneven)?;
                let turn = rotation(axis, local.signum() * angle);
                let mut edits = self.turned(element, &transforms, turn);
                edits.extend(self.placed(element, last, point(origin), decimals)?);
                Ok(sorted(edits))
            }
            Motion::Scale {
                factor,
                along: Along::Own(axis),
                ..
            } => {
                let mut factors = DVec3::ONE;
                factors[axis] = factor;
                let first = transforms.first();
                Ok(self.scaled(element, first, first, factors, decimals))
            }
            Motion::Scale { factor, along, .. } => {
                let factors = match along {
                    Along::World(axis) => {
                        let local = inside.matrix3 * DVec3::AXES[axis];
                        let local = normalise(local).unwrap_or(DVec3::X).abs();
                        let own = (0..3).find(|&own| 1.0 - local[own] < 1e-9);
                        let own = own.ok_or_else(|| {
                            refused(
                                "its group is rotated: press the axis key again for its own axis"
                                    .to_owned(),
                            )
                        })?;
                        let mut factors = DVec3::ONE;
                        factors[own] = factor;
                        factors
                    }
                    Along::All | Along::Own(_) => DVec3::splat(factor),
                };
                let linear = transforms.len() - usize::from(last.is_some());
                let at = transforms[..linear].last();
                let scale = at.filter(|at| at.parameter.element == "scale");
                let mut edits = self.scaled(element, scale, last, factors, decimals);
                edits.extend(self.placed(element, last, point(origin), decimals)?);
                Ok(sorted(edits))
            }
        }
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
            return Err(refused("the position is out of range".to_owned()));
        }
        Ok(if let Some(last) = last {
            self.set(last, point.to_array(), decimals)
        } else {
            let point = point
                .to_array()
                .map(|number| rounded(0.0, number, decimals));
            if point == [0.0; 3] {
                return Ok(Vec::new());
            }
            let attributes = attributes(&["x", "y", "z"], &point, 0.0);
            vec![self.inserted(element, None, &format!("<translate{attributes}/>"))]
        })
    }

    /// The edits that rotate an object before its last translation.
    fn turned(&self, element: usize, transforms: &[Transform], turn: DMat3) -> Vec<Edit> {
        let is = |transform: &&Transform, name| transform.parameter.element == name;
        let last = transforms.last().filter(|last| is(last, "translate"));
        let linear = &transforms[..transforms.len() - usize::from(last.is_some())];
        let old = linear.last().filter(|old| is(old, "rotate"));
        let before = old.map_or(DMat3::IDENTITY, |old| self.matrix(old).matrix3);
        let (axis, angle) = DQuat::from_mat3(&(turn * before))
            .normalize()
            .to_axis_angle();
        let degrees = rounded(0.0, angle.to_degrees(), 12);
        let axis = axis.to_array().map(|number| rounded(0.0, number, PRECISE));
        let [x, y, z] = axis;
        if let Some(old) = old {
            self.set_numbers(old, &[x, y, z, degrees], PRECISE)
        } else {
            let mut text = attributes(&["x", "y", "z"], &axis, 0.0);
            text.push_str(&attributes(&["angle"], &[degrees], f64::NAN));
            vec![self.inserted(element, last, &format!("<rotate{text}/>"))]
        }
    }

    /// The edits that multiply a scale, or write one before another transform.
    fn scaled(
        &self,
        element: usize,
        scale: Option<&Transform>,
        before: Option<&Transform>,
        factors: DVec3,
        decimals: usize,
    ) -> Vec<Edit> {
        // A factor needs digits that a short distance does not.
        let decimals = decimals.max(2) + 1;
        let is_uniform = factors.x == factors.y && factors.y == factors.z;
        match scale.filter(|scale| scale.parameter.element == "scale") {
            Some(scale) if is_uniform => self.scaled_evenly(scale, factors.x, decimals),
            Some(scale) => {
                let scaled = factors * self.numbers(scale).vector();
                self.set(scale, scaled.to_array(), decimals)
            }
            None => {
                let factors = factors
                    .to_array()
                    .map(|factor| rounded(1.0, factor, decimals));
                let text = if is_uniform {
                    attributes(&["value"], &factors[..1], f64::NAN)
                } else {
                    attributes(&["x", "y", "z"], &factors, 1.0)
                };
                vec![self.inserted(element, before, &format!("<scale{text}/>"))]
            }
        }
    }

    /// The edits that multiply all parts of a scale, by its factor if it has one.
    fn scaled_evenly(&self, scale: &Transform, factor: f64, decimals: usize) -> Vec<Edit> {
        let numbers = self.numbers(scale);
        let new = rounded(numbers.factor, factor * numbers.factor, decimals);
        if let Some(value) = self.origins.value(&self.tree, scale.element, "value") {
            replacements(&self.text, &[value.value], &[new])
        } else {
            let end = self.tree.elements[scale.element].attributes_end as usize;
            vec![Edit {
                span: Span::at(end),
                text: attributes(&["value"], &[new], 1.0),
            }]
        }
    }

    /// The edits that set the vector of a transform, keeping its factor.
    fn set(&self, transform: &Transform, vector: [f64; 3], decimals: usize) -> Vec<Edit> {
        let factor = self.numbers(transform).factor;
        let factor = if factor == 0.0 { 1.0 } else { factor };
        self.set_numbers(transform, &vector.map(|number| number / factor), decimals)
    }

    fn set_numbers(&self, transform: &Transform, new: &[f64], decimals: usize) -> Vec<Edit> {
        let numbers = self.numbers(transform);
        let end = self.tree.elements[transform.element].attributes_end as usize;
        let mut edits = Vec::new();
        let mut missing = String::new();
        for ((name, span, old), new) in numbers.written.iter().zip(new) {
            let new = rounded(*old, *new, decimals);
            match span {
                Some(span) => edits.extend(replacements(&self.text, &[*span], &[new])),
                None => missing.push_str(&attributes(&[name], &[new], *old)),
            }
        }
        if !missing.is_empty() {
            edits.push(Edit {
                span: Span::at(end),
                text: missing,
            });
        }
        sorted(edits)
    }

    /// The edit that writes a transform before another one, or after the last.
    fn inserted(&self, element: usize, before: Option<&Transform>, markup: &str) -> Edit {
        let elements = &self.tree.elements;
        if let Some(before) = before {
            let next = &elements[before.element];
            return Edit {
                span: Span::at(next.whole.start()),
                text: format!("{markup}{}", next.lead.of(&self.text)),
            };
        }
        let last = self
            .transforms(element)
            .pop()
            .map(|last| &elements[last.element]);
        if let Some(last) = last {
            return Edit {
                span: Span::at(last.whole.end()),
                text: format!("{}{markup}", last.lead.of(&self.text)),
            };
        }
        let own = &elements[element];
        let lead = own.lead.of(&self.text);
        let indent = if lead.is_empty() { "" } else { "  " };
        if own.is_empty_tag() {
            let name = own.name.of(&self.text);
            return Edit {
                span: Span::new(own.attributes_end as usize, own.tag.end()),
                text: format!(">{lead}{indent}{markup}{lead}</{name}>"),
            };
        }
        let is_empty = own.close as usize == own.tag.end();
        Edit {
            span: Span::at(own.tag.end()),
            text: format!("{lead}{indent}{markup}{}", if is_empty { lead } else { "" }),
        }
    }

    /// The transforms of an element, in order.
    fn transforms(&self, element: usize) -> Vec<Transform> {
        let children = self.tree.children(element);
        let transforms = children.filter_map(|child| match self.origins.roles.get(child)? {
            Role::Transform(parameter) => Some(Transform {
                element: child,
                parameter,
            }),
            _ => None,
        });
        transforms.collect()
    }

    /// The numbers of a transform.
    fn numbers(&self, transform: &Transform) -> Numbers {
        let is_rotation = transform.parameter.element == "rotate";
        let read = |name: &'static str, default: f64| {
            let value = self.origins.value(&self.tree, transform.element, name);
            let value = value.map(|value| value.value);
            let given = value.map_or(default, |span| number(&self.text, span));
            (name, value, given)
        };
        let default = if transform.parameter.element == "scale" {
            1.0
        } else {
            0.0
        };
        let mut written: Vec<_> = ["x", "y", "z"].map(|name| read(name, default)).into();
        let mut factor = 1.0;
        if is_rotation {
            let angle = read("angle", 0.0);
            let value = read("value", 0.0);
            written.push(if angle.1.is_none() && value.1.is_some() {
                value
            } else {
                angle
            });
        } else {
            factor = read("value", 1.0).2;
        }
        Numbers { written, factor }
    }

    fn matrix(&self, transform: &Transform) -> DAffine3 {
        let numbers = self.numbers(transform);
        let vector = numbers.vector();
        match transform.parameter.element {
            "scale" => DAffine3::from_scale(vector),
            "rotate" => match (normalise(vector), numbers.written.get(3)) {
                (Some(axis), Some((_, _, angle))) => DAffine3::from_mat3(rotation(axis, *angle)),
                _ => DAffine3::IDENTITY,
            },
            _ => DAffine3::from_translation(vector),
        }
    }

    /// The product of an element's own transforms.
    fn local(&self, element: usize) -> DAffine3 {
        let transforms = self.transforms(element);
        let matrices = transforms.iter().map(|transform| self.matrix(transform));
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

impl Numbers {
    fn vector(&self) -> DVec3 {
        let part = |at: usize| self.written[at].2;
        self.factor * DVec3::new(part(0), part(1), part(2))
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

fn sorted(mut edits: Vec<Edit>) -> Vec<Edit> {
    Edit::sort(&mut edits);
    edits
}

fn refused(reason: String) -> StructureError {
    StructureError::Inexpressible(reason)
}
