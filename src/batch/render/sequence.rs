//! The frames of a sequence: scenes of a folder, or one scene that a track changes or that is seen from
//! all around.

use std::f64::consts::TAU;
use std::fs;
use std::path::{Path, PathBuf};

use super::animated::Animated;
use super::arguments::FrameSource;
use super::numbers::Numbers;
use super::shot::Shot;
use super::{Error, Execution, Output, Still};
use crate::{Reading, Tracing};
use file::ReadError;
use language::Language;
use render::{Frames, Job};
use text::counted;

/// The frames of a sequence.
pub(super) struct Sequence {
    /// The numbers of those to render; not empty at first.
    pub(super) numbers: Numbers,
    /// The scene files, and the track file.
    scenes: Vec<PathBuf>,
    shows: Shows,
    /// How each frame is traced.
    tracing: Tracing,
    /// How scenes are read.
    reading: Reading,
}

enum Shows {
    /// A scene each.
    Scenes,
    /// Edits of one scene's text.
    Edits(Box<Animated>),
    /// Turns of one scene.
    Turns { shot: Box<Shot>, count: u32 },
}

impl Sequence {
    /// Reads what the frames have in common. `asked` are the first and the last one to render.
    pub(super) fn of(
        source: FrameSource,
        asked: Option<[u32; 2]>,
        tracing: Tracing,
        reading: Reading,
    ) -> Result<Self, Error> {
        let (scenes, shows) = match source {
            FrameSource::Folder(folder) => (scenes_in(&folder)?, Shows::Scenes),
            FrameSource::Turntable { scene, count } => {
                let shot = Box::new(Shot::of(&scene, &reading, &tracing, Frames::Last)?);
                (vec![scene], Shows::Turns { shot, count })
            }
            FrameSource::Track { scene, track } => {
                let messages = tracing.execution.messages();
                let animated = Animated::new([&scene, &track], &reading, messages)?;
                (vec![scene, track], Shows::Edits(Box::new(animated)))
            }
        };
        let count = match &shows {
            Shows::Scenes => scenes.len() as u32,
            Shows::Edits(animated) => animated.count,
            Shows::Turns { count, .. } => *count,
        };
        let [first, last] = asked.unwrap_or_else(|| [0, count.saturating_sub(1)]);
        if count <= last {
            return Err(Error::Refused(format!(
                "--frames {first}-{last}: there are {} in all, numbered from 0",
                counted(count as usize, "frame")
            )));
        }
        Ok(Self {
            numbers: Numbers::within([first, last]),
            scenes,
            shows,
            tracing,
            reading,
        })
    }

    /// How the frames are traced.
    pub(super) fn execution(&self) -> Execution {
        self.tracing.execution
    }

    /// Frames per second, if that is said.
    pub(super) fn rate(&self) -> Option<u32> {
        match &self.shows {
            Shows::Edits(animated) => animated.rate,
            Shows::Scenes | Shows::Turns { .. } => None,
        }
    }

    /// A frame, ready to trace.
    pub(super) fn shot(&mut self, number: u32, frames: Frames) -> Result<Shot, Error> {
        let no_frame = |reason| Error::NoFrame {
            frame: number,
            reason,
        };
        self.try_shot(number, frames).map_err(|error| match error {
            Error::Invalid { errors } => {
                no_frame(format!("its scene has {}", counted(errors, "error")))
            }
            Error::Incomplete { needed_by } => {
                no_frame(format!("{needed_by} every file of its scene"))
            }
            error => error,
        })
    }

    fn try_shot(&mut self, number: u32, frames: Frames) -> Result<Shot, Error> {
        let Self {
            tracing, reading, ..
        } = self;
        match &mut self.shows {
            Shows::Scenes => Shot::of(&self.scenes[number as usize], reading, tracing, frames),
            Shows::Edits(animated) => animated.shot(number, tracing, frames),
            Shows::Turns { shot, count } => {
                let turn = f64::from(number) / f64::from(*count);
                let shot = (**shot).clone();
                let job = Job {
                    camera: shot.still.job.camera.about_target(TAU * turn),
                    frames,
                    ..shot.still.job
                };
                let layers = shot.still.layers;
                Ok(Shot {
                    still: Still { job, layers },
                    ..shot
                })
            }
        }
    }

    /// Refuses to overwrite a scene, or one of these files that scenes reference.
    pub(super) fn check_spared(&self, output: &Output, files: &[PathBuf]) -> Result<(), Error> {
        output.check_is_not(&self.scenes, "it is a file of the sequence")?;
        output.check_is_not(files, "a scene uses it")
    }
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
