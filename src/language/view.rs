//! A camera in the words of a language: the literals of the view's fields.

use super::table::{Field, Kind, place_of};
use crate::text::{line_end, next_line, parse_number};

/// The numbers of each of the view's fields; for a choice, the place of the word.
pub(super) type Numbers = Vec<Vec<f64>>;

/// What the fields of the view would say of a camera that has these numbers, one literal a component.
pub(super) fn literals(
    fields: impl Iterator<Item = &'static Field>,
    numbers: Numbers,
) -> Vec<Vec<String>> {
    let literals = |(field, numbers): (&Field, Vec<f64>)| {
        let spell = |number| literal(field, number);
        numbers.into_iter().map(spell).collect()
    };
    fields.zip(numbers).map(literals).collect()
}

/// The numbers of the view after a component of a field says something else.
///
/// # Errors
///
/// What it must be, if it can't be that.
pub(super) fn saying(
    mut fields: impl Iterator<Item = &'static Field>,
    mut numbers: Numbers,
    (field, component): (usize, usize),
    said: &str,
) -> Result<Numbers, String> {
    let number = numbers
        .get_mut(field)
        .and_then(|field| field.get_mut(component));
    let (Some(field), Some(number)) = (fields.nth(field), number) else {
        return Ok(numbers);
    };
    *number = match field.kind {
        Kind::Choice(words) => {
            let place = place_of(words, said);
            place.ok_or_else(|| words.join(" or "))? as f64
        }
        _ => parse_number(said)
            .ok()
            .filter(|&number| field.allowed.contains(number))
            .ok_or_else(|| field.allowed.limits())?,
    };
    Ok(numbers)
}

/// How a number of a field is written where none stood before.
pub(super) fn literal(field: &Field, number: f64) -> String {
    match field.kind {
        Kind::Choice(words) => words[number as usize % words.len()].to_owned(),
        _ if 1e16 <= number.abs() => format!("{number:e}"),
        // The sum is the same number, and 0 for −0.
        _ => (number + 0.0).to_string(),
    }
}

/// Whether the text must change to say another number; it says 0 for both zeros.
pub(super) fn differ(old: f64, new: f64) -> bool {
    old.partial_cmp(&new) != Some(std::cmp::Ordering::Equal)
}

/// How the text's first line ends; all others are taken to end so, too.
pub(super) fn line_ending(text: &str) -> &'static str {
    let from = line_end(text, 0);
    let end = &text[from..next_line(text, from)];
    ["\n", "\r", "\r\n"]
        .into_iter()
        .find(|&known| known == end)
        .unwrap_or(if end.is_empty() { "\n" } else { "\r\r\n" })
}

/// Where the text begins, after a byte order mark.
pub(super) fn beginning(text: &str) -> usize {
    const MARK: char = '\u{FEFF}';
    if text.starts_with(MARK) {
        MARK.len_utf8()
    } else {
        0
    }
}
