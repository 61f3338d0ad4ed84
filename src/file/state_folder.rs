//! The folders of what is kept from one run to the next, below `halflight` in `$XDG_STATE_HOME` or in
//! `~/.local/state`, and of what runs share, in the same folder of any other. Whatever is kept is read, written and removed through one of them.
//!
//! A folder is held open and all names are resolved relative to it, so that replacing it has no
//! effect. Neither it nor its parent may be a link or be writable by others: anyone who could write
//! there might plant links and files. In the state folder itself others may write only as in
//! `/tmp`, where nobody can move files that belong to somebody else. No link in it is followed, and
//! files are replaced by new ones, so that nothing outside is ever written to.

mod handle;

use std::env;
use std::ffi::OsString;
use std::fs::{DirBuilder, File, Metadata};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process;

use handle::{FolderHandle, Missing, at, suspicion};

/// What is kept, each in a folder of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Store {
    /// Recent scenes and the sizes of panels.
    Sessions,
    /// Unsaved edits.
    Edits,
    /// Full-size traces.
    Traces,
    /// Sockets that editors connect to, which end with their runs.
    Sockets,
}

impl Store {
    /// The folders below the state folder, outermost first.
    const fn names(self) -> &'static [&'static str] {
        match self {
            Self::Sessions | Self::Sockets => &["halflight"],
            Self::Edits => &["halflight", "recovery"],
            Self::Traces => &["halflight", "traces"],
        }
    }

    /// The path of the folder in a state folder.
    fn path_in(self, state: &Path) -> PathBuf {
        let mut path = state.to_owned();
        path.extend(self.names());
        path
    }
}

const NOT_REGULAR: &str = "is not a regular file";

/// The end of the names of files that are to replace others.
pub const NEW: &str = ".new";

/// The bytes of a file that are written at once.
const CHUNK: usize = 1 << 18;

/// A folder, held open.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    held: FolderHandle,
}

/// The path of a folder of the user's. Fails if nothing can be kept there.
pub fn place(part: Store) -> io::Result<PathBuf> {
    let state = path()?;
    Folder::find(&state, part)?;
    Ok(part.path_in(&state))
}

/// The state folder that the environment defines.
pub fn path() -> io::Result<PathBuf> {
    state_by(|name| env::var_os(name))
}

fn state_by(set: impl Fn(&str) -> Option<OsString>) -> io::Result<PathBuf> {
    // A relative path would depend on the current folder; the specification says to ignore it.
    let set = |name| {
        let path = set(name).map(PathBuf::from);
        path.filter(|path| path.is_absolute())
    };
    set("XDG_STATE_HOME")
        .or_else(|| Some(set("HOME")?.join(".local/state")))
        .ok_or_else(|| io::Error::other("neither HOME nor XDG_STATE_HOME names a folder"))
}

impl Folder {
    /// Opens a folder in a state folder, creating both if they are missing.
    pub fn make(state: &Path, part: Store) -> io::Result<Self> {
        let mut builder = DirBuilder::new();
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        let created = builder.recursive(true).create(state);
        created.map_err(|error| at(state, &error))?;
        Self::open_in(state, part, Missing::Made)
    }

