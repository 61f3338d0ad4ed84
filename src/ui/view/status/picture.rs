//! What the status line says of the picture: how it is made, and its progress.

use std::time::Duration;

use ratatui::style::Style;

use super::segments::{Rank, Segments};
use crate::app::{Picture, Shared, display};
use crate::theme;
use render::Progress;
use text::percentage;

/// The progress of the full-size trace while another picture is on screen.
pub(super) fn background(trace: &Picture) -> String {
    let done = trace.progress().map_or(0.0, |progress| progress.done);
    let paused = if trace.paused { " paused," } else { "" };
    format!("trace{paused} {}", percent(done))
}

/// Adds the progress of the picture, whose scene asks for so many samples per pixel.
pub(super) fn progress(progress: &Progress, asked: u32, segments: &mut Segments) {
    let seconds = progress.elapsed.as_secs_f64();
    if !progress.complete {
        let pass = format!("pass {}/{}", progress.pass, progress.passes);
        segments.say(Rank::Pass, pass, theme::DIM);
    }
    if 0 < progress.spp {
        let samples = progress.samples();
        // Where some pixels take more than exports are asked for, that is the preview's doing.
        let samples = if asked < progress.spp && progress.is_adaptive() {
            format!("preview {samples}")
        } else {
            samples
        };
        segments.say(Rank::Samples, samples, Style::new());
    }
    if !progress.complete {
        segments.say(Rank::Share, percent(progress.done), theme::ACCENT);
    }
    if let Some(noise) = progress.noise {
        let text = format!("noise {}", percentage(noise));
        segments.say(Rank::Noise, text, Style::new());
    }
    if !progress.elapsed.is_zero() {
        segments.say(Rank::Elapsed, duration(progress.elapsed), Style::new());
    }
    if let Some(left) = time_left(progress) {
        let text = format!("ETA {}", duration(left));
        segments.say(Rank::TimeLeft, text, theme::DIM);
    }
    if 0.0 < seconds && 0 < progress.rays {
        let rate = progress.rays as f64 / seconds / 1e6;
        let digits = usize::from(rate < 10.0);
        if 0.05 <= rate {
            segments.say(Rank::Rate, format!("{rate:.digits$} Mray/s"), theme::DIM);
        }
    }
    if 0 < progress.over_budget {
        let text = format!("{} over ray budget", progress.over_budget);
        segments.say(Rank::OverBudget, text, theme::WARNING);
    }
}

/// Adds the auxiliary image shown, or the integrator, with a star if it differs from the scene's.
pub(super) fn making(shared: &Shared, segments: &mut Segments) {
    if shared.wireframe().is_some() {
        segments.say(Rank::Departure, "wireframe", theme::WARNING);
        return;
    }
    if let Some(display) = display::display_name(shared) {
        let text = format!(" {display} ");
        segments.say(Rank::Notice, text, theme::chip(theme::WARNING));
    }
    let view = display::view_name(shared);
    if let Some(view) = &view {
        segments.say(Rank::Departure, view.as_str(), theme::WARNING);
    }
    if let Some(legend) = display::legend(shared) {
        segments.say(Rank::Scale, legend, theme::DIM);
    }
    if view.is_some() {
        return;
    }
    let name = shared.rendering().integrator().name();
    if shared.is_integrator_changed() {
        segments.say(Rank::Departure, format!("{name}*"), theme::WARNING);
    } else {
        segments.say(Rank::Integrator, name, theme::DIM);
    }
    if 0.0 < shared.rendering().noise() {
        segments.say(Rank::Caveat, "adaptive, slightly biased", theme::DIM);
    }
    if 0.0 < shared.rendering().clamp() {
        segments.say(Rank::Caveat, "clamped, biased", theme::DIM);
    }
}

/// Estimates the remaining time at the pace so far. `None` during the first pass, whose coarse
/// samples say little about the others.
fn time_left(progress: &Progress) -> Option<Duration> {
    let known = !progress.elapsed.is_zero()
        && 1 <= progress.spp
        && 0.0 < progress.done
        && !progress.complete;
    let seconds = progress.elapsed.as_secs_f64() * (1.0 - progress.done) / progress.done;
    known.then(|| Duration::try_from_secs_f64(seconds).ok())?
}

/// A share as a percentage.
pub(super) fn percent(share: f64) -> String {
    // Rounded down: only a complete picture shows 100 %.
    format!("{} %", (100.0 * share).floor())
}

fn duration(time: Duration) -> String {
    let seconds = time.as_secs();
    match seconds {
        0..10 => format!("{:.1} s", time.as_secs_f64()),
        10..60 => format!("{seconds} s"),
        60..3600 => format!("{}:{:02} min", seconds / 60, seconds % 60),
        _ => format!("{}:{:02} h", seconds / 3600, seconds / 60 % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_short() {
        let times = [9, 59, 61, 7260].map(|seconds| duration(Duration::from_secs(seconds)));
        assert_eq!(times, ["9.0 s", "59 s", "1:01 min", "2:01 h"]);
    }
}
