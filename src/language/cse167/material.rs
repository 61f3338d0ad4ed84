//! The material that a primitive inherits from commands above it, and how it gets values of its own.

use std::cell::LazyCell;

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
    /// object inherits, if there is one.
    pub(super) fn with_inherited(&self, node: Node, own: Vec<FieldSpans>) -> Vec<FieldSpans> {
        let (mut fields, material, ends) = match node {
            Node::Object(object) => (own, self.material(object), Some([object; 2])),
            Node::Material(material) => {
                let ends = self.origins.own.ends.get(material).copied();
                (Vec::new(), Some(material), ends)
            }
            _ => return own,
        };
        let state = &self.origins.own;
        let commands = material.and_then(|material| state.stated.get(material));
        let (Some(ends), Some(commands)) = (ends, commands) else {
            return fields;
        };
        let around = LazyCell::new(|| self.around(ends));
        let parts = commands.iter().zip(MATERIAL).zip(DEFAULTS);
        fields.extend(parts.map(|((at, record), default)| {
            let Some((at, placed)) = at.and_then(|at| Some((at, self.command(at, record)?))) else {
                let former = default.into_iter().take(record.numbers()).map(spelled);
                return around.field(record, former.collect(), None);
            };
            if matches!(node, Node::Material(_)) || state.inheritors.get(&at) == Some(&1) {
                return placed;
            }
            let former = placed
                .spans
                .iter()
                .map(|span| span.of(&self.text).to_owned());
            around.field(record, former.collect(), placed.spans.first().copied())
        }));
        fields
    }

    /// The field of a command of the material.
    fn command(&self, at: usize, record: &'static Record) -> Option<FieldSpans> {
        fields(&self.text, &self.tree, (at, record)).pop()
    }

    /// The surroundings of the objects from the first to the last of these.
    fn around(&self, [first, last]: [usize; 2]) -> Around<'_> {
        let first = self.commands(first).first().copied().unwrap_or_default();
        let last = self.commands(last).last().copied().unwrap_or_default();
        let (text, start) = (&*self.text, self.tree.span(first).start());
        Around {
            text,
            indent: Span::new(line_from(text, start), start),
            // The comment above is the object's.
            start: self.block_span(first).start(),
            behind: line_end(text, self.tree.span(last).end()),
        }
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
        let inheritors = &self.origins.own.inheritors;
        let mut own = Vec::new();
        for at in (0..first).rev() {
            let Some(record) = stated(at).filter(|_| inheritors.get(&at) == Some(&1)) else {
                break;
            };
            let before = (0..at).rev().find(|at| self.kind(*at) == Some(record));
            let slot = MATERIAL.iter().position(|of| *of == record);
            let default = slot.map(|slot| DEFAULTS[slot][..record.numbers()].to_vec());
            let former = before.map_or(default, |before| numbers(before, record));
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

/// The surroundings of some objects, where commands can state values for them alone.
struct Around<'t> {
    text: &'t str,
    /// The white space before the first command.
    indent: Span,
    /// The place of a line in front.
    start: usize,
    /// The place behind the last line.
    behind: usize,
}

impl Around<'_> {
    /// A value that a command in front could state, and the former one that a command behind would
    /// restore, with its place in the text.
    fn field(
        &self,
        record: &'static Record,
        former: Vec<String>,
        inherited: Option<Span>,
    ) -> FieldSpans {
        let (indent, ending) = (self.indent, line_ending(self.text));
        let restored = [
            ending,
            indent.of(self.text),
            record.name,
            " ",
            &former.join(" "),
        ]
        .concat();
        let component = |value: String| Component {
            name: "",
            place: None,
            default: value.into(),
            is_required: true,
        };
        let insertion = Insertion {
            before: vec![Piece::Copy(indent)],
            between: vec![Piece::Literal(ending), Piece::Copy(indent)],
            after: vec![Piece::Literal(ending)],
            ..Insertion::at(self.start)
        };
        let components = former.into_iter().map(component).collect();
        let (field, name) = (record.field(0), Some(record.name));
        FieldSpans::with_defaults(field, components, name, insertion).limited(Limit {
            edit: Edit {
                span: Span::at(self.behind),
                text: restored,
            },
            inherited,
        })
    }
}

/// Returns the edits that insert render settings and commands of the material.
pub(super) fn insertions(text: &str, wanted: &[Wanted<'_>]) -> Vec<Edit> {
    let is_inherited = |(placed, _): &&Wanted<'_>| {
        MATERIAL
            .iter()
            .any(|record| record.field(0) == placed.field)
    };
    let (inherited, settings): (Vec<_>, Vec<_>) = wanted.iter().partition(is_inherited);
    let settings: Vec<_> = settings.into_iter().cloned().collect();
    let mut edits = rendering::insertions(text, &settings);
    let own = inherited.iter().filter(|(placed, values)| {
        let is_same = |(at, value): &(usize, String)| placed.default_of(*at) == Some(value);
        !values.iter().all(is_same) && !inherited.iter().any(|(other, _)| also_sets(other, placed))
    });
    let own: Vec<_> = own.map(|wanted| (*wanted).clone()).collect();
    edits.extend(field_spans::insertions(text, &own, |implicit, values| {
        let value = |(at, component): (usize, &Component)| {
            let given = values.iter().find(|(given, _)| *given == at);
            given.map_or_else(|| component.default.to_string(), |(_, value)| value.clone())
        };
        let components = &implicit.components;
        let values: Vec<_> = components.iter().enumerate().map(value).collect();
        format!(
            "{} {}",
            implicit.element.unwrap_or_default(),
            values.join(" ")
        )
    }));
    edits
}

/// Whether setting `placed` sets `other` too: they share a command, or the one stands around all objects
/// of the other.
fn also_sets(placed: &FieldSpans, other: &FieldSpans) -> bool {
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
