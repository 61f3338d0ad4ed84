//! The bucket at a fixed rate, and simulated lines that are measured.

use super::*;
use crate::terminal::environment;

const fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

#[test]
fn the_bucket_fills_at_the_rate_up_to_a_quarter_of_a_second() {
    let start = Instant::now();
    let mut link = Link::new(Budget::Fixed(1000));
    assert_eq!(link.allowance(start), 250);
    link.spent(250, start);
    for (after, allowance) in [(0, 0), (1, 1), (100, 100), (250, 250), (9000, 250)] {
        let found = link.allowance(start + ms(after));
        assert_eq!(found, allowance, "after {after} ms");
    }
}

/// A picture larger than the bucket waits for a full one, and text may cause debt.
#[test]
fn pictures_wait_for_a_full_bucket() {
    let start = Instant::now();
    let mut link = Link::new(Budget::Fixed(1000));
    assert_eq!(link.ready_at(start), None);
    link.spent(50, start);
    assert_eq!(link.ready_at(start), Some(start + ms(50)));
    link.spent(1200, start);
    assert_eq!(link.allowance(start), 0);
    assert_eq!(link.allowance(start + ms(1100)), 100);
    assert_eq!(link.ready_at(start), Some(start + ms(1250)));
    assert_eq!(link.ready_at(start + ms(1250)), None);
}

#[test]
fn the_time_returned_is_never_too_early_for_an_odd_rate() {
    let start = Instant::now();
    for rate in [1, 3, 7, 999_983, u32::MAX] {
        let mut link = Link::new(Budget::Fixed(rate));
        link.spent(rate as usize, start);
        let ready = link.ready_at(start).expect("the bucket is in debt");
        assert_eq!(link.ready_at(ready), None, "at {rate} bytes a second");
        let before = ready.checked_sub(Duration::from_nanos(1));
        let before = link.ready_at(before.expect("it is after the start"));
        assert!(before.is_some(), "at {rate} bytes a second");
    }
}

#[test]
fn local_and_zero_budgets_mean_no_limit() {
    let start = Instant::now();
    for limit in [Budget::Local, Budget::Fixed(0)] {
        let mut link = Link::new(limit);
        link.spent(1 << 40, start);
        assert_eq!(link.allowance(start), usize::MAX);
        assert_eq!(link.ready_at(start), None);
    }
}

#[test]
fn only_the_last_second_is_measured() {
    let start = Instant::now();
    let mut link = Link::new(Budget::Local);
    link.spent(10, start);
    link.spent(20, start + ms(600));
    assert_eq!(link.rate(start + ms(999)), 30);
    assert_eq!(link.rate(start + ms(1000)), 20);
    assert_eq!(link.rate(start + ms(1600)), 0);
}

#[test]
fn the_environment_determines_what_can_be_measured() {
    use Budget::{Fixed, Local, Measured};
    for (variables, budget) in table! {
        "TERM=xterm" => Local;
        "SSH_TTY=" => Local;
        "SSH_TTY=/dev/pts/1" => Measured;
        "SSH_CONNECTION=a,1,b,22" => Measured;
        "SSH_TTY=/dev/pts/1 TMUX=/tmp/tmux-0/default" => Fixed(128_000);
        "SSH_TTY=/dev/pts/1 TERM=screen-256color" => Fixed(128_000);
        "TERM=tmux-256color" => Fixed(0);
    } {
        let found = Budget::of_environment(environment(variables));
        assert_eq!(found, budget, "{variables}");
    }
}

/// A line with its rate in bytes per second and its round trip in milliseconds.
#[derive(Clone, Copy, Debug)]
struct Line {
    rate: u32,
    round_trip: u64,
    /// Maximum delay of a reply, in milliseconds.
    jitter: u64,
    /// Delay of the first reply, in milliseconds.
    start: u64,
    /// Size in bytes of the picture that replaces the previous one every 400 ms.
    picture: usize,
}

/// Result of a minute of pictures and keys.
struct Minute {
    /// Delays of the answers to keys, excluding the round trip, in ascending order.
    delays: Vec<Duration>,
    /// Bytes of picture sent.
    pictures: usize,
    questions: usize,
}

