//! Whether keys would do something: the others are not hinted.

use super::{Shared, Tool};
use crate::language::Node;
use crate::language::table::Kind;

impl Shared {
    /// Whether the field under the cursor is a colour.
    pub(super) fn has_colour(&self) -> bool {
        let row = self.field_row(self.cursor.field);
        row.is_some_and(|row| row.colour().is_some())
    }

    /// Whether it is changed by steps of some size.
    pub(super) fn has_number(&self) -> bool {
        let row = self.field_row(self.cursor.field);
        row.is_some_and(|row| row.field.kind.is_numeric())
    }

    /// Whether it is changed by steps.
    pub(super) fn has_steps(&self) -> bool {
        let row = self.field_row(self.cursor.field);
        row.is_some_and(|row| row.field.kind != Kind::Word)
    }

    /// Whether the selected node has several components.
    pub(super) fn has_components(&self) -> bool {
        let fields = self.cursor.fields().iter();
        let components = fields.map(|placed| placed.field.kind.components());
        1 < components.sum::<usize>()
    }

    /// Whether it has a frame whose directions are not orthonormal.
    pub(super) fn has_oblique_frame(&self) -> bool {
        let edits = self.source().orthonormalised(self.cursor.selected());
        edits.is_ok_and(|edits| !edits.is_empty())
    }

    /// Whether the explained thing is a light.
    pub(super) fn explains_light(&self) -> bool {
        matches!(self.explained_node(), Some(Node::Light(_)))
    }

    /// Whether the targets have a place that a tool changes.
    pub(super) fn is_movable(&self, tool: Tool) -> bool {
        let has_place = |node: &Node| match node {
            Node::View => self.refuses_camera(tool).is_none(),
            Node::Object(_) => true,
            node => self.source().pose(*node).is_some(),
        };
        self.targets().iter().all(has_place)
    }
}
