//! How many bytes a second the line to the terminal is given.
//!
//! A write returns long before its bytes are seen: channel windows and socket buffers hide
//! seconds of frames. So the pace of pictures is set by a token bucket, and its rate by the replies
//! of the terminal, which show when bytes have arrived. Knows no clock: every question carries its
//! moment.

mod estimate;

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use estimate::Estimate;

/// Bytes a second for pictures at the other end of a network where nothing can be measured.
const REMOTE_BANDWIDTH: u32 = 128_000;

/// A bucket of a fixed rate holds this part of a second of bytes: four pictures a second even when
/// each of them empties it.
const CAPACITY: Duration = Duration::from_millis(250);

/// What is worth waiting for at a fixed rate, in bytes.
const MORSEL: usize = 4096;

/// A frame that the terminal takes longer for than this shows a line slower than it seemed.
const SLOW: Duration = Duration::from_millis(250);

/// A line that takes so many bytes a second needs no limit at home.
const AMPLE: u32 = 8_000_000;

/// The span over which the rate is measured.
const MEASURED: Duration = Duration::from_secs(1);

/// One byte in the bucket's units, which make a nanosecond at one byte a second a whole number.
const BYTE: i128 = 1_000_000_000;

/// What pictures are held to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Budget {
    /// So many bytes a second; 0 means no limit.
    Fixed(u32),
    /// What the line turns out to take, as at the other end of a network.
    Measured,
    /// No limit, unless the line turns out to be slow.
    Local,
}

impl Budget {
    /// What suits the line that these variables of the environment describe.
    ///
    /// Multiplexers reply for themselves, so replies say nothing of the line behind them.
    pub fn of_environment(variable: impl Fn(&str) -> Option<String>) -> Self {
        let set = |name: &str| variable(name).is_some_and(|value| !value.is_empty());
        let is_remote = set("SSH_CONNECTION") || set("SSH_TTY");
        let term = variable("TERM").unwrap_or_default();
        let is_multiplexed = set("TMUX")
            || set("STY")
            || ["tmux", "screen"].iter().any(|name| term.starts_with(name));
        match (is_remote, is_multiplexed) {
            (false, false) => Self::Local,
            (false, true) => Self::Fixed(0),
            (true, false) => Self::Measured,
            (true, true) => Self::Fixed(REMOTE_BANDWIDTH),
        }
    }
}

/// Holds pictures back to what the line takes.
///
/// Text is never held back, but it counts, and may take the bucket into debt.
#[derive(Debug)]
pub struct Link {
    budget: Budget,
    pace: Pace,
    /// What was in the bucket at `as_of`, in billionths of a byte; negative is debt.
    level: i128,
    as_of: Option<Instant>,
    recent: VecDeque<(Instant, usize)>,
}

#[derive(Debug)]
enum Pace {
    Unlimited,
    Fixed(u32),
    Measured(Estimate),
}

/// What a bucket is like.
#[derive(Clone, Copy, Debug)]
struct Bucket {
    /// Bytes a second.
    rate: u32,
    /// Bytes.
    capacity: u64,
    /// The bytes that a picture waits for.
    worth: u64,
}

impl Link {
    /// Starts with a full bucket.
    pub fn new(budget: Budget) -> Self {
        let pace = match budget {
            Budget::Fixed(0) | Budget::Local => Pace::Unlimited,
            Budget::Fixed(rate) => Pace::Fixed(rate),
            Budget::Measured => Pace::Measured(Estimate::new()),
        };
        let mut link = Self {
            budget,
            pace,
            level: 0,
            as_of: None,
            recent: VecDeque::new(),
        };
        link.level = link.bucket(None).map_or(0, |bucket| units(bucket.capacity));
        link
    }

    /// Whether pictures are held back at all.
    pub fn is_limited(&self) -> bool {
        !matches!(self.pace, Pace::Unlimited)
    }

    /// Returns how many bytes of picture may go at once, `usize::MAX` without a limit.
    pub fn allowance(&self, now: Instant) -> usize {
        let Some(bucket) = self.bucket(Some(now)) else {
            return usize::MAX;
        };
        if self.held_until(now).is_some() {
            return 0;
        }
        (self.level_at(now, bucket) / BYTE).max(0) as usize
    }

    /// Counts bytes that were sent, text and pictures alike.
    pub fn spent(&mut self, bytes: usize, now: Instant) {
        if let Some(bucket) = self.bucket(Some(now)) {
            self.level = self.level_at(now, bucket) - units(bytes as u64);
            self.as_of = Some(now);
        }
        if let Pace::Measured(estimate) = &mut self.pace {
            estimate.sent(bytes as u64, now);
        }
        self.recent.push_back((now, bytes));
        while self.recent.front().is_some_and(|&(at, _)| is_past(at, now)) {
            self.recent.pop_front();
        }
    }

