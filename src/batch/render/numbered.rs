//! Renders the frames of a sequence to a file each.

use std::sync::Arc;
use std::time::Instant;

use super::plan::{self, FramePlan};
use super::{Finished, NumberedPlan};
use crate::Error;
use crate::output::Output;
use crate::progress::{self, Place};
use crate::signals::Signals;
use crate::tracing::Tracer;
use image_file::{ImageFormat, Picture};
use render::{Aov, Frame};
use text::counted;

/// Renders the frames that are not finished, and lists each.
pub(super) fn render(mut plan: NumberedPlan) -> Result<(), Error> {
    // Without them, a signal ends the process, and finished frames are kept all the same.
    let signals = Signals::noted().unwrap_or_default();
    let means = plan.sequence.means();
    let mut tracer = Tracer::new(means).stopped_by(signals.clone());
    let is_again = plan.finished == Finished::Rendered;
    let (numbers, mut skipped) = (plan.sequence.numbers, 0);
    let begun = Instant::now();
    for (number, before) in numbers.iter().zip(0..) {
        let stopped = |error| match (error, signals.last()) {
            (Error::Stopped, Some(signal)) => Error::KeptFrames {
                signal,
                frame: number,
                is_again,
            },
            (error, _) => error,
        };
        if signals.arrived() {
            return Err(stopped(Error::Stopped));
        }
        let Some(planned) = plan::frame(&mut plan, number)? else {
            skipped += 1;
            continue;
        };
        let place = Place {
            frame: number,
            before,
            skipped,
            all: numbers.count,
            begun,
        };
        let frame = tracer.trace(planned.still.job.clone(), Some(place), || {});
        let frame = frame.map_err(stopped)?;
        let layers = tracer.layers(&planned.still, frame.progress.spp);
        let layers = layers.map_err(stopped)?;
        let FramePlan { path, inputs, .. } = &planned;
        let bytes = encoded(&planned, &frame, &layers, plan.format)?;
        plan.ledger.add(inputs, path, &bytes)?;
    }
    if 0 < skipped {
        let was = if skipped == 1 { "was" } else { "were" };
        let note = format!(
            "{} {was} already finished",
            counted(skipped as usize, "frame")
        );
        means.messages().note(&note);
    }
    progress::finish_sequence(means.progress, numbers.count, begun.elapsed());
    Ok(())
}

/// Writes a frame to its file; returns the bytes.
fn encoded(
    planned: &FramePlan,
    frame: &Frame,
    layers: &[(Aov, Arc<Frame>)],
    format: ImageFormat,
) -> Result<Vec<u8>, Error> {
    let picture = Picture {
        frame,
        layers,
        provenance: Some(&planned.provenance.clone().in_frame(frame)),
    };
    let mut bytes = Vec::new();
    Output::File(planned.path.clone()).write(|out| {
        format.write(picture, &mut bytes)?;
        out.write_all(&bytes)
    })?;
    Ok(bytes)
}
