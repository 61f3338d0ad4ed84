//! Progress on standard error: a line that is updated, or lines of JSON for other programs.

use std::io::{self, Write};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::report::has_controls;
use render::Progress;
use text::percentage;

/// Minimum time between two updates: short enough to show life, long enough to be read.
const INTERVAL: Duration = Duration::from_millis(200);

/// Width of the bar in cells.
const BAR: usize = 20;

/// How progress is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ProgressStyle {
    /// A line that is updated, if standard error is a terminal that can do that, and erased at the end.
    #[default]
    Line,
    /// An object of JSON a line, messages too: one with the event `done` at the end, and one with the
    /// event `frame` for each frame of a sequence that is traced.
    Json,
    /// Not at all.
    Off,
}

/// Shows progress on standard error. Failing to write it does no harm.
pub(super) struct Reporter {
    style: ProgressStyle,
    last: Option<Instant>,
    /// The place in a sequence, such as `frame 3/36`.
    place: Option<Place>,
    /// The fraction of the work that was done before, 0 to 1, unless it is of a sequence.
    begun: f64,
}

/// How far all the work is: a picture, or a whole sequence.
#[derive(Clone, Copy, Debug)]
struct Whole {
    /// The fraction that is done, 0 to 1, and what was done of it before.
    done: f64,
    begun: f64,
    /// The time since it was begun.
    elapsed: Duration,
}

/// The place of a picture in a sequence.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// The number of the frame.
    pub(super) frame: u32,
    /// How many are done before it.
    pub(super) before: u32,
    /// How many of those were finished already.
    pub(super) skipped: u32,
    /// How many there are.
    pub(super) all: u32,
    /// When the first was begun.
    pub(super) begun: Instant,
}

impl Reporter {
    pub(super) fn new(style: ProgressStyle) -> Self {
        let style = match style {
            ProgressStyle::Line if !has_controls() => ProgressStyle::Off,
            style => style,
        };
        Self {
            style,
            last: None,
            place: None,
            begun: 0.0,
        }
    }

    /// Tells the place of the picture in a sequence.
    pub(super) fn at(self, place: Option<Place>) -> Self {
        Self { place, ..self }
    }

    /// Tells the fraction of the work that was done before, 0 to 1.
    pub(super) fn begun(self, begun: f64) -> Self {
        Self { begun, ..self }
    }

    /// Shows the current state, at most once per [`INTERVAL`].
    pub(super) fn show(&mut self, progress: &Progress) {
        if self.last.is_some_and(|last| last.elapsed() < INTERVAL) {
            return;
        }
        self.last = Some(Instant::now());
        let _ = match self.style {
            ProgressStyle::Line => {
                let place = self.place.map_or_else(String::new, |place| {
                    format!(
                        "frame {} ({}/{})  ",
                        place.frame,
                        place.before + 1,
                        place.all
                    )
                });
                write!(
                    io::stderr(),
                    "\r{place}{}\x1b[K",
                    line(progress, &self.whole(progress))
                )
            }
            ProgressStyle::Json => writeln!(io::stderr(), "{}", self.object("progress", progress)),
            ProgressStyle::Off => Ok(()),
        };
    }

    /// How far all the work is, given the progress of a picture.
    fn whole(&self, progress: &Progress) -> Whole {
        match self.place {
            None => Whole {
                done: progress.done,
                begun: self.begun,
                elapsed: progress.elapsed,
            },
            Some(place) => place.whole(progress.done, place.begun.elapsed()),
        }
    }

    fn object(&self, event: &str, progress: &Progress) -> Value {
        let mut object = object(event, progress, &self.whole(progress));
        if let Some(Place {
            frame, before, all, ..
        }) = self.place
        {
            object["frame"] = frame.into();
            object["frames_before"] = before.into();
            object["frames"] = all.into();
        }
        object
    }

    /// Says that the picture is traced, which may be a frame of a sequence.
    pub(super) fn finish(&self, progress: &Progress) {
        if self.style == ProgressStyle::Json {
            let event = self.place.map_or("done", |_| "frame");
            let _ = writeln!(io::stderr(), "{}", self.object(event, progress));
        }
    }
}

impl Place {
    /// How far the sequence is, with this fraction of the frame done.
    fn whole(&self, done: f64, elapsed: Duration) -> Whole {
        let all = f64::from(self.all);
        Whole {
            done: (f64::from(self.before) + done) / all,
            begun: f64::from(self.skipped) / all,
            elapsed,
        }
    }
}

