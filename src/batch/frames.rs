//! Renders sequences of pictures: scenes of a folder, or turns of the view of one.

use std::f64::consts::TAU;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::fingerprint::{digest, fingerprint};
use super::ledger::Ledger;
use super::pattern::Pattern;
use super::progress::Place;
use super::render::{Output, check_output, written};
use super::tracing::{Tracer, Tracing};
use super::{Error, Warnings, load, print_error, print_message};
use crate::assets;
use crate::file::{self, ReadError};
use crate::image_file::{ImageFormat, MovieFormat, MovieWriter};
use crate::language::Language;
use crate::memory;
use crate::part::Shard;
use crate::render::{Frame, Frames, Job};
use crate::text::counted;

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
        /// Frames per second.
        rate: u32,
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
    try_render(work).inspect_err(print_error)
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
            let numbers = source.numbers.iter().copied();
            source.numbers = numbers
                .filter(|number| number % shard.count == shard.index)
                .collect();
            pictures(work, &source, (pattern, *shard), *format, *finished)
        }
        SequenceOutput::Movie { to, format, rate } => {
            check_output(to)?;
            movie(work, &source, to, (*format, *rate))
        }
    }
}

/// Renders frames to a file each.
fn pictures(
    work: &Sequence,
    source: &Source<'_>,
    (pattern, shard): (&Pattern, Shard),
    format: ImageFormat,
    finished: Finished,
) -> Result<(), Error> {
    let path = pattern.ledger(shard);
    let io = |source| Error::Create {
        path: path.clone(),
        source,
    };
    let mut ledger = Ledger::read(path.clone()).map_err(io)?;
    let mut tracer = Tracer::new(&work.tracing);
    let (numbers, mut skipped) = (source.numbers.clone(), 0);
    for (before, &number) in numbers.iter().enumerate() {
        let picture = pattern.path(number);
        let (job, inputs) = source.job(number, format.frames())?;
        let inputs = digest([inputs.as_bytes(), format.name().as_bytes()]);
        if finished == Finished::Skipped && ledger.has(number, &inputs, &picture) {
            skipped += 1;
            continue;
        }
        let output = Output::File(picture);
        check_output(&output)?;
        if let Some(reason) = format.refuses(job.settings.traced().size()) {
            return Err(Error::Refused(format!("frame {number}: {reason}")));
        }
        let place = Place {
            frame: number,
            before,
            all: numbers.len(),
        };
        let frame = tracer.trace(job, Some(place), || {})?;
        let mut bytes = Vec::new();
        let encoded = format.write(&frame, &mut bytes);
        let saved = encoded.and_then(|()| match &output {
            Output::File(path) => {
                file::deliver(path, |out| out.write_all(&bytes), || Ok(())).map(drop)
            }
            Output::Stdout | Output::StdoutTerminal => Ok(()),
        });
        written(&output, saved)?;
        ledger.add(number, &inputs, &bytes).map_err(io)?;
    }
    if 0 < skipped {
        let note = format!("{} finished before", counted(skipped, "frame"));
        print_message("note", &note);
    }
    Ok(())
}

/// Renders frames to one file.
fn movie(
    work: &Sequence,
    source: &Source<'_>,
    to: &Output,
    format: (MovieFormat, u32),
) -> Result<(), Error> {
    let mut failed = None;
    let mut write = |out: &mut dyn Write| {
        let out = BufWriter::new(out);
        let outcome = write_movie(work, source, out, format);
        outcome.map_err(|failure| match failure {
            Failure::Writing(error) => error,
            Failure::Rendering(error) => {
                failed = Some(error);
                io::Error::other("a frame cannot be rendered")
            }
        })
    };
    let saved = match to {
        Output::File(path) => file::deliver(path, &mut write, || Ok(())).map(drop),
        Output::Stdout | Output::StdoutTerminal => write(&mut io::stdout().lock()),
    };
    match failed {
        Some(error) => Err(error),
        None => written(to, saved),
    }
}

