//! Typing and pasting values.

use crossterm::event::{KeyCode, KeyEvent};
use tui_input::Input;

use super::nudging::{current, next_component};
use crate::app::shared::change::Change;
use crate::app::shared::cursor::Typing;
use crate::app::shared::line;
use crate::app::values::typed;
use crate::app::values::typed::Values;
use crate::app::{Shared, text};
use ::text::{Diagnostic, Span};

/// Opens the current component to be typed.
pub(super) fn type_current(shared: &mut Shared) {
    if let Some((field, literal)) = current(shared) {
        shared.cursor.typing = Some(Typing {
            opened: Some(literal.clone()),
            input: Input::from(literal),
            is_selected: !field.kind.is_numeric(),
            refused: None,
        });
    }
}

/// Handles a key while a value is typed.
pub(crate) fn typing_key(shared: &mut Shared, key: KeyEvent) {
    let Some(typing) = &mut shared.cursor.typing else {
        return;
    };
    match key.code {
        KeyCode::Esc => shared.cursor.typing = None,
        KeyCode::Enter | KeyCode::Tab | KeyCode::BackTab | KeyCode::Down | KeyCode::Up => {
            if commit(shared) {
                match key.code {
                    KeyCode::Tab => next_component(shared, 1),
                    KeyCode::BackTab => next_component(shared, -1),
                    KeyCode::Down => shared.move_field(1),
                    KeyCode::Up => shared.move_field(-1),
                    _ => {}
                }
            }
        }
        _ => {
            typing.refused = None;
            let deletes = matches!(key.code, KeyCode::Backspace | KeyCode::Delete);
            let replaces = deletes || line::types(key);
            if std::mem::take(&mut typing.is_selected) && replaces {
                typing.input.reset();
            }
            line::edit(&mut typing.input, key);
        }
    }
}

/// Accepts the typed value, or drops one that is as it was opened: another program may have changed
/// the field since. Returns whether it was valid.
fn commit(shared: &mut Shared) -> bool {
    let Some(typing) = &shared.cursor.typing else {
        return true;
    };
    let typed = typing.input.value().trim().to_owned();
    let opened = typing.opened.as_deref().map(str::trim);
    if opened == Some(&*typed) {
        shared.cursor.typing = None;
        return true;
    }
    let outcome = match literals_of(shared, &typed) {
        Ok(values) => assign_whole(shared, &values),
        Err(reason) => Err(Diagnostic::error(Span::at(0), reason, "")),
    };
    match outcome {
        Ok(()) => shared.cursor.typing = None,
        Err(mut refused) => {
            refused.message = refused.message_with_hint();
            if let Some(typing) = &mut shared.cursor.typing {
                typing.refused = Some(refused);
            }
        }
    }
    shared.cursor.typing.is_none()
}

/// Sets fields as an undo step of its own.
pub(crate) fn assign_whole(shared: &mut Shared, values: &[Values]) -> Result<(), Diagnostic> {
    shared.document.end_step();
    let outcome = text::assign(shared, values);
    shared.document.end_step();
    if outcome.is_ok() {
        let field = shared.cursor.current().map(|placed| placed.field);
        if let Some((field, values)) = field.zip(values.first()) {
            shared.cursor.changed = Some(Change::Set(field, values.clone()));
        }
        text::merge_input(shared);
    }
    outcome
}

/// The values that a typed or pasted text gives to the current field and, if it is a list that
/// is longer, to those below; or why it gives none.
pub(crate) fn literals_of(shared: &Shared, text: &str) -> Result<Vec<Values>, String> {
    let Some(row) = shared.field_row(shared.cursor.field) else {
        return Err("nothing to edit here".to_owned());
    };
    let values = typed::values(row.field, (shared.cursor.component, &row.literals), text);
    values.map(|values| vec![values]).or_else(|reason| {
        let below = shared.cursor.fields().iter().skip(shared.cursor.field);
        let below = below.map(|placed| (placed.field.key, placed.field.kind));
        let kinds = below.clone().map(|(_, kind)| kind);
        let spread = typed::spread(kinds, text);
        spread.ok_or_else(|| typed::misfit(below, text).unwrap_or(reason))
    })
}

/// Whether the line being typed has room for more characters; says so if it has not.
pub(crate) fn has_room(shared: &mut Shared, more: usize) -> bool {
    let typing = shared.cursor.typing.as_ref();
    let typing = typing.map(|typing| (&typing.input, typing.is_selected));
    let has_room = match shared.overlays.line().or(typing) {
        None | Some((_, true)) => more <= line::LONGEST,
        Some((input, false)) => input.value().chars().count() + more <= line::LONGEST,
    };
    if !has_room {
        shared.warn(format!("a line is limited to {} characters", line::LONGEST));
    }
    has_room
}
