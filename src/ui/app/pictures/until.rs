//! When the full-size trace is complete.

use std::fmt;
use std::time::Duration;

use render::Limit;
use scene::MAX_SPP;
use text::{parse_duration, rounded};

/// When the full-size trace is complete.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Until {
    /// With this many samples per pixel, 1 to [`MAX_SPP`].
    Samples(u32),
    /// After about this time.
    Time(Duration),
    /// With less noise than this, above 0 and below 1.
    Noise(f64),
}

impl Until {
    /// Parses `256 spp`, `30 s` or `noise 0.01`; the error says what is expected.
    pub(crate) fn parse(said: &str) -> Result<Self, String> {
        let said = said.trim();
        if let Some(level) = said.strip_prefix("noise") {
            let (level, each) = match level.trim().strip_suffix('%') {
                Some(percent) => (percent, 0.01),
                None => (level, 1.0),
            };
            let level = level.trim().parse::<f64>().map(|level| each * level);
            let level = level.ok().filter(|level| 0.0 < *level && *level < 1.0);
            let expected = || ":until noise needs a level between 0 and 1, such as 0.01 or 1 %";
            return level.map(Self::Noise).ok_or_else(|| expected().to_owned());
        }
        if let Some(count) = said.strip_suffix("spp") {
            let count = count.trim().parse().ok();
            let count = count.filter(|count| (1..=MAX_SPP).contains(count));
            let expected = || format!("samples per pixel must be 1 to {MAX_SPP}");
            return count.map(Self::Samples).ok_or_else(expected);
        }
        let has_unit = said.ends_with(|c: char| c.is_ascii_alphabetic());
        let time = parse_duration(said).filter(|_| has_unit);
        time.map(Self::Time).ok_or_else(|| {
            ":until needs samples, a time or a noise level: 256 spp, 30 s, noise 0.01".to_owned()
        })
    }

    /// The most samples per pixel, and the limit that may end the trace earlier.
    pub(crate) fn limits(self) -> (u32, Option<Limit>) {
        match self {
            Self::Samples(count) => (count, None),
            Self::Time(time) => (MAX_SPP, Some(Limit::Time(time))),
            Self::Noise(level) => (MAX_SPP, Some(Limit::Noise(level))),
        }
    }
}

impl fmt::Display for Until {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Samples(count) => write!(f, "at {count} spp"),
            Self::Time(time) => write!(f, "after {} s", rounded(time.as_secs_f64(), 3)),
            Self::Noise(level) => write!(f, "below a noise of {} %", rounded(100.0 * level, 4)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_of_traces_are_read_and_told() {
        let wrong = ":until needs samples";
        for (said, told) in [
            ("256 spp", Ok("at 256 spp")),
            ("1spp", Ok("at 1 spp")),
            ("0 spp", Err("samples per pixel must be 1 to 65536")),
            ("30 s", Ok("after 30 s")),
            ("1.5min", Ok("after 90 s")),
            ("noise 0.01", Ok("below a noise of 1 %")),
            ("noise 0.5 %", Ok("below a noise of 0.5 %")),
            ("noise 1", Err(":until noise needs a level")),
            ("noise", Err(":until noise needs a level")),
            ("30", Err(wrong)),
            ("tomorrow", Err(wrong)),
        ] {
            match (Until::parse(said), told) {
                (Ok(until), Ok(told)) => assert_eq!(until.to_string(), told),
                (Err(reason), Err(told)) => assert!(reason.starts_with(told), "{reason}"),
                (parsed, _) => panic!("{said}: {parsed:?}"),
            }
        }
    }
}
