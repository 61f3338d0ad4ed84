//! The picture files that scenes name, read into shared values. What may be read is a scene's own:
//! regular files below the folder above the scene's, or below folders that the user names. Knows
//! nothing of what pictures are for.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::file::{self, ReadError};
use crate::image_file::{self, Unreadable, known_extensions};
use crate::scene::{Image, Images, NamedFile};
use crate::text::{Diagnostic, Findings};

/// What all pictures of a scene may have together: 512 MiB in files, 384 MiB in memory.
const LIMITS: Room = Room {
    bytes: 512 << 20,
    pixels: 1 << 27,
};

/// Reads pictures, and keeps those of the last reading: bytes that are known are not decoded again.
#[derive(Debug)]
pub struct Assets {
    /// Folders that may be read besides the scene's surroundings.
    folders: Vec<PathBuf>,
    /// How much is read for one scene.
    limits: Room,
    known: Known,
}

/// The pictures of a reading.
#[derive(Debug, Default)]
struct Known {
    /// What stands for the bytes of each file.
    files: HashMap<PathBuf, u64>,
    /// The pictures by what stands for their bytes.
    images: HashMap<u64, Arc<Image>>,
}

/// How much may be read for one scene.
#[derive(Clone, Copy, Debug)]
struct Room {
    bytes: u64,
    pixels: u64,
}

/// Which files a scene names: where it stands, and the names as its text says them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// The scene file; names are relative to its folder.
    pub scene: PathBuf,
    /// The names, each once.
    pub names: BTreeSet<String>,
}

impl Wanted {
    /// What the files named by a scene's text are.
    pub fn new(scene: &Path, files: &[NamedFile]) -> Self {
        Self {
            scene: scene.to_owned(),
            names: files.iter().map(|file| file.path.clone()).collect(),
        }
    }

    /// Where a file of this name stands.
    fn place(&self, name: &str) -> PathBuf {
        folder(&self.scene).join(name)
    }
}

/// What became of a reading.
#[derive(Clone, Debug, Default)]
pub struct Loaded {
    /// The pictures, by name.
    pub images: Images,
    /// Why there is none, or none of now, by name.
    pub troubles: Troubles,
}

/// What is wrong with files, by name.
pub type Troubles = BTreeMap<String, Trouble>;

/// What is wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// What, as the end of a sentence.
    reason: String,
    /// What helps.
    hint: Option<String>,
    /// What is seen of it.
    shown: Shown,
}

/// What is seen of a picture that can't be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shown {
    /// The renderer's stand-in.
    Magenta,
    /// The last one that could.
    Last,
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Magenta => "magenta stands for it",
            Self::Last => "its last picture is kept",
        })
    }
}

impl Assets {
    /// Reads from `folders` too.
    pub fn new(folders: &[PathBuf]) -> Self {
        Self {
            folders: folders.to_vec(),
            limits: LIMITS,
            known: Known::default(),
        }
    }

    /// Reads all files wanted. One that holds no picture now but did in the last reading, such as
    /// one that is being written, keeps the last one.
    pub fn read(&mut self, wanted: &Wanted) -> Loaded {
        let before = std::mem::take(&mut self.known);
        let mut room = self.limits;
        let mut images = Vec::new();
        let mut troubles = Troubles::new();
        for name in &wanted.names {
            let place = wanted.place(name);
            let read = self.read_one(wanted, name, &before, &mut room);
            let image = match read {
                Ok(known) => Some(known),
                Err(failure) => {
                    let last = failure.may_pass().then(|| before.image_of(&place));
                    let last = last
                        .flatten()
                        .filter(|(bytes, image)| self.has_room(*bytes, image, &room));
                    let shown = match last {
                        Some(_) => Shown::Last,
                        None => Shown::Magenta,
                    };
                    troubles.insert(name.clone(), failure.trouble(&place, shown));
                    last
                }
            };
            if let Some((bytes, image)) = image {
                images.push((name.clone(), Arc::clone(&image)));
                self.known.files.insert(place, bytes);
                let pixels = image.size().pixels() as u64;
                if self.known.images.insert(bytes, image).is_none() {
                    room.pixels -= pixels;
                }
            }
        }
        Loaded {
            images: images.into_iter().collect(),
            troubles,
        }
    }

    /// The files whose changes matter to a scene: those that may be read, there or not.
    pub fn places(&self, wanted: &Wanted) -> Vec<PathBuf> {
        let places = wanted.names.iter().map(|name| (name, wanted.place(name)));
        let may = |(name, place): &(&String, PathBuf)| match fs::canonicalize(place) {
            // A link that leads elsewhere may give way to a file.
            Ok(real) => {
                let own = fs::canonicalize(folder(place));
                self.may_read(wanted, name, &real)
                    || own.is_ok_and(|own| self.may_read(wanted, name, &own))
            }
            Err(_) => !Path::new(name.as_str()).is_absolute(),
        };
        places.filter(may).map(|(_, place)| place).collect()
    }

