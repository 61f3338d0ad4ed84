//! Renders a sequence to one file.

use std::io::{self, Write};
use std::sync::Arc;
use std::time::Instant;

use super::{MoviePlan, plan};
use crate::Error;
use crate::progress::{self, Place};
use crate::tracing::Tracer;
use image_file::MovieWriter;
use render::Frame;

/// Renders the frames, and writes each when it is traced.
pub(super) fn render(mut plan: MoviePlan) -> Result<(), Error> {
    let mut failed = None;
    let to = plan.to.clone();
    let written = to.write(|out| {
        write(&mut plan, out).map_err(|failure| match failure {
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

fn write(plan: &mut MoviePlan, out: &mut dyn Write) -> Result<(), Failure> {
    let means = plan.sequence.means();
    let mut tracer = Tracer::new(means);
    let begun = Instant::now();
    let (format, rate, numbers) = (plan.format, plan.rate, plan.sequence.numbers);
    let mut next = |(number, before)| {
        let job = plan::movie_frame(plan, number)?;
        let place = Place {
            frame: number,
            before,
            skipped: 0,
            all: numbers.count,
            begun,
        };
        tracer.trace(job, Some(place), || {})
    };
    let mut places = numbers.iter().zip(0..);
    let first = places.next().ok_or(Error::Stopped);
    let first: Arc<Frame> = first.and_then(&mut next).map_err(Failure::Rendering)?;
    let movie = MovieWriter::new(format, first.size, rate, out);
    let mut movie = movie.map_err(Failure::Writing)?;
    movie.add(&first).map_err(Failure::Writing)?;
    for place in places {
        let frame = next(place).map_err(Failure::Rendering)?;
        movie.add(&frame).map_err(Failure::Writing)?;
    }
    movie.finish().map_err(Failure::Writing)?;
    progress::finish_sequence(means.progress, numbers.count, begun.elapsed());
    Ok(())
}
