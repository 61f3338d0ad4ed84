//! Plans a picture, a sequence, and each frame of one: reads what it takes, and refuses what can be refused
//! before tracing, in the order in which users see it.

use std::path::PathBuf;

use super::arguments::{Finished, PictureWork, Purpose, SequenceOutput, SequenceWork};
use super::ledger::Ledger;
use super::lists::{list, lists};
use super::parts::PartFile;
use super::picture::short;
use super::sequence::Sequence;
use super::shot::Shot;
use super::{Error, MoviePlan, NumberedPlan, Output, PicturePlan, Plan, Still, Way};
use crate::finding::print_without_effect;
use crate::reading::Loaded;
use crate::stats::Times;
use crate::{Reading, Tracing};
use assets::fingerprint;
use file::Digest;
use image_file::{DEFAULT_RATE, ImageFormat};
use render::{Aov, Frames, Job, Limit, Provenance, check_memory, memory_for, photons_kept};
use text::{Diagnostic, Span};

/// Plans a picture, and reads its scene.
pub(super) fn picture(
    work: PictureWork,
    tracing: &Tracing,
    reading: &Reading,
) -> Result<Plan, Error> {
    let part = check_outputs(&work)?;
    let mut times = Times::started();
    reading.begin()?;
    let execution = tracing.execution;
    let messages = execution.messages();
    let mut loaded = reading.load(messages, &work.scene, Some(&tracing.over()))?;
    let scene = loaded.take_scene()?;
    for output in work.outputs() {
        output.check_spares(&work.scene, &loaded.read.files)?;
    }
    if let Some(part) = &part
        && !loaded.read.is_whole()
    {
        let needed_by = part.needs();
        return Err(Error::Incomplete { needed_by });
    }
    let Loaded {
        path, source, read, ..
    } = loaded;
    let still = tracing.still(scene, read.images, work.target.format.frames())?;
    let settings = &still.job.settings;
    if let Some(reason) = work.target.format.refuses(settings.traced().size()) {
        if let (None, None, Some(span)) = (tracing.region, tracing.size, loaded.size) {
            let error = no_such_size(span, &reason);
            messages.findings(&path, source.text(), &[error]);
            return Err(Error::Invalid { errors: 1 });
        }
        let option = tracing.region.map_or("--size", |_| "--region");
        return Err(Error::Refused(format!("{option} {reason}")));
    }
    if part.is_some() && settings.aov == Some(Aov::Cost) && 0.0 < settings.noise {
        let refused = "--shard and --resume cannot sample --aov cost adaptively; use --noise 0";
        return Err(Error::Refused(refused.to_owned()));
    }
    print_without_effect(messages, &tracing.over_text(), settings);
    let used = memory::used().unwrap_or(0);
    let needed = |kept| match &part {
        None => memory_of_whole(&still, kept),
        Some(part) => memory_of_part(&still, part, execution.threads, kept),
    };
    if work.purpose == Purpose::Estimate {
        let needed = needed(photons_kept(&still.job));
        return Ok(Plan::Estimate(estimate(used, needed, execution.threads)));
    }
    let needed = needed(None);
    check_memory(&still.job, needed)?;
    times.load = times.lap();
    let way = match part {
        None => Way::Whole {
            source,
            found: read.found,
        },
        Some(part) => {
            let picture = still.provenance(fingerprint(source.text(), &read.found)?);
            Way::Part {
                source: short(source),
                part: Box::new(part.open(picture, execution)?),
            }
        }
    };
    let plan = PicturePlan {
        scene: work.scene,
        prospects: loaded.prospects,
        still,
        execution,
        target: work.target,
        stats: work.stats,
        estimate: estimate(used, needed, execution.threads),
        times,
    };
    Ok(Plan::Picture(Box::new(plan), way))
}

/// Refuses outputs that cannot be written, or would overwrite the scene or one another. Returns the part
/// file, if one is asked for.
fn check_outputs(work: &PictureWork) -> Result<Option<PartFile>, Error> {
    for output in work.outputs() {
        output.check_spares(&work.scene, &[])?;
        output.check()?;
    }
    if let (Some(stats), Output::File(picture)) = (&work.stats, &work.target.output) {
        stats.check_is_apart(picture, "it is the picture")?;
    }
    let Some(parts) = work.parts else {
        return Ok(None);
    };
    let part = PartFile::beside(&work.target.output, parts)?;
    for output in work.outputs() {
        output.check_is_apart(part.path(), "it is the part file")?;
    }
    Ok(Some(part))
}

