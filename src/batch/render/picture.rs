//! Renders a picture, or a part of one, as planned.

use super::parts::Traced;
use super::{Error, PicturePlan, Way};
use crate::Messages;
use crate::finding::{Naming, Suspect, Text, print_biases};
use crate::stats::Stats;
use crate::tracing::Tracer;
use assets::fingerprint;
use image_file::Picture;
use language::Source;
use render::{Frame, Limit, Progress, Provenance};
use text::counted;

/// Traces and writes a picture, says what is wrong with it, and writes the figures.
pub(super) fn render(mut plan: PicturePlan, way: Way) -> Result<(), Error> {
    let (still, execution) = (plan.still, plan.execution);
    let messages = execution.messages();
    let is_limited = matches!(still.job.limit, Some(Limit::Time(_)));
    // Kept to the end, so that its threads free memory while the picture is written.
    let mut tracer = None;
    let (traced, source) = match way {
        Way::Whole { source, found } => {
            let tracer = tracer.insert(Tracer::new(execution));
            let is_digest_said = plan.target.format.has_metadata() || plan.stats.is_some();
            let mut digest = None;
            let mut kept = None;
            let meanwhile = || {
                digest = is_digest_said.then(|| fingerprint(source.text(), &found));
                kept = short(source);
            };
            let frame = tracer.trace(still.job.clone(), None, meanwhile)?;
            let digest = digest.transpose()?.unwrap_or_default();
            let traced = Traced {
                picture: still.provenance(digest).in_frame(&frame),
                progress: frame.progress,
                pixels: frame.size.pixels(),
                frame: Some(frame),
            };
            (traced, kept)
        }
        Way::Part { source, part } => (part.trace(still.job.clone())?, source),
    };
    let mut layers = Vec::new();
    if let Some(frame) = &traced.frame
        && !still.layers.is_empty()
    {
        let tracer = tracer.get_or_insert_with(|| Tracer::new(execution));
        layers = tracer.layers(&still, frame.progress.spp)?;
    }
    // Another reference to the job would keep the scene in memory until the end.
    let frame = traced.frame.as_ref();
    let suspect = frame.and_then(|frame| Suspect::of_picture(frame, still.job, &plan.prospects));
    plan.times.trace = plan.times.lap();
    if let Some(frame) = &traced.frame {
        print_notes(frame, &traced.picture, messages);
        if is_limited {
            print_samples(&frame.progress, messages);
        }
        plan.target.write(Picture {
            frame,
            layers: &layers,
            provenance: Some(&traced.picture),
        })?;
    }
    plan.times.write = plan.times.lap();
    if let Some(suspect) = suspect {
        let text = Text {
            messages,
            path: &plan.scene,
            naming: Naming::Implied,
            source: source.as_ref(),
            prospects: &plan.prospects,
        };
        suspect.print(&text, || tracer.unwrap_or_else(|| Tracer::new(execution)));
    }
    let Some(output) = &plan.stats else {
        return Ok(());
    };
    let stats = Stats {
        scene: &plan.scene,
        picture: &traced.picture,
        threads: execution.threads,
        progress: traced.progress,
        pixels: traced.pixels,
        estimate: plan.estimate,
        times: plan.times,
    };
    stats.write(output)
}

/// A text, if it is so short that keeping it costs nothing. Freeing one of 85 MB takes 10 ms, its tree nearly
/// as long, which are spent while the picture is traced.
pub(super) fn short(source: Source) -> Option<Source> {
    Some(source).filter(|source| source.text().len() <= 1 << 20)
}

/// Prints the notes on a picture before it is written.
fn print_notes(frame: &Frame, picture: &Provenance, messages: Messages) {
    if 0 < frame.progress.over_budget {
        let samples = counted(frame.progress.over_budget as usize, "sample");
        messages.note(&format!(
            "{samples} ran out of rays and may be too dark; try a lower --depth"
        ));
    }
    print_biases(messages, frame, picture);
}

/// Prints how many samples a picture took in its time.
fn print_samples(progress: &Progress, messages: Messages) {
    let Progress { spp, elapsed, .. } = progress;
    let samples = counted(*spp as usize, "sample");
    let seconds = elapsed.as_secs_f64();
    messages.note(&format!("{samples} per pixel in {seconds:.1} s"));
}
