//! The values that a typed or pasted text gives to the components of a field.

use super::arithmetic::{Fault, evaluate, fault};
use super::literals;
use language::schema::{Field, Kind};
use text::{alternatives, concise, counted, parse_number};

/// Significant digits of a computed number: fewer than of an `f64`, so that no trace of binary
/// fractions appears.
const DIGITS: usize = 12;

/// Significant digits of a computed number whose decimals do not end, such as 1/3.
const ENDLESS_DIGITS: usize = 6;

/// Operators that, followed by `=`, change the present value.
const RELATIVE: [char; 4] = ['+', '-', '*', '/'];

/// Components of a field with their new literals.
pub(crate) type Values = Vec<(usize, String)>;

/// Returns the components that a text sets, with their literals: the current one, or all of the
/// field. Literals are kept as typed; expressions become their values, and those after `+=`, `-=`,
/// `*=` or `/=` change the present ones.
///
/// # Errors
///
/// Fails with the reason, and its column in an expression.
pub(crate) fn values(
    field: &Field,
    (component, present): (usize, &[String]),
    text: &str,
) -> Result<Values, String> {
    let kind = field.kind;
    if let Some(all) = literals::all_of(kind, text) {
        return Ok(all.into_iter().enumerate().collect());
    }
    let one = |literal: &str| Ok(vec![(component, literal.to_owned())]);
    if !kind.is_numeric() {
        if let Kind::Choice(words) = kind
            && field.chosen(text).is_none()
            && let Some(word) = literals::word_meant(words, text)
        {
            return one(word);
        }
        return if literals::is_one(text) {
            one(text)
        } else {
            Err(format!("expected {}", field.expected()))
        };
    }
    // A size has no suffix; a number of another language's style is left to its parser.
    if kind.is_size() && parse_number(text).is_ok() {
        return one(text);
    }
    if parse_number(literals::plain(text)).is_ok() {
        return one(literals::plain(text));
    }
    computed(kind, component, present, text)
}

/// Returns the values that a list of numbers or expressions gives to the first of some fields and to
/// those after it, whose kinds are given. `None` unless it sets all components of two fields or more.
pub(crate) fn spread(kinds: impl Iterator<Item = Kind>, text: &str) -> Option<Vec<Values>> {
    let parts = parts(text);
    let mut left = &parts[..];
    let mut fields = Vec::new();
    for kind in kinds {
        if left.is_empty() {
            break;
        }
        if !kind.is_numeric() {
            return None;
        }
        let (own, rest) = left.split_at_checked(kind.components())?;
        let set = |(component, (_, part)): (usize, &(usize, &str))| {
            value_of(part, "").ok().map(|literal| (component, literal))
        };
        fields.push(
            own.iter()
                .enumerate()
                .map(set)
                .collect::<Option<Values>>()?,
        );
        left = rest;
    }
    (left.is_empty() && 1 < fields.len()).then_some(fields)
}

/// How many numbers would set some fields, given by their names and kinds, where a list of numbers sets one
/// of them by half; `None` for any other text.
pub(crate) fn misfit<'n>(
    fields: impl Iterator<Item = (&'n str, Kind)>,
    text: &str,
) -> Option<String> {
    let parts = parts(text);
    if parts.len() < 2 || !parts.iter().all(|(_, part)| value_of(part, "").is_ok()) {
        return None;
    }
    let mut fits = Vec::new();
    let (mut first, mut sum) = (None, 0);
    for (name, kind) in fields.take_while(|(_, kind)| kind.is_numeric()) {
        sum += kind.components();
        fits.push(match *first.get_or_insert(name) {
            first if first == name => format!("{sum} for {name}"),
            first => format!("{sum} for {first} to {name}"),
        });
        if parts.len() <= sum {
            break;
        }
    }
    let last = fits.len().checked_sub(2)?;
    let expected = alternatives(fits.drain(last..));
    let count = parts.len();
    Some(format!("{count} numbers do not fit: expected {expected}"))
}

