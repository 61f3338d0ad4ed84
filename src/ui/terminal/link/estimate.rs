//! Estimates the capacity of a line from the delays of the terminal's replies.
//!
//! The reply to a question sent after a burst of bytes takes a round trip plus the time for the
//! line to transmit the burst. A late reply means that bytes are queueing: pictures then wait until
//! the line is empty, and the round trip and the rate are measured again.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Rate assumed before the first reply, in bytes per second.
const FIRST_RATE: u32 = 32_000;

const MIN_RATE: u32 = 2_000;
const MAX_RATE: u32 = 64_000_000;

/// Share of the rate available to pictures, in per cent: an estimate that is a quarter too high
/// causes no queue.
const SHARE: u32 = 75;

/// Transmission time of a piece of picture, which may delay the answer to a key.
const BURST: Duration = Duration::from_millis(20);

/// Transmission time of a piece that is measured: long compared to the jitter of replies.
const MEASURED_BURST: Duration = Duration::from_millis(50);

/// The shortest burst from which the rate can be measured.
const TELLING: Duration = Duration::from_millis(25);

/// Minimum size of a piece of picture, in bytes: about ten cells.
const MIN_BURST: u64 = 256;

/// Delay of a reply from which the line counts as overloaded.
const SLACK: Duration = Duration::from_millis(30);

/// Minimum time between questions once the rate has settled.
const INTERVAL: Duration = Duration::from_secs(2);

/// Minimum time between bursts that are long enough to measure, once the rate has settled: the
/// answer to a key waits for a whole burst. A connection that slows down is noticed earlier, by
/// late replies.
const BURST_INTERVAL: Duration = Duration::from_secs(10);

/// Minimum time between questions after too few bytes to measure, before the rate has settled.
const UNSETTLED_INTERVAL: Duration = Duration::from_millis(500);

/// Maximum increase of the rate after one burst, as a factor: an overestimated round trip, as
/// during startup, makes any line look infinitely fast.
const GROWTH: f64 = 4.0;

/// The same once the rate has settled: jitter that delays a reply makes the next measurement too
/// high, and a connection seldom becomes faster.
const LATE_GROWTH: f64 = 1.25;

/// Maximum time to wait for a reply.
const PATIENCE: Duration = Duration::from_secs(5);

/// The shortest time that is distinguished from zero.
const RESOLUTION: Duration = Duration::from_millis(1);

/// The estimated rate and round trip of a line.
#[derive(Debug)]
pub(super) struct Estimate {
    /// The current estimate, in bytes per second.
    rate: u32,
    /// The last rate that proved right.
    settled: Option<u32>,
    round_trip: Option<Duration>,
    stage: Stage,
    /// Number of bytes in the queue of the line at `as_of`.
    queue: f64,
    as_of: Option<Instant>,
    /// Total number of bytes sent.
    sent: u64,
    questions: VecDeque<Question>,
    /// Time of the last question.
    asked: Option<Instant>,
    /// Time of the last question after a burst.
    burst_asked: Option<Instant>,
    /// Time of the last reply, and the number of bytes sent before its question.
    acknowledged: Option<(Instant, u64)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// The round trip must be measured on an empty line.
    Empty,
    /// The rate must be measured, regardless of the assumed one.
    Open,
    /// The rate was raised and must be measured again.
    Raised,
    /// The rate is right.
    Settled,
}

#[derive(Clone, Copy, Debug)]
struct Question {
    at: Instant,
    kind: ProbeKind,
    /// Number of bytes in the queue when it was sent.
    queue: f64,
    /// Total number of bytes sent before it.
    sent: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ProbeKind {
    /// Sent on an empty line.
    Bare,
    /// Sent after a burst.
    Burst,
    /// Sent after too few bytes to measure: only a late reply is significant.
    Check,
}

impl Estimate {
    /// Starts with an unknown line.
    pub(super) fn new() -> Self {
        Self::of_slow(FIRST_RATE)
    }