    /// Opens a folder in a state folder; `None` if it is missing.
    pub fn find(state: &Path, part: Store) -> io::Result<Option<Self>> {
        match Self::open_in(state, part, Missing::Refused) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            opened => opened.map(Some),
        }
    }

    fn open_in(state: &Path, part: Store, missing: Missing) -> io::Result<Self> {
        let held = FolderHandle::of(state, part.names(), missing)?;
        let path = part.path_in(state);
        Ok(Self { path, held })
    }

    /// Whether the folder is still at its path and nobody else can write to it.
    pub fn is_sound(&self) -> bool {
        self.held.is_sound(&self.path).unwrap_or(false)
    }

    /// Whether a name in the folder refers to this open file.
    pub fn has(&self, name: &str, file: &File) -> io::Result<bool> {
        self.held.has(name, file)
    }

    /// Creates a file for writing. Fails if the name exists, even as a link.
    pub fn create(&self, name: &str) -> io::Result<File> {
        let made = self.held.create(name);
        made.map_err(|error| at(&self.path, &error))
    }

    /// Opens a file for reading, if it exists. Fails unless it is a regular file of our own.
    pub fn open(&self, name: &str) -> io::Result<Option<File>> {
        let place = self.place(name);
        let refused = |reason| {
            let reason = format!("{} {reason}", place.display());
            io::Error::new(io::ErrorKind::InvalidInput, reason)
        };
        let file = match self.held.open(name) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            // For example a link, which is not followed.
            Err(_) if place.symlink_metadata().is_ok_and(|found| !found.is_file()) => {
                return Err(refused(NOT_REGULAR));
            }
            Err(error) => return Err(at(&place, &error)),
        };
        match Self::refusal(&file.metadata()?) {
            Some(reason) => Err(refused(reason)),
            None => Ok(Some(file)),
        }
    }

    /// Why a file cannot be one of ours, phrased to follow its name.
    pub fn refusal(metadata: &Metadata) -> Option<&'static str> {
        let not_regular = Some(NOT_REGULAR).filter(|_| !metadata.is_file());
        not_regular.or_else(|| suspicion(metadata))
    }

    /// Whether a name in the folder is taken; `false` if that cannot be determined.
    pub fn holds(&self, name: &str) -> bool {
        self.place(name).symlink_metadata().is_ok()
    }

    /// Replaces or creates a file, of which at any moment the old or the complete new content is
    /// there. A link in its place is replaced, not followed.
    pub fn replace(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        let new = format!("{name}.{}{NEW}", process::id());
        // Left behind by an earlier process of this number.
        self.remove(&new)?;
        let file = self.create(&new)?;
        let mut out = BufWriter::with_capacity(CHUNK, &file);
        let written = write(&mut out).and_then(|()| out.flush());
        // After an error the rest of the buffer is not written.
        let _ = out.into_parts();
        let kept = written.and_then(|()| file.sync_all());
        let placed = kept.and_then(|()| self.rename(&new, name));
        match placed {
            Ok(()) => self.sync(),
            Err(_) => drop(self.remove(&new)),
        }
        placed
    }

    /// The names in the folder.
    pub fn names(&self) -> Vec<String> {
        let entries = self.path.read_dir().into_iter().flatten().flatten();
        let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
        names.collect()
    }

    /// Renames a file, replacing any file of the new name.
    pub fn rename(&self, from: &str, to: &str) -> io::Result<()> {
        self.held.rename(from, to)
    }

    /// Removes a file, if it exists.
    pub fn remove(&self, name: &str) -> io::Result<()> {
        match self.held.remove(name) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    /// Makes names survive a system crash, where folders can be synchronized.
    pub fn sync(&self) {
        self.held.sync();
    }

    /// The path of a file with this name.
    pub fn place(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// A path of a file with this name that is short enough for a socket, where there can be one; it holds
    /// only while the folder is open.
    pub fn short_place(&self, name: &str) -> PathBuf {
        /// What addresses of sockets hold, in bytes, on macOS a few less than elsewhere.
        const LONGEST: usize = 100;
        let place = self.place(name);
        if cfg!(target_os = "linux") && LONGEST < place.as_os_str().len() {
            return self.held.number().join(name);
        }
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_state_folder_is_absolute() {
        for (xdg, home, expected) in [
            (Some("/state"), Some("/home/me"), Some("/state")),
            (None, Some("/home/me"), Some("/home/me/.local/state")),
            (Some(""), Some("/home/me"), Some("/home/me/.local/state")),
            (
                Some("state"),
                Some("/home/me"),
                Some("/home/me/.local/state"),
            ),
            (Some("state"), Some("me"), None),
            (None, None, None),
        ] {
            let set = |name: &str| if name == "HOME" { home } else { xdg };
            let found = state_by(|name| set(name).map(OsString::from)).ok();
            assert_eq!(found.as_deref(), expected.map(Path::new));
        }
    }
}
