//! Error numbers in messages.

use std::borrow::Cow;

/// The standard library appends this, a number and a parenthesis to the system's message.
const CODE: &str = " (os error ";

/// Removes the system's error numbers, which only repeat the words before them:
/// `Permission denied (os error 13)`.
pub fn without_codes(message: &str) -> Cow<'_, str> {
    let mut kept = String::new();
    let mut rest = message;
    while let Some((before, code)) = rest.split_once(CODE) {
        let after = code.trim_start_matches(|c: char| c.is_ascii_digit());
        match after.strip_prefix(')') {
            Some(after) if after.len() + 1 < code.len() => {
                kept.push_str(before);
                rest = after;
            }
            _ => break,
        }
    }
    if rest.len() == message.len() {
        return Cow::Borrowed(message);
    }
    Cow::Owned(kept + rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_error_numbers_are_removed() {
        for (message, shown) in [
            ("a.ray: gone", "a.ray: gone"),
            ("a: Permission denied (os error 13)", "a: Permission denied"),
            (
                "a: No such file (os error 2); b: Busy (os error 16): try again",
                "a: No such file; b: Busy: try again",
            ),
            ("a (os error ).ray", "a (os error ).ray"),
            ("a (os error 2", "a (os error 2"),
        ] {
            assert_eq!(without_codes(message), shown);
        }
    }
}
