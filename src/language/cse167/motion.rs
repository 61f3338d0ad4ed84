//! Motions of what `.test` places: of a sphere or a light by its own numbers, of anything else by
//! transforms in a push and pop of its own.

use std::fmt::{self, Display, Formatter};
use std::ops::Range;

use glam::{DAffine3, DVec3};

use super::Source;
use super::lower::Placed;
use super::schema::{POP, PUSH, ROTATE, SCALE, SCHEMA, SPHERE, TRANSLATE, TRI, TRI_NORMAL};
use crate::engine::identities::kind;
use crate::engine::motion::Moves;
use crate::engine::places::{Place, fields};
use crate::field_spans::FieldSpans;
use crate::form::digits::Lengths;
use crate::form::{self, digits};
use crate::form::{Along, Form, rounded};
use crate::schema::{Makes, Part, Record, Schema};
use crate::spelling::rounded_off;
use crate::structure::{Pose, number, replacements};
use crate::view::{line_ending, line_from, spelled};
use crate::{Motion, Node, SceneText, StructureError};
use text::{Edit, Span, line_end};

/// The largest relative difference that counts as rounding.
const ROUNDING: f64 = 1e-9;
/// Decimals of numbers that are sums of shorter ones: fewer than show the rounding errors of binary
/// fractions.
const MOST: usize = 15;
/// The least decimals of a factor.
const FACTOR_DECIMALS: usize = 4;

impl Moves for Source {
    fn schema(&self) -> &'static Schema {
        &SCHEMA
    }

    fn object_record(&self, object: usize) -> Option<&'static Record> {
        Some(self.origins.objects().get(object)?.record)
    }

    fn respelled(&self, _: usize, _: &str, _: &Form) -> Result<Vec<Edit>, StructureError> {
        let reason = "spheres and meshes keep their type";
        Err(StructureError::Inexpressible(reason.to_owned()))
    }

    fn pose_of(&self, node: Node) -> Option<Pose> {
        let own = &self.origins.own;
        let (centre, transform) = match node {
            Node::Object(object) => {
                let placed = own.objects.get(object)?;
                (placed.centre, placed.transform)
            }
            Node::Light(light) => {
                let transform = *own.lights.get(light)?;
                let fields = self.fields(node);
                let is_place = |placed: &&FieldSpans| matches!(placed.field.part, Part::Point(_));
                let place = self.vector(fields.iter().find(is_place)?)?;
                (transform.transform_point3(place), DAffine3::IDENTITY)
            }
            _ => return None,
        };
        let columns = [transform.x_axis, transform.y_axis, transform.z_axis];
        let axes = columns.map(|column| column.try_normalize().unwrap_or(DVec3::X));
        Some(Pose { centre, axes })
    }

    fn moved(
        &self,
        node: Node,
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError> {
        let fixed =
            || StructureError::Inexpressible(format!("{} has no position", self.name(node)));
        let own = &self.origins.own;
        match node {
            Node::Light(light) => {
                let transform = *own.lights.get(light).ok_or_else(fixed)?;
                Ok(self.moved_by_numbers(node, &transform, motion, decimals))
            }
            Node::Object(object) => {
                let place = *self.origins.objects().get(object).ok_or_else(fixed)?;
                let placed = *own.objects.get(object).ok_or_else(fixed)?;
                let is_even = match motion {
                    Motion::Move(_) => true,
                    Motion::Rotate { .. } => is_similar(&placed.transform),
                    Motion::Scale { along, .. } => *along == Along::All,
                };
                if *place.record == SPHERE && is_even {
                    return Ok(self.moved_by_numbers(node, &placed.transform, motion, decimals));
                }
                self.wrapped([place.at, place.end], &placed, motion, decimals)
            }
            _ => Err(fixed()),
        }
    }
}

impl Source {
    /// The commands of an object: its line, or those of its triangles, and the transforms around them in a
    /// push and pop that hold nothing else.
    pub(super) fn commands(&self, object: usize) -> Vec<usize> {
        let Some(place) = self.origins.objects().get(object) else {
            return Vec::new();
        };
        let is =
            |at: usize, kinds: &[Record]| self.kind(at).is_some_and(|kind| kinds.contains(kind));
        let own = (place.at..=place.end).filter(|&at| at == place.at || is(at, &[TRI, TRI_NORMAL]));
        let own: Vec<_> = own.collect();
        let is_transform = |at: &usize| is(*at, &[TRANSLATE, SCALE, ROTATE]);
        let first = (0..place.at).rev().find(|at| !is_transform(at));
        let (Some(push), pop) = (first, place.end + 1) else {
            return own;
        };
        let is_alone = own.len() == place.end + 1 - place.at;
        if is_alone && is(push, &[PUSH]) && is(pop, &[POP]) {
            (push..=pop).collect()
        } else {
            own
        }
    }

