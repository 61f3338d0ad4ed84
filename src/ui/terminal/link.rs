//! Limits the rate of output to the terminal.
//!
//! A write returns long before its bytes are displayed: channel windows and socket buffers hide
//! seconds of frames. Pictures are therefore paced by a token bucket, whose rate is derived from
//! replies of the terminal, which show when bytes have arrived. This module reads no clock: every
//! call passes the time.

mod estimate;

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use estimate::Estimate;

/// Bytes per second for pictures over a network on which nothing can be measured.
const REMOTE_BANDWIDTH: u32 = 128_000;

/// The capacity of a bucket of fixed rate, as a time: four pictures per second even if each of them
/// empties the bucket.
const CAPACITY: Duration = Duration::from_millis(250);

/// Minimum amount worth waiting for at a fixed rate, in bytes.
const MORSEL: usize = 4096;

/// A frame that takes longer than this indicates a line slower than assumed.
const SLOW: Duration = Duration::from_millis(250);

/// A local line with at least this rate, in bytes per second, needs no limit.
const AMPLE: u32 = 8_000_000;

/// Period over which the rate is measured.
const MEASURED: Duration = Duration::from_secs(1);

/// One byte in units of the bucket, in which a nanosecond at one byte per second is one unit.
const BYTE: i128 = 1_000_000_000;

/// The limit on the rate at which pictures are sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Budget {
    /// Bytes per second; 0 means no limit.
    Fixed(u32),
    /// The measured rate of the line, for a terminal across a network.
    Measured,
    /// No limit unless the line proves slow.
    Local,
}

impl Budget {
    /// Returns the budget for a line described by these environment variables.
    ///
    /// Multiplexers reply for themselves, so their replies say nothing about the line behind them.
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

/// Limits pictures to the capacity of the line.
///
/// Text is never delayed, but it counts and may put the bucket into debt.
#[derive(Debug)]
pub struct Link {
    budget: Budget,
    pace: Pace,
    /// The level of the bucket at `as_of`, in billionths of a byte; negative is debt.
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

/// Parameters of the bucket.
#[derive(Clone, Copy, Debug)]
struct Bucket {
    /// Bytes that flow in per second.
    rate: u32,
    /// The most bytes that it holds.
    capacity: u64,
    /// Minimum number of bytes for a piece of picture to be sent.
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

    /// Whether pictures are limited at all.
    pub fn is_limited(&self) -> bool {
        !matches!(self.pace, Pace::Unlimited)
    }

    /// Returns the number of bytes of picture that may be sent now; `usize::MAX` without a limit.
    pub fn allowance(&self, now: Instant) -> usize {
        let Some(bucket) = self.bucket(Some(now)) else {
            return usize::MAX;
        };
        if self.held_until(now).is_some() {
            return 0;
        }
        (self.level_at(now, bucket) / BYTE).max(0) as usize
    }

    /// Counts bytes that were sent, both text and pictures.
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

    /// Returns when a worthwhile piece of picture may be sent; `None` if at once.
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

    /// Returns the number of bytes sent during the last second.
    pub fn rate(&self, now: Instant) -> usize {
        let recent = self.recent.iter().filter(|&&(at, _)| !is_past(at, now));
        recent.map(|&(_, bytes)| bytes).sum()
    }

    /// Records that the terminal took this long to accept a frame of `bytes` bytes.
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

    /// Whether to request a reply now, after everything sent so far.
    pub fn has_question(&self, now: Instant) -> bool {
        let estimate = self.estimate();
        estimate.is_some_and(|estimate| estimate.has_question(now))
    }

    /// When [`Link::has_question`] becomes true even if nothing is sent: when the line is empty.
    pub fn asks_at(&self) -> Option<Instant> {
        self.estimate()?.asks_at()
    }

    /// Records that a reply was requested.
    pub fn asked(&mut self, now: Instant) {
        if let Pace::Measured(estimate) = &mut self.pace {
            estimate.asked(now);
        }
    }

    /// Handles the reply to the oldest request.
    pub fn replied(&mut self, at: Instant) {
        if let Pace::Measured(estimate) = &mut self.pace {
            estimate.replied(at);
            if self.budget == Budget::Local && AMPLE < estimate.rate() {
                self.pace = Pace::Unlimited;
            }
        }
    }

    /// Stops expecting overdue replies; returns whether there were any. A terminal that has never
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
        self.estimate()?.gives_up_at()
    }

    /// Until when pictures are held back, regardless of the level of the bucket.
    fn held_until(&self, now: Instant) -> Option<Instant> {
        let until = self.estimate()?.holds_until(now);
        until.filter(|&until| now < until)
    }

    fn estimate(&self) -> Option<&Estimate> {
        match &self.pace {
            Pace::Measured(estimate) => Some(estimate),
            Pace::Unlimited | Pace::Fixed(_) => None,
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
                    // Spare capacity, so that a late refill loses nothing.
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