/// The error for a size in a scene that the format cannot hold.
fn no_such_size(span: Span, reason: &str) -> Diagnostic {
    let message = format!("view size {reason}");
    Diagnostic::error(span, message, "a smaller size").with_hint("or override it: --size WxH")
}

/// About how many bytes of memory it takes to trace a picture as a whole, besides its scene. `kept` is the
/// number of photons in each map, if known.
fn memory_of_whole(still: &Still, kept: Option<u64>) -> u64 {
    memory_for(&still.job, kept).saturating_add(still.memory_for_layers())
}

/// The same for a picture that these threads trace into a part file.
fn memory_of_part(still: &Still, part: &PartFile, threads: usize, kept: Option<u64>) -> u64 {
    let traced = part.memory_for(&still.job, threads, kept);
    traced.saturating_add(still.memory_for_layers())
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

/// Plans a sequence, and reads what all of its frames have in common.
pub(super) fn sequence(
    work: SequenceWork,
    tracing: Tracing,
    reading: Reading,
) -> Result<Plan, Error> {
    reading.begin()?;
    let mut sequence = Sequence::of(work.shows, work.frames, tracing, reading)?;
    match work.output {
        SequenceOutput::Pictures {
            pattern,
            format,
            shard,
            finished,
        } => {
            sequence.numbers = sequence.numbers.of_shard(shard);
            let list = list(&pattern, shard);
            let output = Output::File(list.clone());
            sequence.check_spared(&output, &[])?;
            output.check()?;
            Ok(Plan::Numbered(NumberedPlan {
                ledger: Ledger::read(list, &lists(&pattern))?,
                sequence,
                pattern,
                format,
                finished,
            }))
        }
        SequenceOutput::Movie { to, format, rate } => {
            let rate = rate.or_else(|| sequence.rate()).unwrap_or(DEFAULT_RATE);
            if let Some(reason) = format.refuses(rate) {
                return Err(Error::Refused(reason));
            }
            sequence.check_spared(&to, &[])?;
            to.check()?;
            Ok(Plan::Movie(MoviePlan {
                sequence,
                to,
                format,
                rate,
            }))
        }
    }
}

/// A frame of a sequence, to be written to a file of its own.
pub(super) struct FramePlan {
    pub(super) still: Still,
    /// What the picture is made from.
    pub(super) provenance: Provenance,
    /// Its file.
    pub(super) path: PathBuf,
    /// The digest of all that the file depends on.
    pub(super) inputs: String,
}

/// Plans a frame, and reads its scene; `None` if the frame is finished.
pub(super) fn frame(plan: &mut NumberedPlan, number: u32) -> Result<Option<FramePlan>, Error> {
    let format = plan.format;
    let path = plan.pattern.path(number);
    let Shot {
        still,
        digest,
        files,
    } = plan.sequence.shot(number, format.frames())?;
    let job = &still.job;
    let provenance = still.provenance(digest);
    let inputs = inputs(job, &provenance, format);
    if plan.finished == Finished::Skipped && plan.ledger.has(&inputs, &path) {
        return Ok(None);
    }
    let output = Output::File(path.clone());
    plan.sequence.check_spared(&output, &files)?;
    output.check_is_apart(plan.ledger.path(), "it is the list of finished frames")?;
    output.check()?;
    if let Some(reason) = format.refuses(job.settings.traced().size()) {
        return Err(Error::Refused(format!("frame {number}: {reason}")));
    }
    check_memory(job, memory_of_whole(&still, None))?;
    Ok(Some(FramePlan {
        still,
        provenance,
        path,
        inputs,
    }))
}

/// The digest of all that a picture file depends on.
fn inputs(job: &Job, picture: &Provenance, format: ImageFormat) -> String {
    let entries = picture.written().into_iter().map(|(_, value)| value);
    let samples = match job.limit {
        Some(Limit::Time(time)) => format!("{} s", time.as_secs_f64()),
        _ => picture.settings.spp.to_string(),
    };
    let parts: Vec<_> = entries.chain([samples, format.name().to_owned()]).collect();
    Digest::of(parts.iter().map(String::as_bytes))
}

/// Plans a frame of a movie, and reads its scene.
pub(super) fn movie_frame(plan: &mut MoviePlan, number: u32) -> Result<Job, Error> {
    let Shot { still, files, .. } = plan.sequence.shot(number, Frames::Last)?;
    plan.sequence.check_spared(&plan.to, &files)?;
    Ok(still.job)
}