    /// Fails if two nodes are of several lines, or a state changes between them.
    pub(super) fn check_exchange(&self, [first, second]: [Node; 2]) -> Result<(), StructureError> {
        let refused = |reason: &str| Err(StructureError::Inexpressible(reason.to_owned()));
        let (Some(before), Some(behind)) = (self.origins.get(first), self.origins.get(second))
        else {
            return Ok(());
        };
        let is_single = |place: &&Place| place.record.makes != Makes::State;
        if [before, behind].iter().any(|place| !is_single(place)) {
            return refused("a mesh keeps its place: its triangles are many lines");
        }
        let mut between = (before.at + 1..behind.at).filter_map(|at| self.kind(at));
        if between.any(|kind| kind.makes == Makes::State) {
            return refused("the state changes between them: move the lines in the text");
        }
        Ok(())
    }

    /// The kind of a command; `None` if it is unknown.
    pub(super) fn kind(&self, at: usize) -> Option<&'static Record> {
        kind(&SCHEMA, &self.text, &self.tree.tokens(&self.text, at)).ok()
    }

    /// The edits of a node's own numbers, which are in a space with this transform.
    fn moved_by_numbers(
        &self,
        node: Node,
        transform: &DAffine3,
        motion: &Motion,
        decimals: usize,
    ) -> Vec<Edit> {
        let back = transform.inverse();
        let decimals = decimals + finer(transform);
        let mut edits = Vec::new();
        for placed in self.fields(node) {
            let new = match (placed.field.part, self.vector(&placed), motion) {
                (Part::Point(_), Some(old), _) => {
                    let moved = motion.point(transform.transform_point3(old));
                    let new = back.transform_point3(moved);
                    [0, 1, 2]
                        .map(|at| rounded(old[at], new[at], decimals))
                        .to_vec()
                }
                (Part::Direction, Some(old), Motion::Rotate { .. }) => {
                    let moved = motion.direction(transform.transform_vector3(old));
                    let new = back.transform_vector3(moved);
                    let within = form::tolerance(motion);
                    digits::direction(old, new, Lengths::Unit, within)
                        .to_array()
                        .to_vec()
                }
                (_, _, Motion::Scale { factor, .. }) if placed.field.key == "radius" => {
                    let old = number(&self.text, placed.spans[0]);
                    let new = factor * old;
                    vec![rounded(old, new, digits::of_length(new, decimals))]
                }
                _ => continue,
            };
            edits.extend(replacements(&self.text, &placed.spans, &new));
        }
        edits
    }

    /// The edits that put transforms around some commands: into a push and pop of their own if they have
    /// one, where transforms of the same kind become one, otherwise into a new one.
    fn wrapped(
        &self,
        [first, last]: [usize; 2],
        placed: &Placed,
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError> {
        let (text, own) = (&*self.text, &self.origins.own);
        let end = line_ending(text);
        let line = |at: usize| {
            let span = self.tree.span(at);
            Span::new(line_from(text, span.start()), line_end(text, span.end()))
        };
        let indent = |at: usize| &text[line(at).start()..self.tree.span(at).start()];
        let insert = |at, text| Edit {
            span: Span::at(at),
            text,
        };
        let push = self.own_push(first, last);
        // Scaling along its own axes acts before all other transforms.
        let is_own = matches!(
            motion,
            Motion::Scale {
                along: Along::Own(_),
                ..
            }
        );
        let frame = push
            .filter(|_| !is_own)
            .and_then(|push| own.pushed.get(&push));
        let frame = frame.unwrap_or(&placed.transform);
        let decimals = decimals + finer(frame);
        let mut new = transforms(frame, placed.centre, motion)?;
        for one in &mut new {
            one.shorten(form::tolerance(motion), decimals);
        }
        let lines = |indent: &str, before: &str, behind: &str| -> String {
            let lines = new.iter().map(Transform::to_string);
            lines
                .flat_map(|one| [before, indent, &one, behind].map(str::to_owned))
                .collect()
        };
        let Some(push) = push else {
            let indent = indent(first);
            let opening = format!("{indent}{}{end}{}", PUSH.name, lines(indent, "", end));
            return Ok(vec![
                insert(self.block_span(first).start(), opening),
                insert(line(last).end(), format!("{end}{indent}{}", POP.name)),
            ]);
        };
        let begin = if is_own {
            first.saturating_sub(new.len())
        } else {
            0
        };
        let known = begin.max(push + 1)..first;
        if let Some(edits) = self.joined(known, &new, (is_own, decimals)) {
            return Ok(edits);
        }
        Ok(vec![if is_own {
            insert(
                self.block_span(first).start(),
                lines(indent(first), "", end),
            )
        } else {
            insert(line(push).end(), lines(indent(push + 1), end, ""))
        }])
    }

    /// The edits that join transforms with the same kind of transforms among these commands, at their
    /// beginning or, if they come `last`, at their end: about one point, two are one. Points are one if
    /// they are so when rounded to this number of decimals.
    fn joined(
        &self,
        commands: Range<usize>,
        new: &[Transform],
        (last, decimals): (bool, usize),
    ) -> Option<Vec<Edit>> {
        let known = commands.take(new.len()).map(|at| self.transform(at));
        let known: Vec<_> = known.collect::<Option<_>>()?;
        let point = if last { new.len() - 1 } else { 0 };
        let is_about = |known: &(Transform, Vec<Span>)| known.0.is_like(&new[point], decimals);
        if new.len() != 1 && !known.get(point).is_some_and(is_about) {
            return None;
        }
        let middle = new.len() / 2;
        let (old, spans) = known.get(middle)?;
        let numbers = new[middle].after(old)?;
        Some(replacements(&self.text, spans, &numbers))
    }

    /// The transform that a command is, with the places of its numbers.
    fn transform(&self, at: usize) -> Option<(Transform, Vec<Span>)> {
        let transforms = [&TRANSLATE, &SCALE, &ROTATE];
        let record = self.kind(at).filter(|kind| transforms.contains(kind))?;
        let spans = fields(&self.text, &self.tree, (at, record)).pop()?.spans;
        let numbers = spans.iter().map(|span| number(&self.text, *span)).collect();
        Some((Transform { record, numbers }, spans))
    }

    /// The push of a pair that holds no other primitive or light than these commands.
    fn own_push(&self, first: usize, last: usize) -> Option<usize> {
        let triangles = [TRI, TRI_NORMAL];
        let is_plain = |kind: &Record| {
            let is_other = triangles.contains(kind) || *kind == POP || *kind == PUSH;
            kind.makes == Makes::State && !is_other
        };
        let mut before = (0..first).rev().map(|at| (at, self.kind(at)));
        let (push, _) = before.find(|(_, kind)| !kind.is_some_and(is_plain))?;
        let mut behind = (last + 1..self.tree.records.len()).map(|at| (at, self.kind(at)));
        let (pop, _) = behind.find(|(_, kind)| !kind.is_some_and(is_plain))?;
        let is_pair = self.kind(push) == Some(&PUSH) && self.kind(pop) == Some(&POP);
        is_pair.then_some(push)
    }
}

