//! Wording shared by the diagnostics of lowering.

use std::fmt;

use super::schema::Field;
use text::{
    Diagnostic, Findings, NumberError, Severity, Span, concise, is_integer, parse_number,
    without_suffix,
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
        hint: number_hint(token, error),
        ..Diagnostic::error(span, message, expected)
    };
    match corrected(token) {
        Some((_, number)) => found.with_fix(span, number),
        None => found,
    }
}

/// The longest token that is looked at for what was meant, in bytes.
const LONGEST: usize = 64;

/// The number that was probably meant by a token that is none, and why it is not, as a sentence.
fn corrected(token: &str) -> Option<(&'static str, String)> {
    if LONGEST < token.len() {
        return None;
    }
    if let Some(plain) = without_suffix(token) {
        return Some(("", plain.to_owned()));
    }
    let reads = |text: &str| parse_number(text).is_ok();
    let unsigned = token.trim_start_matches(['+', '-']);
    let unhexed = unsigned
        .strip_prefix("0x")
        .or_else(|| unsigned.strip_prefix("0X"));
    if let Some(digits) = unhexed
        && let Ok(value) = u64::from_str_radix(digits, 16)
    {
        let sign = if token.starts_with('-') { "-" } else { "" };
        return Some(("numbers are decimal: ", format!("{sign}{value}")));
    }
    let pointed = token.replace(',', ".");
    if token.matches(',').count() == 1 && reads(&pointed) && !token.ends_with(',') {
        return Some(("the decimal separator is a point: ", pointed));
    }
    let plain = token.replace(['−', '–', '—'], "-");
    (plain != token && reads(&plain)).then_some(("the minus sign is `-`: ", plain))
}

/// A hint at what was probably meant by a token that is not a number.
fn number_hint(token: &str, error: NumberError) -> Option<String> {
    if LONGEST < token.len() {
        return None;
    }
    if error == NumberError::Overflow {
        return Some("numbers go up to about 1.8e308".to_owned());
    }
    if let Some((why, number)) = corrected(token) {
        return Some(format!("{why}write {number}"));
    }
    let reads = |text: &str| parse_number(text).is_ok();
    if token.contains(',') && token.split(',').all(|part| part.is_empty() || reads(part)) {
        return Some("numbers are separated by white space, without commas".to_owned());
    }
    let word = token.trim_start_matches(['+', '-']).to_ascii_lowercase();
    if matches!(word.as_str(), "nan" | "inf" | "infinity") {
        return Some("numbers are finite".to_owned());
    }
    None
}

/// Adds a question after the word that was probably meant in its place; `otherwise` if none is known.
pub(super) fn did_you_mean(
    diagnostic: Diagnostic,
    meant: Option<&str>,
    otherwise: Option<&str>,
) -> Diagnostic {
    let span = diagnostic.span;
    match meant {
        Some(word) => diagnostic
            .with_hint(format!("did you mean `{word}`?"))
            .with_fix(span, word),
        None => Diagnostic {
            hint: otherwise.map(str::to_owned),
            ..diagnostic
        },
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
    fn malformed_numbers_get_a_hint() {
        for (token, hint) in [
            ("1,5", Some("write 1.5")),
            ("1,2,3", Some("without commas")),
            ("1,", Some("without commas")),
            ("-0x10", Some("write -16")),
            ("−3", Some("write -3")),
            ("3f", Some("write 3")),
            ("NaN", Some("finite")),
            ("1e999", Some("1.8e308")),
            ("abc", None),
            ("0x", None),
            ("0xffffffffffffffffffffffff", None),
        ] {
            let error = parse_number(token).expect_err("no number");
            let found = number_hint(token, error);
            match hint {
                Some(part) => assert!(found.is_some_and(|hint| hint.contains(part)), "{token}"),
                None => assert_eq!(found, None, "{token}"),
            }
        }
    }

    #[test]
    fn quoted_tokens_are_truncated_and_printable() {
        assert_eq!(quoted("ab"), "`ab`");
        assert_eq!(quoted("a\u{1b}[2J"), "`a\\u{1b}[2J`");
        assert_eq!(quoted(&"é".repeat(25)), format!("`{}…`", "é".repeat(24)));
    }
}
