//! A progress line.

use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

use crate::render::Progress;
use crate::text::percentage;

/// Minimum time between two updates: short enough to show life, long enough to be read.
const INTERVAL: Duration = Duration::from_millis(200);

/// Width of the bar in cells.
const BAR: usize = 20;

/// A line on standard error, shown only if that is a terminal, and erased on drop.
pub(super) struct ProgressLine {
    terminal: Option<io::Stderr>,
    last: Option<Instant>,
}

impl ProgressLine {
    pub(super) fn new() -> Self {
        let stream = io::stderr();
        Self {
            terminal: stream.is_terminal().then_some(stream),
            last: None,
        }
    }

    /// Shows the current state, at most once per [`INTERVAL`].
    pub(super) fn show(&mut self, progress: &Progress) {
        let Some(terminal) = &mut self.terminal else {
            return;
        };
        if self.last.is_some_and(|last| last.elapsed() < INTERVAL) {
            return;
        }
        self.last = Some(Instant::now());
        // Failing to write a progress line does no harm.
        let _ = write!(terminal, "\r{}\x1b[K", line(progress));
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        if let (Some(terminal), Some(_)) = (&mut self.terminal, self.last) {
            let _ = write!(terminal, "\r\x1b[K");
        }
    }
}

/// `████████░░░░░░░░░░░░ 42 %  pass 3/6  noise 1.3 %  1.2 s, about 1.7 s left  14.0 Mray/s`
fn line(progress: &Progress) -> String {
    let elapsed = progress.elapsed.as_secs_f64();
    let percent = (progress.done * 100.0).floor();
    let full = (progress.done * BAR as f64) as usize;
    let bar = ["█".repeat(full), "░".repeat(BAR.saturating_sub(full))].concat();
    let noise = progress.noise.map_or_else(String::new, |noise| {
        format!("  noise {}", percentage(noise))
    });
    let state = format!(
        "{bar} {percent} %  pass {}/{}{noise}  {elapsed:.1} s",
        progress.pass, progress.passes
    );
    // Early on, the rate is too noisy to extrapolate from.
    if progress.done <= 0.0 || elapsed <= 0.5 {
        return state;
    }
    let left = elapsed * (1.0 - progress.done) / progress.done;
    let rate = progress.rays as f64 / elapsed / 1e6;
    format!("{state}, about {left:.1} s left  {rate:.1} Mray/s")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn progress(done: f64, seconds: f64) -> Progress {
        Progress {
            pass: 3,
            passes: 6,
            spp: 2,
            done,
            elapsed: Duration::from_secs_f64(seconds),
            rays: 28_000_000,
            shadow_rays: 0,
            over_budget: 0,
            noise: Some(0.0134),
            complete: false,
        }
    }

    #[test]
    fn the_line_extrapolates_from_the_fraction_done() {
        assert_eq!(
            line(&progress(0.25, 2.0)),
            "█████░░░░░░░░░░░░░░░ 25 %  pass 3/6  noise 1.3 %  2.0 s, about 6.0 s left  14.0 Mray/s"
        );
        assert_eq!(
            line(&progress(0.0, 9.0)),
            "░░░░░░░░░░░░░░░░░░░░ 0 %  pass 3/6  noise 1.3 %  9.0 s"
        );
        assert_eq!(
            line(&progress(0.999, 0.1)),
            "███████████████████░ 99 %  pass 3/6  noise 1.3 %  0.1 s"
        );
    }
}
