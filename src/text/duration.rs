//! Durations as users type them.

use std::time::Duration;

/// The longest duration read: a year, in seconds.
const LONGEST: f64 = 365.0 * 24.0 * 3600.0;

/// Reads a positive duration of at most a year, such as `30`, `30s`, `1.5 min` or `2h`; seconds
/// without a unit.
pub fn parse_duration(said: &str) -> Option<Duration> {
    let said = said.trim();
    let end = said.find(|c: char| c.is_ascii_alphabetic());
    let (number, unit) = said.split_at(end.unwrap_or(said.len()));
    let each = match unit {
        "" | "s" | "sec" | "second" | "seconds" => 1.0,
        "ms" => 1e-3,
        "m" | "min" | "minute" | "minutes" => 60.0,
        "h" | "hour" | "hours" => 3600.0,
        _ => return None,
    };
    let number = number.trim();
    if !number
        .bytes()
        .all(|byte| byte.is_ascii_digit() || byte == b'.')
    {
        return None;
    }
    let seconds = each * number.parse::<f64>().ok()?;
    (0.0 < seconds && seconds <= LONGEST).then(|| Duration::from_secs_f64(seconds))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_have_units_from_milliseconds_to_hours() {
        for (said, seconds) in [
            ("30", Some(30.0)),
            ("30s", Some(30.0)),
            (" 30 s ", Some(30.0)),
            ("250ms", Some(0.25)),
            ("1.5 min", Some(90.0)),
            ("2h", Some(7200.0)),
            ("0", None),
            ("-3 s", None),
            ("1e3", None),
            ("inf", None),
            ("1.2.3 s", None),
            ("9999999 h", None),
            ("3 days", None),
            ("s", None),
            ("", None),
        ] {
            let expected = seconds.map(Duration::from_secs_f64);
            assert_eq!(parse_duration(said), expected, "{said:?}");
        }
    }
}
