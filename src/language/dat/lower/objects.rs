//! Objects, their combinations, and the choice of those to draw.

use std::collections::HashSet;
use std::sync::Arc;

use glam::DVec3;

use super::{Definition, Drawn, Lowering, shapes};
use crate::dat::origins::ObjectPlace;
use crate::dat::table::{HALF_SPACE, OPERATIONS, ObjectKind, RecordKind};
use crate::record::what;
use crate::report::{Name, number_of, quoted};
use crate::table::{Category, Range, SIZES};
use crate::words::Words;
use geometry::{Csg, Node as CsgNode, Quadric, Shape, Solid};
use scene::Object;
use text::{Diagnostic, Span, counted};

use super::record::RecordContent;

/// Maximum number of parts of all drawn combinations together, so that a chain of them, each drawn
/// as well, cannot exhaust memory.
const MOST_PARTS: usize = 1 << 20;

/// Maximum number of operands named in a message.
const NAMED: usize = 8;

/// Maximum number of objects listed in a message.
const LISTED: usize = 64;

/// Number of numbers of a half-space.
const EACH: usize = HALF_SPACE.kind.components();

/// A count for a message, where another one is declared: `1 cut follows`.
fn following(count: usize, what: &str) -> String {
    let verb = if count == 1 { "follows" } else { "follow" };
    format!("{} {verb}", counted(count, what))
}

impl<'a> Lowering<'a> {
    pub(super) fn object(&mut self, record: usize, kind: ObjectKind, tokens: &Words<'a>) {
        let errors = self.report.errors();
        let call = |id| Name::Known("object", id, kind.keyword());
        let mut line = self.line(RecordKind::Object(kind), tokens, call);
        let fields = RecordKind::Object(kind).fields();
        line.as_record().check_frame(fields, &mut self.report);
        let cuts = match kind {
            ObjectKind::Quadric if line.is_complete => self.cuts(&mut line),
            _ => Vec::new(),
        };
        self.surplus(&line);
        let (mut material, mut operands) = (None, None);
        if kind == ObjectKind::Csg {
            let fields = const { [ObjectKind::Csg.at("first"), ObjectKind::Csg.at("second")] };
            let [first, second] =
                fields.map(|field| self.resolve(Category::Object, line.reference(field)));
            operands = first.zip(second).map(|(first, second)| [first, second]);
        } else {
            material = self.resolve(Category::Material, line.reference(kind.at("mat")));
        }
        let Some(id) = self.define(Category::Object, &line, self.parts.len()) else {
            return;
        };
        let is_valid = errors == self.report.errors();
        let numbers = line.numbers().filter(|_| is_valid);
        let solid = numbers.and_then(|numbers| self.solid(kind, numbers, material, &cuts, &line));
        self.parts.push(solid.unwrap_or(Definition::Faulty));
        self.origins.objects.push(ObjectPlace {
            record,
            kind,
            id,
            operands,
            material,
            cuts: cuts.len(),
        });
    }

    fn solid(
        &mut self,
        kind: ObjectKind,
        numbers: &[f64],
        material: Option<usize>,
        cuts: &[(DVec3, f64)],
        line: &RecordContent<'_>,
    ) -> Option<Definition> {
        let shape = match kind {
            ObjectKind::Csg => {
                let operator = const { ObjectKind::Csg.at("operator") };
                let operation = operator.choice(numbers, &OPERATIONS);
                return Some(Definition::Combined(operation));
            }
            ObjectKind::Sphere => Some(shapes::sphere(numbers)),
            ObjectKind::Ellipsoid => shapes::ellipsoid(numbers),
            ObjectKind::Cylinder => shapes::cylinder(numbers),
            ObjectKind::Box => shapes::cuboid(numbers),
            ObjectKind::Quadric => self.quadric(numbers, cuts, line),
        };
        if shape.is_none() {
            let span = line.span_after_material();
            self.report.error(|| {
                let message = format!("{}: its size or position is out of range", line.name);
                let [least, beyond] = SIZES;
                let expected = format!(
                    "sizes of at least {least:e} and less than {beyond:e}, at finite positions"
                );
                Diagnostic::error(span, message, expected)
            });
        }
        Some(Definition::Solid(shape?, material? as u32))
    }

