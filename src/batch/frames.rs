//! Renders sequences of pictures: scenes of a folder, or one scene that a track changes or that is
//! seen from all around.

use std::f64::consts::TAU;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use super::animated::{Animated, Origin};
use super::ledger::Ledger;
use super::lists::{list, lists};
use super::numbers::Numbers;
use super::output::Output;
use super::progress::{self, Place};
use super::signals::Signals;
use super::still::Still;
use super::tracing::{Tracer, Tracing};
use super::{Error, Messages, Warnings};
use file::{Digest, ReadError};
use image_file::{DEFAULT_RATE, ImageFormat, MovieFormat, MovieWriter, Pattern, Picture};
use language::Language;
use part::Shard;
use render::{Frame, Frames, Job, Provenance, check_memory, memory_for};
use text::counted;

/// A sequence of pictures to render.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// What the frames show.
    pub shows: FrameSource,
    /// The numbers of the first and the last frame to render; all if `None`.
    pub frames: Option<[u32; 2]>,
    /// Where they go.
    pub output: SequenceOutput,
    /// How the warnings of scenes are treated.
    pub warnings: Warnings,
    /// How each frame is traced.
    pub tracing: Tracing,
    /// Additional folders that pictures and meshes may be read from.
    pub assets: Vec<PathBuf>,
}

/// What the frames of a sequence show. They are numbered from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FrameSource {
    /// The scenes of a folder, in the order of their names.
    Folder(PathBuf),
    /// A scene, seen from around the point that its view looks at.
    Turntable {
        /// The scene file.
        scene: PathBuf,
        /// How many frames a whole turn has.
        count: u32,
    },
    /// A scene whose values a track changes.
    Track {
        /// The scene file.
        scene: PathBuf,
        /// The track file.
        track: PathBuf,
    },
}

/// Where the frames of a sequence go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SequenceOutput {
    /// A picture file each. Those that are finished already are skipped.
    Pictures {
        /// The names of the files.
        pattern: Pattern,
        /// The format of the pictures.
        format: ImageFormat,
        /// Only frames whose number leaves this remainder belong to this process.
        shard: Shard,
        /// What becomes of those that are finished already.
        finished: Finished,
    },
    /// One file.
    Movie {
        /// Where it goes.
        to: Output,
        /// Its format.
        format: MovieFormat,
        /// Frames per second; by default those of the track, or 24.
        rate: Option<u32>,
    },
}

/// What becomes of frames that are finished already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finished {
    /// They are skipped.
    Skipped,
    /// They are rendered again.
    Rendered,
}

/// Renders the frames of a sequence. Warnings, notes and progress go to standard error.
pub fn render_sequence(work: &Sequence) -> Result<(), Error> {
    try_render(work).inspect_err(|error| work.messages().error(error))
}

fn try_render(work: &Sequence) -> Result<(), Error> {
    assets::check_folders(&work.assets)?;
    memory::start_threads_or_none();
    let mut source = Source::new(work)?;
    match &work.output {
        SequenceOutput::Pictures {
            pattern,
            format,
            shard,
            finished,
        } => {
            source.numbers = source.numbers.of_shard(*shard);
            pictures(work, &mut source, (pattern, *shard), *format, *finished)
        }
        SequenceOutput::Movie { to, format, rate } => {
            let rate = rate.or(source.rate()).unwrap_or(DEFAULT_RATE);
            if let Some(reason) = format.refuses(rate) {
                return Err(Error::Refused(reason));
            }
            source.check_spared(to, &[])?;
            to.check()?;
            movie(work, &mut source, to, (*format, rate))
        }
    }
}

