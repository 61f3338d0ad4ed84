//! Values of a configuration, and words for errors in them.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use text::{Diagnostic, Span, nearest_word};

/// After this many errors no more is read: they tell the user nothing new, and a long file could have
/// many thousands.
pub(super) const MOST_ERRORS: usize = 100;

/// A key of a table.
pub(super) type Name<'a> = Spanned<std::borrow::Cow<'a, str>>;
/// A value of a table.
pub(super) type Value<'a> = Spanned<DeValue<'a>>;

/// The entries of a table in the order of the text.
pub(super) fn in_order<'a, 'i>(table: &'a DeTable<'i>) -> Vec<(&'a Name<'i>, &'a Value<'i>)> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(name, _)| name.span().start);
    entries
}

/// The place of a name or a value.
pub(super) fn span_of<T>(spanned: &Spanned<T>) -> Span {
    let span = spanned.span();
    Span::new(span.start, span.end)
}

/// What a value is, with its article.
pub(super) fn kind_of(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a string",
        DeValue::Integer(_) => "an integer",
        DeValue::Float(_) => "a float",
        DeValue::Boolean(_) => "a boolean",
        DeValue::Datetime(_) => "a date or time",
        DeValue::Array(_) => "an array",
        DeValue::Table(_) => "a table",
    }
}

/// The best advice for a misspelt word, if any.
pub(super) fn advised<'a>(
    error: Diagnostic,
    word: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Diagnostic {
    match nearest_word(word, known) {
        Some(nearest) => error.with_hint(format!("did you mean {nearest}?")),
        None => error,
    }
}
