//! Access control: which files may be read, where they are searched for, and their bytes.
//!
//! A file is opened only if it lies in the scene's folder, its parent, or a folder that the user
//! named. The parent is excluded where it is likely to contain more than scenes: if it is the root,
//! the user's home, or writable by everyone.

use std::env;
use std::fs::{self, File};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::path::{Component, Path, PathBuf};

use rayon::prelude::*;

use super::failure::Failure;
use super::folder::Folder;
use file::directory_of;

/// The folders that a scene's files may be read from.
#[derive(Debug)]
pub(super) struct Gate {
    /// The scene's folder as given; names are relative to it.
    folder: PathBuf,
    /// The scene's folder, and its parent if permitted.
    near: Vec<Folder>,
    /// The folders that the user named, with their paths as given.
    named: Vec<(PathBuf, Folder)>,
    /// Whether the current folder lies in one of these.
    is_current_within: bool,
}

/// The content of a file.
#[derive(Clone, Debug)]
pub(super) struct FileContent {
    pub(super) bytes: Vec<u8>,
    /// A hash of the bytes.
    pub(super) digest: u64,
    /// The path of the file if it is not the first one tried.
    pub(super) elsewhere: Option<PathBuf>,
}

/// A file opened at its beginning.
#[derive(Debug)]
pub(super) struct Stream {
    pub(super) file: File,
    /// A hash of the bytes.
    pub(super) digest: u64,
    /// The path of the file if it is not the first one tried.
    pub(super) elsewhere: Option<PathBuf>,
}

impl Gate {
    /// Opens the folders permitted for a scene. Those that do not exist are left out.
    pub(super) fn new(scene: &Path, folders: &[PathBuf], home: Option<&Path>) -> Self {
        let folder = directory_of(scene).to_owned();
        let near: Vec<_> = Folder::open(&folder).into_iter().collect();
        let above = near.first().and_then(|own| own.real().parent());
        let above = above.and_then(|above| Folder::open(above).ok());
        let above = above.filter(|above| holds_scenes(above.real(), home) && !above.is_public());
        let named = folders
            .iter()
            .filter_map(|folder| Some((folder.clone(), Folder::open(folder).ok()?)));
        let mut gate = Self {
            folder,
            near: near.into_iter().chain(above).collect(),
            named: named.collect(),
            is_current_within: false,
        };
        let current = env::current_dir().and_then(fs::canonicalize);
        gate.is_current_within = current.is_ok_and(|current| gate.folder_of(&current).is_some());
        gate
    }

    /// The first path to try for a name.
    pub(super) fn place(&self, name: &str) -> PathBuf {
        self.folder.join(portable(name))
    }

    /// Reads a file and subtracts its length from `room`.
    pub(super) fn read(&self, name: &str, room: &mut u64) -> Result<FileContent, Failure> {
        let (file, real, elsewhere) = self.open(name)?;
        let bytes = file::read_opened(&file, &real, *room)?;
        *room -= bytes.len() as u64;
        Ok(FileContent {
            digest: digest(&bytes),
            bytes,
            elsewhere,
        })
    }

    /// Opens a file for reading in parts, hashes it, and subtracts its length from `room`.
    pub(super) fn stream(&self, name: &str, room: &mut u64) -> Result<Stream, Failure> {
        let (file, _, elsewhere) = self.open(name)?;
        let length = file.metadata()?.len();
        *room = room.checked_sub(length).ok_or(Failure::TooLong)?;
        Ok(Stream {
            digest: digest_of_file(&file, length)?,
            file,
            elsewhere,
        })
    }

    /// Opens a regular file. Returns also its canonical path, and the path that led to it if it is
    /// not the first one tried.
    fn open(&self, name: &str) -> Result<(File, PathBuf, Option<PathBuf>), Failure> {
        let (real, elsewhere) = self.find(name)?;
        let folder = self.folder_of(&real).ok_or(Failure::Missing(Vec::new()))?;
        let file = file::regular(folder.file(&real)?, &real)?;
        Ok((file, real, elsewhere))
    }

    /// Finds a file. Returns its canonical path, and the path that led to it if not the first.
    fn find(&self, name: &str) -> Result<(PathBuf, Option<PathBuf>), Failure> {
        let first = self.place(name);
        let refusal = match self.resolve(&first) {
            Ok(real) | Err(Failure::Outside { real, .. }) if is_absolute(name) => {
                Failure::Absolute(real)
            }
            Err(_) if is_absolute(name) => Failure::Absolute(first.clone()),
            Ok(real) => return Ok((real, None)),
            Err(refusal @ (Failure::Missing(_) | Failure::Outside { .. })) => refusal,
            Err(other) => return Err(other),
        };
        let is_missing = matches!(refusal, Failure::Missing(_));
        let places = self.elsewhere(name, is_missing);
        for place in &places {
            if let Ok(real) = self.resolve(place) {
                return Ok((real, Some(place.clone())));
            }
        }
        Err(match refusal {
            Failure::Missing(_) => Failure::Missing([first].into_iter().chain(places).collect()),
            refusal => refusal,
        })
    }

