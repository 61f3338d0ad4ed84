//! Moves, turns and scales nodes, and changes solids to others, by what their numbers are in space.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::field_spans::FieldSpans;
use crate::form::digits::Lengths;
use crate::form::{self, digits};
use crate::form::{Form, rounded};
use crate::frame::{frameless, straight};
use crate::node::Node;
use crate::schema::layout::Unfit;
use crate::schema::{Field, Part, Record, Schema};
use crate::structure::{Pose, number, replacements};
use crate::{Motion, SceneText, StructureError};
use text::{Edit, Span};

/// The numbers of an object.
pub(crate) struct ObjectNumbers {
    pub(crate) record: &'static Record,
    pub(crate) spans: Vec<Span>,
    pub(crate) values: Vec<f64>,
}

impl ObjectNumbers {
    /// Its form; `None` if it is no unit solid.
    pub(crate) fn form(&self) -> Option<Form> {
        self.record.layout.as_ref()?.form(&self.values)
    }
}

/// A text whose objects are mostly unit solids, placed by the numbers of their records.
pub(crate) trait Moves {
    /// The records of its language.
    fn schema(&self) -> &'static Schema;

    /// The record of an object.
    fn object_record(&self, object: usize) -> Option<&'static Record>;

    /// The kind of object that can take any form, if that is another than a unit solid.
    fn general(&self) -> Option<&'static str> {
        None
    }

    /// What a field of a light is in space.
    fn part_of_light(&self, fields: &[FieldSpans], field: &Field) -> Part {
        let _ = fields;
        field.part
    }

    /// The place of an object that is no unit solid.
    fn other_pose(&self, record: &Record, numbers: &[f64]) -> Option<Pose> {
        let _ = (record, numbers);
        None
    }

    /// The numbers of an object that is no unit solid after a motion; `None` if it has no place.
    fn other_moved(&self, record: &Record, numbers: &[f64], motion: &Motion) -> Option<Vec<f64>> {
        let _ = (record, numbers, motion);
        None
    }

    /// Returns the edits that make an object one of another kind, of this form.
    ///
    /// # Errors
    ///
    /// Fails if the kind cannot take the form.
    fn respelled(
        &self,
        object: usize,
        kind: &str,
        form: &Form,
    ) -> Result<Vec<Edit>, StructureError>;

    /// The numbers of an object; `None` if its record breaks off.
    fn object_numbers(&self, index: usize) -> Option<ObjectNumbers>
    where
        Self: SceneText,
    {
        let node = Node::Object(index);
        let record = self.object_record(index)?;
        let fields = self.fields(node);
        let spans: Vec<_> = fields
            .iter()
            .flat_map(|placed| placed.spans.clone())
            .collect();
        let values: Vec<_> = spans
            .iter()
            .map(|span| number(self.text(), *span))
            .collect();
        (record.numbers() <= values.len()).then_some(ObjectNumbers {
            record,
            spans,
            values,
        })
    }

    /// The place of an object or a light.
    fn pose_of(&self, node: Node) -> Option<Pose>
    where
        Self: SceneText,
    {
        match node {
            Node::Object(index) => {
                let numbers = self.object_numbers(index)?;
                match numbers.form() {
                    Some(form) => Some(Pose::of(&form)),
                    None => self.other_pose(numbers.record, &numbers.values),
                }
            }
            Node::Light(_) => {
                let fields = self.fields(node);
                let is_place = |placed: &&FieldSpans| {
                    matches!(self.part_of_light(&fields, placed.field), Part::Point(_))
                };
                Some(Pose {
                    centre: self.vector(fields.iter().find(is_place)?)?,
                    axes: DVec3::AXES,
                })
            }
            _ => None,
        }
    }

    /// The vector of a field.
    fn vector(&self, placed: &FieldSpans) -> Option<DVec3>
    where
        Self: SceneText,
    {
        let spans: [Span; 3] = placed.spans.as_slice().try_into().ok()?;
        Some(DVec3::from_array(
            spans.map(|span| number(self.text(), span)),
        ))
    }

    /// The edits that make the frame of a solid orthogonal.
    fn straightened(&self, node: Node) -> Result<Vec<Edit>, StructureError>
    where
        Self: SceneText,
    {
        let numbers = match node {
            Node::Object(index) => self.object_numbers(index),
            _ => None,
        };
        let frame = numbers.and_then(|numbers| {
            let layout = numbers.record.layout.as_ref()?;
            Some((numbers, layout.frame()?, layout.is_relative()))
        });
        let (numbers, axes, is_relative) = frame.ok_or_else(|| frameless(&self.name(node)))?;
        let lengths = if is_relative {
            Lengths::Kept
        } else {
            Lengths::Unit
        };
        let new = straight(axes, &numbers.values, lengths)?;
        Ok(replacements(self.text(), &numbers.spans, &new))
    }

    /// The edits that move one node.
    fn moved(
        &self,
        node: Node,
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError>
    where
        Self: SceneText,
    {
        let fixed =
            || StructureError::Inexpressible(format!("{} has no position", self.name(node)));
        match node {
            Node::Object(index) => {
                let numbers = self.object_numbers(index).ok_or_else(fixed)?;
                if numbers.record.layout.is_some() {
                    return self.moved_solid(index, &numbers, motion, decimals);
                }
                let new = self
                    .other_moved(numbers.record, &numbers.values, motion)
                    .ok_or_else(fixed)?;
                let kept = numbers.values.iter().zip(&new);
                let new: Vec<_> = kept.map(|(old, new)| rounded(*old, *new, 17)).collect();
                Ok(replacements(self.text(), &numbers.spans, &new))
            }
            Node::Light(_) => {
                let fields = self.fields(node);
                let edits = fields.iter().filter_map(|placed| {
                    let old = self.vector(placed)?;
                    let new = match self.part_of_light(&fields, placed.field) {
                        Part::Point(_) => {
                            let new = motion.point(old);
                            [0, 1, 2].map(|at| rounded(old[at], new[at], decimals))
                        }
                        Part::Direction => form::turned(old, motion).to_array(),
                        Part::None | Part::Axis(_) | Part::Length(..) => return None,
                    };
                    Some(replacements(self.text(), &placed.spans, &new))
                });
                Ok(edits.flatten().collect())
            }
            _ => Err(fixed()),
        }
    }

    /// The edits that move nodes, each once.
    fn all_moved(
        &self,
        nodes: impl Iterator<Item = Node>,
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError>
    where
        Self: SceneText,
    {
        let mut edits = Vec::new();
        for node in nodes.collect::<BTreeSet<_>>() {
            edits.extend(self.moved(node, motion, decimals)?);
        }
        Edit::sort(&mut edits);
        Ok(edits)
    }

    fn moved_solid(
        &self,
        index: usize,
        numbers: &ObjectNumbers,
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError>
    where
        Self: SceneText,
    {
        let ObjectNumbers {
            record,
            spans,
            values: old,
        } = numbers;
        let along = "it can only be scaled along its own axes: press the axis key again";
        let form = numbers.form().and_then(|form| motion.applied(&form));
        let form = form.ok_or_else(|| StructureError::Inexpressible(along.to_owned()))?;
        let mut new = old.clone();
        let turns = matches!(motion, Motion::Rotate { .. });
        if let Some(layout) = &record.layout
            && let Err(unfit) = layout.put(&form, &mut new)
        {
            return match self.general().filter(|_| turns && unfit == Unfit::Turned) {
                Some(general) => self.respelled(index, general, &form),
                None => Err(refusal(unfit, self.schema().extension, record.name)),
            };
        }
        let fields = record.fields();
        let fields = fields.flat_map(|field| std::iter::repeat_n(field, field.kind.components()));
        for ((new, old), field) in new.iter_mut().zip(old).zip(fields) {
            *new = match field.part {
                Part::Axis(_) if turns => *new,
                Part::Axis(_) => *old,
                Part::Length(..) => rounded(*old, *new, digits::of_length(*new, decimals)),
                _ => rounded(*old, *new, decimals),
            };
        }
        if turns && let Some(layout) = &record.layout {
            layout.shorten_axes(old, &mut new, form::tolerance(motion));
        }
        Ok(replacements(self.text(), spans, &new))
    }

    /// Returns the edits that change an object to another kind of about the same form.
    fn retyped(&self, object: usize, kind: &str) -> Result<Vec<Edit>, StructureError>
    where
        Self: SceneText,
    {
        let refused = |reason: &str| StructureError::Inexpressible(reason.to_owned());
        let form = self
            .object_numbers(object)
            .and_then(|numbers| numbers.form());
        let form = form.ok_or_else(|| refused("it has no size that another type could use"))?;
        let new = self.schema().solids().find(|record| record.name == kind);
        if new.is_none() && self.general() != Some(kind) {
            return Err(refused("only solids and lights can change their type"));
        }
        let form = match new.and_then(|record| record.layout.as_ref()) {
            Some(layout) => layout.nearest(&form),
            None => form,
        };
        self.respelled(object, kind, &form)
    }
}

/// The numbers of a record, of which those that place a unit solid are of a form and all others are 0.
///
/// # Errors
///
/// Fails if they cannot describe the form.
pub(crate) fn numbers_of(
    schema: &Schema,
    record: &Record,
    form: &Form,
) -> Result<Vec<f64>, StructureError> {
    let mut numbers = vec![0.0; record.numbers()];
    if let Some(layout) = &record.layout {
        let put = layout.put(form, &mut numbers);
        put.map_err(|unfit| refusal(unfit, schema.extension, record.name))?;
    }
    Ok(numbers)
}

/// Why a record of this name, in a language with this extension, cannot take a form.
fn refusal(unfit: Unfit, extension: &str, name: &str) -> StructureError {
    StructureError::Inexpressible(match unfit {
        Unfit::Uneven => {
            format!("a {name} has a single radius: change its type to ellipsoid first")
        }
        Unfit::Elliptic => format!("a .{extension} {name} has a circular base"),
        Unfit::Turned => {
            format!(
                "a .{extension} {name} is always axis-aligned: change its type to quadric first"
            )
        }
    })
}