    /// Reads one file: what stands for its bytes, and its picture.
    fn read_one(
        &self,
        wanted: &Wanted,
        name: &str,
        before: &Known,
        room: &mut Room,
    ) -> Result<(u64, Arc<Image>), Failure> {
        let real = fs::canonicalize(wanted.place(name));
        if Path::new(name).is_absolute() && !real.as_ref().is_ok_and(|real| self.is_allowed(real)) {
            let real = real.unwrap_or_else(|_| PathBuf::from(name));
            return Err(Failure::Absolute(real));
        }
        let real = real?;
        if !self.may_read(wanted, name, &real) {
            return Err(Failure::Outside(real));
        }
        let content = file::read_bytes(&real, room.bytes)?;
        room.bytes -= content.len() as u64;
        let mut hasher = DefaultHasher::new();
        content.hash(&mut hasher);
        let bytes = hasher.finish();
        let known = self.known.images.get(&bytes);
        let image = match known.or_else(|| before.images.get(&bytes)) {
            Some(image) => Arc::clone(image),
            None => Arc::new(image_file::decode(&content, room.pixels)?),
        };
        if self.has_room(bytes, &image, room) {
            Ok((bytes, image))
        } else {
            Err(Failure::Unreadable(Unreadable::NoRoom))
        }
    }

    /// Whether a picture is among those read, or fits beside them.
    fn has_room(&self, bytes: u64, image: &Image, room: &Room) -> bool {
        image.size().pixels() as u64 <= room.pixels || self.known.images.contains_key(&bytes)
    }

    /// Whether a file without links on its way may be read for a name.
    fn may_read(&self, wanted: &Wanted, name: &str, real: &Path) -> bool {
        let surroundings = || {
            let folder = fs::canonicalize(folder(&wanted.scene)).ok()?;
            Some(folder.parent().unwrap_or(&folder).to_owned())
        };
        let is_near = || surroundings().is_some_and(|folder| real.starts_with(folder));
        self.is_allowed(real) || !Path::new(name).is_absolute() && is_near()
    }

    /// Whether the user has named a folder above it.
    fn is_allowed(&self, real: &Path) -> bool {
        let folders = self.folders.iter();
        let mut real_folders = folders.filter_map(|folder| fs::canonicalize(folder).ok());
        real_folders.any(|folder| real.starts_with(folder))
    }
}

impl Known {
    fn image_of(&self, place: &Path) -> Option<(u64, Arc<Image>)> {
        let bytes = *self.files.get(place)?;
        Some((bytes, Arc::clone(self.images.get(&bytes)?)))
    }
}

impl Trouble {
    /// What is wrong, at a name's place in the text.
    fn at(&self, file: &NamedFile) -> Diagnostic {
        let message = format!("{}: {}; {}", file.what, self.reason, self.shown);
        let expected = format!("a picture file: {}", known_extensions());
        let warning = Diagnostic::warning(file.span, message, expected);
        match &self.hint {
            Some(hint) => warning.with_hint(hint),
            None => warning,
        }
    }
}

/// Adds what is wrong with a scene's files to what is wrong with its text.
pub fn report(troubles: &Troubles, files: &[NamedFile], mut findings: Findings) -> Findings {
    if troubles.is_empty() {
        return findings;
    }
    for file in files {
        if let Some(trouble) = troubles.get(&file.path) {
            findings.warning(|| trouble.at(file));
        }
    }
    findings.sorted()
}

/// Why a file was not read.
#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error("an absolute path is not read")]
    Absolute(PathBuf),
    #[error("is outside of the folder above the scene's")]
    Outside(PathBuf),
    #[error("no such file")]
    Missing,
    #[error("{0}")]
    Io(io::Error),
    #[error("is {0}, not a file")]
    NotRegular(&'static str),
    #[error("the scene's textures have more than {} MiB together", LIMITS.bytes >> 20)]
    TooLong,
    #[error("{0}")]
    Unreadable(#[from] Unreadable),
}

impl Failure {
    /// Whether it may be over in a moment: a file that is being written or replaced.
    fn may_pass(&self) -> bool {
        matches!(
            self,
            Self::Missing
                | Self::Io(_)
                | Self::Unreadable(Unreadable::Unknown | Unreadable::Broken(_))
        )
    }

    /// What it means for whoever looks at a picture.
    fn trouble(&self, place: &Path, shown: Shown) -> Trouble {
        let hint = match self {
            Self::Absolute(real) | Self::Outside(real) => {
                let folder = folder(real).display();
                Some(format!("--assets {folder} lets it be read"))
            }
            Self::Missing => Some(format!("it is looked for as {}", place.display())),
            _ => None,
        };
        Trouble {
            reason: self.to_string(),
            hint,
            shown,
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => Self::Missing,
            _ => Self::Io(error),
        }
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::NotRegular { kind, .. } => Self::NotRegular(kind),
            ReadError::TooLong { .. } => Self::TooLong,
            ReadError::Io { source, .. } => Self::Io(source),
            ReadError::NotFound { .. } | ReadError::NotUtf8 { .. } => Self::Missing,
        }
    }
}

/// The folder that a file is in.
fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

#[cfg(all(test, unix))]
mod tests;
