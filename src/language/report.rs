//! Wording shared by the diagnostics of lowering.

use std::fmt;

use super::schema::Field;
use text::{
    Diagnostic, Findings, NumberError, Severity, Span, concise, is_integer, meant_number,
    parse_number, without_suffix,
};

/// A token for display in messages: in backticks, truncated, unprintable characters escaped.
pub(super) fn quoted(token: &str) -> String {
    const SHOWN: usize = 24;
    let mut shown: String = token
        .chars()
        .take(SHOWN)
        .flat_map(char::escape_debug)
        .collect();
    if token.chars().nth(SHOWN).is_some() {
        shown.push('…');
    }
    format!("`{shown}`")
}

/// Parses a number that may have a fraction. A trailing `f` is ignored, with a warning; `what`
/// names the field.
pub(super) fn number(
    span: Span,
    token: &str,
    report: &mut Findings,
    what: impl FnOnce() -> String,
) -> Result<f64, NumberError> {
    let read = parse_number(token);
    let Some(plain) = read.err().and_then(|_| without_suffix(token)) else {
        return read;
    };
    let value = parse_number(plain)?;
    report.warning(|| {
        let shown = quoted(token);
        let message = format!("{}: the `f` at the end of {shown} is ignored", what());
        let expected = format!("a number without it: {}", quoted(plain).trim_matches('`'));
        Diagnostic::warning(span, message, expected)
            .with_hint("other readers of the format may refuse it")
            .with_fix(span, plain)
    });
    Ok(value)
}

/// Reads a number of a field; NaN, with an error, if it is malformed. `what` names the number.
pub(super) fn number_of(
    field: &Field,
    span: Span,
    token: &str,
    report: &mut Findings,
    what: impl Fn() -> String,
) -> f64 {
    parsed(field, span, token, report, &what).unwrap_or_else(|error| {
        report.error(|| {
            let expected = field.allowed.words();
            no_number(Severity::Error, span, token, &what(), &expected, error)
        });
        f64::NAN
    })
}

/// Reads a number of a field in a comment, where what is wrong with it is a warning for the text.
/// `what` names the number.
pub(super) fn number_in_comment(
    field: &Field,
    span: Span,
    token: &str,
    report: &mut Findings,
    what: impl Fn() -> String,
) -> Result<f64, Diagnostic> {
    let expected = field.allowed.words();
    let value = parsed(field, span, token, report, &what)
        .map_err(|error| no_number(Severity::Warning, span, token, &what(), &expected, error))?;
    let is_too_large = field.kind.is_size() && f64::from(u32::MAX) < value;
    let is_fraction = field.allowed.is_whole() && !is_integer(token);
    if field.allowed.contains(value) && !is_too_large && !is_fraction {
        return Ok(value);
    }
    let limits = if is_too_large {
        format!("{} at most", u32::MAX)
    } else {
        field.allowed.limits()
    };
    let message = format!("{}: must be {limits}", what());
    Err(Diagnostic::warning(span, message, expected))
}

/// Parses a number of a field; only one that may have a fraction may have a suffix.
fn parsed(
    field: &Field,
    span: Span,
    token: &str,
    report: &mut Findings,
    what: impl FnOnce() -> String,
) -> Result<f64, NumberError> {
    if field.allowed.is_whole() {
        parse_number(token)
    } else {
        number(span, token, report, what)
    }
}

/// The diagnostic for a number outside the usual range of its field: an error if it is not even
/// allowed.
pub(super) fn out_of_range(field: &Field, span: Span, value: f64, what: &str) -> Diagnostic {
    if !field.allowed.contains(value) {
        let message = format!("{what}: must be {}", field.allowed.limits_against(value));
        return Diagnostic::error(span, message, field.allowed.words_against(value));
    }
    let message = format!("{what}: {} is not {}", concise(value), field.usual.limits());
    let warning = Diagnostic::warning(span, message, field.usual.words());
    match field.reads_as {
        Some(value) => warning
            .with_hint(format!("it is read as {value}"))
            .with_fix(span, value.to_string()),
        None => warning.with_hint("it is used as given"),
    }
}

/// The diagnostic for a token where a number is expected. `what` names the field.
pub(super) fn no_number(
    severity: Severity,
    span: Span,
    token: &str,
    what: &str,
    expected: &str,
    error: NumberError,
) -> Diagnostic {
    let shown = quoted(token);
    let message = match error {
        NumberError::NotANumber => format!("{what}: {shown} is not a number"),
        NumberError::Overflow => format!("{what}: {shown} is too large for any number"),
    };
    let found = Diagnostic {
        severity,
        hint: error.hint(token),
        ..Diagnostic::error(span, message, expected)
    };
    match meant_number(token) {
        Some(number) => found.with_fix(span, number),
        None => found,
    }
}

/// A node's name, formatted only when a message needs it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Name {
    View,
    Ambient,
    Light(usize),
    /// By index and kind.
    Object(usize, &'static str),
    /// An item with an ID: category, ID and kind.
    Known(&'static str, i64, &'static str),
    /// A record without an ID.
    Record(&'static str),
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::View => f.write_str("view"),
            Self::Ambient => f.write_str("ambient"),
            Self::Light(index) => write!(f, "light {}", index + 1),
            Self::Object(index, kind) => write!(f, "object {} ({kind})", index + 1),
            Self::Known(word, id, "") => write!(f, "{word} {id}"),
            Self::Known(word, id, kind) => write!(f, "{word} {id} ({kind})"),
            Self::Record(word) => f.write_str(word),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quoted_tokens_are_truncated_and_printable() {
        assert_eq!(quoted("ab"), "`ab`");
        assert_eq!(quoted("a\u{1b}[2J"), "`a\\u{1b}[2J`");
        assert_eq!(quoted(&"é".repeat(25)), format!("`{}…`", "é".repeat(24)));
    }
}