/// Returns the numbers of a list of numbers and expressions.
///
/// # Errors
///
/// Fails with the reason and its column.
pub(crate) fn numbers(text: &str) -> Result<Vec<f64>, String> {
    if let Some(hint) = comma_hint(text) {
        return Err(hint);
    }
    let parts = parts(text);
    let numbers = parts.iter().map(|(at, part)| {
        evaluate(part).map_err(|fault| format!("column {}: {}", at + fault.at + 1, fault.reason))
    });
    numbers.collect()
}

/// The values of expressions: one for each component, or one for the current one.
fn computed(
    kind: Kind,
    component: usize,
    present: &[String],
    text: &str,
) -> Result<Values, String> {
    let parts = parts(text);
    let set = |(component, (at, part)): (usize, &(usize, &str))| {
        let old = present.get(component).map_or("", String::as_str);
        match value_of(part, old) {
            Ok(literal) => Ok((component, literal)),
            Err(fault) => Err(format!("column {}: {}", at + fault.at + 1, fault.reason)),
        }
    };
    if let Some(hint) = comma_hint(text).filter(|_| !literals::is_all(kind, parts.len())) {
        return Err(hint);
    }
    let [_, _, ..] = &parts[..] else {
        let whole = parts.first().map(|part| (component, part));
        return whole.map_or_else(|| Err(expected(kind)), |whole| Ok(vec![set(whole)?]));
    };
    let is_list = parts.iter().all(|(_, part)| value_of(part, "0").is_ok());
    let is_all = literals::is_all(kind, parts.len());
    if is_list && !is_all {
        return Err(expected(kind));
    }
    // Blanks around an operator do not separate.
    let whole = set((component, &(0, text)));
    if is_list || (is_all && whole.is_err()) {
        return parts.iter().enumerate().map(set).collect();
    }
    Ok(vec![whole?])
}

/// What is to be written for a number with a decimal comma.
fn comma_hint(text: &str) -> Option<String> {
    let error = parse_number(text).err().filter(|_| text.contains(','))?;
    let hint = error.hint(text)?;
    hint.contains("separator").then_some(hint)
}

fn expected(kind: Kind) -> String {
    match kind.components() {
        1 => "expected one number".to_owned(),
        several => format!("expected one number, or {}", counted(several, "number")),
    }
}

/// The parts of a text between blanks and commas outside parentheses, each with the number of
/// characters before it.
fn parts(text: &str) -> Vec<(usize, &str)> {
    let mut parts = Vec::new();
    let mut depth = 0_usize;
    let mut start = None;
    for (at, (byte, c)) in text.char_indices().enumerate() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        let separates = depth == 0 && (c.is_whitespace() || matches!(c, ',' | ';'));
        match start {
            Some((before, from)) if separates => {
                parts.push((before, &text[from..byte]));
                start = None;
            }
            None if !separates => start = Some((at, byte)),
            _ => {}
        }
    }
    parts.extend(start.map(|(before, from)| (before, &text[from..])));
    parts
}

/// The literal of a part: a number as typed, or the value of an expression.
fn value_of(part: &str, old: &str) -> Result<String, Fault> {
    let plain = literals::plain(part);
    if parse_number(plain).is_ok() {
        return Ok(plain.to_owned());
    }
    let relative = part.strip_prefix(RELATIVE);
    let Some(change) = relative.and_then(|rest| rest.strip_prefix('=')) else {
        return Ok(spelled(evaluate(part)?));
    };
    let shifted = |fault: Fault| Fault {
        at: fault.at + 2,
        ..fault
    };
    let by = evaluate(change).map_err(shifted)?;
    let Ok(old) = parse_number(literals::plain(old)) else {
        return Err(fault(0, "there is no number to change"));
    };
    let value = match part.chars().next() {
        Some('+') => old + by,
        Some('-') => old - by,
        Some('*') => old * by,
        _ if by == 0.0 => return Err(fault(0, "division by 0")),
        _ => old / by,
    };
    if value.is_finite() {
        Ok(spelled(value))
    } else {
        Err(fault(0, "the result is too large"))
    }
}