    /// Starts with a line that accepted this many bytes per second.
    pub(super) fn of_slow(rate: u32) -> Self {
        Self {
            rate: rate.clamp(MIN_RATE, MAX_RATE),
            settled: None,
            round_trip: None,
            stage: Stage::Empty,
            queue: 0.0,
            as_of: None,
            sent: 0,
            questions: VecDeque::new(),
            asked: None,
            burst_asked: None,
            acknowledged: None,
        }
    }

    /// The rate of the line, in bytes per second.
    pub(super) fn rate(&self) -> u32 {
        self.rate
    }

    /// The rate available to pictures, in bytes per second.
    pub(super) fn pace(&self) -> u32 {
        (u64::from(self.rate) * u64::from(SHARE) / 100) as u32
    }

    /// The number of bytes of picture to send at once; greater if the rate should be measured.
    pub(super) fn burst(&self, now: Option<Instant>) -> u64 {
        let measured = now.is_some_and(|now| self.wants_burst(now));
        let time = if measured { MEASURED_BURST } else { BURST };
        let bytes = u64::from(self.rate) * time.as_millis() as u64 / 1000;
        bytes.max(MIN_BURST)
    }

    pub(super) fn sent(&mut self, bytes: u64, now: Instant) {
        self.queue = self.queue_at(now) + bytes as f64;
        self.as_of = Some(now);
        self.sent += bytes;
    }

    pub(super) fn has_question(&self, now: Instant) -> bool {
        if self.stage == Stage::Empty {
            return self.questions.is_empty() && self.is_empty_at() <= Some(now);
        }
        self.wants_burst(now) && self.is_telling(now) || self.wants_check(now)
    }

    /// When the line will be empty, if the round trip should be measured then.
    pub(super) fn asks_at(&self) -> Option<Instant> {
        let is_wanted = self.stage == Stage::Empty && self.questions.is_empty();
        self.is_empty_at().filter(|_| is_wanted)
    }

    pub(super) fn asked(&mut self, now: Instant) {
        let kind = if self.stage == Stage::Empty {
            self.stage = Stage::Open;
            ProbeKind::Bare
        } else if self.is_telling(now) {
            self.burst_asked = Some(now);
            ProbeKind::Burst
        } else {
            ProbeKind::Check
        };
        self.questions.push_back(Question {
            at: now,
            kind,
            queue: self.queue_at(now),
            sent: self.sent,
        });
        self.asked = Some(now);
    }

    pub(super) fn replied(&mut self, at: Instant) {
        let Some(question) = self.questions.pop_front() else {
            return;
        };
        let time = at.saturating_duration_since(question.at);
        match (question.kind, self.round_trip) {
            // Of two round trips that differ only by jitter, the shorter one is right: the longer
            // one would make the next burst seem fast.
            (ProbeKind::Bare, Some(known)) if time.abs_diff(known) < SLACK => {
                self.round_trip = Some(known.min(time));
            }
            (ProbeKind::Bare, _) | (_, None) => self.round_trip = Some(time),
            (kind, Some(round_trip)) => {
                self.round_trip = Some(round_trip.min(time));
                let on_line = time.saturating_sub(round_trip);
                let is_late = self.time_for(question.queue) + SLACK < on_line;
                let is_first = self.stage == Stage::Open && kind == ProbeKind::Burst;
                if is_late && !is_first {
                    self.slow_down(question, at);
                } else if time.mul_f64(1.25) + RESOLUTION < round_trip {
                    // The line was not empty when the round trip was measured.
                    self.stage = Stage::Raised;
                } else if kind == ProbeKind::Burst {
                    self.judge(question, on_line);
                } else if self.stage == Stage::Raised {
                    // There is no queue at the present load.
                    self.stage = Stage::Settled;
                }
            }
        }
        self.acknowledged = Some((at, question.sent));
    }

    /// Until when pictures must wait: for a late reply, or for the measurement on an empty line.
    pub(super) fn holds_until(&self, now: Instant) -> Option<Instant> {
        let round_trip = self.round_trip?;
        let Some(question) = self.questions.front() else {
            return self.is_empty_at().filter(|_| self.stage == Stage::Empty);
        };
        let expected = round_trip + self.time_for(question.queue) + 2 * SLACK;
        let is_late = expected < now.saturating_duration_since(question.at);
        (is_late || question.kind == ProbeKind::Bare).then_some(question.at + PATIENCE)
    }