/// Renders frames to a file each.
fn pictures(
    work: &Sequence,
    source: &mut Source<'_>,
    (pattern, shard): (&Pattern, Shard),
    format: ImageFormat,
    finished: Finished,
) -> Result<(), Error> {
    let list = list(pattern, shard);
    let output = Output::File(list.clone());
    source.check_spared(&output, &[])?;
    output.check()?;
    let mut ledger = Ledger::read(list.clone(), &lists(pattern))?;
    // Without them, a signal ends the process, and finished frames are kept all the same.
    let signals = Signals::noted().unwrap_or_default();
    let mut tracer = Tracer::new(&work.tracing).stopped_by(signals.clone());
    let (numbers, mut skipped) = (source.numbers, 0);
    let begun = Instant::now();
    for (number, before) in numbers.iter().zip(0..) {
        let stopped = |error| match (error, signals.last()) {
            (Error::Stopped, Some(signal)) => Error::KeptFrames {
                signal,
                frame: number,
                is_again: finished == Finished::Rendered,
            },
            (error, _) => error,
        };
        if signals.arrived() {
            return Err(stopped(Error::Stopped));
        }
        let picture = pattern.path(number);
        let Still { job, scene, files } = source.still(number, format.frames())?;
        let provenance = work.tracing.provenance(&job, scene);
        let inputs = inputs(&work.tracing, &provenance, format);
        if finished == Finished::Skipped && ledger.has(&inputs, &picture) {
            skipped += 1;
            continue;
        }
        let output = Output::File(picture.clone());
        source.check_spared(&output, &files)?;
        output.check_is_apart(&list, "it is the list of finished frames")?;
        output.check()?;
        if let Some(reason) = format.refuses(job.settings.traced().size()) {
            return Err(Error::Refused(format!("frame {number}: {reason}")));
        }
        let layers = work.tracing.memory_for_layers(&job);
        check_memory(&job, memory_for(&job, None).saturating_add(layers))?;
        let place = Place {
            frame: number,
            before,
            skipped,
            all: numbers.count,
            begun,
        };
        let frame = tracer.trace(job.clone(), Some(place), || {});
        let frame = frame.map_err(stopped)?;
        let layers = tracer.layers(&job, frame.progress.spp, &work.tracing.layers);
        let layers = layers.map_err(stopped)?;
        let written = Picture {
            frame: &frame,
            layers: &layers,
            provenance: Some(&provenance.in_frame(&frame)),
        };
        let mut bytes = Vec::new();
        output.write(|out| {
            format.write(written, &mut bytes)?;
            out.write_all(&bytes)
        })?;
        ledger.add(&inputs, &picture, &bytes)?;
    }
    if 0 < skipped {
        let was = if skipped == 1 { "was" } else { "were" };
        let note = format!(
            "{} {was} already finished",
            counted(skipped as usize, "frame")
        );
        work.messages().note(&note);
    }
    progress::finish_sequence(work.tracing.progress, numbers.count, begun.elapsed());
    Ok(())
}

