//! What was probably meant by a token that is not a number.

use super::{NumberError, parse_number, without_suffix};

/// The longest token that is looked at for what was meant, in bytes.
const LONGEST: usize = 64;

/// The number that was probably meant by a token that is none.
pub fn meant_number(token: &str) -> Option<String> {
    corrected(token).map(|(_, number)| number)
}

/// The number that was probably meant, and what is wrong with the token, before a colon.
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

impl NumberError {
    /// A hint at what was probably meant by a token with this error.
    pub fn hint(self, token: &str) -> Option<String> {
        if LONGEST < token.len() {
            return None;
        }
        if self == Self::Overflow {
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
            let found = error.hint(token);
            match hint {
                Some(part) => assert!(found.is_some_and(|hint| hint.contains(part)), "{token}"),
                None => assert_eq!(found, None, "{token}"),
            }
        }
    }
}