    /// A quadric; `None` if its size is out of range.
    fn quadric(
        &mut self,
        numbers: &[f64],
        cuts: &[(DVec3, f64)],
        line: &RecordContent<'_>,
    ) -> Option<Solid> {
        const QUADRIC: ObjectKind = ObjectKind::Quadric;
        let coefficients = const {
            [
                QUADRIC.at("A"),
                QUADRIC.at("B"),
                QUADRIC.at("C"),
                QUADRIC.at("D"),
                QUADRIC.at("E"),
                QUADRIC.at("F"),
                QUADRIC.at("G"),
                QUADRIC.at("H"),
                QUADRIC.at("I"),
                QUADRIC.at("J"),
            ]
        };
        let quadric = Quadric::new(coefficients.map(|at| at.number(numbers)), cuts);
        let span = line.span_after_material();
        if quadric.is_empty() {
            self.report.warning(|| {
                let message = format!("{}: the solid is empty", line.name);
                Diagnostic::warning(
                    span,
                    message,
                    "coefficients of a solid that contains points",
                )
                .with_hint("inside is where the sum is 0 or less")
            });
        } else if !quadric.sizes().all(|size| Range::Size.contains(size)) {
            return None;
        } else if quadric.has_lost_its_shape() {
            self.report.warning(|| {
                let message = format!("{}: too far from the origin for its size", line.name);
                Diagnostic::warning(span, message, "a quadric nearer to the origin")
                    .with_hint("double precision cannot represent its shape")
            });
        }
        Some(Solid::Quadric(Box::new(quadric)))
    }

    /// Reads the half-spaces after a quadric's coefficients: their count, then each. If the count
    /// is wrong, the line is incomplete.
    fn cuts(&mut self, line: &mut RecordContent<'a>) -> Vec<(DVec3, f64)> {
        line.is_complete = false;
        let Some(token) = line.rest.next() else {
            let end = line.spans.last().map_or(0, |span| span.end());
            let name = line.name;
            self.report.error(|| {
                let message = format!("{name}: the line ends before the number of cuts");
                Diagnostic::error(Span::at(end), message, "a whole number, 0 for no cuts")
            });
            return Vec::new();
        };
        let name = line.name;
        let Some((count, _)) = self.identity(token, || format!("{name} number of cuts")) else {
            return Vec::new();
        };
        let most = Quadric::MOST_HALF_SPACES;
        // Up to the permitted maximum.
        let have = line.rest.clone().take(EACH * most).count() / EACH;
        let fits = usize::try_from(count).is_ok_and(|count| count <= have && count <= most);
        if !fits {
            self.report.error(|| {
                let shown = quoted(token.of(self.text));
                let (message, expected) = if have < most {
                    let follow = following(have, "cut");
                    let message = format!("{name}: declares {shown} cuts, but {follow}");
                    (message, "as many as there are".to_owned())
                } else {
                    (
                        format!("{name}: declares {shown} cuts"),
                        format!("{most} at most"),
                    )
                };
                Diagnostic::error(token, message, expected)
                    .with_hint("a cut takes 4 numbers: normal x y z, distance d")
            });
            return Vec::new();
        }
        line.is_complete = true;
        let cuts = (0..count).map_while(|_| line.rest.next_array());
        cuts.filter_map(|cut| self.cut(name, &cut)).collect()
    }

    fn cut(&mut self, name: Name, tokens: &[Span; EACH]) -> Option<(DVec3, f64)> {
        let mut values = [f64::NAN; EACH];
        let components = HALF_SPACE.kind.component_names();
        for ((value, token), component) in values.iter_mut().zip(tokens).zip(components) {
            let word = token.of(self.text);
            let what = || what(name, HALF_SPACE, component);
            *value = number_of(HALF_SPACE, *token, word, &mut self.report, what);
        }
        let [x, y, z, distance] = values;
        let normal = DVec3::new(x, y, z);
        if normal == DVec3::ZERO {
            self.report.error(|| {
                let message = format!("{name} cut: its normal must not be zero");
                Diagnostic::error(tokens[0].to(tokens[2]), message, "a direction")
            });
            return None;
        }
        (!normal.is_nan() && !distance.is_nan()).then_some((normal, distance))
    }