/// Renders frames to one file.
fn movie(
    work: &Sequence,
    source: &mut Source<'_>,
    to: &Output,
    format: (MovieFormat, u32),
) -> Result<(), Error> {
    let mut failed = None;
    let written = to.write(|out| {
        let outcome = write_movie(work, source, (to, out), format);
        outcome.map_err(|failure| match failure {
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

fn write_movie(
    work: &Sequence,
    source: &mut Source<'_>,
    (to, out): (&Output, &mut dyn Write),
    (format, rate): (MovieFormat, u32),
) -> Result<(), Failure> {
    let mut tracer = Tracer::new(&work.tracing);
    let begun = Instant::now();
    let numbers = source.numbers;
    let mut next = |(number, before)| {
        let Still { job, files, .. } = source.still(number, Frames::Last)?;
        source.check_spared(to, &files)?;
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
    progress::finish_sequence(work.tracing.progress, numbers.count, begun.elapsed());
    Ok(())
}

/// The frames of a sequence.
struct Source<'w> {
    work: &'w Sequence,
    /// The numbers of those to render; not empty at first.
    numbers: Numbers,
    /// The scene files, and the track file.
    scenes: Vec<PathBuf>,
    shows: Shows<'w>,
}

enum Shows<'w> {
    /// A scene each.
    Scenes,
    /// Edits of one scene's text.
    Edits(Box<Animated<'w>>),
    /// Turns of one scene.
    Turns { still: Box<Still>, count: u32 },
}

impl<'w> Source<'w> {
    fn new(work: &'w Sequence) -> Result<Self, Error> {
        let (scenes, shows) = match &work.shows {
            FrameSource::Folder(folder) => (scenes_in(folder)?, Shows::Scenes),
            FrameSource::Turntable { scene, count } => {
                let still = Box::new(work.still(scene, Frames::Last)?);
                let count = *count;
                (vec![scene.clone()], Shows::Turns { still, count })
            }
            FrameSource::Track { scene, track } => {
                let origin = Origin {
                    scene,
                    track,
                    folders: &work.assets,
                    warnings: work.warnings,
                    messages: work.messages(),
                };
                let shows = Shows::Edits(Box::new(Animated::new(origin)?));
                (vec![scene.clone(), track.clone()], shows)
            }
        };
        let count = match &shows {
            Shows::Scenes => scenes.len() as u32,
            Shows::Edits(animated) => animated.count,
            Shows::Turns { count, .. } => *count,
        };
        let [first, last] = work.frames.unwrap_or_else(|| [0, count.saturating_sub(1)]);
        if count <= last {
            return Err(Error::Refused(format!(
                "--frames {first}-{last}: there are {} in all, numbered from 0",
                counted(count as usize, "frame")
            )));
        }
        Ok(Self {
            work,
            numbers: Numbers::within([first, last]),
            scenes,
            shows,
        })
    }

    /// Frames per second, if that is said.
    fn rate(&self) -> Option<u32> {
        match &self.shows {
            Shows::Edits(animated) => animated.rate,
            Shows::Scenes | Shows::Turns { .. } => None,
        }
    }

    /// A frame, ready to trace.
    fn still(&mut self, number: u32, frames: Frames) -> Result<Still, Error> {
        let no_frame = |reason| Error::NoFrame {
            frame: number,
            reason,
        };
        self.try_still(number, frames).map_err(|error| match error {
            Error::Invalid { errors } => {
                no_frame(format!("its scene has {}", counted(errors, "error")))
            }
            Error::Incomplete { needed_by } => {
                no_frame(format!("{needed_by} every file of its scene"))
            }
            error => error,
        })
    }

    fn try_still(&mut self, number: u32, frames: Frames) -> Result<Still, Error> {
        match &mut self.shows {
            Shows::Scenes => self.work.still(&self.scenes[number as usize], frames),
            Shows::Edits(animated) => animated.still(number, &self.work.tracing, frames),
            Shows::Turns { still, count } => {
                let turn = f64::from(number) / f64::from(*count);
                let Still { job, scene, files } = (**still).clone();
                let job = Job {
                    camera: job.camera.about_target(TAU * turn),
                    frames,
                    ..job
                };
                Ok(Still { job, scene, files })
            }
        }
    }

    /// Refuses to overwrite a scene, or one of these files that scenes reference.
    fn check_spared(&self, output: &Output, files: &[PathBuf]) -> Result<(), Error> {
        output.check_is_not(&self.scenes, "it is a file of the sequence")?;
        output.check_is_not(files, "a scene uses it")
    }
}

impl Sequence {
    fn messages(&self) -> Messages {
        Messages::beside(self.tracing.progress)
    }

    /// Reads a scene file.
    fn still(&self, path: &Path, frames: Frames) -> Result<Still, Error> {
        Still::of(path, (&self.assets, self.warnings), &self.tracing, frames)
    }
}

/// The digest of all that a picture file depends on.
fn inputs(tracing: &Tracing, picture: &Provenance, format: ImageFormat) -> String {
    let entries = picture.written().into_iter().map(|(_, value)| value);
    let samples = match tracing.time {
        Some(time) => format!("{} s", time.as_secs_f64()),
        None => picture.settings.spp.to_string(),
    };
    let parts: Vec<_> = entries.chain([samples, format.name().to_owned()]).collect();
    Digest::of(parts.iter().map(String::as_bytes))
}

/// The scene files of a folder, in the order of their names.
fn scenes_in(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let io = |source| ReadError::Io {
        path: folder.to_owned(),
        source,
    };
    let mut scenes = Vec::new();
    for entry in fs::read_dir(folder).map_err(io)? {
        let path = entry.map_err(io)?.path();
        if Language::of_path(&path).is_ok() && path.is_file() {
            scenes.push(path);
        }
    }
    scenes.sort();
    if scenes.is_empty() {
        let reason = format!("{}: there are no scenes in this folder", folder.display());
        return Err(Error::Refused(reason));
    }
    Ok(scenes)
}
