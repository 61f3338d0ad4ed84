//! Numbers and words as they are typed, pasted and nudged.

use language::schema::{Kind, Range};
use text::{decimals, parse_number, rounded, spell_like, without_suffix};

/// Adds `change`, a multiple of `step`, to a literal and spells the sum like the literal. It has
/// the decimals of the old number or of the step, whichever has more, so that no trace of binary
/// fractions appears. `None` if the literal is not a number.
pub(crate) fn nudged(literal: &str, change: f64, step: f64) -> Option<String> {
    let old = parse_number(plain(literal)).ok()?;
    let places = decimals(&old.to_string()).max(decimals(&step.to_string()));
    let sum = rounded(old + change, places);
    sum.is_finite().then(|| {
        if sum.to_bits() == old.to_bits() {
            literal.to_owned()
        } else {
            spell_like(literal, sum)
        }
    })
}

/// A nudged number, stopped at the end of the slider that the number before was on: 0 or 1 where
/// these are the ends of the usual range.
pub(crate) fn kept_in(usual: Range, before: &str, nudged: String) -> String {
    let ends = slider_ends(usual);
    let numbers = parse_number(plain(before))
        .ok()
        .zip(parse_number(plain(&nudged)).ok());
    match (ends, numbers) {
        (Some([least, greatest]), Some((old, new))) if usual.contains(old) => {
            let kept = new.clamp(least, greatest);
            if kept == old {
                before.to_owned()
            } else if kept == new {
                nudged
            } else {
                spell_like(before, kept)
            }
        }
        _ => nudged,
    }
}

/// The ends of a slider over a usual range; `None` for ranges without one.
pub(crate) fn slider_ends(usual: Range) -> Option<[f64; 2]> {
    (usual == Range::Unit).then_some([0.0, 1.0])
}

/// Returns the word some steps after `literal`, wrapping around, or the first if `literal` is none
/// of them. `None` if there are no words.
pub(crate) fn next(words: &[impl AsRef<str>], literal: &str, steps: i8) -> Option<String> {
    let place = words.iter().position(|word| word.as_ref() == literal);
    let next = place.map_or(0, |place| {
        (place as isize + isize::from(steps)).rem_euclid(words.len() as isize) as usize
    });
    words.get(next).map(|word| word.as_ref().to_owned())
}

/// Completes an unambiguous prefix of a word, ignoring case.
pub(crate) fn word_meant<'w>(words: &[&'w str], text: &str) -> Option<&'w str> {
    let begins = |word: &&&str| {
        let start = word.get(..text.len());
        start.is_some_and(|start| start.eq_ignore_ascii_case(text))
    };
    let mut meant = words.iter().filter(begins);
    let first = meant.next()?;
    meant.next().is_none().then_some(*first)
}

/// Strips the `f` that a number may end in; other text is returned unchanged.
pub(crate) fn plain(literal: &str) -> &str {
    without_suffix(literal).unwrap_or(literal)
}

/// Whether a text may be a single number or word; the parser decides whether it is.
pub(crate) fn is_one(text: &str) -> bool {
    !text.is_empty()
        && !text.contains(|c: char| c.is_whitespace() || c.is_control())
        && !text.contains("//")
        && !text.contains("\\\\")
}

/// Splits a text into the literals of a field with several components: `0.1 0.2 0.3` separated by
/// blanks or commas, `#rrggbb` for a colour, `800x600` for a size. For a scaled vector the first
/// three suffice.
pub(crate) fn all_of(kind: Kind, text: &str) -> Option<Vec<String>> {
    match (kind, text.strip_prefix('#')) {
        (Kind::Colour, Some(digits)) => return colour(digits),
        (Kind::ScaledColour, Some(digits)) => {
            let channels = colour(digits)?;
            return Some(channels.into_iter().chain(["1".to_owned()]).collect());
        }
        _ => {}
    }
    let split =
        |c: char| c.is_whitespace() || matches!(c, ',' | ';') || (kind == Kind::Pixels && c == 'x');
    let bare = text.trim_matches(['(', ')', '[', ']', '<', '>']);
    let words: Vec<_> = bare
        .split(split)
        .filter(|word| !word.is_empty())
        .map(|word| if kind.is_size() { word } else { plain(word) }.to_owned())
        .collect();
    let numbers = words.iter().all(|word| parse_number(word).is_ok());
    (1 < words.len() && is_all(kind, words.len()) && numbers).then_some(words)
}

