//! How many bytes a second the line to the terminal is given.
//!
//! A write returns long before its bytes are seen: channel windows and socket buffers hide
//! seconds of frames. So the pace of pictures is set by a token bucket, not by how long writes
//! take. Knows no clock: every question carries its moment.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Bytes a second for pictures when the terminal is at the other end of a network.
const REMOTE_BANDWIDTH: u32 = 128_000;

/// The bucket holds this part of a second of bytes: four pictures a second even when each of them
/// empties it.
const CAPACITY: Duration = Duration::from_millis(250);

/// The span over which the rate is measured.
const MEASURED: Duration = Duration::from_secs(1);

/// One byte in the bucket's units, which make a nanosecond at one byte a second a whole number.
const BYTE: i128 = 1_000_000_000;

/// Holds pictures back to a number of bytes a second.
///
/// Text is never held back, but it counts, and may take the bucket into debt.
#[derive(Debug)]
pub struct Link {
    bytes_per_second: Option<u32>,
    /// What was in the bucket at `as_of`, in billionths of a byte; negative is debt.
    level: i128,
    as_of: Option<Instant>,
    recent: VecDeque<(Instant, usize)>,
}

impl Link {
    /// Starts with a full bucket; `None` and zero mean no limit.
    pub fn new(bytes_per_second: Option<u32>) -> Self {
        let bytes_per_second = bytes_per_second.filter(|&rate| rate != 0);
        Self {
            bytes_per_second,
            level: bytes_per_second.map_or(0, capacity),
            as_of: None,
            recent: VecDeque::new(),
        }
    }

    /// Returns how many bytes of picture may go at once, `usize::MAX` without a limit.
    pub fn allowance(&self, now: Instant) -> usize {
        match self.bytes_per_second {
            None => usize::MAX,
            Some(rate) => (self.level_at(now, rate) / BYTE).max(0) as usize,
        }
    }

    /// Counts bytes that were written, text and pictures alike.
    pub fn spent(&mut self, bytes: usize, now: Instant) {
        if let Some(rate) = self.bytes_per_second {
            self.level = self.level_at(now, rate) - bytes as i128 * BYTE;
            self.as_of = Some(now);
        }
        self.recent.push_back((now, bytes));
        while self.recent.front().is_some_and(|&(at, _)| is_past(at, now)) {
            self.recent.pop_front();
        }
    }

    /// Returns when a picture of so many bytes may go, `None` if it may go at once.
    ///
    /// A picture larger than the bucket waits for a full one and leaves a debt.
    pub fn ready_at(&self, now: Instant, bytes: usize) -> Option<Instant> {
        let rate = self.bytes_per_second?;
        let wanted = (bytes as i128 * BYTE).min(capacity(rate));
        let missing = wanted - self.level_at(now, rate);
        if missing <= 0 {
            return None;
        }
        let nanoseconds = (missing + i128::from(rate) - 1) / i128::from(rate);
        Some(now + Duration::from_nanos(nanoseconds as u64))
    }

    /// Returns the bytes written during the last second.
    pub fn rate(&self, now: Instant) -> usize {
        let recent = self.recent.iter().filter(|&&(at, _)| !is_past(at, now));
        recent.map(|&(_, bytes)| bytes).sum()
    }

    fn level_at(&self, now: Instant, rate: u32) -> i128 {
        let elapsed = self
            .as_of
            .map_or(Duration::ZERO, |as_of| now.saturating_duration_since(as_of));
        let gained = elapsed.as_nanos() as i128 * i128::from(rate);
        (self.level + gained).min(capacity(rate))
    }
}

/// Returns the bytes a second that suit the line: a limit over SSH, none at home.
pub fn default_bandwidth(variable: impl Fn(&str) -> Option<String>) -> Option<u32> {
    let set = |name: &str| variable(name).is_some_and(|value| !value.is_empty());
    (set("SSH_CONNECTION") || set("SSH_TTY")).then_some(REMOTE_BANDWIDTH)
}

fn capacity(rate: u32) -> i128 {
    i128::from(rate) * CAPACITY.as_nanos() as i128
}

fn is_past(at: Instant, now: Instant) -> bool {
    MEASURED <= now.saturating_duration_since(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn ms(milliseconds: u64) -> Duration {
        Duration::from_millis(milliseconds)
    }

    #[test]
    fn fills_at_the_rate_up_to_a_quarter_of_a_second() {
        let start = Instant::now();
        let mut link = Link::new(Some(1000));
        assert_eq!(link.allowance(start), 250);
        link.spent(250, start);
        for (after, allowance) in [(0, 0), (1, 1), (100, 100), (250, 250), (9000, 250)] {
            assert_eq!(
                link.allowance(start + ms(after)),
                allowance,
                "after {after} ms"
            );
        }
    }

    #[test]
    fn text_may_go_into_debt_and_pictures_wait_for_it() {
        let start = Instant::now();
        let mut link = Link::new(Some(1000));
        link.spent(1250, start);
        assert_eq!(link.allowance(start), 0);
        assert_eq!(link.ready_at(start, 100), Some(start + ms(1100)));
        assert_eq!(link.allowance(start + ms(1100)), 100);
        assert_eq!(link.ready_at(start + ms(1100), 100), None);
    }

    #[test]
    fn a_picture_larger_than_the_bucket_waits_for_a_full_one() {
        let start = Instant::now();
        let mut link = Link::new(Some(1000));
        assert_eq!(link.ready_at(start, 100_000), None);
        link.spent(50, start);
        assert_eq!(link.ready_at(start, 100_000), Some(start + ms(50)));
    }

    #[test]
    fn the_moment_named_is_never_too_early_for_an_odd_rate() {
        let start = Instant::now();
        for rate in [1, 3, 7, 999_983, u32::MAX] {
            let mut link = Link::new(Some(rate));
            link.spent(rate as usize, start);
            let ready = link.ready_at(start, 1).expect("the bucket is in debt");
            assert_eq!(link.ready_at(ready, 1), None, "at {rate} bytes a second");
            let before = ready
                .checked_sub(Duration::from_nanos(1))
                .expect("it is after the start");
            assert!(
                link.ready_at(before, 1).is_some(),
                "at {rate} bytes a second"
            );
        }
    }

    #[test]
    fn nothing_and_zero_mean_no_limit() {
        let start = Instant::now();
        for limit in [None, Some(0)] {
            let mut link = Link::new(limit);
            link.spent(1 << 40, start);
            assert_eq!(link.allowance(start), usize::MAX);
            assert_eq!(link.ready_at(start, usize::MAX), None);
        }
    }

    #[test]
    fn measures_the_last_second_only() {
        let start = Instant::now();
        let mut link = Link::new(None);
        link.spent(10, start);
        link.spent(20, start + ms(600));
        assert_eq!(link.rate(start + ms(999)), 30);
        assert_eq!(link.rate(start + ms(1000)), 20);
        assert_eq!(link.rate(start + ms(1600)), 0);
    }

    #[test]
    fn a_network_line_gets_a_limit() {
        let with = |name: &'static str, value: &'static str| {
            default_bandwidth(move |asked| (asked == name).then(|| value.to_owned()))
        };
        assert_eq!(with("SSH_TTY", "/dev/pts/1"), Some(128_000));
        assert_eq!(with("SSH_CONNECTION", "a 1 b 22"), Some(128_000));
        assert_eq!(with("SSH_TTY", ""), None);
        assert_eq!(with("TERM", "xterm"), None);
    }
}