    /// Reads the list of objects to draw: `render N ID i …`.
    pub(super) fn render_list(&mut self, tokens: &Words<'a>) {
        self.drawn = Drawn::Results;
        let name = Name::Record("render");
        let mut rest = tokens.clone();
        let word = rest.next().unwrap_or_default();
        let Some(token) = rest.next() else {
            self.report.error(|| {
                let message = "render: the line ends before the number of objects";
                let end = Span::at(word.end());
                Diagnostic::error(end, message, "a whole number, 0 for all objects")
            });
            return;
        };
        let count = self.identity(token, || "render: the number of objects".to_owned());
        let Some(count) = count.map(|(count, _)| count) else {
            return;
        };
        if count < 0 {
            self.report.error(|| {
                let message = "render: the number of objects must be 0 or more";
                Diagnostic::error(token, message, "a whole number, 0 for all objects")
            });
        }
        let mut ids = Vec::new();
        while (ids.len() as i64) < count {
            let Some([word, id]) = rest.next_array() else {
                break;
            };
            if word.of(self.text) != "ID" {
                self.report.error(|| {
                    let shown = quoted(word.of(self.text));
                    let message = format!("render: expected `ID`, not {shown}");
                    Diagnostic::error(word, message, "`ID`")
                });
                return;
            }
            let Some(id) = self.identity(id, || "render ID".to_owned()) else {
                return;
            };
            ids.push(id);
        }
        if (ids.len() as i64) < count {
            self.report.error(|| {
                let shown = quoted(token.of(self.text));
                let follow = following(ids.len(), "object");
                let message = format!("render: declares {shown}, but {follow} in the line");
                Diagnostic::error(token, message, "as many as there are")
                    .with_hint("each object is given as `ID` and its number")
            });
            return;
        }
        self.left_over(name, &rest);
        self.drawn = if count == 0 {
            Drawn::All(token)
        } else {
            Drawn::Listed(ids)
        };
    }

    /// The objects to draw, in file order.
    pub(super) fn drawn(&mut self) -> Vec<Object> {
        let mut drawn: Vec<usize> = match std::mem::replace(&mut self.drawn, Drawn::Results) {
            Drawn::Listed(listed) => listed
                .into_iter()
                .filter_map(|id| self.resolve(Category::Object, Some(id)))
                .collect(),
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
        if self.parts.is_empty() && self.report.errors() == 0 {
            self.report.warning(|| {
                Diagnostic::warning(Span::at(0), "no object is defined", "an `obj` record")
            });
        }
        let mut left = MOST_PARTS;
        let mut objects = Vec::with_capacity(drawn.len());
        for &object in &drawn {
            if self.report.errors() == 0 {
                objects.extend(self.build(object, &mut left));
            }
        }
        self.origins.drawn = drawn;
        objects
    }

    /// The operands of CSG, and all other objects.
    fn operands_and_results(&self) -> [Vec<usize>; 2] {
        let combined = self.origins.objects.iter();
        let combined: HashSet<_> = combined.filter_map(|at| at.operands).flatten().collect();
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
                .map(|&object| format!("ID {}", self.origins.objects[object].id))
                .collect();
            ids.join(" ")
        };
        self.report.warning(|| {
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
        let place = self.origins.objects[object];
        let (shape, material) = match &self.parts[object] {
            Definition::Solid(solid, material) => (Shape::Solid(solid.clone()), *material),
            Definition::Faulty => return None,
            Definition::Combined(_) => {
                let nodes = self.nodes(object, *left);
                *left -= nodes.len().min(*left);
                if *left == 0 {
                    let span = self.tree.span_of(place.record);
                    self.report.error(|| {
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
        let operands = |object: usize| self.origins.objects[object].operands.into_iter().flatten();
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
                let [first, second] = self.origins.objects[object].operands?;
                Some(CsgNode::Operation {
                    operation: *operation,
                    first: place(first),
                    second: place(second),
                })
            }
            Definition::Faulty => None,
        };
        reached.iter().filter_map(node).collect()
    }
}