/// Size of the answer to a key, in bytes.
const ANSWER: usize = 300;

/// Sends pictures over a line within a budget, with a key every 210 ms, like a session: requests a
/// reply after sending something and when [`Link::asks_at`] is due. The first second is not
/// counted.
fn minute(budget: Budget, line: Line) -> Minute {
    let start = Instant::now();
    let half = ms(line.round_trip) / 2;
    let mut link = Link::new(budget);
    let mut minute = Minute {
        delays: Vec::new(),
        pictures: 0,
        questions: 0,
    };
    // When the line is free again, and when replies arrive.
    let mut free = start;
    let mut replies = VecDeque::new();
    let mut jitter = 0;
    let mut picture = 0;
    let mut send = |bytes: usize, now: Instant| {
        let time = Duration::from_secs_f64(bytes as f64 / f64::from(line.rate));
        free = free.max(now) + time;
        free + half
    };
    let text = send(6000, start);
    assert!(start < text);
    link.spent(6000, start);
    for step in 0..60_000 {
        let now = start + ms(step);
        while replies.front().is_some_and(|&at| at <= now) {
            link.replied(now);
            replies.pop_front();
        }
        link.give_up(now);
        let mut is_awake = link.asks_at().is_some_and(|at| at <= now);
        if step % 210 == 0 {
            is_awake = true;
            let seen = send(ANSWER, now);
            link.spent(ANSWER, now);
            if 1000 <= step {
                minute.delays.push((seen - now).saturating_sub(half));
            }
        }
        if step % 400 == 0 {
            picture = line.picture;
        }
        let bytes = link.allowance(now).min(picture);
        if 0 < bytes && link.ready_at(now).is_none() {
            send(bytes, now);
            link.spent(bytes, now);
            minute.pictures += bytes;
            picture -= bytes;
            is_awake = true;
        }
        if is_awake && link.has_question(now) {
            jitter = (jitter + 7) % (line.jitter + 1);
            let is_first = minute.questions == 0;
            let late = if is_first { line.start } else { jitter };
            replies.push_back(send(4, now) + half + ms(late));
            link.asked(now);
            minute.questions += 1;
        }
    }
    minute.delays.sort();
    minute
}

const ENDLESS: usize = 1 << 40;

#[test]
fn answers_to_keys_wait_for_few_bytes_of_pictures() {
    for (rate, round_trip, jitter, start, picture) in [
        (40_000, 50, 0, 0, ENDLESS),
        (40_000, 50, 0, 70, 50_000),
        (40_000, 50, 35, 0, 50_000),
        (40_000, 50, 45, 0, 50_000),
        (40_000, 200, 45, 0, 50_000),
        (40_000, 200, 80, 0, 50_000),
        (40_000, 200, 0, 0, ENDLESS),
        (40_000, 200, 15, 0, 50_000),
        (40_000, 200, 15, 300, 50_000),
        (64_000, 100, 10, 0, ENDLESS),
        (128_000, 20, 0, 0, ENDLESS),
        (128_000, 200, 15, 0, ENDLESS),
        (128_000, 200, 15, 100, 20_000),
        (1_000_000, 20, 0, 0, ENDLESS),
        (1_000_000, 200, 20, 0, ENDLESS),
        (1_000_000, 200, 20, 100, 50_000),
        (10_000_000, 2, 1, 0, ENDLESS),
    ] {
        let line = Line {
            rate,
            round_trip,
            jitter,
            start,
            picture,
        };
        let minute = minute(Budget::Measured, line);
        let p95 = minute.delays[minute.delays.len() * 95 / 100];
        assert!(p95 <= ms(50), "{line:?}: {p95:?}");
        // Half of the line's rate, of the picture data, or of the maximum rate.
        let least = (rate as usize * 60 / 2)
            .min(60_000_000)
            .min(picture.saturating_mul(150) / 2);
        let (pictures, questions) = (minute.pictures, minute.questions);
        assert!(least <= pictures, "{line:?}: {pictures} bytes");
        assert!(questions < 60, "{line:?}: {questions} questions");
    }
}
