//! What `render` is asked to do.

use std::path::PathBuf;

use super::{Output, Target};
use crate::{Reading, Tracing};
use image_file::{ImageFormat, MovieFormat, Pattern};
use shards::Shard;

/// What is to be rendered.
#[derive(Clone, Debug, PartialEq)]
pub struct Render {
    /// What is made of what.
    pub work: Work,
    /// How it is traced.
    pub tracing: Tracing,
    /// How scenes are read.
    pub reading: Reading,
}

/// A picture or several.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Work {
    /// A picture.
    Picture(PictureWork),
    /// A sequence of pictures.
    Sequence(SequenceWork),
}

/// A picture to render.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureWork {
    /// The scene file.
    pub scene: PathBuf,
    /// Where the picture goes.
    pub target: Target,
    /// Whether it is traced into a part file, and how.
    pub parts: Option<Parts>,
    /// What is to be done.
    pub purpose: Purpose,
    /// Where figures about the render go.
    pub stats: Option<Output>,
}

impl PictureWork {
    /// Where the picture and the figures go.
    pub(super) fn outputs(&self) -> impl Iterator<Item = &Output> {
        [&self.target.output].into_iter().chain(&self.stats)
    }
}

/// How a picture is traced into a part file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    /// The part of the picture to trace.
    pub shard: Shard,
    /// What becomes of a part file that is there already.
    pub existing: Existing,
}

/// What becomes of a part file that is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// It is continued.
    Continued,
    /// It is an error.
    Refused,
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

/// A sequence of pictures to render.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SequenceWork {
    /// What the frames show.
    pub shows: FrameSource,
    /// The numbers of the first and the last frame to render; all if `None`.
    pub frames: Option<[u32; 2]>,
    /// Where they go.
    pub output: SequenceOutput,
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