    /// The further paths to try if the first one fails. Uses the whole name only if the first path
    /// did not exist, otherwise only its last component.
    fn elsewhere(&self, name: &str, is_missing: bool) -> Vec<PathBuf> {
        let name = portable(name);
        let mut places = Vec::new();
        let folders = || self.named.iter().map(|(folder, _)| folder);
        if is_missing {
            places.extend(self.is_current_within.then(|| PathBuf::from(&name)));
            places.extend(folders().map(|folder| folder.join(&name)));
        }
        if let Some(last) = Path::new(&name).file_name() {
            places.extend(folders().map(|folder| folder.join(last)));
        }
        let absolute = |place: &Path| std::path::absolute(place).ok();
        let first = is_missing.then(|| absolute(&self.folder.join(&name)));
        let mut known: Vec<_> = first.into_iter().collect();
        places.retain(|place: &PathBuf| {
            let place = absolute(place);
            let is_new = !known.contains(&place);
            known.push(place);
            is_new
        });
        places
    }

    /// Canonicalizes a path. Fails if it does not exist or lies outside the permitted folders.
    fn resolve(&self, place: &Path) -> Result<PathBuf, Failure> {
        let real = fs::canonicalize(place).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => Failure::Missing(Vec::new()),
            _ => Failure::Io(error),
        })?;
        if self.folder_of(&real).is_some() {
            return Ok(real);
        }
        Err(Failure::Outside {
            real,
            allowed: self.allowed(),
        })
    }

    /// The paths to watch for a name: those tried, up to the first that may be read.
    pub(super) fn watched(&self, name: &str) -> Vec<PathBuf> {
        let first = self.place(name);
        let found = self.resolve(&first);
        let mut places = Vec::new();
        let mut is_missing = false;
        match found {
            _ if is_absolute(name) => {}
            Ok(_) => return vec![first],
            Err(Failure::Missing(_)) => {
                is_missing = true;
                // Not conditional on the scene's folder, which may be missing temporarily.
                let name = portable(name);
                let climbs = Path::new(&name)
                    .components()
                    .any(|step| step == Component::ParentDir);
                if !climbs || self.may_appear(&first) {
                    places.push(first);
                }
            }
            Err(_) => {
                // A link that leads outside may be replaced by a file.
                let own = fs::canonicalize(directory_of(&first));
                if own.is_ok_and(|own| self.folder_of(&own).is_some()) {
                    places.push(first);
                }
            }
        }
        for place in self.elsewhere(name, is_missing) {
            let exists = self.resolve(&place).is_ok();
            if exists || self.may_appear(&place) {
                places.push(place);
            }
            if exists {
                break;
            }
        }
        places
    }

    /// Whether a missing file could be read if it were created.
    fn may_appear(&self, place: &Path) -> bool {
        let mut existing = place.ancestors().filter_map(|at| fs::canonicalize(at).ok());
        existing
            .next()
            .is_some_and(|real| self.folder_of(&real).is_some())
    }

    /// The permitted folder that contains a canonical path.
    fn folder_of(&self, real: &Path) -> Option<&Folder> {
        let named = self.named.iter().map(|(_, folder)| folder);
        let mut folders = self.near.iter().chain(named);
        folders.find(|folder| folder.holds(real))
    }

    /// The permitted folders, joined by "and".
    pub(super) fn allowed(&self) -> String {
        let named = self.named.iter().map(|(_, folder)| folder);
        let folders = self.near.last().into_iter().chain(named);
        let folders: Vec<_> = folders
            .map(|folder| folder.real().display().to_string())
            .collect();
        folders.join(" and ")
    }
}

/// The canonical path of the user's home.
pub(super) fn home() -> Option<PathBuf> {
    fs::canonicalize(env::var_os("HOME")?).ok()
}

/// Whether the parent of a scene's folder is likely to contain only scenes and their files.
fn holds_scenes(folder: &Path, home: Option<&Path>) -> bool {
    folder.parent().is_some() && Some(folder) != home
}

/// A name with slashes instead of backslashes.
fn portable(name: &str) -> String {
    name.replace('\\', "/")
}

fn is_absolute(name: &str) -> bool {
    Path::new(&portable(name)).is_absolute()
}

/// The parts of a large file that are hashed in parallel, in bytes.
const PART: usize = 1 << 20;

fn hash(value: impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

/// A hash of bytes.
fn digest(bytes: &[u8]) -> u64 {
    let parts: Vec<u64> = if bytes.len() <= PART {
        vec![hash(bytes)]
    } else {
        bytes.par_chunks(PART).map(hash).collect()
    };
    hash(parts)
}

/// A hash of the bytes of a file with this length. The file position stays at the beginning.
fn digest_of_file(file: &File, length: u64) -> Result<u64, Failure> {
    use std::os::unix::fs::FileExt;
    let part = |at: u64| {
        let mut bytes = vec![0; PART.min((length - at) as usize)];
        file.read_exact_at(&mut bytes, at)?;
        Ok(hash(&bytes[..]))
    };
    let starts = 0..length.div_ceil(PART as u64);
    let starts = starts.map(|number| number * PART as u64);
    let parts: io::Result<Vec<u64>> = if length <= PART as u64 {
        starts.map(part).collect()
    } else {
        let starts: Vec<u64> = starts.collect();
        starts.into_par_iter().map(part).collect()
    };
    Ok(hash(parts?))
}

#[cfg(test)]
mod tests;