/// How many more decimals a number needs in a space with this transform, for steps are rounded in the
/// world.
fn finer(transform: &DAffine3) -> usize {
    let size = transform.matrix3.determinant().abs().max(f64::MIN_POSITIVE);
    let finer = (libm::log10(size) / 3.0).ceil();
    finer.clamp(0.0, MOST as f64) as usize
}

/// Whether a transform is a similarity: a rotation with a uniform scale.
pub(super) fn is_similar(transform: &DAffine3) -> bool {
    let columns = [transform.x_axis, transform.y_axis, transform.z_axis];
    let [a, b, c] = columns.map(DVec3::length);
    let across = [
        columns[0].dot(columns[1]),
        columns[0].dot(columns[2]),
        columns[1].dot(columns[2]),
    ];
    (a - b).abs().max((a - c).abs()) <= ROUNDING * a
        && across.iter().all(|dot| dot.abs() <= ROUNDING * a * a)
}

/// A command of a transform.
#[derive(Clone, Debug)]
struct Transform {
    record: &'static Record,
    numbers: Vec<f64>,
}

impl Display for Transform {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(self.record.name)?;
        for &number in &self.numbers {
            write!(f, " {}", spelled(rounded_off(rounded(0.0, number, MOST))))?;
        }
        Ok(())
    }
}