impl Drop for Reporter {
    fn drop(&mut self) {
        if self.style == ProgressStyle::Line && self.last.is_some() {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}

/// Says as JSON that all frames of a sequence are rendered.
pub(super) fn finish_sequence(style: ProgressStyle, frames: u32, elapsed: Duration) {
    if style == ProgressStyle::Json {
        let elapsed = elapsed.as_secs_f64();
        let object = json!({
            "event": "done", "done": 1.0, "frames": frames, "elapsed": elapsed, "left": 0.0,
        });
        let _ = writeln!(io::stderr(), "{object}");
    }
}

/// Progress as JSON. The keys are part of the interface of the command; times are in seconds, what
/// is not known yet is null.
fn object(event: &str, progress: &Progress, whole: &Whole) -> Value {
    json!({
        "event": event,
        "done": whole.done,
        "pass": progress.pass,
        "passes": progress.passes,
        "spp": progress.spp,
        "mean_spp": progress.mean_spp,
        "elapsed": whole.elapsed.as_secs_f64(),
        "left": whole.left(),
        "rays": progress.rays,
        "noise": progress.noise,
    })
}

impl Whole {
    /// The seconds that are left; `None` early on, when the rate is too noisy to extrapolate from.
    fn left(&self) -> Option<f64> {
        let (done, begun) = (self.done, self.begun);
        let elapsed = self.elapsed.as_secs_f64();
        if 1.0 <= done {
            return Some(0.0);
        }
        (begun < done && 0.5 < elapsed).then(|| elapsed * (1.0 - done) / (done - begun))
    }
}

/// `████████░░░░░░░░░░░░ 42 %  pass 3/6  noise 1.3 %  1.2 s, about 1.7 s left  14.0 Mray/s`
fn line(progress: &Progress, whole: &Whole) -> String {
    let elapsed = whole.elapsed.as_secs_f64();
    let percent = (whole.done * 100.0).floor();
    let full = (whole.done * BAR as f64) as usize;
    let bar = ["█".repeat(full), "░".repeat(BAR.saturating_sub(full))].concat();
    let noise = progress.noise.map_or_else(String::new, |noise| {
        format!("  noise {}", percentage(noise))
    });
    let state = format!(
        "{bar} {percent} %  pass {}/{}{noise}  {elapsed:.1} s",
        progress.pass, progress.passes
    );
    let Some(left) = whole.left() else {
        return state;
    };
    let rate = progress.rays as f64 / progress.elapsed.as_secs_f64() / 1e6;
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
            mean_spp: 2.0,
            done,
            elapsed: Duration::from_secs_f64(seconds),
            rays: 28_000_000,
            shadow_rays: 0,
            over_budget: 0,
            noise: Some(0.0134),
            complete: false,
        }
    }

    /// The progress of a single picture.
    fn alone(progress: &Progress, begun: f64) -> Whole {
        Reporter::new(ProgressStyle::Off)
            .begun(begun)
            .whole(progress)
    }

    fn object_of(event: &str, done: f64, seconds: f64) -> Value {
        let progress = progress(done, seconds);
        object(event, &progress, &alone(&progress, 0.0))
    }

    fn line_of(done: f64, seconds: f64) -> String {
        let progress = progress(done, seconds);
        line(&progress, &alone(&progress, 0.0))
    }

    #[test]
    fn the_object_has_all_figures() {
        let expected = json!({
            "event": "progress", "done": 0.25, "pass": 3, "passes": 6, "spp": 2, "mean_spp": 2.0,
            "elapsed": 2.0, "left": 6.0, "rays": 28_000_000, "noise": 0.0134,
        });
        assert_eq!(object_of("progress", 0.25, 2.0), expected);
        let done = object_of("done", 1.0, 0.1);
        assert_eq!(
            (&done["left"], &done["event"]),
            (&json!(0.0), &json!("done"))
        );
        assert_eq!(object_of("progress", 0.25, 0.1)["left"], Value::Null);
    }

    #[test]
    fn the_line_extrapolates_from_the_fraction_done() {
        assert_eq!(
            line_of(0.25, 2.0),
            "█████░░░░░░░░░░░░░░░ 25 %  pass 3/6  noise 1.3 %  2.0 s, about 6.0 s left  14.0 Mray/s"
        );
        assert_eq!(
            line_of(0.0, 9.0),
            "░░░░░░░░░░░░░░░░░░░░ 0 %  pass 3/6  noise 1.3 %  9.0 s"
        );
        assert_eq!(
            line_of(0.999, 0.1),
            "███████████████████░ 99 %  pass 3/6  noise 1.3 %  0.1 s"
        );
        // What was done before took no time now.
        assert_eq!(alone(&progress(0.75, 2.0), 0.25).left(), Some(1.0));
    }

    #[test]
    fn figures_of_a_frame_cover_the_sequence() {
        // Frames before it, those of them that were finished already, the share of it that is done,
        // seconds since the sequence was begun; the share of all that is done, and the seconds left.
        for (before, skipped, done, seconds, all_done, left) in [
            (0, 0, 0.0, 0.1, 0.0, None),
            (0, 0, 1.0, 6.0, 0.25, Some(18.0)),
            (2, 0, 0.0, 8.0, 0.5, Some(8.0)),
            (2, 2, 0.0, 8.0, 0.5, None),
            (2, 2, 0.5, 8.0, 0.625, Some(24.0)),
            (2, 1, 1.0, 8.0, 0.75, Some(4.0)),
            (3, 0, 1.0, 8.0, 1.0, Some(0.0)),
        ] {
            let place = Place {
                frame: before,
                before,
                skipped,
                all: 4,
                begun: Instant::now(),
            };
            let whole = place.whole(done, Duration::from_secs_f64(seconds));
            let case = (before, skipped, done);
            assert_eq!((whole.done, whole.left()), (all_done, left), "{case:?}");
            assert_eq!(whole.elapsed.as_secs_f64(), seconds);
        }
    }
}
