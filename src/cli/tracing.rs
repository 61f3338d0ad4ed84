//! The arguments that say how a scene is traced without an interface.

use std::env;
use std::num::NonZero;
use std::thread;
use std::time::Duration;

use clap::Args;

use super::choices::AovChoice;
use super::rendering::RenderingArguments;
use super::shared::{spp_range, threads_range, whole_number};
use batch::{Execution, ProgressStyle, Tracing};
use render::{Aov, Region, can_denoise};
use scene::{Rendering, Size, Viewpoint};
use text::parse_duration;

#[derive(Args, Debug)]
pub(super) struct TracingArguments {
    #[command(flatten)]
    samples: SampleArguments,
    /// Trace only this part of the picture, in pixels from its top left corner: the same pixels as in
    /// the whole picture, but scaled AOVs and --noise go by the part alone
    #[arg(long, value_name = "X,Y,W,H", allow_hyphen_values = true, value_parser = parse_region)]
    region: Option<Region>,
    /// Samples per pixel, 1 to 65536 [default: the scene's, otherwise 16, or up to 4096 with
    /// --noise; as many as the time permits with --time]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = spp_range())]
    spp: Option<u32>,
    /// Stop within this time, such as 90s or 5min, after a whole pass (1, 2, 4 … samples): the same
    /// picture as with that --spp
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = parse_time)]
    time: Option<Duration>,
    /// Render a property of the first surface under each pixel, or of the samples of its light,
    /// instead of light
    #[arg(long, value_name = "AOV", value_enum)]
    aov: Option<AovChoice>,
    /// Number of tracing threads, 1 to 1024 [default: one per core that the process may use; in a
    /// Slurm job, as many as its task has]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads_range())]
    threads: Option<u16>,
}

/// What the samples of a picture depend on.
#[derive(Args, Debug)]
pub(super) struct SampleArguments {
    /// Width and height in pixels, such as 800x600; at most 268435456 pixels in all (16384x16384)
    /// [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<Size>,
    /// Replace parts of the scene's view, such as "eye 0 1 5 fov 30"; parts: eye X Y Z, target X Y Z,
    /// up X Y Z, fov DEGREES, height H, aspect A, near D, far D, focus D, lens R
    #[arg(long, value_name = "PARTS", allow_hyphen_values = true, value_parser = Viewpoint::parse)]
    view: Option<Viewpoint>,
    #[command(flatten)]
    rendering: RenderingArguments,
    /// Random seed, 0 to 4294967295 [default: 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole_number(0, u32::MAX))]
    seed: Option<u32>,
}

impl TracingArguments {
    /// Whether a limit of time decides how many samples are taken.
    pub(super) fn is_limited(&self) -> bool {
        self.time.is_some()
    }

    /// With layers and, unless an AOV without noise is rendered, with noise reduced.
    pub(super) fn with(self, layers: Vec<Aov>, denoise: bool) -> Result<Tracing, String> {
        let tracing = self.into_tracing();
        let noiseless = tracing.aov.filter(|&of| denoise && !can_denoise(Some(of)));
        if let Some(aov) = noiseless {
            return Err(format!(
                "--denoise reduces the noise of light: not with --aov {}",
                aov.name()
            ));
        }
        Ok(Tracing {
            layers,
            denoise,
            ..tracing
        })
    }

    pub(super) fn into_tracing(self) -> Tracing {
        let samples = self.samples.into_tracing();
        Tracing {
            region: self.region,
            rendering: Rendering {
                spp: self.spp,
                ..samples.rendering
            },
            time: self.time,
            aov: self.aov.map(AovChoice::value),
            execution: Execution {
                threads: self.threads.map_or(samples.execution.threads, usize::from),
                ..samples.execution
            },
            ..samples
        }
    }
}

impl SampleArguments {
    pub(super) fn into_tracing(self) -> Tracing {
        Tracing {
            size: self.size,
            view: self.view.unwrap_or_default(),
            region: None,
            rendering: self.rendering.rendering(None),
            time: None,
            seed: self.seed,
            aov: None,
            layers: Vec::new(),
            denoise: false,
            execution: Execution {
                threads: default_threads(|name| env::var(name).ok()),
                progress: ProgressStyle::default(),
            },
        }
    }
}

/// As many threads as the process may use cores, by its affinity and control group, and no more
/// than Slurm has given its task, which it does not enforce everywhere.
fn default_threads(variable: impl Fn(&str) -> Option<String>) -> usize {
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let given = ["SLURM_CPUS_PER_TASK", "SLURM_CPUS_ON_NODE"];
    let mut given = given.iter().filter_map(|name| variable(name)?.parse().ok());
    given
        .next()
        .map_or(cores, |given: NonZero<usize>| cores.min(given.get()))
}

fn parse_size(text: &str) -> Result<Size, String> {
    Size::parse(text)
        .ok_or_else(|| "expected two integers of at least 1, such as 800x600".to_owned())
}

fn parse_region(text: &str) -> Result<Region, String> {
    Region::parse(text).ok_or_else(|| {
        "expected left column, top row, width and height in pixels, such as 100,50,64,48".to_owned()
    })
}

fn parse_time(text: &str) -> Result<Duration, String> {
    parse_duration(text).ok_or_else(|| "expected a time, such as 90s, 5min or 2h".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_task_takes_no_more_threads_than_slurm_gives_it() {
        let cores = thread::available_parallelism().map_or(1, NonZero::get);
        let with = |task: &str, node: &str| {
            default_threads(|name| match name {
                "SLURM_CPUS_PER_TASK" => Some(task.to_owned()),
                _ => Some(node.to_owned()),
            })
        };
        assert_eq!(default_threads(|_| None), cores);
        assert_eq!(with("1", "64"), 1);
        assert_eq!(with("", "1"), 1);
        assert_eq!(with("4096", "1"), cores);
        assert_eq!(with("0", "no number"), cores);
    }
}
