//! Objects, their combinations, and the choice of those to draw.

use std::collections::HashSet;
use std::sync::Arc;

use glam::DVec3;

use super::{Definition, Lowering};
use crate::dat::schema::{CSG, OPERATIONS, QUADRIC};
use crate::engine::reader::Reading;
use crate::schema::position::At;
use crate::schema::{Category, Range, SIZES};
use geometry::{Csg, Node as CsgNode, Quadric, Shape, Solid};
use scene::Object;
use text::{Diagnostic, Span};

/// Maximum number of parts of all drawn combinations together, so that a chain of them, each drawn
/// as well, cannot exhaust memory.
const MOST_PARTS: usize = 1 << 20;

/// Maximum number of operands named in a message.
const NAMED: usize = 8;

/// Maximum number of objects listed in a message.
const LISTED: usize = 64;

/// The first of a quadric's ten coefficients, which follow each other.
const COEFFICIENTS: At<1> = QUADRIC.at("A");

/// The objects to draw.
pub(super) enum Drawn {
    /// All except operands, by default.
    Results,
    /// All, as requested at this place.
    All(Span),
    /// The objects with these IDs, in the record with this index.
    Listed(usize, Vec<Span>),
}

impl Lowering<'_> {
    pub(super) fn object(&mut self, read: &Reading<'_>) {
        let definition = read.numbers().and_then(|numbers| {
            if *read.record == CSG {
                let operator = const { CSG.at("operator") };
                return Some(Definition::Combined(operator.choice(numbers, &OPERATIONS)));
            }
            let material = read.refers[0]? as u32;
            Some(Definition::Solid(self.solid(read, numbers)?, material))
        });
        self.parts.push(definition.unwrap_or(Definition::Faulty));
    }

    fn solid(&mut self, read: &Reading<'_>, numbers: &[f64]) -> Option<Solid> {
        // What follows the material.
        let span = read.spans[1].to(read.spans[read.record.numbers() - 1]);
        let solid = match &read.record.layout {
            Some(layout) => {
                let lengths = layout.lengths(numbers);
                let are_sizes = lengths.iter().all(|length| Range::Size.contains(*length));
                layout.solid(numbers).filter(|_| are_sizes)
            }
            None => self.quadric(read, numbers, span),
        };
        if solid.is_none() {
            self.reader.report.error(|| {
                let message = format!("{}: its size or position is out of range", read.name);
                let [least, beyond] = SIZES;
                let expected = format!(
                    "sizes of at least {least:e} and less than {beyond:e}, at finite positions"
                );
                Diagnostic::error(span, message, expected)
            });
        }
        solid
    }

    /// A quadric; `None` if its size is out of range.
    fn quadric(&mut self, read: &Reading<'_>, numbers: &[f64], span: Span) -> Option<Solid> {
        let cuts = numbers[read.record.numbers()..].as_chunks().0.iter();
        let cuts: Vec<_> = cuts.map(|&[x, y, z, d]| (DVec3::new(x, y, z), d)).collect();
        let first = COEFFICIENTS.index();
        let coefficients = std::array::from_fn(|at| numbers[first + at]);
        let quadric = Quadric::new(coefficients, &cuts);
        if quadric.is_empty() {
            self.reader.report.warning(|| {
                let message = format!("{}: the solid is empty", read.name);
                let expected = "coefficients of a solid that contains points";
                Diagnostic::warning(span, message, expected)
                    .with_hint("inside is where the sum is 0 or less")
            });
        } else if !quadric.sizes().all(|size| Range::Size.contains(size)) {
            return None;
        } else if quadric.has_lost_its_shape() {
            self.reader.report.warning(|| {
                let message = format!("{}: too far from the origin for its size", read.name);
                Diagnostic::warning(span, message, "a quadric nearer to the origin")
                    .with_hint("double precision cannot represent its shape")
            });
        }
        Some(Solid::Quadric(Box::new(quadric)))
    }

    /// Notes the objects that `render N ID i …` lists.
    pub(super) fn list(&mut self, at: usize, read: &Reading<'_>) {
        self.drawn = match read.count {
            Some(_) if read.numbers().is_none() => Drawn::Results,
            Some(count) if read.spans.is_empty() => Drawn::All(count),
            Some(_) => Drawn::Listed(at, read.spans.clone()),
            None => Drawn::Results,
        };
    }

    /// The objects to draw, in file order.
    pub(super) fn drawn(&mut self) -> Vec<Object> {
        let mut drawn: Vec<usize> = match std::mem::replace(&mut self.drawn, Drawn::Results) {
            Drawn::Listed(at, listed) => {
                let object = |span: Span| {
                    let id = span.of(self.reader.text).parse().ok()?;
                    self.reader.resolve(Category::Object, id, (at, span))
                };
                listed.into_iter().filter_map(object).collect()
            }
            Drawn::All(token) => {
                let [operands, results] = self.operands_and_results();
                self.warn_of_operands(token, &operands, &results);
                (0..self.parts.len()).collect()
            }
            Drawn::Results => {
                let [_, results] = self.operands_and_results();
                results
            }
        };
        drawn.sort_unstable();
        drawn.dedup();
        // If there are errors, they may be about the missing objects.
        if self.parts.is_empty() && self.reader.report.errors() == 0 {
            self.reader.report.warning(|| {
                Diagnostic::warning(Span::at(0), "no object is defined", "an `obj` record")
            });
        }
        let mut left = MOST_PARTS;
        let mut objects = Vec::with_capacity(drawn.len());
        for &object in &drawn {
            if self.reader.report.errors() == 0 {
                objects.extend(self.build(object, &mut left));
            }
        }
        self.reader.places.drawn = drawn;
        objects
    }

    /// The operands of CSG, and all other objects.
    fn operands_and_results(&self) -> [Vec<usize>; 2] {
        let combined = self.reader.places.objects().iter();
        let combined: HashSet<_> = combined
            .flat_map(|place| place.of(Category::Object))
            .collect();
        let (operands, results) =
            (0..self.parts.len()).partition(|object| combined.contains(object));
        [operands, results]
    }

    /// Warns of operands drawn together with their combination.
    fn warn_of_operands(&mut self, token: Span, operands: &[usize], results: &[usize]) {
        if operands.is_empty() {
            return;
        }
        let ids = |objects: &[usize], most: usize| {
            let ids = objects.iter().take(most);
            let ids: Vec<_> = ids
                .map(|&object| format!("ID {}", self.reader.places.objects()[object].id))
                .collect();
            ids.join(" ")
        };
        self.reader.report.warning(|| {
            let more = match operands.len().saturating_sub(NAMED) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            let named = ids(operands, NAMED);
            let message = format!("render: 0 also draws the operands of CSG: {named}{more}");
            let hint = if results.len() <= LISTED {
                let listed = ids(results, LISTED);
                format!("only the results: render {} {listed}", results.len())
            } else {
                "without a `render` record only the results are drawn".to_owned()
            };
            Diagnostic::warning(token, message, "a list of objects").with_hint(hint)
        });
    }

    /// Builds an object to draw. `left` is the remaining number of parts for combinations.
    fn build(&mut self, object: usize, left: &mut usize) -> Option<Object> {
        let place = self.reader.places.objects()[object];
        let (shape, material) = match &self.parts[object] {
            Definition::Solid(solid, material) => (Shape::Solid(solid.clone()), *material),
            Definition::Faulty => return None,
            Definition::Combined(_) => {
                let nodes = self.nodes(object, *left);
                *left -= nodes.len().min(*left);
                if *left == 0 {
                    let span = self.reader.lines.span(place.at);
                    self.reader.report.error(|| {
                        let message = format!("object {} (CSG): too many parts", place.id);
                        let expected = format!("{MOST_PARTS} parts in all that is drawn");
                        Diagnostic::error(span, message, expected)
                    });
                    return None;
                }
                let csg = Csg::new(nodes);
                let material = csg.tags().next()?;
                (Shape::Csg(Arc::new(csg)), material)
            }
        };
        Some(Object { shape, material })
    }

    /// The parts of a combination, each once, operands before the combination that uses them; at
    /// most about `limit`.
    fn nodes(&self, object: usize, limit: usize) -> Vec<CsgNode> {
        let operands = |object: usize| self.reader.places.objects()[object].of(Category::Object);
        let mut reached = HashSet::from([object]);
        let mut pending = vec![object];
        while let Some(object) = pending.pop()
            && reached.len() <= limit
        {
            pending.extend(operands(object).filter(|&operand| reached.insert(operand)));
        }
        let mut reached: Vec<_> = reached.into_iter().collect();
        // Operands are defined before their combination.
        reached.sort_unstable();
        let place = |object: usize| reached.binary_search(&object).map_or(0, |at| at as u32);
        let node = |&object: &usize| match &self.parts[object] {
            Definition::Solid(solid, material) => Some(CsgNode::Leaf {
                solid: solid.clone(),
                tag: *material,
            }),
            Definition::Combined(operation) => {
                let mut operands = operands(object);
                Some(CsgNode::Operation {
                    operation: *operation,
                    first: place(operands.next()?),
                    second: place(operands.next()?),
                })
            }
            Definition::Faulty => None,
        };
        reached.iter().filter_map(node).collect()
    }
}
