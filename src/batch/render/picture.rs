//! Renders a picture, or a part of one, as planned.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use super::parts::Opened;
use super::{PicturePlan, Way};
use crate::Error;
use crate::finding::{Naming, Suspect, Text, print_biases};
use crate::stats::Stats;
use crate::tracing::{Means, Still, Tracer};
use assets::fingerprint;
use image_file::Picture;
use language::{Prospect, Source};
use render::{Aov, Frame, Limit, Progress, Provenance};
use text::counted;

/// Traces and writes a picture, says what is wrong with it, and writes the figures.
pub(super) fn render(plan: PicturePlan) -> Result<(), Error> {
    let PicturePlan {
        scene,
        prospects,
        still,
        way,
        means,
        target,
        stats,
        estimate,
        mut times,
    } = plan;
    let is_limited = matches!(still.job.limit, Some(Limit::Time(_)));
    let traced = match way {
        Way::Whole { source, found } => {
            let is_digest_said = target.format.has_metadata() || stats.is_some();
            let digest = is_digest_said.then_some(&found);
            whole(still, (source, digest), &prospects, means)?
        }
        Way::Part {
            source,
            part,
            picture,
        } => self::part(still, (part, picture), source, &prospects, means)?,
    };
    times.trace = times.lap();
    if let Some(frame) = &traced.frame {
        print_notes(frame, &traced.picture, is_limited, means);
        target.write(Picture {
            frame,
            layers: &traced.layers,
            provenance: Some(&traced.picture),
        })?;
    }
    times.write = times.lap();
    if let Some(suspect) = traced.suspect {
        let tracer = || traced.tracer.unwrap_or_else(|| Tracer::new(means));
        let text = Text {
            messages: means.messages(),
            path: &scene,
            naming: Naming::Implied,
            source: traced.source.as_ref(),
            prospects: &prospects,
        };
        suspect.print(&text, tracer);
    }
    let Some(output) = &stats else {
        return Ok(());
    };
    let stats = Stats {
        scene: &scene,
        picture: &traced.picture,
        threads: means.threads,
        progress: traced.progress,
        pixels: traced.pixels,
        estimate,
        times,
    };
    stats.write(output)
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

/// Traces a picture, and computes the digest of its scene with these files meanwhile, if there are any.
fn whole(
    still: Still,
    (source, files): (Source, Option<&BTreeMap<String, PathBuf>>),
    prospects: &[Prospect],
    means: Means,
) -> Result<Traced, Error> {
    let mut picture = still.provenance(String::new());
    let mut digest = None;
    let mut tracer = Tracer::new(means);
    let mut kept = None;
    let meanwhile = || {
        digest = files.map(|files| fingerprint(source.text(), files));
        kept = short(source);
    };
    let frame = tracer.trace(still.job.clone(), None, meanwhile)?;
    if let Some(digest) = digest {
        picture.scene = digest?;
    }
    let layers = tracer.layers(&still, frame.progress.spp)?;
    Ok(Traced {
        picture: picture.in_frame(&frame),
        progress: frame.progress,
        pixels: frame.size.pixels(),
        // Another reference would keep the scene in memory until the end.
        suspect: Suspect::of_picture(&frame, still.job, prospects),
        source: kept,
        frame: Some(frame),
        layers,
        tracer: Some(tracer),
    })
}

/// A text, if it is so short that keeping it costs nothing. Freeing one of 85 MB takes 10 ms, its tree nearly
/// as long, which are spent while the picture is traced.
pub(super) fn short(source: Source) -> Option<Source> {
    Some(source).filter(|source| source.text().len() <= 1 << 20)
}

/// Traces what a part file has of a picture.
fn part(
    still: Still,
    (part, mut picture): (Opened, Provenance),
    source: Option<Source>,
    prospects: &[Prospect],
    means: Means,
) -> Result<Traced, Error> {
    let traced = part.trace(still.job.clone())?;
    let layers = match &traced.frame {
        Some(frame) if !still.layers.is_empty() => {
            Tracer::new(means).layers(&still, frame.progress.spp)?
        }
        _ => Vec::new(),
    };
    picture.settings.spp = traced.progress.spp;
    let suspect = |frame| Suspect::of_picture(frame, still.job, prospects);
    Ok(Traced {
        suspect: traced.frame.as_ref().and_then(suspect),
        source,
        frame: traced.frame.map(Arc::new),
        layers,
        picture,
        progress: traced.progress,
        pixels: traced.pixels,
        tracer: None,
    })
}

/// Says what is to be said of a picture before it is written.
fn print_notes(frame: &Frame, picture: &Provenance, is_limited: bool, means: Means) {
    let messages = means.messages();
    if 0 < frame.progress.over_budget {
        let samples = counted(frame.progress.over_budget as usize, "sample");
        messages.note(&format!(
            "{samples} ran out of rays and may be too dark; try a lower --depth"
        ));
    }
    print_biases(messages, frame, picture);
    if is_limited {
        let Progress { spp, elapsed, .. } = frame.progress;
        let samples = counted(spp as usize, "sample");
        let seconds = elapsed.as_secs_f64();
        messages.note(&format!("{samples} per pixel in {seconds:.1} s"));
    }
}
