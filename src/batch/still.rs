//! A picture of a sequence, before it is traced.

use std::path::{Path, PathBuf};

use super::{Error, Messages, Tracing, Warnings, load};
use assets::fingerprint;
use render::{Frames, Job};

/// A picture of a sequence, ready to trace.
#[derive(Clone)]
pub(super) struct Still {
    pub(super) job: Job,
    /// The digest of its scene.
    pub(super) scene: String,
    /// The files that its scene references.
    pub(super) files: Vec<PathBuf>,
}

impl Still {
    /// Reads a scene file.
    pub(super) fn of(
        path: &Path,
        (folders, warnings): (&[PathBuf], Warnings),
        tracing: &Tracing,
        frames: Frames,
    ) -> Result<Self, Error> {
        let messages = Messages::beside(tracing.progress);
        let loaded = load(messages, path, folders, warnings, Some(&tracing.over()))?;
        let errors = loaded.findings.errors();
        let scene = loaded.scene.ok_or(Error::Invalid { errors })?;
        if !loaded.read.is_whole() {
            return Err(Error::Incomplete {
                needed_by: "a sequence needs",
            });
        }
        let job = tracing.job(scene, loaded.read.images, frames)?;
        Ok(Self {
            job,
            scene: fingerprint(loaded.source.text(), &loaded.read.found)?,
            files: loaded.read.files,
        })
    }
}
