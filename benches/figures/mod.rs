//! Times between events and frames, and the rows of the printed table.

use std::time::{Duration, Instant};

use crate::desk::Drawn;

pub(crate) const SECOND: Duration = Duration::from_secs(1);

/// The time from `from` to the first later frame that satisfies a condition.
pub(crate) fn first(
    drawn: &[Drawn],
    from: Instant,
    holds: impl Fn(&Drawn) -> bool,
) -> Option<Duration> {
    let after = drawn.iter().filter(|drawn| from < drawn.at);
    after
        .filter(|drawn| holds(drawn))
        .map(|drawn| drawn.at - from)
        .next()
}

/// The time from each key to the first later frame that satisfies a condition.
pub(crate) fn each(
    drawn: &[Drawn],
    pressed: &[Instant],
    holds: impl Fn(&Drawn) -> bool,
) -> Vec<Duration> {
    pressed
        .iter()
        .filter_map(|&key| first(drawn, key, &holds))
        .collect()
}

pub(crate) fn times_row(name: &str, times: &[Duration], target: &str) {
    let mut times: Vec<_> = times.iter().map(|time| time.as_secs_f64() * 1e3).collect();
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times.get(((times.len() as f64 * share).ceil() as usize).max(1) - 1);
    let text =
        [at(0.5), at(0.95), at(1.0)].map(|t| t.map_or_else(|| "-".into(), |t| format!("{t:.1}")));
    let [p50, p95, most] = text;
    let text = format!(
        "p50 {p50:>6}  p95 {p95:>6}  max {most:>6}  n {}",
        times.len()
    );
    row(&format!("{name}, ms"), &text, target);
}

pub(crate) fn row(name: &str, text: &str, target: &str) {
    println!("{name:<32} {text:<46} {target}");
}
