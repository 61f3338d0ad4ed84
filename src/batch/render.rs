//! Renders a scene file to a picture file.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::finding::{Naming, Suspect, Text, print_without_effect};
use super::output::Output;
use super::parts::{self, Existing, Parts};
use super::stats::{Stats, Times};
use super::tracing::Tracer;
use super::{Error, Messages, Tracing, Warnings, load, stdout};
use assets::fingerprint;
use image_file::{ImageFormat, Picture};
use language::{Prospect, Source};
use render::{
    Aov, Frame, Job, Progress, Provenance, check_memory, exposes, memory_for, photons_kept,
};
use scene::Size;
use text::{Diagnostic, Span, counted};

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
/// the new one, see [`deliver`](file::deliver).
pub fn render(work: &Render) -> Result<(), Error> {
    try_render(work).inspect_err(|error| work.messages().error(error))
}

fn try_render(work: &Render) -> Result<(), Error> {
    for output in outputs(work) {
        output.check_spares(&work.scene, &[])?;
        output.check()?;
    }
    check_apart(work)?;
    assets::check_folders(&work.assets)?;
    let mut times = Times::started();
    memory::start_threads_or_none();
    let messages = work.messages();
    let loaded = load(
        messages,
        &work.scene,
        &work.assets,
        work.warnings,
        Some(&work.tracing.over()),
    )?;
    let scene = loaded.scene.ok_or_else(|| Error::Invalid {
        errors: loaded.findings.errors(),
    })?;
    for output in outputs(work) {
        output.check_spares(&work.scene, &loaded.read.files)?;
    }
    if let Some(Parts { existing, .. }) = work.parts
        && !loaded.read.is_whole()
    {
        let needed_by = match existing {
            Existing::Continued => "--resume needs",
            Existing::Refused => "--shard needs",
        };
        return Err(Error::Incomplete { needed_by });
    }
    let frames = work.format.frames();
    let job = work.tracing.job(scene, loaded.read.images, frames)?;
    check_size(
        work,
        job.settings.traced().size(),
        &loaded.source,
        loaded.size,
    )?;
    if work.parts.is_some() && job.settings.aov == Some(Aov::Cost) && 0.0 < job.settings.noise {
        let refused = "--shard and --resume cannot sample --aov cost adaptively; use --noise 0";
        return Err(Error::Refused(refused.to_owned()));
    }
    print_without_effect(messages, &work.tracing.over_text(), &job.settings);
    let threads = work.tracing.threads;
    let used = memory::used().unwrap_or(0);
    if work.purpose == Purpose::Estimate {
        let needed = memory_needed(work, &job, photons_kept(&job));
        let estimate = estimate(used, needed, threads);
        let line = format!("{}M\n", estimate.div_ceil(1 << 20));
        return stdout::print(&line).map_err(stdout::error);
    }
    let needed = memory_needed(work, &job, None);
    check_memory(&job, needed)?;
    times.load = times.lap();
    let prospects = loaded.prospects;
    let text = (loaded.source, loaded.read.found);
    let traced = match work.parts {
        Some(parts) => trace_parts(work, parts, &job, text, &prospects)?,
        None => trace_whole(work, job, text, &prospects)?,
    };
    times.trace = times.lap();
    if let Some(frame) = &traced.frame {
        finish(work, frame, &traced)?;
    }
    times.write = times.lap();
    if let Some(suspect) = traced.suspect {
        let tracer = || traced.tracer.unwrap_or_else(|| Tracer::new(&work.tracing));
        let text = Text {
            messages,
            path: &work.scene,
            naming: Naming::Implied,
            source: traced.source.as_ref(),
            prospects: &prospects,
        };
        suspect.print(&text, tracer);
    }
    let Some(output) = &work.stats else {
        return Ok(());
    };
    let stats = Stats {
        scene: &work.scene,
        picture: &traced.picture,
        threads: work.tracing.threads,
        progress: traced.progress,
        pixels: traced.pixels,
        estimate: estimate(used, needed, threads),
        times,
    };
    stats.write(output)
}

