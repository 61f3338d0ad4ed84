//! Tables of a track file, and the values in them.

use std::borrow::Cow;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::Named;
use text::{Diagnostic, Findings, Span, alternatives, nearest_word, parse_number};

/// A value and its place.
pub(super) type FieldSpans<'a, 'i> = &'a Spanned<DeValue<'i>>;

/// A table of which entries are taken one by one.
pub(super) struct Table<'a, 'i> {
    /// The entries not taken yet, in the order of the text.
    entries: Vec<(&'a Spanned<Cow<'i, str>>, FieldSpans<'a, 'i>)>,
    /// The names that were asked for.
    known: Vec<&'static str>,
    span: Span,
}

impl<'a, 'i> Table<'a, 'i> {
    pub(super) fn new(table: &'a DeTable<'i>, span: Span) -> Self {
        let mut entries: Vec<_> = table.iter().collect();
        entries.sort_by_key(|(name, _)| name.span().start);
        Self {
            entries,
            known: Vec::new(),
            span,
        }
    }

    /// The table that a value is.
    pub(super) fn of(value: FieldSpans<'a, 'i>, expected: &str) -> Result<Self, Diagnostic> {
        match value.get_ref() {
            DeValue::Table(table) => Ok(Self::new(table, span_of(value))),
            _ => Err(wrong(value, "a table", expected)),
        }
    }

    /// The place of the table.
    pub(super) fn span(&self) -> Span {
        self.span
    }

    /// Takes an entry, which need not be there.
    pub(super) fn take(&mut self, name: &'static str) -> Option<FieldSpans<'a, 'i>> {
        self.known.push(name);
        let at = self
            .entries
            .iter()
            .position(|(found, _)| found.get_ref() == name)?;
        Some(self.entries.remove(at).1)
    }

    /// Takes an entry that must be there.
    pub(super) fn require(
        &mut self,
        name: &'static str,
        expected: &str,
    ) -> Result<FieldSpans<'a, 'i>, Diagnostic> {
        let missing = || Diagnostic::error(self.span, format!("`{name}` is missing"), expected);
        let missing = missing();
        self.take(name).ok_or(missing)
    }

    /// Reports the entries that were not asked for.
    pub(super) fn finish(self, findings: &mut Findings) {
        for (name, _) in self.entries {
            findings.error(|| {
                let known = || self.known.iter().copied();
                let error = Diagnostic::error(
                    span_of(name),
                    format!("unknown entry `{}`", name.get_ref()),
                    alternatives(known()),
                );
                match nearest_word(name.get_ref(), known()) {
                    Some(nearest) => error.with_hint(format!("did you mean {nearest}?")),
                    None => error,
                }
            });
        }
    }
}

/// The place of a name or a value.
pub(super) fn span_of<T>(spanned: &Spanned<T>) -> Span {
    let span = spanned.span();
    Span::new(span.start, span.end)
}

/// The elements that a value is an array of.
pub(super) fn elements<'a, 'i>(
    value: FieldSpans<'a, 'i>,
    expected: &str,
) -> Result<Vec<FieldSpans<'a, 'i>>, Diagnostic> {
    match value.get_ref() {
        DeValue::Array(array) => Ok(array.iter().collect()),
        _ => Err(wrong(value, "an array", expected)),
    }
}

/// The string that a value is.
pub(super) fn string(value: FieldSpans<'_, '_>, expected: &str) -> Result<Named, Diagnostic> {
    match value.get_ref() {
        DeValue::String(text) => Ok(Named {
            name: text.clone().into_owned(),
            span: span_of(value),
        }),
        _ => Err(wrong(value, "a string", expected)),
    }
}

/// The integer that a value is, within limits.
pub(super) fn integer(
    value: FieldSpans<'_, '_>,
    [least, most]: [u32; 2],
) -> Result<u32, Diagnostic> {
    let number = match value.get_ref() {
        DeValue::Integer(digits) => u32::from_str_radix(digits.as_str(), digits.radix()).ok(),
        _ => None,
    };
    let inside = number.filter(|number| (least..=most).contains(number));
    inside.ok_or_else(|| {
        let expected = format!("a whole number from {least} to {most}");
        wrong(value, &expected, &expected)
    })
}

/// The finite number that a value is.
pub(super) fn number(value: FieldSpans<'_, '_>) -> Option<f64> {
    match value.get_ref() {
        DeValue::Float(digits) => parse_number(digits.as_str()).ok(),
        DeValue::Integer(digits) if digits.radix() == 10 => parse_number(digits.as_str()).ok(),
        DeValue::Integer(digits) => {
            let parsed = u32::from_str_radix(digits.as_str(), digits.radix());
            parsed.ok().map(f64::from)
        }
        _ => None,
    }
}

/// The error for a value that is something else.
pub(super) fn wrong(value: FieldSpans<'_, '_>, is_not: &str, expected: &str) -> Diagnostic {
    Diagnostic::error(span_of(value), format!("this is not {is_not}"), expected)
}
