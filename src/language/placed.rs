//! Where the text says a field, or would say it: and the edits that make it say something else.

use super::table::Field;
use super::{Answers, xml};
use crate::text::{Edit, Span};

/// A field and where its components stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The field.
    pub field: &'static Field,
    /// One span a component: where the text does not say it, the empty one where it would. None at
    /// all for a part of the view that only [`Answers::view_edits`] can say.
    pub spans: Vec<Span>,
    /// What the text does not say, if it could.
    pub unsaid: Option<Box<Unsaid>>,
}

/// What the text does not say of a field, and how it would.
#[derive(Clone, Debug, PartialEq)]
pub struct Unsaid {
    /// Of each component, what stands for it; `None` if the text says it.
    pub literals: Vec<Option<&'static str>>,
    /// What would be written, in this order.
    pub(super) attributes: Vec<Unwritten>,
    /// The element that they would be in, if that is missing itself.
    pub(super) element: Option<&'static str>,
    /// Where, and with what around it.
    pub(super) insertion: Insertion,
}

/// An attribute that is not there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unwritten {
    /// The component that it would say; `None` for one that just goes with them.
    pub(super) component: Option<usize>,
    pub(super) name: &'static str,
    pub(super) literal: &'static str,
    /// Whether it must be written with the others, for their being there would change what is read
    /// without it.
    pub(super) goes_along: bool,
}

/// A place of a text where something is put in.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Insertion {
    /// What is replaced, most often nothing.
    pub(super) span: Span,
    pub(super) before: Vec<Piece>,
    /// What stands between, if it is more than one thing.
    pub(super) between: Vec<Piece>,
    pub(super) after: Vec<Piece>,
}

/// A piece of what is put in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Piece {
    /// These words.
    Words(&'static str),
    /// What stands here already.
    Copy(Span),
}

impl Placed {
    /// A field that the text says, or a part of the view that it does not say.
    pub(super) fn said(field: &'static Field, spans: Vec<Span>) -> Self {
        Self {
            field,
            spans,
            unsaid: None,
        }
    }

    /// What stands for a component that the text does not say.
    pub fn default_of(&self, component: usize) -> Option<&'static str> {
        *self.unsaid.as_ref()?.literals.get(component)?
    }

    /// Whether the text says any of its components.
    pub fn is_said(&self) -> bool {
        (0..self.spans.len()).any(|component| self.default_of(component).is_none())
    }

    /// The edits after which the text says these values of its components.
    pub fn edits(&self, source: &dyn Answers, values: &[(usize, String)]) -> Vec<Edit> {
        edits(source, &[(self, values.to_vec())])
    }
}

/// The edits after which the text says these values of components of fields.
pub(super) fn edits(source: &dyn Answers, wanted: &[(&Placed, Vec<(usize, String)>)]) -> Vec<Edit> {
    let mut edits = Vec::new();
    // What goes to one place is put there at once.
    let mut put: Vec<(&Insertion, Vec<String>)> = Vec::new();
    for (placed, values) in wanted {
        let is_said = |component: usize| placed.default_of(component).is_none();
        let (said, missing): (Vec<_>, Vec<_>) = values
            .iter()
            .partition(|(component, _)| is_said(*component));
        edits.extend(said.into_iter().filter_map(|(component, literal)| {
            let span = *placed.spans.get(*component)?;
            Some(Edit {
                span,
                text: source.spelled(span, literal).into_owned(),
            })
        }));
        let Some(unsaid) = placed.unsaid.as_ref().filter(|_| !missing.is_empty()) else {
            continue;
        };
        let words = unsaid.said(&missing);
        match put
            .iter_mut()
            .find(|(place, _)| **place == unsaid.insertion)
        {
            Some((_, all)) => all.push(words),
            None => put.push((&unsaid.insertion, vec![words])),
        }
    }
    edits.extend(
        put.into_iter()
            .map(|(place, all)| place.edit(source.text(), &all)),
    );
    edits.sort_by_key(|edit| edit.span.start());
    edits
}

impl Unsaid {
    /// What would be written to say these values.
    fn said(&self, values: &[&(usize, String)]) -> String {
        let mut said = String::new();
        said.extend(self.element.map(|name| ["<", name]).into_iter().flatten());
        for attribute in &self.attributes {
            let value = values
                .iter()
                .find(|(component, _)| attribute.component == Some(*component));
            let literal = match value {
                Some((_, literal)) => literal,
                None if attribute.goes_along => attribute.literal,
                None => continue,
            };
            let literal = xml::spelled(literal, '"');
            said.extend([" ", attribute.name, "=\"", &literal, "\""]);
        }
        said.extend(self.element.map(|_| "/>"));
        said
    }
}

impl Insertion {
    /// The edit that puts something in.
    fn edit(&self, text: &str, all: &[String]) -> Edit {
        let words = |pieces: &[Piece]| {
            pieces
                .iter()
                .map(|piece| piece.of(text))
                .collect::<String>()
        };
        let put = [
            words(&self.before),
            all.join(&words(&self.between)),
            words(&self.after),
        ]
        .concat();
        Edit {
            span: self.span,
            text: put,
        }
    }
}

impl Piece {
    fn of(self, text: &str) -> &str {
        match self {
            Self::Words(words) => words,
            Self::Copy(span) => span.of(text),
        }
    }
}