impl Render {
    fn messages(&self) -> Messages {
        Messages::beside(self.tracing.progress)
    }
}

/// A picture, or a part of one, that was traced.
struct Traced {
    /// `None` for a part.
    frame: Option<Arc<Frame>>,
    layers: Vec<(Aov, Arc<Frame>)>,
    /// What it is made from; without the digest of the scene where nothing says it.
    picture: Provenance,
    progress: Progress,
    /// The number of pixels traced.
    pixels: usize,
    /// The picture, if something may be wrong with it.
    suspect: Option<Suspect>,
    /// The text of the scene, if it is short.
    source: Option<Source>,
    /// Kept to the end, so that its threads free memory while the picture is written.
    tracer: Option<Tracer>,
}

fn trace_whole(
    work: &Render,
    job: Job,
    (source, found): (Source, BTreeMap<String, PathBuf>),
    prospects: &[Prospect],
) -> Result<Traced, Error> {
    let tracing = &work.tracing;
    let mut picture = tracing.provenance(&job, String::new());
    let again = job.clone();
    let is_digest_said = work.format.has_metadata() || work.stats.is_some();
    let mut digest = None;
    let mut tracer = Tracer::new(tracing);
    let mut kept = None;
    let meanwhile = || {
        digest = is_digest_said.then(|| fingerprint(source.text(), &found));
        kept = short(source);
    };
    let frame = tracer.trace(job, None, meanwhile)?;
    if let Some(digest) = digest {
        picture.scene = digest?;
    }
    let layers = tracer.layers(&again, frame.progress.spp, &tracing.layers)?;
    Ok(Traced {
        picture: picture.in_frame(&frame),
        progress: frame.progress,
        pixels: frame.size.pixels(),
        // Another reference would keep the scene in memory until the end.
        suspect: Suspect::of_picture(&frame, again, prospects),
        source: kept,
        frame: Some(frame),
        layers,
        tracer: Some(tracer),
    })
}

/// A text, if it is so short that keeping it costs nothing. Freeing one of 85 MB takes 10 ms, its tree nearly
/// as long, which are spent while the picture is traced.
fn short(source: Source) -> Option<Source> {
    Some(source).filter(|source| source.text().len() <= 1 << 20)
}

fn trace_parts(
    work: &Render,
    parts: Parts,
    job: &Job,
    (source, found): (Source, BTreeMap<String, PathBuf>),
    prospects: &[Prospect],
) -> Result<Traced, Error> {
    let path = beside(&work.output)?;
    let tracing = &work.tracing;
    let digest = fingerprint(source.text(), &found)?;
    let source = short(source);
    let mut picture = tracing.provenance(job, digest);
    let traced = parts::trace(tracing, (path, parts), job.clone(), &picture)?;
    let mut layers = Vec::new();
    if let Some(frame) = &traced.frame
        && !tracing.layers.is_empty()
    {
        layers = Tracer::new(tracing).layers(job, frame.progress.spp, &tracing.layers)?;
    }
    picture.settings.spp = traced.progress.spp;
    Ok(Traced {
        suspect: traced
            .frame
            .as_ref()
            .and_then(|frame| Suspect::of_picture(frame, job.clone(), prospects)),
        source,
        frame: traced.frame.map(Arc::new),
        layers,
        picture,
        progress: traced.progress,
        pixels: traced.pixels,
        tracer: None,
    })
}

/// Refuses a size that the format has not, at its place in the text if it is from there.
fn check_size(
    work: &Render,
    traced: Size,
    source: &Source,
    of_scene: Option<Span>,
) -> Result<(), Error> {
    let Some(reason) = work.format.refuses(traced) else {
        return Ok(());
    };
    let (size, region) = (work.tracing.size, work.tracing.region);
    let of_scene = of_scene.filter(|_| size.is_none() && region.is_none());
    let Some(span) = of_scene else {
        let option = region.map_or("--size", |_| "--region");
        return Err(Error::Refused(format!("{option} {reason}")));
    };
    let message = format!("view size {reason}");
    let diagnostic =
        Diagnostic::error(span, message, "a smaller size").with_hint("or override it: --size WxH");
    let messages = work.messages();
    messages.findings(&work.scene, source.text(), &[diagnostic]);
    Err(Error::Invalid { errors: 1 })
}

