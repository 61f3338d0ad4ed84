//! New lights and objects of `.ray`, laid out like their neighbours, and objects of another kind.

use glam::DVec3;

use super::Source;
use super::schema::{LIGHT, MATERIAL, SCHEMA, ShapeKind};
use super::tree::comments;
use crate::engine::motion::{Moves, numbers_of};
use crate::form::Form;
use crate::schema::{Field, Kind};
use crate::spelling::rounded_off;
use crate::structure::NewNode;
use crate::view::{line_ending, line_from, spelled};
use crate::{Addition, Node, Placement, SceneText, StructureEdits, StructureError};
use text::{Edit, Span};

/// The kinds of things that can be added: solids, by their keywords, and a light.
pub(super) const ADDITIONS: &[Addition] = &[
    Addition::new("sphere", "round, by centre and radius"),
    Addition::new("ellipsoid", "a sphere stretched along three directions"),
    Addition::new("box", "six faces, by a corner and three edges"),
    Addition::new("cylinder", "closed, on an elliptic base"),
    Addition::new("cone", "closed by an elliptic base"),
    Addition::new(
        "light",
        "shines in all directions, as bright at any distance",
    ),
];

/// Returns the edits that add a thing.
pub(super) fn addition(
    source: &Source,
    name: &str,
    wish: &NewNode<'_>,
) -> Result<Placement, StructureError> {
    let text = if let Some(kind) = ShapeKind::of_word(name) {
        // A solid of revolution stands; the frame of another is the world's.
        let axis = match kind {
            ShapeKind::Cylinder | ShapeKind::Cone => wish.up,
            ShapeKind::Sphere | ShapeKind::Ellipsoid | ShapeKind::Box => DVec3::Z,
        };
        let form = Form::upright(wish.centre, wish.half, axis);
        let numbers = numbers_of(&SCHEMA, kind.record(), &form)?.into_iter();
        let mut literals: Vec<_> = numbers.map(|number| wish.literal(number)).collect();
        let plain = || PLAIN.split(' ').map(str::to_owned).collect();
        literals.extend(source.material_literals(wish.after).unwrap_or_else(plain));
        let like = source.like(kind, wish.after);
        source.laid_out(kind.keyword(), kind.fields(), &literals, like)
    } else {
        let above = wish.centre + DVec3::new(0.0, 4.0 * wish.half, 0.0);
        let numbers = above.to_array().into_iter().chain([1.0; 3]);
        let literals: Vec<_> = numbers.map(|number| wish.literal(number)).collect();
        let lights = source.origins.light_count();
        let like = lights.checked_sub(1).map(Node::Light);
        source.laid_out("", LIGHT.fields(), &literals, like)
    };
    source.insertion(&text, wish.after)
}

/// Returns the edits that make an object one of another kind, of this form.
pub(super) fn respelled(
    source: &Source,
    object: usize,
    kind: &str,
    form: &Form,
) -> Result<Vec<Edit>, StructureError> {
    let node = Node::Object(object);
    let old = source.object_numbers(object).zip(ShapeKind::of_word(kind));
    let (old, new) = old.ok_or_else(|| {
        StructureError::Inexpressible(format!("{} has only one type", source.name(node)))
    })?;
    let numbers = numbers_of(&SCHEMA, new.record(), form)?.into_iter();
    let literals: Vec<_> = numbers.map(|number| spelled(rounded_off(number))).collect();
    // The material stays as it is written.
    let last = old.spans[old.record.numbers() - 1];
    let span = Span::new(source.span(node).start(), last.end());
    let text = source.laid_out(new.keyword(), new.record().fields(), &literals, Some(node));
    Ok(vec![Edit {
        span,
        text: source.with_comments(span, text.trim_start()),
    }])
}

/// The literals of a plain material.
const PLAIN: &str = "0.1 0.1 0.1 0.6 0.6 0.6 0.3 0.3 0.3 20 0 0 1";

impl Source {
    /// The material of an object as it is written.
    fn material_literals(&self, node: Node) -> Option<Vec<String>> {
        let kind = self.origins.kind(node)?;
        let tokens = self.tree.range(self.origins.tokens(node));
        let material = tokens.get(1 + kind.geometry()..)?.iter();
        let literals = material.map(|span| span.of(&self.text).to_owned());
        (tokens.len() == 1 + kind.numbers()).then(|| literals.collect())
    }

    /// A new text for a span, with the comments of the old one before it, each on its own line.
    fn with_comments(&self, span: Span, new: &str) -> String {
        let text = &*self.text;
        let comments = comments(text, span).filter(|comment| comment.end() <= span.end());
        let lines = comments.map(|comment| comment.of(text)).chain([new]);
        lines.collect::<Vec<_>>().join(line_ending(text))
    }

