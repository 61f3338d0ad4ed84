//! A scene whose text a track changes from frame to frame.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::{Error, Loaded, Warnings, load, print_all_findings, print_message};
use crate::assets::{self, Assets, fingerprint};
use crate::file;
use crate::language::{NamedFile, Source};
use crate::scene::{Images, Meshes, Scene};
use crate::text::Edit;
use crate::track::{self, Bound};

/// A scene with a track.
pub(super) struct Tracked {
    path: PathBuf,
    warnings: Warnings,
    source: Source,
    bound: Bound,
    assets: Assets,
    /// The files that the text names when no track has changed it.
    named: Vec<NamedFile>,
    /// What was read for them.
    found: BTreeMap<String, PathBuf>,
    files: Vec<PathBuf>,
    images: Images,
    meshes: Meshes,
    /// The number of frames.
    pub(super) frames: u32,
    /// Frames per second, if the track says so.
    pub(super) rate: Option<u32>,
}

/// A frame of it.
pub(super) struct TrackedFrame {
    pub(super) scene: Scene,
    pub(super) images: Images,
    /// The digest of the text that shows it, and of its files.
    pub(super) digest: String,
    pub(super) files: Vec<PathBuf>,
}

impl Tracked {
    /// Reads a scene and a track, and prints all findings.
    pub(super) fn open(
        path: &Path,
        track: &Path,
        folders: &[PathBuf],
        warnings: Warnings,
    ) -> Result<Self, Error> {
        let loaded = load(path, folders, warnings)?;
        let errors = loaded.errors;
        let scene = loaded.scene.as_ref().ok_or(Error::Invalid { errors })?;
        if !loaded.is_whole {
            return Err(Error::Incomplete);
        }
        let text = file::read_text(track)?;
        let (read, mut findings) = track::read(&text);
        let (bound, unbound) = track::bind(&read, &loaded.source, &scene.camera);
        findings.append(unbound);
        let findings = warnings.apply(findings);
        print_all_findings(track, &text, &findings);
        if 0 < findings.errors() {
            let errors = findings.errors();
            return Err(Error::InvalidTrack { errors });
        }
        let Loaded {
            source,
            found,
            files,
            images,
            meshes,
            ..
        } = loaded;
        Ok(Self {
            path: path.to_owned(),
            warnings,
            bound,
            assets: Assets::new(folders),
            named: source.files(),
            found,
            files,
            images,
            meshes,
            source,
            frames: read.frames,
            rate: read.rate,
        })
    }

    /// Lowers the text as it shows a frame, and then takes the edits back.
    pub(super) fn frame(&mut self, number: u32) -> Result<TrackedFrame, Error> {
        let edits: Vec<Edit> = self.bound.edits(&self.source, number);
        let inverse = self.source.change(&edits);
        let lowered = self.lowered(number);
        self.source.revert(&inverse);
        lowered
    }

    fn lowered(&mut self, number: u32) -> Result<TrackedFrame, Error> {
        let no_memory = |reason| file::ReadError::NoMemory {
            path: self.path.clone(),
            reason,
        };
        let mut lowered = self.source.lower(&self.meshes).map_err(no_memory)?;
        let mut read = assets::Loaded {
            images: self.images.clone(),
            found: self.found.clone(),
            files: self.files.clone(),
            ..assets::Loaded::default()
        };
        // Files are read again only where a track has changed which are named.
        if self.source.files() != self.named {
            let again = self.assets.lower(&self.path, &mut self.source);
            (lowered, read) = again.map_err(no_memory)?;
        }
        let findings = self.warnings.apply(lowered.diagnostics);
        let errors = findings.errors();
        let Some(scene) = lowered.scene.filter(|_| errors == 0) else {
            print_all_findings(&self.path, self.source.text(), &findings);
            print_message("note", &format!("the text is that of frame {number}"));
            return Err(Error::Invalid { errors });
        };
        if !read.is_whole() {
            return Err(Error::Incomplete);
        }
        Ok(TrackedFrame {
            scene,
            images: read.images,
            digest: fingerprint(self.source.text(), &read.found)?,
            files: read.files,
        })
    }
}
