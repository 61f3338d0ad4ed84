//! A folder that is kept open, so that files opened through it are certain to lie in it.
//!
//! Between the check of a path and its opening, anyone may replace a folder by a link. So the path
//! is resolved first; if the result lies in a permitted folder, it contains no links, and is opened
//! component by component from that folder's descriptor without following links. What became a link
//! meanwhile is an error. On Linux `openat2` with `RESOLVE_BENEATH` can do this in one call, but it
//! refuses absolute links even within the folder, is missing in older kernels and forbidden in some
//! containers, and so would need this loop as a fallback.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use rustix::fd::OwnedFd;
use rustix::fs::{Mode, OFlags};

/// An open folder and its path.
#[derive(Debug)]
pub(super) struct Folder {
    /// The canonical path, without links.
    real: PathBuf,
    descriptor: OwnedFd,
}

/// A folder given with `--assets` cannot be read from.
#[derive(Debug, thiserror::Error)]
#[error("--assets {path}: {reason}", path = path.display(), reason = reason(source))]
pub struct NoFolder {
    /// The folder as given.
    path: PathBuf,
    /// The system's error on opening it.
    source: io::Error,
}

fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such folder".to_owned(),
        io::ErrorKind::NotADirectory => "not a folder".to_owned(),
        _ => error.to_string(),
    }
}

/// Checks that all of these folders can be opened.
pub fn check_folders(folders: &[PathBuf]) -> Result<(), NoFolder> {
    for path in folders {
        Folder::open(path).map_err(|source| NoFolder {
            path: path.clone(),
            source,
        })?;
    }
    Ok(())
}

impl Folder {
    /// Opens a folder, following links.
    pub(super) fn open(path: &Path) -> io::Result<Self> {
        let real = fs::canonicalize(path)?;
        Ok(Self {
            descriptor: rustix::fs::open(&real, flags_of_folders(), Mode::empty())?,
            real,
        })
    }

    /// The canonical path, without links.
    pub(super) fn real(&self) -> &Path {
        &self.real
    }

    /// Whether a canonical path lies in the folder or is the folder itself.
    pub(super) fn holds(&self, real: &Path) -> bool {
        real.starts_with(&self.real)
    }

    /// Opens a file of this folder by its canonical path; never blocks. Fails if the path lies
    /// outside or contains links by now.
    pub(super) fn file(&self, real: &Path) -> io::Result<File> {
        let inside = real.strip_prefix(&self.real).map_err(io::Error::other)?;
        let own = Path::new(".");
        let name = inside.file_name().map_or(own, Path::new);
        let mut folder = None;
        for step in inside.parent().into_iter().flat_map(Path::components) {
            let from = folder.as_ref().unwrap_or(&self.descriptor);
            let next =
                rustix::fs::openat(from, step.as_os_str(), flags_of_folders(), Mode::empty());
            folder = Some(next?);
        }
        // A terminal must not become the controlling terminal.
        let flags = OFlags::RDONLY | OFlags::NONBLOCK | OFlags::NOCTTY;
        let flags = flags | OFlags::NOFOLLOW | OFlags::CLOEXEC;
        let folder = folder.as_ref().unwrap_or(&self.descriptor);
        Ok(rustix::fs::openat(folder, name, flags, Mode::empty())?.into())
    }

    /// Whether the folder is writable by everyone.
    pub(super) fn is_public(&self) -> bool {
        let mode = |stat: rustix::fs::Stat| Mode::from_raw_mode(stat.st_mode);
        rustix::fs::fstat(&self.descriptor).map_or(true, |stat| mode(stat).contains(Mode::WOTH))
    }
}

/// The flags for opening folders. On Linux, `O_PATH` needs no permission to list them.
fn flags_of_folders() -> OFlags {
    #[cfg(target_os = "linux")]
    let access = OFlags::PATH;
    #[cfg(not(target_os = "linux"))]
    let access = OFlags::RDONLY;
    access | OFlags::DIRECTORY | OFlags::NOFOLLOW | OFlags::CLOEXEC
}