    /// The object to lay a new one out like: one of the kind, otherwise any.
    fn like(&self, kind: ShapeKind, after: Node) -> Option<Node> {
        let is_kind = |node: &Node| self.origins.kind(*node) == Some(kind);
        let mut all = (0..self.origins.objects.len()).map(Node::Object);
        let same = Some(after).filter(is_kind);
        let same = same.or_else(|| all.clone().rfind(is_kind));
        same.or_else(|| all.next_back())
    }

    /// A thing's text. Its fields share lines as they do in its model and in the last objects; on
    /// several lines it has the model's indentation.
    fn laid_out<'f>(
        &self,
        keyword: &str,
        fields: impl Iterator<Item = &'f Field>,
        literals: &[String],
        like: Option<Node>,
    ) -> String {
        let text = &*self.text;
        let own = like.map(|node| self.span(node)).unwrap_or_default();
        let is_long = own.of(text).contains(['\n', '\r']) || like.is_none();
        let start = line_from(text, own.start());
        let indent = &text[start..own.start()];
        let indent = if indent.trim().is_empty() { indent } else { "" };
        let joints = is_long.then(|| self.joints(like));
        let mut laid_out = format!("{indent}{keyword}");
        let mut before = (!keyword.is_empty()).then_some(KEYWORD);
        let mut rest = literals;
        for field in fields {
            let (own, behind) = rest.split_at(field.kind.components());
            rest = behind;
            match before {
                Some(before)
                    if joints
                        .as_ref()
                        .is_some_and(|all| breaks(all, before, field)) =>
                {
                    laid_out.push_str(line_ending(text));
                    laid_out.push_str(indent);
                }
                Some((_, Some(Kind::Number))) if is_long && field.kind == Kind::Number => {
                    laid_out.push(' ');
                }
                Some(_) => laid_out.push_str("  "),
                None => {}
            }
            laid_out.push_str(&own.join(" "));
            before = Some(side(field));
        }
        laid_out
    }

    /// How a model, and after it the last objects of several lines, go from each field to the next.
    fn joints(&self, like: Option<Node>) -> Vec<Joint> {
        let objects = self.origins.objects.len();
        let last = (objects.saturating_sub(MODELS)..objects).rev();
        let models = like.into_iter().chain(last.map(Node::Object));
        let is_long = |model: &Node| self.span(*model).of(&self.text).contains(['\n', '\r']);
        let joints = models.filter(is_long).flat_map(|model| {
            let start = self.span(model).start();
            let keyword = self.origins.kind(model).map(|kind| {
                let end = start + kind.keyword().len();
                (KEYWORD, Span::new(start, end))
            });
            let fields = self.fields(model).into_iter().map(|placed| {
                let whole = placed.spans[0].to(placed.spans[placed.spans.len() - 1]);
                (side(placed.field), whole)
            });
            let parts: Vec<_> = keyword.into_iter().chain(fields).collect();
            let joints = parts.windows(2).map(|pair| {
                let between = Span::new(pair[0].1.end(), pair[1].1.start());
                Joint {
                    sides: [pair[0].0, pair[1].0],
                    breaks: between.of(&self.text).contains(['\n', '\r']),
                }
            });
            joints.collect::<Vec<_>>()
        });
        joints.collect()
    }
}

/// The number of objects, from the last, that a new one may be laid out like.
const MODELS: usize = 16;

/// What stands before or after a line break: a field by its key, with its kind, or the keyword.
type Side = (&'static str, Option<Kind>);

const KEYWORD: Side = ("", None);

fn side(field: &Field) -> Side {
    (field.key, Some(field.kind))
}

/// Two parts of an object that follow each other.
struct Joint {
    sides: [Side; 2],
    /// Whether there is a line break between them.
    breaks: bool,
}

/// Whether a field begins a line: as after the same field before, otherwise as between two fields of
/// the same kinds in a shape.
fn breaks(joints: &[Joint], before: Side, field: &Field) -> bool {
    let is_same = |joint: &&Joint| joint.sides == [before, side(field)];
    let is_alike = |joint: &&Joint| {
        let [a, b] = joint.sides;
        let is_shape = |key| MATERIAL.fields().all(|field| field.key != key);
        let kinds = [a.1, b.1] == [before.1, Some(field.kind)];
        kinds && [a.0, b.0, before.0, field.key].into_iter().all(is_shape)
    };
    let found = joints.iter().find(is_same);
    found
        .or_else(|| joints.iter().find(is_alike))
        .is_none_or(|joint| joint.breaks)
}
