//! Figures about a finished render, as JSON.

use std::path::Path;
use std::time::{Duration, Instant};

use serde_json::{Map, Value, json};

use super::Error;
use super::output::Output;
use render::{Progress, Provenance, Settings};

/// What is counted and timed.
pub(super) struct Stats<'s> {
    pub(super) scene: &'s Path,
    pub(super) picture: &'s Provenance,
    pub(super) threads: usize,
    pub(super) progress: Progress,
    /// The number of pixels traced.
    pub(super) pixels: usize,
    /// The bytes of memory estimated beforehand.
    pub(super) estimate: u64,
    pub(super) times: Times,
}

/// How long the steps of a render took.
#[derive(Clone, Copy, Debug)]
pub(super) struct Times {
    last: Instant,
    pub(super) load: Duration,
    pub(super) trace: Duration,
    pub(super) write: Duration,
}

impl Times {
    pub(super) fn started() -> Self {
        Self {
            last: Instant::now(),
            load: Duration::ZERO,
            trace: Duration::ZERO,
            write: Duration::ZERO,
        }
    }

    /// The time since the last call, or the start.
    pub(super) fn lap(&mut self) -> Duration {
        let now = Instant::now();
        now - std::mem::replace(&mut self.last, now)
    }
}

impl Stats<'_> {
    /// Writes the figures.
    pub(super) fn write(&self, output: &Output) -> Result<(), Error> {
        let text = format!("{:#}\n", self.object());
        output.write(&mut |out| out.write_all(text.as_bytes()))
    }

    /// The keys are part of the interface of the command. Times are in seconds, memory in bytes; what
    /// is not known is null.
    fn object(&self) -> Value {
        let Progress {
            mean_spp,
            rays,
            shadow_rays,
            over_budget,
            noise,
            ..
        } = self.progress;
        let Times {
            load, trace, write, ..
        } = self.times;
        let seconds = |time: Duration| time.as_secs_f64();
        let samples = (self.pixels as f64 * mean_spp).round() as u64;
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "scene": self.scene.to_string_lossy(),
            "digest": self.picture.scene,
            "settings": self.settings(),
            "threads": self.threads,
            "pixels": self.pixels,
            "samples": samples,
            "samples_over_budget": over_budget,
            "noise": noise,
            "rays": {
                "all": rays,
                "shadow": shadow_rays,
                "other": rays - shadow_rays,
            },
            "seconds": {
                "load": seconds(load),
                "trace": seconds(trace),
                "write": seconds(write),
                "total": seconds(load + trace + write),
            },
            "memory": {
                "estimate": self.estimate,
                "peak": memory::peak(),
            },
        })
    }
}

impl Stats<'_> {
    /// The settings, with the view, the layers, and whether noise is reduced.
    fn settings(&self) -> Value {
        let mut settings = settings(&self.picture.settings);
        let of_picture = self.picture.written().into_iter();
        for (name, value) in
            of_picture.filter(|(name, _)| ["view", "layers", "denoise"].contains(name))
        {
            settings[name] = Value::String(value);
        }
        settings
    }
}

/// Settings with the names of the command line's options.
pub(super) fn settings(settings: &Settings) -> Value {
    let written = settings.written().into_iter();
    let mut named: Map<_, _> = written
        .map(|(name, value)| (name.to_owned(), number_or_word(value)))
        .collect();
    named.insert("spp".to_owned(), settings.spp.into());
    Value::Object(named)
}

/// A setting, as a number if it is one.
fn number_or_word(written: String) -> Value {
    written
        .parse()
        .map_or(Value::String(written), Value::Number)
}