/// Spells a computed value: one with at most [`DIGITS`] digits exactly, any other with a few.
fn spelled(value: f64) -> String {
    let digits = format!("{value:.*e}", DIGITS - 1);
    let is_endless = digits
        .split('e')
        .next()
        .is_some_and(|digits| !digits.ends_with('0'));
    let rounded = if is_endless {
        format!("{value:.*e}", ENDLESS_DIGITS - 1)
    } else {
        digits
    };
    // Adding 0 turns −0 into 0.
    concise(rounded.parse().unwrap_or(value) + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(kind: Kind, text: &str) -> String {
        let field = Field {
            kind,
            ..Field::point("point", "A point.")
        };
        let present = ["1.50".to_owned(), "2".to_owned(), "3".to_owned()];
        match values(&field, (0, &present), text) {
            Ok(values) => {
                let literals = values
                    .into_iter()
                    .map(|(at, literal)| format!("{at}={literal}"));
                literals.collect::<Vec<_>>().join(" ")
            }
            Err(reason) => reason,
        }
    }

    #[test]
    fn literals_stay_and_expressions_become_their_values() {
        for (text, expected) in [
            ("1e-3", "0=1e-3"),
            (".50", "0=.50"),
            ("0.5f", "0=0.5"),
            ("1/3", "0=0.333333"),
            ("1234.5+0.000001", "0=1234.500001"),
            ("0,5", "the decimal separator is a point: write 0.5"),
            ("-0,25", "the decimal separator is a point: write -0.25"),
            ("0.1+0.2", "0=0.3"),
            ("-1/3", "0=-0.333333"),
            ("sin(30)", "0=0.5"),
            ("-0*1", "0=0"),
            ("10^20", "0=1e20"),
            ("+=0.1", "0=1.6"),
            ("-=1/2", "0=1"),
            ("*=2", "0=3"),
            ("/=3", "0=0.5"),
            ("1 + 2", "0=3"),
            ("1+", "column 3: expected a number at the end"),
            ("*=1/0", "column 4: division by 0"),
            ("1 2", "expected one number"),
            ("", "expected one number"),
        ] {
            assert_eq!(set(Kind::Number, text), expected, "{text}");
        }
    }

    #[test]
    fn a_longer_list_fills_the_fields_below() {
        use Kind::{Colour, Number, Point, Word};
        let kinds = [Point, Number, Number, Colour, Word];
        for (text, filled) in [
            ("1 2 3 4", Some("1 2 3, 4")),
            ("1, 2, 3, 1/2, sqrt(4)", Some("1 2 3, 0.5, 2")),
            ("1 2 3 4 5 6 7 8", Some("1 2 3, 4, 5, 6 7 8")),
            ("1 2 3", None),
            ("1 2 3 4 5 6", None),
            ("1 2 3 +=4", None),
            ("1 2 3 4 5 6 7 8 word", None),
        ] {
            let values = |field: Vec<(usize, String)>| {
                let literals: Vec<_> = field.into_iter().map(|(_, literal)| literal).collect();
                literals.join(" ")
            };
            let fields = spread(kinds.into_iter(), text);
            let fields = fields.map(|fields| fields.into_iter().map(values).collect::<Vec<_>>());
            assert_eq!(
                fields.map(|fields| fields.join(", ")).as_deref(),
                filled,
                "{text}"
            );
        }
    }

    #[test]
    fn expressions_fill_all_components() {
        for (text, expected) in [
            ("1/3 0 sqrt(2)", "0=0.333333 1=0 2=1.41421"),
            ("0,5", "the decimal separator is a point: write 0.5"),
            ("1, (1 + 1), -.5e1", "0=1 1=2 2=-.5e1"),
            ("+=1 *=2 /=2", "0=2.5 1=4 2=1.5"),
            ("1 -2", "expected one number, or 3 numbers"),
            ("1 - 2", "0=-1"),
            ("1 0 1/0", "column 6: division by 0"),
            (
                "1 0 x",
                "column 5: `x` is none of pi e sqrt sin cos tan asin acos atan abs",
            ),
        ] {
            assert_eq!(set(Kind::Point, text), expected, "{text}");
        }
    }
}