/// Whether this many numbers set all components. The factor of a scaled vector, or the angle about
/// an axis, may be omitted and stays.
pub(crate) fn is_all(kind: Kind, count: usize) -> bool {
    let is_scaled = matches!(
        kind,
        Kind::ScaledVector | Kind::ScaledColour | Kind::Rotation
    );
    count == kind.components() || (is_scaled && count == 3)
}

/// Converts six hexadecimal digits to numbers from 0 to 1 with four decimals, finer than 1/255.
fn colour(digits: &str) -> Option<Vec<String>> {
    if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    (0..3)
        .map(|channel| {
            let value = u8::from_str_radix(&digits[2 * channel..2 * channel + 2], 16).ok()?;
            let share = (f64::from(value) / 255.0 * 1e4).round() / 1e4;
            Some(share.to_string())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nudged_numbers_have_no_more_decimals_than_number_and_step() {
        for (literal, change, step, nudged_to) in [
            ("0.1", 0.2, 0.1, "0.3"),
            ("0.10", 0.05, 0.05, "0.15"),
            ("1", 0.1, 0.1, "1.1"),
            ("1.5", -0.1, 0.1, "1.4"),
            ("0.1", -0.1, 0.1, "0.0"),
            ("-0.1", 0.1, 0.1, "0.0"),
            (".5", 0.01, 0.01, ".51"),
            ("1e3", 100.0, 100.0, "1.1e3"),
            ("1e30", 0.1, 0.1, "1e30"),
            ("5", 1.0, 1.0, "6"),
            ("0.01f", 0.1, 0.1, "0.11"),
        ] {
            let nudged = nudged(literal, change, step);
            assert_eq!(nudged.as_deref(), Some(nudged_to), "{literal} + {change}");
        }
        assert_eq!(nudged("x", 1.0, 1.0), None);
        assert_eq!(nudged("1.7e308", 1.7e308, 1.0), None);
    }

    #[test]
    fn words_are_cycled() {
        let words = ["pnt", "inf", "amb"];
        for (literal, steps, expected) in [
            ("pnt", 1, "inf"),
            ("pnt", -1, "amb"),
            ("amb", 1, "pnt"),
            ("other", 1, "pnt"),
        ] {
            assert_eq!(next(&words, literal, steps).as_deref(), Some(expected));
        }
        assert_eq!(next(&[""; 0], "1", 1), None);
    }

    #[test]
    fn unambiguous_prefixes_of_words_are_completed() {
        let words = ["shadow_on", "shadow_off", "point"];
        for (text, meant) in [
            ("p", Some("point")),
            ("SHADOW_ON", Some("shadow_on")),
            ("shadow_o", None),
            ("", None),
            ("points", None),
            ("é", None),
        ] {
            assert_eq!(word_meant(&words, text), meant, "{text}");
        }
    }

    #[test]
    fn triples_colours_and_sizes_fill_all_components() {
        for (kind, text, expected) in [
            (Kind::Point, "0.1 0.2 0.3", Some("0.1 0.2 0.3")),
            (Kind::Point, "(1, -2e3, .5)", Some("1 -2e3 .5")),
            (Kind::Colour, "1;1;1", Some("1 1 1")),
            (Kind::Colour, "0.1f, 1.f, 0F", Some("0.1 1. 0")),
            (Kind::Colour, "#ff8000", Some("1 0.502 0")),
            (Kind::Colour, "#FFFFFF", Some("1 1 1")),
            (Kind::Point, "#ff8000", None),
            (Kind::Colour, "#ff800", None),
            (Kind::Colour, "#ffé00", None),
            (Kind::ScaledColour, "#ff8000", Some("1 0.502 0 1")),
            (Kind::ScaledVector, "1 2 3", Some("1 2 3")),
            (Kind::Rotation, "0 0 1 90", Some("0 0 1 90")),
            (Kind::Pixels, "800x600", Some("800 600")),
            (Kind::Point, "1 2", None),
            (Kind::Point, "1 2 x", None),
            (Kind::Number, "1", None),
        ] {
            let all = all_of(kind, text).map(|all| all.join(" "));
            assert_eq!(all.as_deref(), expected, "{text}");
        }
    }
}
