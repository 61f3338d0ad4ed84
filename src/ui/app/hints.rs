//! Which keys the line of hints and the questions offer: those that would do something.

use super::App;
use crate::language::Node;
use crate::language::table::Kind;
use crate::ui::keymap::{Action, Context, Entry, Mode, Playback, Tool};

impl App {
    /// The hints for the keys that do something now, the most useful first.
    pub fn hints(&self) -> Vec<Entry> {
        let context = self.context();
        self.keymap
            .hints(context, |action| self.acts(action, context))
    }

    /// Whether an action would do something, as far as hints tell.
    fn acts(&self, action: Action, context: Context) -> bool {
        match (action, context) {
            (Action::SaveView, Context::Quit | Context::Leave) => self.is_view_unwritten(),
            (Action::SaveView | Action::ResetView, Context::In(_)) => self.pictures.view.is_some(),
            (Action::Save, Context::In(_)) => !self.is_saved(),
            (Action::OnTrack(Playback::Key), _) => self.sequence.open.is_some(),
            (Action::Scroll(..), _) => !self.viewport().is_fit(),
            (Action::Pause | Action::Stop, Context::In(Mode::Trace)) => self.picture().is_awaited(),
            (Action::Sample(_), _) => 1 < self.sample_count(),
            (Action::Solo, Context::Rays) => matches!(self.explained_node(), Some(Node::Light(_))),
            (Action::Accept, Context::Rays) => self.explained_node().is_some(),
            (Action::Undo, _) => self.document.undoable().is_some(),
            (Action::Transform(tool), Context::In(Mode::Select)) => self.is_movable(tool),
            (Action::Go(Mode::Edit), _) => !self.cursor.fields().is_empty(),
            (_, Context::In(Mode::Edit)) => self.acts_on_field(action),
            _ => true,
        }
    }

    /// Whether an action of EDIT mode would do something to the current field or its node.
    fn acts_on_field(&self, action: Action) -> bool {
        let row = self.field_row(self.cursor.field);
        match action {
            Action::Colour => row.is_some_and(|row| row.colour().is_some()),
            Action::Stride(_) => row.is_some_and(|row| row.field.kind.is_numeric()),
            Action::Nudge(..) => row.is_some_and(|row| row.field.kind != Kind::Word),
            Action::Component(_) => {
                let fields = self.cursor.fields().iter();
                let components = fields.map(|placed| placed.field.kind.components());
                1 < components.sum::<usize>()
            }
            Action::Orthonormalise => {
                let edits = self.source().orthonormalised(self.cursor.selected());
                edits.is_ok_and(|edits| !edits.is_empty())
            }
            _ => true,
        }
    }

    /// Whether the targets have a place that a tool changes.
    fn is_movable(&self, tool: Tool) -> bool {
        let has_place = |node: &Node| match node {
            Node::View => self.refuses_camera(tool).is_none(),
            Node::Object(_) => true,
            node => self.source().pose(*node).is_some(),
        };
        self.targets().iter().all(has_place)
    }
}
