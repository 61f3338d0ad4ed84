//! The fields of the selected node as they are shown.

use super::Shared;
use crate::app::values::colours;
use language::Node;
use language::schema::Field;
use scene::{Camera, Rgb};
use text::Diagnostic;

impl Shared {
    /// The fields of the selected node as shown.
    pub fn fields(&self) -> Vec<FieldRow> {
        let fields = 0..self.cursor.fields().len();
        fields.filter_map(|index| self.field_row(index)).collect()
    }

    /// The most severe error or warning about a field of the selected node.
    pub fn field_finding(&self, index: usize) -> Option<&Diagnostic> {
        let placed = self.cursor.fields().get(index)?;
        let touches = |d: &&Diagnostic| {
            let mut spans = (0..).zip(&placed.spans);
            spans.any(|(at, span)| placed.default_of(at).is_none() && d.span.touches(*span))
        };
        let found = self.diagnostics.iter().filter(touches);
        found.max_by_key(|d| d.severity)
    }

    pub(crate) fn field_row(&self, index: usize) -> Option<FieldRow> {
        let placed = self.cursor.fields().get(index)?;
        let field = placed.field;
        let components = field.kind.components();
        let row = |literals, source| FieldRow {
            field,
            literals,
            sources: vec![source; components],
        };
        let shown = |camera: &Camera| -> Vec<String> {
            let literals = self.source().view_literals(camera);
            literals.into_iter().nth(index).unwrap_or_default()
        };
        let own = self.own_camera();
        if let (Node::View, Some(view), Some(own)) =
            (self.cursor.selected(), &self.pictures.view, &own)
            && shown(view) != shown(own)
        {
            return Some(row(shown(view), Provenance::WorkingView));
        }
        let literals = colours::literals(self.source(), placed);
        if literals.is_empty() {
            let literals = own.map_or_else(|| vec!["?".to_owned(); components], |own| shown(&own));
            return Some(row(literals, Provenance::Default));
        }
        let source = |component| match placed.default_of(component) {
            Some(_) if placed.is_inherited() => Provenance::Inherited,
            Some(_) => Provenance::Default,
            None => Provenance::Text,
        };
        let sources = (0..literals.len()).map(source).collect();
        Some(FieldRow {
            field,
            literals,
            sources,
        })
    }
}

/// A field of the selected node as shown; see [`Shared::fields`].
#[derive(Clone, Debug, PartialEq)]
pub struct FieldRow {
    /// Its description in the language's table.
    pub field: &'static Field,
    /// One literal per component.
    pub literals: Vec<String>,
    /// The provenance of each literal.
    pub sources: Vec<Provenance>,
}

impl FieldRow {
    /// Whether all literals have this provenance.
    pub fn is_all(&self, source: Provenance) -> bool {
        self.sources.iter().all(|&of| of == source)
    }

    /// The colour that its literals represent.
    pub fn colour(&self) -> Option<Rgb> {
        colours::of_literals(self.field.kind, &self.literals)
    }
}

/// The provenance of a field's literal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Provenance {
    /// It is in the text.
    Text,
    /// It is a default, absent from the text.
    Default,
    /// The text states it for several objects; a change states it for this one alone.
    Inherited,
    /// It is from the working view, which differs from the text here.
    WorkingView,
}
