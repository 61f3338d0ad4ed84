//! The places of fields in the text, and the edits that change them.

use super::Answers;
use super::table::Field;
use super::xml::Unsaid;
use crate::text::{Edit, Span};

/// A field with the places of its components.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The field in the table.
    pub field: &'static Field,
    /// One span per component; empty, at the place for insertion, if the text does not state the
    /// component. No spans at all for a part of the view that only [`Answers::view_edits`] can add.
    pub spans: Vec<Span>,
    /// Defaults and insertions of components that the text omits, if it could state them.
    pub(super) unsaid: Option<Box<Unsaid>>,
}

/// A field and the new values of its components, by index.
pub type Wanted<'p> = (&'p Placed, Vec<(usize, String)>);

impl Placed {
    /// A field stated in the text, or a part of the view that is not.
    pub(super) fn said(field: &'static Field, spans: Vec<Span>) -> Self {
        Self {
            field,
            spans,
            unsaid: None,
        }
    }

    /// The default of a component that the text omits.
    pub fn default_of(&self, component: usize) -> Option<&'static str> {
        *self.unsaid.as_ref()?.literals.get(component)?
    }

    /// Whether the text states any of the components.
    pub fn is_said(&self) -> bool {
        (0..self.spans.len()).any(|component| self.default_of(component).is_none())
    }

    /// Returns the edits that set these components.
    pub fn edits(&self, source: &dyn Answers, values: &[(usize, String)]) -> Vec<Edit> {
        source.edits(&[(self, values.to_vec())])
    }
}

/// Returns the edits that set these components where the text states them.
pub(super) fn edits<Source: Answers + ?Sized>(source: &Source, wanted: &[Wanted<'_>]) -> Vec<Edit> {
    let edits = wanted.iter().flat_map(|(placed, values)| {
        let said = values
            .iter()
            .filter(|(component, _)| placed.default_of(*component).is_none());
        said.filter_map(|(component, literal)| {
            let span = *placed.spans.get(*component)?;
            let text = source.spelled(span, literal).into_owned();
            Some(Edit { span, text })
        })
    });
    let mut edits: Vec<_> = edits.collect();
    edits.sort_by_key(|edit| edit.span.start());
    edits
}
