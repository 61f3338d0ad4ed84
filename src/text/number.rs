//! Decimal numbers as scene files write them, read and written back in the same style.

/// Why a token is not a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberError {
    /// Not of the form: optional sign, digits with optional fraction, optional exponent.
    NotANumber,
    /// Of that form, but beyond the range of `f64`.
    Overflow,
}

/// Reads a number: optional sign, decimal digits with optional fraction, optional exponent. No
/// hex, `inf` or `nan`. Correctly rounded.
pub fn parse_number(token: &str) -> Result<f64, NumberError> {
    match short_number(token.as_bytes()) {
        Some(value) => Ok(value),
        None => parse_any_number(token),
    }
}

/// The number before the one `f` or `F` at the end of a token, as C writes numbers of single
/// precision: `0.01f`. `None` of all else.
pub fn without_suffix(token: &str) -> Option<&str> {
    let number = token.strip_suffix(['f', 'F'])?;
    (parse_number(number) != Err(NumberError::NotANumber)).then_some(number)
}

/// The value of a number without exponent in fifteen digits or fewer, which most are; `None` of all
/// else. Both its digits as an integer and the power of ten below them are exact, so that their
/// quotient is the one rounding (W. Clinger, "How to read floating point numbers accurately", 1990).
/// A third of the standard parser's time.
#[inline]
fn short_number(token: &[u8]) -> Option<f64> {
    const DIGITS: usize = 15;
    const POWERS: [f64; DIGITS + 1] = [
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
    ];
    let (is_negative, unsigned) = match token {
        [b'-', unsigned @ ..] => (true, unsigned),
        [b'+', unsigned @ ..] | unsigned => (false, unsigned),
    };
    if DIGITS + 1 < unsigned.len() {
        return None;
    }
    let mut value = 0;
    let mut point = None;
    for (at, byte) in unsigned.iter().enumerate() {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            value = 10 * value + u64::from(digit);
        } else if *byte == b'.' && point.is_none() {
            point = Some(at);
        } else {
            return None;
        }
    }
    let digits = unsigned.len() - usize::from(point.is_some());
    if digits == 0 || DIGITS < digits {
        return None;
    }
    let decimals = point.map_or(0, |at| digits - at);
    let value = value as f64 / POWERS[decimals];
    Some(if is_negative { -value } else { value })
}

fn parse_any_number(token: &str) -> Result<f64, NumberError> {
    // The standard parser takes the same form, and beyond it only words for infinity and NaN.
    let worded = token
        .bytes()
        .any(|b| b.is_ascii_alphabetic() && !matches!(b, b'e' | b'E'));
    let value: f64 = match token.parse() {
        Ok(value) if !worded => value,
        _ => return Err(NumberError::NotANumber),
    };
    if value.is_finite() {
        Ok(value)
    } else {
        Err(NumberError::Overflow)
    }
}

/// Whether a number is spelled as an integer, without fraction and exponent.
pub fn is_integer(literal: &str) -> bool {
    !literal.contains(['.', 'e', 'E'])
}

/// How many digits `literal` has after its decimal point (an exponent does not count).
pub fn decimals(literal: &str) -> usize {
    let mantissa = literal.split(['e', 'E']).next().unwrap_or_default();
    mantissa
        .split_once('.')
        .map_or(0, |(_, fraction)| fraction.len())
}

/// Spells `value` in the style of the literal it replaces: a leading `+`, a bare `.5`, the
/// exponent letter and its number of decimals are kept where they can be, an `f` at its end is not;
/// the result always reads back as exactly `value`.
pub fn spell_like(old: &str, value: f64) -> String {
    let old = without_suffix(old).unwrap_or(old);
    let plus = if old.starts_with('+') && value.is_sign_positive() {
        "+"
    } else {
        ""
    };
    let digits = match old.find(['e', 'E']) {
        Some(at) => {
            let shortest = format!("{value:e}");
            let (mantissa, exponent) = shortest.split_once('e').unwrap_or((&shortest, "0"));
            let padded = pad_decimals(mantissa, decimals(old));
            format!("{padded}{}{exponent}", &old[at..=at])
        }
        None => pad_decimals(&format!("{value}"), decimals(old)),
    };
    let unsigned = old.trim_start_matches(['+', '-']);
    let (sign, digits) = match digits.strip_prefix('-') {
        Some(rest) => ("-", rest),
        None => (plus, digits.as_str()),
    };
    let digits = match digits.strip_prefix("0.") {
        Some(fraction) if unsigned.starts_with('.') => format!(".{fraction}"),
        _ => digits.to_owned(),
    };
    format!("{sign}{digits}")
}

