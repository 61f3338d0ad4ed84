//! The fields of the selected node as they are shown.

use super::Shared;
use crate::language::Node;
use crate::language::table::Field;
use crate::scene::{Camera, Rgb};
use crate::text::Diagnostic;
use crate::ui::app::values::colours;

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
        let source = self.source();
        let written = (0..).zip(&placed.spans).map(|(component, span)| {
            let literal = || source.leaf_text(*span).to_owned();
            let default = placed.default_of(component);
            default.map_or_else(
                || (literal(), Provenance::Text),
                |default| (default.to_owned(), Provenance::Default),
            )
        });
        let (literals, sources): (Vec<_>, Vec<_>) = written.unzip();
        let row = |literals, source| FieldRow {
            field: placed.field,
            literals,
            sources: vec![source; placed.field.kind.components()],
        };
        let shown = |camera: &Camera| -> Vec<String> {
            let literals = self.source().view_literals(camera);
            literals.into_iter().nth(index).unwrap_or_default()
        };
        let scene = self.scene.as_ref();
        if let (Node::View, Some(view), Some(scene)) =
            (self.cursor.selected(), &self.pictures.view, scene)
            && shown(view) != shown(&scene.camera)
        {
            return Some(row(shown(view), Provenance::WorkingView));
        }
        Some(match scene {
            Some(scene) if literals.is_empty() => row(shown(&scene.camera), Provenance::Default),
            None if literals.is_empty() => row(
                vec!["?".to_owned(); placed.field.kind.components()],
                Provenance::Default,
            ),
            _ => FieldRow {
                field: placed.field,
                literals,
                sources,
            },
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
    /// It is from the working view, which differs from the text here.
    WorkingView,
}
