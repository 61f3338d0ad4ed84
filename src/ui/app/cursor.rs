//! The cursor while the text changes under it.

use std::sync::Arc;

use super::App;
use crate::language::Placed;
use crate::text::{Edit, Span};

/// Where the cursor was before a text came from outside.
#[derive(Debug)]
pub(super) struct Held {
    /// The text it was in.
    pub(super) text: Arc<String>,
    /// The field it was on, and the place of its component where the text says it.
    field: Option<(&'static str, Option<Span>)>,
}

impl App {
    /// Notes where the cursor is.
    pub(super) fn hold(&self) -> Held {
        let field = self.placed().get(self.field).map(|placed| {
            let span = placed.spans.get(self.component).copied();
            (placed.field.key, span)
        });
        Held {
            text: self.document.shared_text(),
            field,
        }
    }

    /// Puts the cursor back on the number that it was on before an edit, and keeps what is typed
    /// there; whether that had to be dropped because the field is gone.
    pub(super) fn follow_cursor(&mut self, held: &Held, edit: Option<&Edit>) -> bool {
        let Some((key, span)) = held.field else {
            return self.typing.take().is_some();
        };
        let moved = span.zip(edit).and_then(|(span, edit)| {
            if edit.span.end() <= span.start() {
                let by = |at: usize| at + edit.text.len() - edit.span.len();
                Some(Span::new(by(span.start()), by(span.end())))
            } else {
                (span.end() <= edit.span.start()).then_some(span)
            }
        });
        let node = moved.and_then(|span| self.source().node_at(span));
        let component = self.component;
        if let Some(node) = node
            && node != self.selected
        {
            self.selected = node;
        }
        let placed = self.placed();
        // Several fields may have one name.
        let holds = |place: &Placed| moved.is_some_and(|span| place.spans.contains(&span));
        let called = |place: &&Placed| place.field.key == key;
        let field = placed
            .iter()
            .position(holds)
            .or_else(|| placed.iter().position(|place| called(&place)));
        if let Some(field) = field {
            self.field = field;
            self.component = component.min(placed[field].field.kind.components() - 1);
            return false;
        }
        self.keep_cursor();
        self.typing.take().is_some()
    }
}
