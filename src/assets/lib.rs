//! The pictures and meshes that scenes name, read into shared values. Only regular files may be
//! read, from the scene's folder, its parent, and folders that the user names. Independent of what
//! the files are used for.

mod edited;
mod failure;
mod fingerprint;
mod folder;
mod gate;
mod mesh_scene;
mod meshes;
mod pictures;
mod samples;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use language::{FileKind, Lowered, NamedFile, Source};
use memory::OutOfMemory;
use scene::{Image, Images, Meshes};

use failure::Failure;
use gate::{FileContent, Gate, Stream};
use meshes::KnownMesh;

pub use edited::Edited;
pub use failure::{PictureError, PictureErrors, report};
pub use fingerprint::{FileDigests, fingerprint};
pub use folder::{NoFolder, check_folders};
pub use language::xml::Up;
pub use mesh_scene::{MeshScene, is_mesh, is_own_mesh, is_picture};
pub use samples::{Carried, SAMPLES, Sample};

/// The limits for all files of a scene in total: 512 MiB of files, 384 MiB of decoded pictures, and
/// as many triangles as a single mesh may have.
const LIMITS: Room = Room {
    bytes: 512 << 20,
    pixels: 1 << 27,
    triangles: obj::MAX_TRIANGLES,
};

/// Reads files and keeps the last results: files whose bytes are known are not decoded again.
#[derive(Debug)]
pub struct Assets {
    /// The folders that may be read in addition to those around the scene.
    folders: Vec<PathBuf>,
    /// The canonical path of the user's home.
    home: Option<PathBuf>,
    /// The limits for one scene.
    limits: Room,
    known: Known,
}

/// The results of a load.
#[derive(Debug, Default)]
struct Known {
    /// Hashes of the bytes of picture files.
    files: HashMap<PathBuf, u64>,
    /// The pictures by the hashes of their files.
    images: HashMap<u64, Arc<Image>>,
    meshes: Vec<KnownMesh>,
    /// The names of the material libraries that meshes use, relative to the scene.
    libraries: BTreeSet<String>,
}

/// The amounts that may still be read for a scene.
#[derive(Clone, Copy, Debug)]
struct Room {
    bytes: u64,
    pixels: u64,
    triangles: usize,
}

/// The files that a scene names, relative to its folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// The path of the scene file.
    pub scene: PathBuf,
    /// The names of the pictures.
    pub pictures: BTreeSet<String>,
    /// The names of the meshes.
    pub meshes: BTreeSet<String>,
}

/// The outcome of a load.
#[derive(Clone, Debug, Default)]
pub struct Loaded {
    /// The pictures, by name.
    pub images: Images,
    /// The meshes, by name.
    pub meshes: Meshes,
    /// The errors by name, for pictures that are missing or not up to date.
    pub picture_errors: PictureErrors,
    /// The paths by name, for files that were not at the first path tried.
    pub elsewhere: BTreeMap<String, PathBuf>,
    /// The paths of the files that were read, by name.
    pub found: BTreeMap<String, PathBuf>,
    /// The paths to watch: see [`Assets::places`].
    pub files: Vec<PathBuf>,
}

impl Wanted {
    /// Sorts the files named by a scene's text.
    pub fn new(scene: &Path, files: &[NamedFile]) -> Self {
        let of = |kind: FileKind| {
            let names = files.iter().filter(|file| file.kind == kind);
            names.map(|file| file.path.clone()).collect()
        };
        Self {
            scene: scene.to_owned(),
            pictures: of(FileKind::Picture),
            meshes: of(FileKind::Mesh),
        }
    }

    /// Whether all of these files are among `others`, for the same scene.
    pub fn is_among(&self, others: &Self) -> bool {
        self.scene == others.scene
            && self.pictures.is_subset(&others.pictures)
            && self.meshes.is_subset(&others.meshes)
    }
}

impl Loaded {
    /// Whether every file could be read.
    pub fn is_whole(&self) -> bool {
        self.picture_errors.is_empty() && self.meshes.unreadable() == 0
    }
}

impl Assets {
    /// Permits `folders` in addition to those around the scene.
    pub fn new(folders: &[PathBuf]) -> Self {
        Self {
            folders: folders.to_vec(),
            home: gate::home(),
            limits: LIMITS,
            known: Known::default(),
        }
    }

