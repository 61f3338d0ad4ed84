//! The values of its material that a primitive catches from afar, and how it gets others of its own.

use super::Source;
use super::lower::state::{DEFAULTS, MATERIAL};
use crate::SceneText;
use crate::engine::places::fields;
use crate::field_spans::{self, FieldSpans, Implicit, ImplicitAttribute, Insertion, Piece, Wanted};
use crate::node::Node;
use crate::rendering;
use crate::schema::Record;
use crate::view::{line_ending, line_from, spelled};
use text::{Edit, Span, line_end};

impl Source {
    /// The values of a node's material that its own records do not state: of a material those that no
    /// command states; of an object all, in the command that only this object catches, if there is one.
    /// A command for an object stands in front of it, and one behind it restores what was in force.
    pub(super) fn caught(&self, node: Node) -> Vec<FieldSpans> {
        let (object, material) = match node {
            Node::Object(object) => (Some(object), self.material(object)),
            Node::Material(material) => {
                let mut objects = 0..self.origins.objects().len();
                let uses = |object: &usize| self.material(*object) == Some(material);
                (objects.find(uses), Some(material))
            }
            _ => (None, None),
        };
        let (Some(object), Some(material)) = (object, material) else {
            return Vec::new();
        };
        let own = &self.origins.own;
        let commands = own.stated.get(material).into_iter().flatten();
        let part = |((at, record), default): ((&Option<usize>, &&'static Record), [f64; 3])| {
            let command = at.and_then(|at| {
                let placed = fields(&self.text, &self.tree, (at, record)).pop()?;
                Some((own.catches.get(&at), placed))
            });
            match (node, command) {
                (Node::Material(_), Some(_)) => None,
                (Node::Object(_), Some((Some(1), placed))) => Some(placed),
                (_, Some((_, placed))) => {
                    let former = placed
                        .spans
                        .iter()
                        .map(|span| span.of(&self.text).to_owned());
                    Some(self.around(node, object, record, former.collect()))
                }
                (_, None) => {
                    let former = default.into_iter().take(record.numbers()).map(spelled);
                    Some(self.around(node, object, record, former.collect()))
                }
            }
        };
        commands
            .zip(MATERIAL.iter())
            .zip(DEFAULTS)
            .filter_map(part)
            .collect()
    }

    /// A value that a command in front of an object could state, where it is `former` so far.
    fn around(
        &self,
        node: Node,
        object: usize,
        record: &'static Record,
        former: Vec<String>,
    ) -> FieldSpans {
        let (text, place) = (&*self.text, self.origins.objects()[object]);
        let first = self.tree.span(place.at).start();
        let start = line_from(text, first);
        let (indent, ending) = (Span::new(start, first), line_ending(text));
        let behind = line_end(text, self.tree.span(place.end).end());
        let restored = || Edit {
            span: Span::at(behind),
            text: format!(
                "{ending}{}{} {}",
                indent.of(text),
                record.name,
                former.join(" ")
            ),
        };
        let limit = matches!(node, Node::Object(_)).then(restored);
        let attribute = |(component, default): (usize, &String)| ImplicitAttribute {
            component,
            name: record.name,
            default: default.clone().into(),
            is_required: true,
        };
        FieldSpans {
            field: record.field(0),
            spans: vec![Span::at(start); former.len()],
            implicit: Some(Box::new(Implicit {
                attributes: former.iter().enumerate().map(attribute).collect(),
                defaults: former.into_iter().map(|value| Some(value.into())).collect(),
                element: None,
                insertion: Insertion {
                    span: Span::at(start),
                    before: vec![Piece::Copy(indent)],
                    between: vec![Piece::Literal(ending), Piece::Copy(indent)],
                    after: vec![Piece::Literal(ending)],
                },
                limit,
            })),
        }
    }
}

/// Returns the edits that insert render settings and commands of the material.
pub(super) fn insertions(text: &str, wanted: &[Wanted<'_>]) -> Vec<Edit> {
    let is_caught = |(placed, _): &Wanted<'_>| {
        MATERIAL
            .iter()
            .any(|record| record.field(0) == placed.field)
    };
    let (caught, settings): (Vec<_>, Vec<_>) = wanted.iter().cloned().partition(is_caught);
    let mut edits = rendering::insertions(text, &settings);
    edits.extend(field_spans::insertions(
        text,
        &caught,
        |implicit, values| {
            let value = |attribute: &ImplicitAttribute| {
                let given = values.iter().find(|(at, _)| *at == attribute.component);
                given.map_or_else(|| attribute.default.to_string(), |(_, value)| value.clone())
            };
            let values: Vec<_> = implicit.attributes.iter().map(value).collect();
            let name = implicit
                .attributes
                .first()
                .map_or("", |attribute| attribute.name);
            format!("{name} {}", values.join(" "))
        },
    ));
    edits
}
