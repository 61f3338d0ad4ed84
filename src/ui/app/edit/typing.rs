//! Entering values: nudging, typing, pasting.

use crossterm::event::{KeyCode, KeyEvent};
use tui_input::Input;

use crate::language::table::{Field, Kind};
use crate::text::{Diagnostic, Span, parse_number};
use crate::ui::app::shared::cursor::Typing;
use crate::ui::app::shared::line;
use crate::ui::app::values::typed::Values;
use crate::ui::app::values::{literals, typed};
use crate::ui::app::{Shared, Stride, text};

/// The current component's field and its literal as shown.
fn current(shared: &Shared) -> Option<(&'static Field, String)> {
    let row = shared.field_row(shared.cursor.field)?;
    let literal = row.literals.get(shared.cursor.component)?.clone();
    Some((row.field, literal))
}

/// Nudges the current component by a number of steps; a word or a reference goes to its neighbour.
pub(super) fn nudge(shared: &mut Shared, steps: i8, stride: Stride) {
    let Some((field, literal)) = current(shared) else {
        return;
    };
    let step = shared.cursor.stride_with(stride).of(field.step);
    let nudged = match field.kind {
        Kind::Choice(words) => {
            let word = field
                .chosen(&literal)
                .map_or(&literal[..], |(_, word)| word);
            literals::next(words, word, steps)
        }
        Kind::Reference(category) | Kind::Name(category) => {
            let known = shared
                .source()
                .references(shared.cursor.selected(), category);
            let known: Vec<_> = known.into_iter().map(|(literal, _)| literal).collect();
            literals::next(&known, &literal, steps)
        }
        _ => literals::nudged(&literal, f64::from(steps) * step, step)
            .map(|nudged| literals::kept_in(field.usual, &literal, nudged)),
    };
    let Some(nudged) = nudged else {
        let expected = field.expected();
        shared.fail(format!("{literal} has no next value; type {expected}"));
        return;
    };
    if nudged == literal {
        let is_end = |end: &f64| parse_number(literals::plain(&literal)) == Ok(*end);
        shared.warn(if !field.kind.is_numeric() {
            "there are no other choices"
        } else if literals::slider_ends(field.usual).is_some_and(|ends| ends.iter().any(is_end)) {
            "end of the slider; type a value to go on"
        } else {
            "the step is too small to change this number"
        });
    } else if let Err(refused) = text::assign(shared, &[vec![(shared.cursor.component, nudged)]]) {
        shared.fail(refused.message);
    }
}

/// Makes the steps of nudges larger or smaller.
pub(super) fn change_stride(shared: &mut Shared, step: isize) {
    let words = shared.cursor.change_stride(step);
    shared.say(words);
}

/// Moves the cursor to another component.
pub(super) fn next_component(shared: &mut Shared, step: isize) {
    shared.document.end_step();
    shared.cursor.next_component(step);
}

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
        KeyCode::Enter => {
            commit(shared);
        }
        KeyCode::Tab | KeyCode::BackTab => {
            let step = if key.code == KeyCode::Tab { 1 } else { -1 };
            if commit(shared) {
                next_component(shared, step);
            }
        }
        KeyCode::Down | KeyCode::Up => {
            let step = if key.code == KeyCode::Down { 1 } else { -1 };
            if commit(shared) {
                shared.move_field(step);
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
        let kinds = below.map(|placed| placed.field.kind);
        typed::spread(kinds, text).ok_or(reason)
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

/// Whether the field under the cursor is a colour.
pub(super) fn has_colour(shared: &Shared) -> bool {
    let row = shared.field_row(shared.cursor.field);
    row.is_some_and(|row| row.colour().is_some())
}

/// Whether it is changed by steps of some size.
pub(super) fn has_number(shared: &Shared) -> bool {
    let row = shared.field_row(shared.cursor.field);
    row.is_some_and(|row| row.field.kind.is_numeric())
}

/// Whether it is changed by steps.
pub(super) fn has_steps(shared: &Shared) -> bool {
    let row = shared.field_row(shared.cursor.field);
    row.is_some_and(|row| row.field.kind != Kind::Word)
}

/// Whether the selected node has several components.
pub(super) fn has_components(shared: &Shared) -> bool {
    let fields = shared.cursor.fields().iter();
    let components = fields.map(|placed| placed.field.kind.components());
    1 < components.sum::<usize>()
}

/// Whether it has a frame whose directions are not orthonormal.
pub(super) fn has_oblique_frame(shared: &Shared) -> bool {
    let edits = shared.source().orthonormalised(shared.cursor.selected());
    edits.is_ok_and(|edits| !edits.is_empty())
}
