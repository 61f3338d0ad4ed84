/// A fraction as a percentage with two digits, but at most two decimals: `13 %`, `1.3 %`, `0.13 %`.
pub fn percentage(share: f64) -> String {
    let percent = 100.0 * share;
    // Numbers that round to 10 or 1 have a digit more before the point, so a decimal less.
    let digits = [9.95, 0.995]
        .iter()
        .filter(|&&bound| percent < bound)
        .count();
    format!("{percent:.digits$} %")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentages_have_two_digits() {
        for (share, text) in [
            (0.5, "50 %"),
            (0.0996, "10 %"),
            (0.0994, "9.9 %"),
            (0.0134, "1.3 %"),
            (0.009_96, "1.0 %"),
            (0.009_94, "0.99 %"),
            (0.0004, "0.04 %"),
            (0.0, "0.00 %"),
        ] {
            assert_eq!(percentage(share), text);
        }
    }
}