    /// Returns when a piece of picture that is worth it may go, `None` if it may go at once.
    pub fn ready_at(&self, now: Instant) -> Option<Instant> {
        let bucket = self.bucket(Some(now))?;
        if let Some(until) = self.held_until(now) {
            return Some(until);
        }
        let missing = units(bucket.worth) - self.level_at(now, bucket);
        if missing <= 0 {
            return None;
        }
        let rate = i128::from(bucket.rate);
        let nanoseconds = (missing + rate - 1) / rate;
        Some(now + Duration::from_nanos(nanoseconds as u64))
    }

    /// Returns the bytes sent during the last second.
    pub fn rate(&self, now: Instant) -> usize {
        let recent = self.recent.iter().filter(|&&(at, _)| !is_past(at, now));
        recent.map(|&(_, bytes)| bytes).sum()
    }

    /// Learns that a frame of so many bytes waited this long for the terminal to take it.
    pub fn waited(&mut self, bytes: usize, time: Duration, now: Instant) {
        if self.budget != Budget::Local || self.is_limited() || time < SLOW {
            return;
        }
        let rate = bytes as f64 / time.as_secs_f64();
        if rate < f64::from(AMPLE) {
            self.pace = Pace::Measured(Estimate::of_slow(rate as u32));
            self.level = 0;
            self.as_of = Some(now);
        }
    }

    /// Whether the terminal is to be asked for a reply, behind all that was sent.
    pub fn has_question(&self, now: Instant) -> bool {
        matches!(&self.pace, Pace::Measured(estimate) if estimate.has_question(now))
    }

    /// When [`Link::has_question`] becomes true though nothing is sent: when the line is empty.
    pub fn asks_at(&self) -> Option<Instant> {
        match &self.pace {
            Pace::Measured(estimate) => estimate.asks_at(),
            _ => None,
        }
    }

    /// Takes note that the terminal was asked.
    pub fn asked(&mut self, now: Instant) {
        if let Pace::Measured(estimate) = &mut self.pace {
            estimate.asked(now);
        }
    }

    /// Takes the reply to the oldest question.
    pub fn replied(&mut self, at: Instant) {
        if let Pace::Measured(estimate) = &mut self.pace {
            estimate.replied(at);
            if self.budget == Budget::Local && AMPLE < estimate.rate() {
                self.pace = Pace::Unlimited;
            }
        }
    }

    /// Gives up on replies that are overdue; whether there were any. A terminal that has never
    /// replied is not asked again.
    pub fn give_up(&mut self, now: Instant) -> bool {
        let Pace::Measured(estimate) = &mut self.pace else {
            return false;
        };
        if estimate.gives_up_at().is_none_or(|at| now < at) {
            return false;
        }
        if !estimate.give_up() {
            self.budget = match self.budget {
                Budget::Local => Budget::Fixed(0),
                _ => Budget::Fixed(REMOTE_BANDWIDTH),
            };
            let recent = std::mem::take(&mut self.recent);
            *self = Self {
                recent,
                ..Self::new(self.budget)
            };
        }
        true
    }

    /// When [`Link::give_up`] is due.
    pub fn gives_up_at(&self) -> Option<Instant> {
        match &self.pace {
            Pace::Measured(estimate) => estimate.gives_up_at(),
            _ => None,
        }
    }

    /// Until when pictures wait, whatever is in the bucket.
    fn held_until(&self, now: Instant) -> Option<Instant> {
        match &self.pace {
            Pace::Measured(estimate) => estimate.holds_until(now).filter(|&until| now < until),
            _ => None,
        }
    }

    fn bucket(&self, now: Option<Instant>) -> Option<Bucket> {
        match &self.pace {
            Pace::Unlimited => None,
            &Pace::Fixed(rate) => {
                let capacity = u64::from(rate) * CAPACITY.as_millis() as u64 / 1000;
                Some(Bucket {
                    rate,
                    capacity,
                    worth: (MORSEL as u64).min(capacity),
                })
            }
            Pace::Measured(estimate) => {
                let worth = estimate.burst(now);
                Some(Bucket {
                    rate: estimate.pace(),
                    // What comes late to an empty bucket loses nothing.
                    capacity: worth + worth / 4,
                    worth,
                })
            }
        }
    }

    fn level_at(&self, now: Instant, bucket: Bucket) -> i128 {
        let elapsed = self
            .as_of
            .map_or(Duration::ZERO, |as_of| now.saturating_duration_since(as_of));
        let gained = elapsed.as_nanos() as i128 * i128::from(bucket.rate);
        (self.level + gained).min(units(bucket.capacity))
    }
}

fn units(bytes: u64) -> i128 {
    i128::from(bytes) * BYTE
}

fn is_past(at: Instant, now: Instant) -> bool {
    MEASURED <= now.saturating_duration_since(at)
}

#[cfg(test)]
mod tests;
