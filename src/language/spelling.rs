//! Numbers in the text that a conversion writes: as short as they can be for the same value.

use std::fmt::Write;

use glam::DVec3;

use text::concise;

/// Appends a number.
pub(super) fn number(out: &mut String, value: f64) {
    let size = value.abs();
    if value == 0.0 {
        // Regardless of its sign.
        out.push('0');
    } else if (1e-4..1e10).contains(&size) {
        // Writing to a string cannot fail.
        let _ = write!(out, "{value}");
    } else {
        out.push_str(&concise(value));
    }
}

/// Appends numbers, each after a blank.
pub(super) fn numbers(out: &mut String, values: impl IntoIterator<Item = f64>) {
    for value in values {
        out.push(' ');
        number(out, value);
    }
}

/// Appends the components of a vector or colour, set apart from what is before.
pub(super) fn vector(out: &mut String, vector: DVec3) {
    out.push(' ');
    numbers(out, vector.to_array());
}

/// Appends groups of numbers, each set apart from what is before on its line.
pub(super) fn groups(out: &mut String, groups: &[&[f64]]) {
    for group in groups {
        if !out.is_empty() && !out.ends_with('\n') {
            out.push_str("  ");
        }
        for (at, value) in group.iter().enumerate() {
            if at != 0 {
                out.push(' ');
            }
            number(out, *value);
        }
    }
}

/// Returns the number as a person would write it: one of fifteen digits, if that is equal up to the
/// rounding of a few operations.
pub(super) fn rounded_off(number: f64) -> f64 {
    let short = format!("{number:.14e}").parse().unwrap_or(number);
    if (short - number).abs() <= 8.0 * f64::EPSILON * number.abs() {
        short
    } else {
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use text::parse_number;

    #[test]
    fn numbers_are_read_back_to_the_last_bit() {
        for value in [
            0.1,
            -2.5,
            1e-5,
            1.0 / 3.0,
            123_456_789_012.0,
            1e22,
            -1e300,
            5e-324,
            f64::MAX,
        ] {
            let mut text = String::new();
            number(&mut text, value);
            assert_eq!(parse_number(&text), Ok(value), "{text}");
            assert!(text.len() < 25, "{text}");
        }
        let mut text = String::new();
        vector(&mut text, DVec3::new(-0.0, 1.0, 0.25));
        assert_eq!(text, "  0 1 0.25");
    }
}