impl Transform {
    fn translate(by: DVec3) -> Self {
        Self {
            record: &TRANSLATE,
            numbers: by.to_array().into(),
        }
    }

    /// Whether it is the same but for rounding to this number of decimals.
    fn is_like(&self, other: &Self, decimals: usize) -> bool {
        let mut pairs = self.numbers.iter().zip(&other.numbers);
        let unit = libm::exp10(-(decimals as f64));
        self.record == other.record
            && pairs.all(|(one, other)| (one - other).abs() <= unit + ROUNDING * one.abs().max(1.0))
    }

    /// Leaves out digits of its numbers: those of a rotation beyond this angle in radians, of distances
    /// beyond these decimals, and of factors that nobody sees.
    fn shorten(&mut self, within: f64, decimals: usize) {
        if let [x, y, z, angle] = self.numbers[..] {
            let (axis, angle) = digits::turn(DVec3::new(x, y, z), angle, within);
            self.numbers = [&axis.to_array()[..], &[angle]].concat();
            return;
        }
        let is_scale = *self.record == SCALE;
        for number in &mut self.numbers {
            let decimals = if is_scale {
                digits::of_length(*number, FACTOR_DECIMALS)
            } else {
                decimals
            };
            *number = rounded(0.0, *number, decimals);
        }
    }

    /// The numbers of the one transform that does what `first` and then this one do; `None` if they are
    /// of different kinds or about different axes.
    fn after(&self, first: &Self) -> Option<Vec<f64>> {
        let pairs = first.numbers.iter().zip(&self.numbers);
        if self.record != first.record {
            return None;
        }
        let join = |old: f64, new: f64| {
            if *self.record == SCALE {
                let product = old * new;
                rounded(old, product, digits::of_length(product, FACTOR_DECIMALS))
            } else {
                rounded(old, old + new, MOST)
            }
        };
        if *self.record != ROTATE {
            return Some(pairs.map(|(&old, &new)| join(old, new)).collect());
        }
        let axis = |of: &Self| DVec3::from_slice(&of.numbers).normalize_or_zero();
        if !axis(self).abs_diff_eq(axis(first), ROUNDING) {
            return None;
        }
        let mut numbers = first.numbers.clone();
        numbers[3] = rounded(numbers[3], (numbers[3] + self.numbers[3]) % 360.0, MOST);
        Some(numbers)
    }
}

/// The commands that, in this frame, do what a motion does in the world.
fn transforms(
    frame: &DAffine3,
    centre: DVec3,
    motion: &Motion,
) -> Result<Vec<Transform>, StructureError> {
    let refused = |reason: &str| Err(StructureError::Inexpressible(reason.to_owned()));
    let back = frame.inverse();
    let about = |point: DVec3, record, numbers: Vec<f64>| {
        let inner = Transform { record, numbers };
        let point = back.transform_point3(point);
        if point == DVec3::ZERO {
            return vec![inner];
        }
        let [to, back] = [point, -point].map(Transform::translate);
        vec![to, inner, back]
    };
    match *motion {
        Motion::Move(by) => Ok(vec![Transform::translate(back.transform_vector3(by))]),
        Motion::Rotate {
            axis,
            angle,
            about: point,
        } => {
            if !is_similar(frame) {
                return refused("its transform is not uniform: edit its rotation in the text");
            }
            let own = back.transform_vector3(axis).normalize().to_array();
            let angle = angle * frame.matrix3.determinant().signum();
            Ok(about(point, &ROTATE, vec![own[0], own[1], own[2], angle]))
        }
        Motion::Scale {
            factor,
            along,
            about: point,
        } => {
            let mut factors = DVec3::ONE;
            let point = match along {
                Along::All => {
                    factors = DVec3::splat(factor);
                    point
                }
                Along::Own(axis) => {
                    factors[axis] = factor;
                    centre
                }
                Along::World(axis) => {
                    let own = back
                        .transform_vector3(DVec3::AXES[axis])
                        .normalize_or_zero();
                    let known = (0..3).find(|&at| ROUNDING.mul_add(-1.0, 1.0) <= own[at].abs());
                    let Some(known) = known.filter(|_| is_similar(frame)) else {
                        return refused(
                            "it can only be scaled along its own axes: press the axis key again",
                        );
                    };
                    factors[known] = factor;
                    point
                }
            };
            Ok(about(point, &SCALE, factors.to_array().into()))
        }
    }
}