/// About how many bytes of memory a job takes, besides its scene. `kept` are the photons of each map, if
/// known.
fn memory_needed(work: &Render, job: &Job, kept: Option<u64>) -> u64 {
    let traced = match work.parts {
        None => memory_for(job, kept),
        Some(parts) => parts::memory_for(job, parts, work.tracing.threads, kept),
    };
    traced.saturating_add(work.tracing.memory_for_layers(job))
}

/// About how many bytes of memory a job that needs these takes in all, with those that its scene uses: a
/// tenth more than the larger parts, for all the others, and the stacks and heaps of threads.
fn estimate(used: u64, needed: u64, threads: usize) -> u64 {
    const OTHERS: u64 = 3 << 20;
    const THREAD: u64 = 1 << 20;
    let all = used.saturating_add(needed);
    all.saturating_add(all / 10)
        .saturating_add(OTHERS + threads as u64 * THREAD)
}

/// Says what is to be said of a picture, and writes it.
fn finish(work: &Render, frame: &Frame, traced: &Traced) -> Result<(), Error> {
    if 0 < frame.progress.over_budget {
        let samples = counted(frame.progress.over_budget as usize, "sample");
        work.messages().note(&format!(
            "{samples} ran out of rays and may be too dark; try a lower --depth"
        ));
    }
    print_biases(work.messages(), frame, &traced.picture);
    if work.tracing.time.is_some() {
        let Progress { spp, elapsed, .. } = frame.progress;
        let samples = counted(spp as usize, "sample");
        let seconds = elapsed.as_secs_f64();
        work.messages()
            .note(&format!("{samples} per pixel in {seconds:.1} s"));
    }
    let picture = Picture {
        frame,
        layers: &traced.layers,
        provenance: Some(&traced.picture),
    };
    work.output.write(|out| work.format.write(picture, out))
}

/// Says by what a picture is biased.
pub(super) fn print_biases(messages: Messages, frame: &Frame, picture: &Provenance) {
    let most = picture.settings.clamp;
    if 0.0 < most && exposes(picture.settings.aov) {
        messages.note(&format!(
            "samples are clamped to {most:?}; light above that is lost (biased)"
        ));
    }
    if frame.progress.is_adaptive() {
        let Progress { spp, mean_spp, .. } = frame.progress;
        messages.note(&format!(
            "adaptive sampling (slightly biased): up to {spp} samples per pixel, {mean_spp:.1} on \
                 average"
        ));
    }
}

/// Refuses outputs that would overwrite one another, and a part file beside no file.
fn check_apart(work: &Render) -> Result<(), Error> {
    if let (Some(stats), Output::File(picture)) = (&work.stats, &work.output) {
        stats.check_is_apart(picture, "it is the picture")?;
    }
    let Some(Parts { shard, .. }) = work.parts else {
        return Ok(());
    };
    let part = part::path_beside(beside(&work.output)?, shard);
    outputs(work).try_for_each(|output| output.check_is_apart(&part, "it is the part file"))
}

/// The file that a part file is kept beside.
fn beside(picture: &Output) -> Result<&Path, Error> {
    match picture {
        Output::File(path) if !path.exists() || path.is_file() => Ok(path),
        _ => Err(Error::Refused(
            "--shard and --resume keep a part file beside the picture: use -o FILE".to_owned(),
        )),
    }
}

/// Where the picture and the statistics go.
fn outputs(work: &Render) -> impl Iterator<Item = &Output> {
    [&work.output].into_iter().chain(&work.stats)
}
