//! What a line takes, judged by how long replies of the terminal are on their way.
//!
//! A reply to a question that follows a burst of bytes comes after a round trip and the time the
//! line takes for the burst. A reply that is late shows bytes that pile up: pictures wait until the
//! line is empty, then the round trip and the rate are measured anew.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// What a line is taken for before the first reply, in bytes a second.
const FIRST_RATE: u32 = 32_000;

const LEAST_RATE: u32 = 2_000;
const MOST_RATE: u32 = 64_000_000;

/// The part of the line that pictures are given, in hundredths: an estimate that is a quarter too
/// high piles nothing up.
const SHARE: u32 = 75;

/// How long the line takes for a piece of picture, which is how long a key's answer may wait.
const BURST: Duration = Duration::from_millis(20);

/// How long it takes for one that is measured: long beside the jitter of replies.
const MEASURED_BURST: Duration = Duration::from_millis(50);

/// The shortest burst that the rate can be measured by.
const TELLING: Duration = Duration::from_millis(25);

/// The least piece of picture, in bytes: about ten cells.
const LEAST_BURST: u64 = 256;

/// How late a reply may come before the line is taken to be overloaded.
const SLACK: Duration = Duration::from_millis(30);

/// The least time between questions once the rate has settled.
const INTERVAL: Duration = Duration::from_secs(2);

/// The least time between questions behind what is too little to measure, before it has settled.
const UNSETTLED_INTERVAL: Duration = Duration::from_millis(500);

/// The most that one burst may multiply the rate by: an overestimated round trip, as during startup,
/// makes any line look infinitely fast.
const GROWTH: f64 = 4.0;

/// How long a reply is waited for.
const PATIENCE: Duration = Duration::from_secs(5);

/// The shortest time that is distinguished from none.
const RESOLUTION: Duration = Duration::from_millis(1);

/// The rate and the round trip of a line.
#[derive(Debug)]
pub(super) struct Estimate {
    /// Bytes a second.
    rate: u32,
    round_trip: Option<Duration>,
    stage: Stage,
    /// The bytes that the line still had to take at `as_of`.
    queue: f64,
    as_of: Option<Instant>,
    /// All bytes that were sent.
    sent: u64,
    questions: VecDeque<Question>,
    /// When the last question was asked.
    asked: Option<Instant>,
    /// When the last reply came, and the bytes that were sent before its question.
    acknowledged: Option<(Instant, u64)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// The round trip is to be measured, on an empty line.
    Empty,
    /// The rate is to be measured, whatever it was taken for.
    Open,
    /// The rate was raised: it is to be measured again.
    Raised,
    /// The rate is right.
    Settled,
}

#[derive(Clone, Copy, Debug)]
struct Question {
    at: Instant,
    kind: Kind,
    /// The bytes that the line had to take before it.
    queue: f64,
    /// The bytes that were sent before it.
    sent: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Behind nothing.
    Bare,
    /// Behind a burst.
    Burst,
    /// Behind too few bytes to measure: only a late reply means anything.
    Check,
}

impl Estimate {
    /// Starts with a line of which nothing is known.
    pub(super) fn new() -> Self {
        Self::of_slow(FIRST_RATE)
    }

    /// Starts with a line that took so many bytes a second.
    pub(super) fn of_slow(rate: u32) -> Self {
        Self {
            rate: rate.clamp(LEAST_RATE, MOST_RATE),
            round_trip: None,
            stage: Stage::Empty,
            queue: 0.0,
            as_of: None,
            sent: 0,
            questions: VecDeque::new(),
            asked: None,
            acknowledged: None,
        }
    }

    /// The bytes a second that the line takes.
    pub(super) fn rate(&self) -> u32 {
        self.rate
    }

    /// The bytes a second that pictures are given.
    pub(super) fn pace(&self) -> u32 {
        (u64::from(self.rate) * u64::from(SHARE) / 100) as u32
    }

