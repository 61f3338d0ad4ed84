//! Renders the frames of a sequence, as planned: to a file each, or all to one.

use std::io::{self, Write};
use std::sync::Arc;
use std::time::Instant;

use super::plan::{self, FramePlan};
use super::{Error, Execution, MoviePlan, NumberedPlan, Output};
use crate::progress::{self, Place};
use crate::signals::Signals;
use crate::tracing::Tracer;
use image_file::{MovieWriter, Picture};
use render::{Frame, Job};
use text::counted;

/// Renders the frames that are not finished, each to its file, and lists them.
pub(super) fn numbered(mut plan: NumberedPlan) -> Result<(), Error> {
    // Without them, a signal ends the process, and finished frames are kept all the same.
    let signals = Signals::noted().unwrap_or_default();
    let finished = plan.finished;
    let numbers = plan.sequence.numbers;
    let mut frames = Frames::new(plan.sequence.execution(), numbers.count, signals.clone());
    for number in numbers.iter() {
        let stopped = |error| match (error, signals.last()) {
            (Error::Stopped, Some(signal)) => Error::KeptFrames {
                signal,
                frame: number,
                finished,
            },
            (error, _) => error,
        };
        if signals.arrived() {
            return Err(stopped(Error::Stopped));
        }
        let Some(planned) = plan::frame(&mut plan, number)? else {
            frames.skip();
            continue;
        };
        let FramePlan {
            still,
            provenance,
            path,
            inputs,
        } = planned;
        let frame = frames.trace(number, still.job.clone()).map_err(stopped)?;
        let layers = frames.tracer.layers(&still, frame.progress.spp);
        let picture = Picture {
            frame: &frame,
            layers: &layers.map_err(stopped)?,
            provenance: Some(&provenance.in_frame(&frame)),
        };
        let mut bytes = Vec::new();
        Output::File(path.clone()).write(&mut |out| {
            plan.format.write(picture, &mut bytes)?;
            out.write_all(&bytes)
        })?;
        plan.ledger.add(&inputs, &path, &bytes)?;
    }
    frames.finish();
    Ok(())
}

/// Renders the frames, and writes each to the one file when it is traced.
pub(super) fn movie(mut plan: MoviePlan) -> Result<(), Error> {
    let mut failed = None;
    let to = plan.to.clone();
    let written = to.write(&mut |out| {
        write_movie(&mut plan, out).map_err(|failure| match failure {
            Failure::Writing(error) => error,
            Failure::Rendering(error) => {
                failed = Some(error);
                io::Error::other("a frame cannot be rendered")
            }
        })
    });
    failed.map_or(written, Err)
}

/// Why a movie is not written.
enum Failure {
    Writing(io::Error),
    Rendering(Error),
}

fn write_movie(plan: &mut MoviePlan, out: &mut dyn Write) -> Result<(), Failure> {
    let (format, rate, mut numbers) = (plan.format, plan.rate, plan.sequence.numbers.iter());
    let count = plan.sequence.numbers.count;
    let mut frames = Frames::new(plan.sequence.execution(), count, Signals::default());
    let mut next = |number| {
        let job = plan::movie_frame(plan, number)?;
        frames.trace(number, job)
    };
    let first = numbers.next().ok_or(Error::Stopped);
    let first: Arc<Frame> = first.and_then(&mut next).map_err(Failure::Rendering)?;
    let movie = MovieWriter::new(format, first.size, rate, out);
    let mut movie = movie.map_err(Failure::Writing)?;
    movie.add(&first).map_err(Failure::Writing)?;
    for number in numbers {
        let frame = next(number).map_err(Failure::Rendering)?;
        movie.add(&frame).map_err(Failure::Writing)?;
    }
    movie.finish().map_err(Failure::Writing)?;
    frames.finish();
    Ok(())
}

/// Traces one frame after the other, and tells how far all are.
struct Frames {
    tracer: Tracer,
    execution: Execution,
    /// The place of the next.
    place: Place,
}

impl Frames {
    fn new(execution: Execution, count: u32, signals: Signals) -> Self {
        Self {
            tracer: Tracer::new(execution).stopped_by(signals),
            execution,
            place: Place {
                frame: 0,
                before: 0,
                skipped: 0,
                all: count,
                begun: Instant::now(),
            },
        }
    }

    fn trace(&mut self, number: u32, job: Job) -> Result<Arc<Frame>, Error> {
        self.place.frame = number;
        let frame = self.tracer.trace(job, Some(self.place), || {});
        self.place.before += 1;
        frame
    }

    /// Leaves out a frame that is finished.
    fn skip(&mut self) {
        self.place.before += 1;
        self.place.skipped += 1;
    }

    /// Tells the end, and how many were left out.
    fn finish(&self) {
        let Place {
            skipped,
            all,
            begun,
            ..
        } = self.place;
        if 0 < skipped {
            let was = if skipped == 1 { "was" } else { "were" };
            let frames = counted(skipped as usize, "frame");
            let note = format!("{frames} {was} already finished");
            self.execution.messages().note(&note);
        }
        progress::finish_sequence(self.execution.progress, all, begun.elapsed());
    }
}
