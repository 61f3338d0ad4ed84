//! Cameras in a language: the literals of the view's fields.

use super::Source;
use super::field_spans::FieldSpans;
use super::schema::{Field, Kind};
use scene::Camera;
use text::{Edit, Span, line_end, line_start, next_line, parse_number, spell_like};

/// The numbers of the view's fields, one per component; for a choice, the index of the word.
pub(super) type Numbers = Vec<f64>;

impl Source {
    /// The literals of the view's fields for a camera, one per component.
    pub fn view_literals(&self, camera: &Camera) -> Vec<Vec<String>> {
        literals(&self.view_fields(), &self.view_numbers(camera))
    }

    /// The camera after a component of a view field is changed.
    ///
    /// # Errors
    ///
    /// Fails with a description of the permitted values if `literal` is not one.
    pub fn view_with(
        &self,
        camera: &Camera,
        at: (usize, usize),
        literal: &str,
    ) -> Result<Camera, String> {
        let numbers = with_component(&self.view_fields(), self.view_numbers(camera), at, literal)?;
        Ok(self.view_camera(&numbers, camera))
    }
}

/// The literals of the view's fields for these numbers, one per component.
pub(super) fn literals(fields: &[&'static Field], numbers: &[f64]) -> Vec<Vec<String>> {
    let mut numbers = numbers.iter();
    let literals = |field: &&Field| {
        let own = numbers.by_ref().take(field.kind.components());
        own.map(|&number| literal(field, number)).collect()
    };
    fields.iter().map(literals).collect()
}

/// Returns the numbers of the view with one component of a field changed to `literal`.
///
/// # Errors
///
/// Fails with a description of the permitted values if `literal` is not one.
pub(super) fn with_component(
    fields: &[&'static Field],
    mut numbers: Numbers,
    (field, component): (usize, usize),
    literal: &str,
) -> Result<Numbers, String> {
    let before = fields.iter().take(field);
    let first: usize = before.map(|field| field.kind.components()).sum();
    let number = numbers.get_mut(first + component);
    let (Some(field), Some(number)) = (fields.get(field), number) else {
        return Ok(numbers);
    };
    *number = match field.kind {
        Kind::Choice(words) => {
            let (place, _) = field.chosen(literal).ok_or_else(|| words.join(" or "))?;
            place as f64
        }
        _ => match parse_number(literal) {
            Ok(number) if field.allowed.contains(number) => number,
            Ok(number) => return Err(field.allowed.limits_against(number)),
            Err(_) => return Err(field.allowed.limits()),
        },
    };
    Ok(numbers)
}

/// Splits off the numbers of a field from the front of `numbers`.
pub(super) fn take<'n>(numbers: &mut &'n [f64], field: &Field) -> &'n [f64] {
    let (taken, rest) = numbers.split_at(field.kind.components());
    *numbers = rest;
    taken
}

/// Returns the edits that change the numbers of a view from `old` to `new` where the text states them,
/// spelled like the old ones. `fields` are those of the view.
pub(super) fn respelled(text: &str, fields: &[FieldSpans], [old, new]: [&[f64]; 2]) -> Vec<Edit> {
    let (mut old, mut new) = (old, new);
    let mut edits = Vec::new();
    for FieldSpans { field, spans, .. } in fields {
        let numbers = take(&mut old, field).iter().zip(take(&mut new, field));
        let changed = spans.iter().zip(numbers);
        let changed = changed.filter(|(_, (old, new))| old != new);
        edits.extend(changed.map(|(&span, (_, &number))| Edit {
            span,
            text: match field.kind {
                Kind::Choice(_) => literal(field, number),
                _ => spell_like(span.of(text), number + 0.0),
            },
        }));
    }
    edits
}

/// Formats a number of a field in default style, for a place without a number.
pub(super) fn literal(field: &Field, number: f64) -> String {
    match field.kind {
        Kind::Choice(words) => words[number as usize % words.len()].to_owned(),
        _ => spelled(number),
    }
}

/// Formats a number in default style.
pub(super) fn spelled(number: f64) -> String {
    if 1e16 <= number.abs() {
        return format!("{number:e}");
    }
    // Adding 0 keeps the number but turns −0 into 0.
    (number + 0.0).to_string()
}

/// The line ending of the text's first line, assumed for all others.
pub(super) fn line_ending(text: &str) -> &'static str {
    let from = line_end(text, 0);
    let end = &text[from..next_line(text, from)];
    ["\n", "\r", "\r\n"]
        .into_iter()
        .find(|&known| known == end)
        .unwrap_or(if end.is_empty() { "\n" } else { "\r\r\n" })
}

/// The offset where the text begins, after a byte order mark.
pub(super) fn beginning(text: &str) -> usize {
    const MARK: char = '\u{FEFF}';
    if text.starts_with(MARK) {
        MARK.len_utf8()
    } else {
        0
    }
}

/// The start of the line that contains offset `at`, after a byte order mark, which belongs to no
/// line: it stays in front.
pub(super) fn line_from(text: &str, at: usize) -> usize {
    line_start(text, at).max(beginning(text).min(at))
}

/// The lines of a span with their end, if nothing else is on them.
pub(super) fn whole_lines(text: &str, span: Span) -> Option<Span> {
    let start = line_from(text, span.start());
    let before = &text[start..span.start()];
    let behind = &text[span.end()..line_end(text, span.end())];
    let is_alone = before.trim().is_empty() && behind.trim().is_empty();
    is_alone.then(|| Span::new(start, next_line(text, span.end())))
}
