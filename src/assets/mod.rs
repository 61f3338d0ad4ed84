//! The files that scenes name, pictures and meshes, read into shared values. What may be read is a
//! scene's own: regular files in its folder and the one above, and in folders that the user names.
//! Knows nothing of what they are for.

mod folder;
mod gate;
mod meshes;
mod pictures;
mod trouble;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::language::{FileKind, NamedFile};
use crate::obj;
use crate::scene::{Image, Images, Meshes};

use gate::{Content, Gate, Stream};
use meshes::KnownMesh;
use trouble::Failure;

pub use folder::{NoFolder, check_folders};
pub use trouble::{Trouble, Troubles, report};

/// What all files of a scene may have together: 512 MiB in files, 384 MiB of pictures in memory, and
/// as many triangles as a mesh may have alone.
const LIMITS: Room = Room {
    bytes: 512 << 20,
    pixels: 1 << 27,
    triangles: obj::MOST_TRIANGLES,
};

/// Reads files, and keeps those of the last reading: bytes that are known are not read anew.
#[derive(Debug)]
pub struct Assets {
    /// Folders that may be read besides the scene's surroundings.
    folders: Vec<PathBuf>,
    /// The user's home, without links.
    home: Option<PathBuf>,
    /// How much is read for one scene.
    limits: Room,
    known: Known,
}

/// What a reading found.
#[derive(Debug, Default)]
struct Known {
    /// What stands for the bytes of each picture file.
    files: HashMap<PathBuf, u64>,
    /// The pictures by what stands for their bytes.
    images: HashMap<u64, Arc<Image>>,
    meshes: Vec<KnownMesh>,
    /// The libraries of materials that meshes asked for, as if the scene's text named them.
    libraries: BTreeSet<String>,
}

/// How much may be read for one scene.
#[derive(Clone, Copy, Debug)]
struct Room {
    bytes: u64,
    pixels: u64,
    triangles: usize,
}

/// Which files a scene names: where it stands, and the names, relative to its folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// The scene file.
    pub scene: PathBuf,
    /// The names of pictures, each once.
    pub pictures: BTreeSet<String>,
    /// The names of meshes, each once.
    pub meshes: BTreeSet<String>,
}

/// What became of a reading.
#[derive(Clone, Debug, Default)]
pub struct Loaded {
    /// The pictures, by name.
    pub images: Images,
    /// The meshes, by name.
    pub meshes: Meshes,
    /// Why there is no picture, or none of now, by name.
    pub troubles: Troubles,
    /// Where files were found that were looked for elsewhere first, by name.
    pub elsewhere: BTreeMap<String, PathBuf>,
    /// The files that matter to the scene: see [`Assets::places`].
    pub files: Vec<PathBuf>,
}

impl Wanted {
    /// What the files named by a scene's text are.
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

    /// Whether other files hold all that is wanted.
    pub fn is_among(&self, others: &Self) -> bool {
        self.scene == others.scene
            && self.pictures.is_subset(&others.pictures)
            && self.meshes.is_subset(&others.meshes)
    }
}

impl Assets {
    /// Reads from `folders` too.
    pub fn new(folders: &[PathBuf]) -> Self {
        Self {
            folders: folders.to_vec(),
            home: gate::home(),
            limits: LIMITS,
            known: Known::default(),
        }
    }

    /// Reads all files wanted, and the libraries of materials that the meshes name. A picture
    /// that can't be read now but could in the last reading, such as one whose file is being
    /// written, stays as it was then.
    pub fn read(&mut self, wanted: &Wanted) -> Loaded {
        let gate = self.gate(wanted);
        let mut reading = Reading {
            gate: &gate,
            elsewhere: BTreeMap::new(),
            before: std::mem::take(&mut self.known),
            now: Known::default(),
            room: self.limits,
        };
        let meshes = reading.meshes(&wanted.meshes);
        let (images, troubles) = reading.pictures(&wanted.pictures);
        let elsewhere = reading.elsewhere;
        self.known = reading.now;
        Loaded {
            images,
            meshes,
            troubles,
            elsewhere,
            files: self.places(wanted),
        }
    }

    /// The folders that files of a scene may be read below, in words.
    pub fn allowed(&self, scene: &Path) -> String {
        Gate::new(scene, &self.folders, self.home.as_deref()).allowed()
    }

    fn gate(&self, wanted: &Wanted) -> Gate {
        Gate::new(&wanted.scene, &self.folders, self.home.as_deref())
    }

    /// The files whose changes matter to a scene: those that may be read, there or not. Which
    /// libraries of materials are among them is known from the last reading.
    pub fn places(&self, wanted: &Wanted) -> Vec<PathBuf> {
        let gate = self.gate(wanted);
        let libraries = self.known.libraries.iter();
        let names = wanted.pictures.iter().chain(&wanted.meshes);
        let places = names.chain(libraries).flat_map(|name| gate.watched(name));
        places.collect::<BTreeSet<_>>().into_iter().collect()
    }
}

/// A reading under way.
struct Reading<'a> {
    gate: &'a Gate,
    /// Where files were found that were looked for elsewhere first, by name.
    elsewhere: BTreeMap<String, PathBuf>,
    before: Known,
    now: Known,
    room: Room,
}

impl Reading<'_> {
    /// Reads one file.
    fn content(&mut self, name: &str) -> Result<Content, Failure> {
        let mut content = self.gate.read(name, &mut self.room.bytes)?;
        self.note(name, content.elsewhere.take());
        Ok(content)
    }

    /// Opens one file that is not read as a whole.
    fn stream(&mut self, name: &str) -> Result<Stream, Failure> {
        let mut stream = self.gate.stream(name, &mut self.room.bytes)?;
        self.note(name, stream.elsewhere.take());
        Ok(stream)
    }

    /// Notes that a file was found elsewhere.
    fn note(&mut self, name: &str, elsewhere: Option<PathBuf>) {
        if let Some(place) = elsewhere {
            self.elsewhere.insert(name.to_owned(), place);
        }
    }
}

#[cfg(all(test, unix))]
mod tests;