/// Spells a value for a message: exactly, and with an exponent only where that is much shorter.
pub fn concise(value: f64) -> String {
    const LONG: usize = 10;
    let (plain, scientific) = (format!("{value}"), format!("{value:e}"));
    if plain.len() <= LONG || plain.len() <= scientific.len() {
        plain
    } else {
        scientific
    }
}

/// Adds zeros until the number has at least `decimals` digits after its point.
fn pad_decimals(number: &str, wanted: usize) -> String {
    let have = decimals(number);
    if have >= wanted {
        return number.to_owned();
    }
    let point = if have == 0 { "." } else { "" };
    format!("{number}{point}{}", "0".repeat(wanted - have))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn numbers_have_a_sign_digits_a_fraction_and_an_exponent() {
        for (token, value) in [
            ("0", 0.0),
            ("-0", 0.0),
            ("+1.5", 1.5),
            (".5", 0.5),
            ("5.", 5.0),
            ("-2e3", -2000.0),
            ("1E-2", 0.01),
            ("1e-400", 0.0),
        ] {
            assert_eq!(parse_number(token), Ok(value), "{token}");
        }
        for token in [
            "", "+", ".", "e1", "1e", "0x10", "inf", "-nan", "infinity", "1,5", "1.2.3", "½",
        ] {
            assert_eq!(parse_number(token), Err(NumberError::NotANumber), "{token}");
        }
        assert_eq!(parse_number("1e999"), Err(NumberError::Overflow));
    }

    #[test]
    fn one_f_may_follow_a_number() {
        for (token, number) in [
            ("0.01f", Some("0.01")),
            ("-1F", Some("-1")),
            ("1.e3f", Some("1.e3")),
            ("1e999f", Some("1e999")),
            ("1", None),
            ("1ff", None),
            ("f", None),
            ("-f", None),
            ("0x1f", None),
            ("inff", None),
        ] {
            assert_eq!(without_suffix(token), number, "{token}");
        }
    }

    #[test]
    fn numbers_are_spelled_like_the_literal_they_replace() {
        for (old, value, spelled) in [
            ("0.45", 0.5, "0.50"),
            (".5", 0.51, ".51"),
            (".5", 1.0, "1.0"),
            ("-.5", 0.25, ".25"),
            ("5", 6.0, "6"),
            ("5", 6.5, "6.5"),
            ("+1", 2.0, "+2"),
            ("+1", -2.0, "-2"),
            ("1e3", 2500.0, "2.5e3"),
            ("1.00E3", 2000.0, "2.00E3"),
            ("0.1", 0.0, "0.0"),
            ("0.01f", 0.5, "0.50"),
            ("1E3F", 2000.0, "2E3"),
        ] {
            assert_eq!(spell_like(old, value), spelled, "{old} → {value}");
        }
    }

    #[test]
    fn values_in_messages_are_short() {
        for (value, said) in [
            (1.5, "1.5"),
            (-0.0001, "-0.0001"),
            (1e6, "1000000"),
            (1e300, "1e300"),
            (-2.5e-9, "-2.5e-9"),
            (0.1 + 0.2, "0.30000000000000004"),
        ] {
            assert_eq!(concise(value), said);
        }
    }

    proptest! {
        #[test]
        fn short_numbers_are_read_as_others_are(
            token in "[-+]?([0-9]{1,17}|[0-9]{0,9}\\.[0-9]{0,9})(e[0-9])?|[-+.0-9e]{0,6}",
        ) {
            let (read, expected) = (parse_number(&token), parse_any_number(&token));
            prop_assert_eq!(read.map(f64::to_bits), expected.map(f64::to_bits));
        }

        #[test]
        fn spelled_numbers_read_back_exactly(
            old in "[+-]?(0|[1-9][0-9]{0,2})?\\.?[0-9]{1,4}([eE]-?[0-9]{1,2})?",
            value in proptest::num::f64::NORMAL | proptest::num::f64::ZERO,
        ) {
            prop_assert_eq!(parse_number(&spell_like(&old, value)), Ok(value));
        }

        #[test]
        fn no_token_makes_the_reader_panic(token in ".{0,12}") {
            let _ = parse_number(&token);
        }
    }
}
