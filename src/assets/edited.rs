//! A scene's text under edits that come and go, such as those of the frames of a track.

use std::path::{Path, PathBuf};

use super::{Assets, FileDigests, Loaded, Wanted, report};
use file::ReadError;
use language::{Before, Lowered, Source};
use memory::OutOfMemory;
use scene::Scene;
use text::{Edit, Findings};

/// A text that is lowered with one set of edits after the other. The files that it names are read once,
/// and again only if edits name others.
pub struct Edited {
    path: PathBuf,
    /// The folders that files may be read from besides those around the scene.
    folders: Vec<PathBuf>,
    source: Source,
    /// What takes the present edits back.
    inverse: Vec<Edit>,
    /// The scene of the text without edits, and its findings.
    scene: Scene,
    findings: Findings,
    wanted: Wanted,
    read: Loaded,
    digests: FileDigests,
    /// What read the files again; `None` while the first are those that count.
    assets: Option<Assets>,
}

impl Edited {
    /// A text without errors that was lowered, with its scene, its findings, and its files.
    ///
    /// # Errors
    ///
    /// Fails if a file can no longer be read.
    pub fn new(
        (path, folders): (&Path, &[PathBuf]),
        source: Source,
        (scene, findings): (Scene, Findings),
        read: Loaded,
    ) -> Result<Self, ReadError> {
        Ok(Self {
            path: path.to_owned(),
            folders: folders.to_vec(),
            inverse: Vec::new(),
            wanted: Wanted::new(path, &source.files()),
            digests: FileDigests::of(&read.found)?,
            source,
            scene,
            findings,
            read,
            assets: None,
        })
    }

    /// The text without edits.
    pub fn plain(&mut self) -> &Source {
        let inverse = std::mem::take(&mut self.inverse);
        self.source.revert(&inverse);
        &self.source
    }

    /// Lowers the text with these edits alone. The diagnostics include those of the files.
    ///
    /// # Errors
    ///
    /// Fails if there is not enough memory, or a file can no longer be read.
    pub fn lower(&mut self, edits: &[Edit]) -> Result<Lowered, ReadError> {
        self.plain();
        self.inverse = self.source.change(edits);
        let no_memory = |path: &Path, reason: OutOfMemory| ReadError::NoMemory {
            path: path.to_owned(),
            reason,
        };
        let before = Before {
            scene: &self.scene,
            diagnostics: &self.findings,
        };
        let lowered = self.source.lower_again(&self.read.meshes, before);
        let mut lowered = lowered.map_err(|reason| no_memory(&self.path, reason))?;
        let files = self.source.files();
        if Wanted::new(&self.path, &files).is_among(&self.wanted) {
            let (errors, found) = (&self.read.picture_errors, &self.read.found);
            lowered.diagnostics = report(errors, &files, found, lowered.diagnostics);
            return Ok(lowered);
        }
        let folders = &self.folders;
        let assets = self.assets.get_or_insert_with(|| Assets::new(folders));
        let read = assets.lower(&self.path, &mut self.source);
        let (lowered, read) = read.map_err(|reason| no_memory(&self.path, reason))?;
        self.wanted = Wanted::new(&self.path, &self.source.files());
        self.digests = FileDigests::of(&read.found)?;
        self.read = read;
        Ok(lowered)
    }

    /// The text with the edits lowered last.
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// Its files.
    pub fn read(&self) -> &Loaded {
        &self.read
    }

    /// The digest of the text and its files, as [`fingerprint()`](super::fingerprint()).
    pub fn fingerprint(&self) -> String {
        self.digests.fingerprint(self.source.text())
    }
}
