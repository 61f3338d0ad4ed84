//! Renders a scene file to a picture file.

use std::path::PathBuf;

use super::fingerprint::fingerprint;
use super::output::Output;
use super::parts::{self, Parts};
use super::stats::{Stats, Times};
use super::{Error, Tracing, Warnings, load, print_error, print_findings, print_message, stdout};
use crate::assets;
use crate::image_file::ImageFormat;
use crate::memory;
use crate::render::{Frame, Job, Progress, memory_for};
use crate::text::{Diagnostic, counted};

/// A picture to render.
#[derive(Clone, Debug, PartialEq)]
pub struct Render {
    /// The scene file.
    pub scene: PathBuf,
    /// How warnings of the scene are treated.
    pub warnings: Warnings,
    /// Where the picture goes.
    pub output: Output,
    /// The format of the picture.
    pub format: ImageFormat,
    /// How it is traced.
    pub tracing: Tracing,
    /// Whether it is traced into a part file, and how.
    pub parts: Option<Parts>,
    /// What is to be done.
    pub purpose: Purpose,
    /// Where figures about the render go.
    pub stats: Option<Output>,
    /// Additional folders that pictures and meshes may be read from.
    pub assets: Vec<PathBuf>,
}

/// What is to be done with a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Purpose {
    /// It is rendered.
    #[default]
    Render,
    /// The memory that rendering takes is printed, as batch systems take it, such as `340M`.
    Estimate,
}

/// Renders a scene and writes the picture. Warnings, notes and progress go to standard error. A
/// reader that closes the pipe early is not an error. If interrupted, leaves either the old file or
/// the new one, see [`file::deliver`].
pub fn render(work: &Render) -> Result<(), Error> {
    try_render(work).inspect_err(print_error)
}

fn try_render(work: &Render) -> Result<(), Error> {
    for output in outputs(work) {
        output.check_spares(&work.scene, &[])?;
        output.check()?;
    }
    assets::check_folders(&work.assets)?;
    let mut times = Times::started();
    memory::start_threads_or_none();
    let loaded = load(&work.scene, &work.assets, work.warnings)?;
    let scene = loaded.scene.ok_or(Error::Invalid {
        errors: loaded.errors,
    })?;
    for output in outputs(work) {
        output.check_spares(&work.scene, &loaded.files)?;
    }
    let size = work.tracing.traced_size(&scene)?;
    if let Some(reason) = work.format.refuses(size) {
        let (size, region) = (work.tracing.size, work.tracing.region);
        let of_scene = loaded.size.filter(|_| size.is_none() && region.is_none());
        let Some(span) = of_scene else {
            let option = region.map_or("--size", |_| "--region");
            return Err(Error::Refused(format!("{option} {reason}")));
        };
        let message = format!("view size {reason}");
        let diagnostic = Diagnostic::error(span, message, "a smaller size")
            .with_hint("or override it: --size WxH");
        print_findings(&work.scene, loaded.source.text(), &[diagnostic]);
        return Err(Error::Invalid { errors: 1 });
    }
    let digest = match (work.parts, &work.stats) {
        (None, None) => String::new(),
        _ => fingerprint(loaded.source.text(), &loaded.files)?,
    };
    let job = work.tracing.job(scene, loaded.images, work.format.frames());
    let estimate = estimate(&job);
    if work.purpose == Purpose::Estimate {
        let line = format!("{}M\n", estimate.div_ceil(1 << 20));
        return stdout::print(&line).map_err(stdout::error);
    }
    let settings = job.settings;
    times.load = times.lap();
    let stats = |times, settings, progress, pixels| match &work.stats {
        Some(output) => Stats {
            scene: &work.scene,
            digest: &digest,
            settings,
            threads: work.tracing.threads,
            progress,
            pixels,
            estimate,
            times,
        }
        .write(output),
        None => Ok(()),
    };
    if let Some(parts) = work.parts {
        let Output::File(picture) = &work.output else {
            return Err(Error::Refused(
                "--shard and --resume keep a file beside the picture: use -o FILE".to_owned(),
            ));
        };
        drop(loaded.source);
        let traced = parts::trace(&work.tracing, (picture, parts), job, digest.clone())?;
        times.trace = times.lap();
        if let Some(frame) = &traced.frame {
            finish(work, frame)?;
            times.write = times.lap();
        }
        return stats(times, settings, traced.progress, traced.pixels);
    }
    // Freeing a text of 85 MB takes 10 ms, its tree nearly as long: the worker is already running.
    let free = || drop(loaded.source);
    let traced = work.tracing.trace_job(job, free)?;
    times.trace = times.lap();
    let frame = &traced.frame;
    finish(work, frame)?;
    times.write = times.lap();
    stats(times, settings, frame.progress, frame.size.pixels())
}

/// About how many bytes of memory a job takes in all, now that its scene is loaded: a tenth more than
/// the larger parts, for all the others, and the threads.
fn estimate(job: &Job) -> u64 {
    const THREADS: u64 = 32 << 20;
    let all = memory::used().unwrap_or(0).saturating_add(memory_for(job));
    all.saturating_add(all / 10).saturating_add(THREADS)
}

/// Says what is to be said of a picture, and writes it.
fn finish(work: &Render, frame: &Frame) -> Result<(), Error> {
    if 0 < frame.progress.over_budget {
        let samples = counted(frame.progress.over_budget as usize, "sample");
        print_message(
            "note",
            &format!("{samples} ran out of rays and may be too dark; try a lower --depth"),
        );
    }
    if work.tracing.time.is_some() {
        let Progress { spp, elapsed, .. } = frame.progress;
        let samples = counted(spp as usize, "sample");
        let seconds = elapsed.as_secs_f64();
        print_message("note", &format!("{samples} per pixel in {seconds:.1} s"));
    }
    work.output.write(|out| work.format.write(frame, out))
}

/// Where the picture and the statistics go.
fn outputs(work: &Render) -> impl Iterator<Item = &Output> {
    [&work.output].into_iter().chain(&work.stats)
}