    pub(super) fn gives_up_at(&self) -> Option<Instant> {
        let oldest = self.questions.front();
        oldest.map(|question| question.at + PATIENCE)
    }

    /// Forgets the pending questions; returns whether the terminal has ever replied.
    pub(super) fn give_up(&mut self) -> bool {
        self.questions.clear();
        self.stage = Stage::Empty;
        self.set_rate(f64::from(self.rate) / 2.0);
        self.round_trip.is_some()
    }

    /// Updates the rate from the transmission time of a burst, excluding the round trip.
    fn judge(&mut self, question: Question, time: Duration) {
        let expected = self.time_for(question.queue);
        let rate = f64::from(self.rate);
        let measured = question.queue / time.max(RESOLUTION).as_secs_f64();
        self.stage = if self.stage == Stage::Open || time < expected.mul_f64(0.7) {
            let most = match self.settled {
                Some(settled) => f64::from(settled.max(self.rate)) * LATE_GROWTH,
                None => rate * GROWTH,
            };
            self.set_rate(measured.clamp(rate / GROWTH, most));
            Stage::Raised
        } else {
            self.settled = Some(self.rate);
            Stage::Settled
        };
    }

    /// Handles a late reply: lowers the rate to that delivered since the previous reply, and
    /// requests a measurement once the line is empty.
    fn slow_down(&mut self, question: Question, at: Instant) {
        let delivered = self.acknowledged.map_or(0.0, |(before, sent)| {
            let time = at.saturating_duration_since(before).max(RESOLUTION);
            (question.sent - sent) as f64 / time.as_secs_f64()
        });
        let rate = f64::from(self.rate);
        self.set_rate(delivered.clamp(rate / GROWTH, rate));
        // Bytes sent since then are still in flight.
        self.queue = (self.sent - question.sent) as f64;
        self.as_of = Some(at);
        self.stage = Stage::Empty;
    }

    /// Whether the queue is long enough to measure the rate.
    fn is_telling(&self, now: Instant) -> bool {
        TELLING <= self.time_for(self.queue_at(now))
    }

    /// Whether to check that there is no queue. This needs no burst: if the rate is overestimated,
    /// none may ever be long enough to measure.
    fn wants_check(&self, now: Instant) -> bool {
        let interval = match self.stage {
            Stage::Settled => INTERVAL,
            _ => UNSETTLED_INTERVAL,
        };
        let is_due = |asked: Instant| interval <= now.saturating_duration_since(asked);
        let is_news = self.acknowledged.is_some_and(|(_, sent)| sent < self.sent);
        self.questions.is_empty() && is_news && self.asked.is_some_and(is_due)
    }

    fn wants_burst(&self, now: Instant) -> bool {
        let mut kinds = self.questions.iter().map(|question| question.kind);
        let is_due = |asked: Instant| BURST_INTERVAL <= now.saturating_duration_since(asked);
        match self.stage {
            Stage::Empty => false,
            // The first burst may directly follow the first question.
            Stage::Open => kinds.all(|kind| kind == ProbeKind::Bare),
            Stage::Raised => self.questions.is_empty(),
            Stage::Settled => self.questions.is_empty() && self.burst_asked.is_none_or(is_due),
        }
    }

    fn set_rate(&mut self, rate: f64) {
        self.rate = (rate as u32).clamp(MIN_RATE, MAX_RATE);
    }

    /// When the queue will be empty; `None` before anything was sent.
    fn is_empty_at(&self) -> Option<Instant> {
        self.as_of.map(|as_of| as_of + self.time_for(self.queue))
    }

    fn queue_at(&self, now: Instant) -> f64 {
        let elapsed = self
            .as_of
            .map_or(Duration::ZERO, |as_of| now.saturating_duration_since(as_of));
        (self.queue - elapsed.as_secs_f64() * f64::from(self.rate)).max(0.0)
    }

    fn time_for(&self, bytes: f64) -> Duration {
        Duration::from_secs_f64(bytes / f64::from(self.rate))
    }
}
