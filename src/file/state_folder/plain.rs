//! Systems without the users and links that matter here.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io;
use std::path::Path;

/// What to do about a missing folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Missing {
    Made,
    Refused,
}

#[derive(Debug)]
pub(super) struct FolderHandle;

impl FolderHandle {
    pub(super) fn of(state: &Path, names: &[&str], missing: Missing) -> io::Result<Self> {
        let mut path = state.to_owned();
        path.extend(names);
        if missing == Missing::Made {
            fs::create_dir_all(&path)?;
        }
        fs::metadata(path)?;
        Ok(Self)
    }

    pub(super) fn is_sound(&self, path: &Path) -> io::Result<bool> {
        Ok(path.is_dir())
    }

    pub(super) fn has(&self, path: &Path, name: &str, _: &File) -> io::Result<bool> {
        Ok(path.join(name).is_file())
    }

    pub(super) fn create(&self, path: &Path, name: &str) -> io::Result<File> {
        let mut options = OpenOptions::new();
        options.write(true).create_new(true).open(path.join(name))
    }

    pub(super) fn open(&self, path: &Path, name: &str) -> io::Result<File> {
        File::open(path.join(name))
    }

    pub(super) fn rename(&self, path: &Path, from: &str, to: &str) -> io::Result<()> {
        fs::rename(path.join(from), path.join(to))
    }

    pub(super) fn remove(&self, path: &Path, name: &str) -> io::Result<()> {
        fs::remove_file(path.join(name))
    }

    pub(super) fn sync(&self) {}
}

pub(super) fn suspicion(_: &Metadata) -> Option<&'static str> {
    None
}

/// Adds the path to an error.
pub(super) fn at(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}
