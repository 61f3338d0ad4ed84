//! A picture of a sequence, before it is traced.

use std::path::{Path, PathBuf};

use super::{Error, Still};
use crate::{Reading, Tracing};
use assets::fingerprint;
use render::Frames;

/// A picture of a sequence, ready to trace.
#[derive(Clone)]
pub(super) struct Shot {
    pub(super) still: Still,
    /// The digest of its scene.
    pub(super) digest: String,
    /// The files that its scene references.
    pub(super) files: Vec<PathBuf>,
}

impl Shot {
    /// Reads a scene file.
    pub(super) fn of(
        path: &Path,
        reading: &Reading,
        tracing: &Tracing,
        frames: Frames,
    ) -> Result<Self, Error> {
        let messages = tracing.execution.messages();
        let mut loaded = reading.load(messages, path, Some(&tracing.over()))?;
        let scene = loaded.take_scene()?;
        if !loaded.read.is_whole() {
            return Err(Error::Incomplete {
                needed_by: "a sequence needs",
            });
        }
        Ok(Self {
            still: tracing.still(scene, loaded.read.images, frames)?,
            digest: fingerprint(loaded.source.text(), &loaded.read.found)?,
            files: loaded.read.files,
        })
    }
}