    /// The bytes of picture that are sent at once; more where they are to be measured.
    pub(super) fn burst(&self, now: Option<Instant>) -> u64 {
        let measured = now.is_some_and(|now| self.wants_burst(now));
        let time = if measured { MEASURED_BURST } else { BURST };
        let bytes = u64::from(self.rate) * time.as_millis() as u64 / 1000;
        bytes.max(LEAST_BURST)
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

    /// When the line is empty, if the round trip is to be measured then.
    pub(super) fn asks_at(&self) -> Option<Instant> {
        let is_wanted = self.stage == Stage::Empty && self.questions.is_empty();
        self.is_empty_at().filter(|_| is_wanted)
    }

    pub(super) fn asked(&mut self, now: Instant) {
        let kind = if self.stage == Stage::Empty {
            self.stage = Stage::Open;
            Kind::Bare
        } else if self.is_telling(now) {
            Kind::Burst
        } else {
            Kind::Check
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
            (Kind::Bare, _) | (_, None) => self.round_trip = Some(time),
            (kind, Some(round_trip)) => {
                self.round_trip = Some(round_trip.min(time));
                let on_line = time.saturating_sub(round_trip);
                let is_late = self.time_for(question.queue) + SLACK < on_line;
                let is_first = self.stage == Stage::Open && kind == Kind::Burst;
                if is_late && !is_first {
                    self.slow_down(question, at);
                } else if time.mul_f64(1.25) + RESOLUTION < round_trip {
                    // The line was not empty when the round trip was measured.
                    self.stage = Stage::Raised;
                } else if kind == Kind::Burst {
                    self.judge(question, on_line);
                } else if self.stage == Stage::Raised {
                    // Nothing piles up at the present load.
                    self.stage = Stage::Settled;
                }
            }
        }
        self.acknowledged = Some((at, question.sent));
    }

    /// Until when pictures wait: for a reply that is late, and for the measure of an empty line.
    pub(super) fn holds_until(&self, now: Instant) -> Option<Instant> {
        let round_trip = self.round_trip?;
        let Some(question) = self.questions.front() else {
            return self.is_empty_at().filter(|_| self.stage == Stage::Empty);
        };
        let expected = round_trip + self.time_for(question.queue) + 2 * SLACK;
        let is_late = expected < now.saturating_duration_since(question.at);
        (is_late || question.kind == Kind::Bare).then_some(question.at + PATIENCE)
    }

    pub(super) fn gives_up_at(&self) -> Option<Instant> {
        self.questions
            .front()
            .map(|question| question.at + PATIENCE)
    }

    /// Forgets what was asked; whether the terminal has ever replied.
    pub(super) fn give_up(&mut self) -> bool {
        self.questions.clear();
        self.stage = Stage::Empty;
        self.set_rate(f64::from(self.rate) / 2.0);
        self.round_trip.is_some()
    }

    /// Takes the time that a burst was on its way, beyond the round trip.
    fn judge(&mut self, question: Question, time: Duration) {
        let expected = self.time_for(question.queue);
        let rate = f64::from(self.rate);
        let measured = question.queue / time.max(RESOLUTION).as_secs_f64();
        self.stage = if self.stage == Stage::Open || time < expected.mul_f64(0.7) {
            self.set_rate(measured.clamp(rate / GROWTH, rate * GROWTH));
            Stage::Raised
        } else {
            Stage::Settled
        };
    }

    /// Handles a late reply: lowers the rate to what was delivered since the previous one, and has the
    /// line measured again once it is empty.
    fn slow_down(&mut self, question: Question, at: Instant) {
        let delivered = self.acknowledged.map_or(0.0, |(before, sent)| {
            let time = at.saturating_duration_since(before).max(RESOLUTION);
            (question.sent - sent) as f64 / time.as_secs_f64()
        });
        let rate = f64::from(self.rate);
        self.set_rate(delivered.clamp(rate / GROWTH, rate));
        // What was sent since is still on its way.
        self.queue = (self.sent - question.sent) as f64;
        self.as_of = Some(at);
        self.stage = Stage::Empty;
    }

    /// Whether enough bytes are on the line to measure its rate.
    fn is_telling(&self, now: Instant) -> bool {
        TELLING <= self.time_for(self.queue_at(now))
    }

    /// Whether to check that nothing piles up. That needs no burst: if the rate is overestimated, none
    /// may ever be long enough to measure.
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
        match self.stage {
            Stage::Empty => false,
            // The first burst may follow the first question at once.
            Stage::Open => self.questions.iter().all(|asked| asked.kind == Kind::Bare),
            Stage::Raised => self.questions.is_empty(),
            Stage::Settled => {
                let is_due = |asked: Instant| INTERVAL <= now.saturating_duration_since(asked);
                self.questions.is_empty() && self.asked.is_none_or(is_due)
            }
        }
    }

    fn set_rate(&mut self, rate: f64) {
        self.rate = (rate as u32).clamp(LEAST_RATE, MOST_RATE);
    }

    /// When the line has taken everything; `None` before anything was sent.
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