    /// Lowers the text of a scene file with the files that it names, and returns what was read of
    /// them too. The diagnostics include those of the files.
    ///
    /// # Errors
    ///
    /// Fails if lowering would take more memory than is available.
    pub fn lower(
        &mut self,
        path: &Path,
        source: &mut Source,
    ) -> Result<(Lowered, Loaded), OutOfMemory> {
        let mut lowered = source.lower(&Meshes::default())?;
        let mut files = source.files();
        let mut wanted = Wanted::new(path, &files);
        let mut loaded = self.read(&wanted);
        if !wanted.meshes.is_empty() {
            lowered = source.lower(&loaded.meshes)?;
            // Meshes may reference pictures.
            files = source.files();
            let before = wanted;
            wanted = Wanted::new(path, &files);
            if wanted != before {
                loaded = self.read(&wanted);
            }
        }
        let errors = &loaded.picture_errors;
        lowered.diagnostics = report(errors, &files, &loaded.found, lowered.diagnostics);
        Ok((lowered, loaded))
    }

    /// Reads all files wanted and the material libraries that the meshes name. A picture that could
    /// be read last time but cannot now, for instance because it is being written, keeps its last
    /// content.
    pub fn read(&mut self, wanted: &Wanted) -> Loaded {
        let gate = self.gate(wanted);
        let mut load = Load {
            gate: &gate,
            elsewhere: BTreeMap::new(),
            found: BTreeMap::new(),
            before: std::mem::take(&mut self.known),
            now: Known::default(),
            room: self.limits,
        };
        let meshes = load.meshes(&wanted.meshes);
        let (images, picture_errors) = load.pictures(&wanted.pictures);
        let (elsewhere, found) = (load.elsewhere, load.found);
        self.known = load.now;
        Loaded {
            images,
            meshes,
            picture_errors,
            elsewhere,
            found,
            files: self.places(wanted),
        }
    }

    /// The folders that files of a scene may be read from, joined by "and".
    pub fn allowed(&self, scene: &Path) -> String {
        Gate::new(scene, &self.folders, self.home.as_deref()).allowed()
    }

    fn gate(&self, wanted: &Wanted) -> Gate {
        Gate::new(&wanted.scene, &self.folders, self.home.as_deref())
    }

    /// The paths to watch for a scene: all that may be read, existing or not. Includes the material
    /// libraries found by the last load.
    pub fn places(&self, wanted: &Wanted) -> Vec<PathBuf> {
        let gate = self.gate(wanted);
        let libraries = self.known.libraries.iter();
        let names = wanted.pictures.iter().chain(&wanted.meshes);
        let longer = wanted
            .meshes
            .iter()
            .filter_map(|name| meshes::with_extension(name));
        let places = names.chain(libraries).flat_map(|name| gate.watched(name));
        let places = places.chain(longer.flat_map(|name| gate.watched(&name)));
        places.collect::<BTreeSet<_>>().into_iter().collect()
    }
}

/// A reading in progress.
struct Load<'a> {
    gate: &'a Gate,
    /// The paths by name, for files that were not at the first path tried.
    elsewhere: BTreeMap<String, PathBuf>,
    /// The paths of the files that were read, by name.
    found: BTreeMap<String, PathBuf>,
    before: Known,
    now: Known,
    room: Room,
}

impl Load<'_> {
    /// Reads one file whole, and notes where it was found.
    fn content(&mut self, name: &str) -> Result<FileContent, Failure> {
        let mut content = self.gate.read(name, &mut self.room.bytes)?;
        self.note(name, content.elsewhere.take());
        Ok(content)
    }

    /// Opens one file for reading in parts.
    fn stream(&mut self, name: &str) -> Result<Stream, Failure> {
        let mut stream = self.gate.stream(name, &mut self.room.bytes)?;
        self.note(name, stream.elsewhere.take());
        Ok(stream)
    }

    /// Records the path of a file, which may not be the first path tried.
    fn note(&mut self, name: &str, elsewhere: Option<PathBuf>) {
        if let Some(place) = &elsewhere {
            self.elsewhere.insert(name.to_owned(), place.clone());
        }
        let place = elsewhere.unwrap_or_else(|| self.gate.place(name));
        self.found.insert(name.to_owned(), place);
    }
}

#[cfg(test)]
mod tests;
