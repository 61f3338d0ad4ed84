//! Nudging values, and the component that is nudged.

use super::repeating::edits_by;
use crate::app::shared::change::Change;
use crate::app::values::literals;
use crate::app::{Shared, Stride, text};
use ::text::{Diagnostic, parse_number};
use language::schema::{Field, Kind};

/// The current component's field and its literal as shown.
pub(super) fn current(shared: &Shared) -> Option<(&'static Field, String)> {
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
    } else if let Err(refused) = assign_nudged(shared, &nudged, f64::from(steps) * step) {
        shared.fail(refused.message);
    }
}

/// Sets the current component to its nudged literal; the numbers of marked nodes change by the same amount.
fn assign_nudged(shared: &mut Shared, nudged: &str, by: f64) -> Result<(), Diagnostic> {
    let component = shared.cursor.component;
    let Some(field) = shared.cursor.current().map(|placed| placed.field) else {
        return Ok(());
    };
    let values = vec![(component, nudged.to_owned())];
    if !field.kind.is_numeric() {
        text::assign(shared, std::slice::from_ref(&values))?;
        shared.cursor.changed = Some(Change::Set(field, values));
        return Ok(());
    }
    if text::sets_marked(shared) && 1 < shared.cursor.marks.len() {
        let nodes: Vec<_> = shared.cursor.marks.iter().copied().collect();
        let (edits, _) = edits_by(shared, &nodes, (field, component), by);
        text::try_edits(shared, &edits)?;
        text::say_marked(shared);
    } else {
        text::assign(shared, &[values])?;
    }
    shared.cursor.changed = Some(Change::Nudged(field, component, by));
    Ok(())
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
