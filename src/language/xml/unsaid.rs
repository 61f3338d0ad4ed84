//! Defaults of fields that an `.xml` text omits, and the insertion of these fields.

use super::tree::spelled;
use crate::language::placed::Wanted;
use crate::text::{Edit, Span};

/// The omitted part of a field, and how to insert it.
#[derive(Clone, Debug, PartialEq)]
pub struct Unsaid {
    /// The default of each component; `None` if the text states it.
    pub(in crate::language) literals: Vec<Option<&'static str>>,
    /// The attributes to write, in this order.
    pub(super) attributes: Vec<Unwritten>,
    /// The element to write them in, if that is missing too.
    pub(super) element: Option<&'static str>,
    /// The place and the surroundings of the insertion.
    pub(super) insertion: Insertion,
}

/// A missing attribute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unwritten {
    /// The component it sets; `None` if it only accompanies the others.
    pub(super) component: Option<usize>,
    pub(super) name: &'static str,
    pub(super) literal: &'static str,
    /// Whether it must be written with the others, whose presence would change the default of this
    /// one.
    pub(super) goes_along: bool,
}

/// A place for an insertion.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Insertion {
    /// The text replaced, usually empty.
    pub(super) span: Span,
    pub(super) before: Vec<Piece>,
    /// The text between several insertions at this place.
    pub(super) between: Vec<Piece>,
    pub(super) after: Vec<Piece>,
}

/// A piece of inserted text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Piece {
    /// Fixed text.
    Words(&'static str),
    /// A copy of this part of the text.
    Copy(Span),
}

/// Returns the edits that insert these values where the text omits them. Insertions at one place
/// are combined.
pub(super) fn insertions(text: &str, wanted: &[Wanted<'_>]) -> Vec<Edit> {
    let mut put: Vec<(&Insertion, Vec<String>)> = Vec::new();
    for (placed, values) in wanted {
        let missing = values
            .iter()
            .filter(|(component, _)| placed.default_of(*component).is_some());
        let missing: Vec<_> = missing.collect();
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
    let edits = put.into_iter();
    edits.map(|(place, all)| place.edit(text, &all)).collect()
}

impl Unsaid {
    /// The text to insert for these values.
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
            let literal = spelled(literal, '"');
            said.extend([" ", attribute.name, "=\"", &literal, "\""]);
        }
        said.extend(self.element.map(|_| "/>"));
        said
    }
}

impl Insertion {
    /// The edit that inserts all of these at once.
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
