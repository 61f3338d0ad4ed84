//! The arguments of `bench`.

use std::path::PathBuf;

use clap::Args;

use super::shared::{ReadingArguments, whole_number};
use super::tracing::TracingArguments;
use batch::{Bench, Report};

pub(super) const EXAMPLES: &str = "\
Examples:
  halflight bench                                     built-in scenes, a few seconds each
  halflight bench scene.xml --size 1920x1080 --spp 16
  halflight bench --threads 1 --json > bench.json

Prints medians: the time to load a scene, to build its acceleration structures, to show a first \
picture, and to trace all samples; and the rays and samples per second while tracing.";

#[derive(Args, Debug)]
pub(super) struct BenchArguments {
    /// Scene files [default: the embedded scene, and cubes of 1000 and 64000 spheres]
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Number of runs, 1 to 1000
    #[arg(long, value_name = "N", default_value_t = 5, allow_negative_numbers = true, value_parser = whole_number(1, 1000_u32))]
    runs: u32,
    /// Print the figures as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    tracing: TracingArguments,
    #[command(flatten)]
    reading: ReadingArguments,
}

impl BenchArguments {
    pub(super) fn into_bench(self) -> Result<Bench, String> {
        if self.tracing.is_limited() {
            return Err("bench measures the time of all samples: use --spp".to_owned());
        }
        Ok(Bench {
            scenes: self.scenes,
            tracing: self.tracing.into_tracing(),
            runs: self.runs,
            report: if self.json {
                Report::Json
            } else {
                Report::Text
            },
            reading: self.reading.into_reading(),
        })
    }
}