/// Why a movie is not written.
enum Failure {
    Writing(io::Error),
    Rendering(Error),
}

fn write_movie(
    work: &Sequence,
    source: &Source<'_>,
    out: impl Write,
    (format, rate): (MovieFormat, u32),
) -> Result<(), Failure> {
    let mut tracer = Tracer::new(&work.tracing);
    let numbers = source.numbers.clone();
    let mut next = |before: usize| {
        let number = numbers[before];
        let (job, _) = source.job(number, Frames::Last)?;
        let place = Place {
            frame: number,
            before,
            all: numbers.len(),
        };
        tracer.trace(job, Some(place), || {})
    };
    let first: Arc<Frame> = next(0).map_err(Failure::Rendering)?;
    let movie = MovieWriter::new(format, first.size, rate, out);
    let mut movie = movie.map_err(Failure::Writing)?;
    movie.add(&first).map_err(Failure::Writing)?;
    for before in 1..numbers.len() {
        let frame = next(before).map_err(Failure::Rendering)?;
        movie.add(&frame).map_err(Failure::Writing)?;
    }
    movie.finish().map_err(Failure::Writing)
}

/// The frames of a sequence.
struct Source<'w> {
    work: &'w Sequence,
    /// The numbers of those to render; not empty at first.
    numbers: Vec<u32>,
    shows: Shows,
}

enum Shows {
    /// The scene of each frame.
    Scenes(Vec<PathBuf>),
    /// Turns of a job, whose inputs have this digest.
    Turns {
        job: Box<Job>,
        inputs: String,
        count: u32,
    },
}

impl<'w> Source<'w> {
    fn new(work: &'w Sequence) -> Result<Self, Error> {
        let shows = match &work.shows {
            FrameSource::Folder(folder) => Shows::Scenes(scenes_in(folder)?),
            FrameSource::Turntable { scene, count } => {
                let (job, inputs) = job_of(work, scene)?;
                let (job, count) = (Box::new(job), *count);
                Shows::Turns { job, inputs, count }
            }
        };
        let count = match &shows {
            Shows::Scenes(scenes) => scenes.len() as u32,
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
            numbers: (first..=last).collect(),
            shows,
        })
    }

    /// The job of a frame, and the digest of all that its picture depends on but the format.
    fn job(&self, number: u32, frames: Frames) -> Result<(Job, String), Error> {
        match &self.shows {
            Shows::Scenes(scenes) => {
                let (job, inputs) = job_of(self.work, &scenes[number as usize])?;
                Ok((Job { frames, ..job }, inputs))
            }
            Shows::Turns { job, inputs, count } => {
                let turn = f64::from(number) / f64::from(*count);
                let job = Job {
                    camera: job.camera.about_target(TAU * turn),
                    frames,
                    ..(**job).clone()
                };
                let turn = turn.to_bits().to_le_bytes();
                Ok((job, digest([inputs.as_bytes(), &turn])))
            }
        }
    }
}

/// The job of a scene file, and the digest of all that its picture depends on but the format.
fn job_of(work: &Sequence, path: &Path) -> Result<(Job, String), Error> {
    let loaded = load(path, &work.assets, work.warnings)?;
    let errors = loaded.errors;
    let scene = loaded.scene.ok_or(Error::Invalid { errors })?;
    let scene_digest = fingerprint(loaded.source.text(), &loaded.files)?;
    work.tracing.traced_size(&scene)?;
    let frames = Frames::Last;
    let job = work.tracing.job(scene, loaded.images, frames);
    let written = job.settings.written();
    let mut parts = vec![env!("CARGO_PKG_VERSION").to_owned(), scene_digest];
    parts.extend(written.map(|(_, value)| value));
    parts.push(match work.tracing.time {
        Some(time) => format!("{} s", time.as_secs_f64()),
        None => job.settings.spp.to_string(),
    });
    let inputs = digest(parts.iter().map(String::as_bytes));
    Ok((job, inputs))
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
