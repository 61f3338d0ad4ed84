//! The values of its material that a primitive catches from afar, and how it gets others of its own.

use super::Source;
use super::lower::state::{DEFAULTS, MATERIAL};
use crate::SceneText;
use crate::engine::places::fields;
use crate::field_spans::{self, Component, FieldSpans, Insertion, Limit, Piece, Wanted};
use crate::node::Node;
use crate::rendering;
use crate::schema::Record;
use crate::structure::number;
use crate::view::{line_ending, line_from, spelled};
use text::{Edit, Span, line_end};

impl Source {
    /// The fields of a node, given those in its own records: of a material all its values, whether a
    /// command states them or not; of an object those of its material too, in the command that only this
    /// object catches, if there is one.
    pub(super) fn with_caught(&self, node: Node, own: Vec<FieldSpans>) -> Vec<FieldSpans> {
        let objects = 0..self.origins.objects().len();
        let (mut fields, material, objects) = match node {
            Node::Object(object) => (own, self.material(object), [Some(object); 2]),
            Node::Material(material) => {
                // One follows the other, with only lights between.
                let uses = |object: &usize| self.material(*object) == Some(material);
                let ends = [objects.clone().find(uses), objects.rev().find(uses)];
                (Vec::new(), Some(material), ends)
            }
            _ => return own,
        };
        let caught = &self.origins.own;
        let commands = material.and_then(|material| caught.stated.get(material));
        let ([Some(first), Some(last)], Some(commands)) = (objects, commands) else {
            return fields;
        };
        let parts = commands.iter().zip(MATERIAL).zip(DEFAULTS);
        fields.extend(parts.map(|((at, record), default)| {
            let Some((at, placed)) = at.and_then(|at| Some((at, self.command(at, record)?))) else {
                let former = default.into_iter().take(record.numbers()).map(spelled);
                return self.around([first, last], record, (former.collect(), None));
            };
            if matches!(node, Node::Material(_)) || caught.catches.get(&at) == Some(&1) {
                return placed;
            }
            let former = placed
                .spans
                .iter()
                .map(|span| span.of(&self.text).to_owned());
            let inherited = placed.spans.first().copied();
            self.around([first, last], record, (former.collect(), inherited))
        }));
        fields
    }

    /// The field of a command of the material.
    fn command(&self, at: usize, record: &'static Record) -> Option<FieldSpans> {
        fields(&self.text, &self.tree, (at, record)).pop()
    }

    /// A value that a command in front of objects could state, and the former one that a command behind
    /// them would restore, with its place in the text.
    fn around(
        &self,
        [first, last]: [usize; 2],
        record: &'static Record,
        (former, inherited): (Vec<String>, Option<Span>),
    ) -> FieldSpans {
        let (text, ending) = (&*self.text, line_ending(&self.text));
        let ends = [
            self.commands(first).first().copied(),
            self.commands(last).last().copied(),
        ];
        let [first, last] = ends.map(|at| self.tree.span(at.unwrap_or_default()));
        let indent = Span::new(line_from(text, first.start()), first.start());
        let at_first = self.tree.at(first).next().unwrap_or_default();
        // The comment above is the object's.
        let start = self.block_span(at_first).start();
        let restored = format!(
            "{ending}{}{} {}",
            indent.of(text),
            record.name,
            former.join(" ")
        );
        let component = |value: String| Component {
            name: record.name,
            place: None,
            default: value.into(),
            is_required: true,
        };
        let insertion = Insertion {
            before: vec![Piece::Copy(indent)],
            between: vec![Piece::Literal(ending), Piece::Copy(indent)],
            after: vec![Piece::Literal(ending)],
            ..Insertion::at(start)
        };
        let components = former.into_iter().map(component).collect();
        let placed = FieldSpans::with_defaults(record.field(0), components, None, insertion);
        placed.limited(Limit {
            edit: Edit {
                span: Span::at(line_end(text, last.end())),
                text: restored,
            },
            inherited,
        })
    }

    /// The commands around an object that state values for it alone and restore the former ones.
    pub(super) fn own_values(&self, object: usize) -> Vec<usize> {
        let commands = self.commands(object);
        let (Some(&first), Some(&last)) = (commands.first(), commands.last()) else {
            return Vec::new();
        };
        let stated = |at: usize| self.kind(at).filter(|kind| MATERIAL.contains(kind));
        let numbers = |at: usize, record: &'static Record| -> Option<Vec<f64>> {
            let placed = self.command(at, record)?;
            Some(
                placed
                    .spans
                    .iter()
                    .map(|span| number(&self.text, *span))
                    .collect(),
            )
        };
        let catches = &self.origins.own.catches;
        let mut own = Vec::new();
        for at in (0..first).rev() {
            let Some(record) = stated(at).filter(|_| catches.get(&at) == Some(&1)) else {
                break;
            };
            let before = (0..at).rev().find(|at| self.kind(*at) == Some(record));
            let former = match before {
                Some(before) => numbers(before, record),
                None => MATERIAL.iter().zip(DEFAULTS).find_map(|(of, default)| {
                    (**of == *record).then(|| default[..record.numbers()].to_vec())
                }),
            };
            let mut behind = (last + 1..).take_while(|at| stated(*at).is_some());
            let restores = |at: &usize| {
                stated(*at) == Some(record) && former.is_some() && numbers(*at, record) == former
            };
            if let Some(restoring) = behind.find(restores) {
                own.extend([at, restoring]);
            }
        }
        own
    }
}

/// Returns the edits that insert render settings and commands of the material.
pub(super) fn insertions(text: &str, wanted: &[Wanted<'_>]) -> Vec<Edit> {
    let is_caught = |(placed, _): &&Wanted<'_>| {
        MATERIAL
            .iter()
            .any(|record| record.field(0) == placed.field)
    };
    let (caught, settings): (Vec<_>, Vec<_>) = wanted.iter().partition(is_caught);
    let settings: Vec<_> = settings.into_iter().cloned().collect();
    let mut edits = rendering::insertions(text, &settings);
    let own = caught.iter().filter(|(placed, values)| {
        let is_same = |(at, value): &(usize, String)| placed.default_of(*at) == Some(value);
        !values.iter().all(is_same) && !caught.iter().any(|(other, _)| covers(other, placed))
    });
    let own: Vec<_> = own.map(|wanted| (*wanted).clone()).collect();
    edits.extend(field_spans::insertions(text, &own, |implicit, values| {
        let value = |(at, component): (usize, &Component)| {
            let given = values.iter().find(|(given, _)| *given == at);
            given.map_or_else(|| component.default.to_string(), |(_, value)| value.clone())
        };
        let components = &implicit.components;
        let values: Vec<_> = components.iter().enumerate().map(value).collect();
        let name = components.first().map_or("", |first| first.name);
        format!("{name} {}", values.join(" "))
    }));
    edits
}

/// Whether a value that is set is that of another field too: stated in the command that the other
/// inherits, or in a command around all of its objects.
fn covers(placed: &FieldSpans, other: &FieldSpans) -> bool {
    if placed.field != other.field {
        return false;
    }
    let ends = |of: &FieldSpans| {
        let limit = of.implicit.as_ref()?.limit.as_ref()?;
        Some([*of.spans.first()?, limit.edit.span])
    };
    match (ends(placed), ends(other)) {
        (None, Some(_)) => other
            .inherited()
            .is_some_and(|first| placed.spans.contains(&first)),
        (Some([start, end]), Some([of, to])) => {
            [start, end] != [of, to] && start <= of && to <= end
        }
        _ => false,
    }
}
