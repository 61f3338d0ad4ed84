//! A folder that is held open, so that what is read in it stands in it.
//!
//! Between a look at a path and its opening anybody may put a link in a folder's place. So the path
//! is resolved first, links and all; if the outcome lies in a folder that may be read, it has no
//! links left, and is gone through from that folder's descriptor, name by name, following none. What
//! became a link meanwhile is an error then. Linux can do this in one call, `openat2` with
//! `RESOLVE_BENEATH`; that refuses absolute links even to places within, is missing in older kernels
//! and forbidden in some containers, and so would need this walk besides.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

#[cfg(unix)]
use rustix::fd::OwnedFd;
#[cfg(unix)]
use rustix::fs::{Mode, OFlags};

/// A folder, and where it stands.
#[derive(Debug)]
pub(super) struct Folder {
    /// Its path without links.
    real: PathBuf,
    #[cfg(unix)]
    held: OwnedFd,
}

/// A folder that is named to be read from can't be.
#[derive(Debug, thiserror::Error)]
#[error("--assets {path}: {reason}", path = path.display(), reason = reason(source))]
pub struct NoFolder {
    /// Its name.
    path: PathBuf,
    /// What the system said.
    source: io::Error,
}

fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such folder".to_owned(),
        io::ErrorKind::NotADirectory => "not a folder".to_owned(),
        _ => error.to_string(),
    }
}

/// Finds out whether these folders can be read from.
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
    /// Opens a folder, wherever links lead.
    pub(super) fn open(path: &Path) -> io::Result<Self> {
        let real = fs::canonicalize(path)?;
        Ok(Self {
            #[cfg(unix)]
            held: rustix::fs::open(&real, flags_of_folders(), Mode::empty())?,
            real,
        })
    }

    /// Its path without links.
    pub(super) fn real(&self) -> &Path {
        &self.real
    }

    /// Whether a path without links lies in it, or is its own.
    pub(super) fn holds(&self, real: &Path) -> bool {
        real.starts_with(&self.real)
    }

    /// Opens what a path without links leads to, if it lies in this folder; never waits. It is an
    /// error if there are links on the way by now.
    #[cfg(unix)]
    pub(super) fn file(&self, real: &Path) -> io::Result<File> {
        let inside = real.strip_prefix(&self.real).map_err(io::Error::other)?;
        let own = Path::new(".");
        let name = inside.file_name().map_or(own, Path::new);
        let mut folder = None;
        for step in inside.parent().into_iter().flat_map(Path::components) {
            let from = folder.as_ref().unwrap_or(&self.held);
            let next =
                rustix::fs::openat(from, step.as_os_str(), flags_of_folders(), Mode::empty());
            folder = Some(next?);
        }
        // A terminal must not become the one that controls the process.
        let flags = OFlags::RDONLY | OFlags::NONBLOCK | OFlags::NOCTTY;
        let flags = flags | OFlags::NOFOLLOW | OFlags::CLOEXEC;
        let folder = folder.as_ref().unwrap_or(&self.held);
        Ok(rustix::fs::openat(folder, name, flags, Mode::empty())?.into())
    }

    /// Opens what a path without links leads to.
    #[cfg(not(unix))]
    pub(super) fn file(&self, real: &Path) -> io::Result<File> {
        File::open(real)
    }

    /// Whether everybody may write in it.
    #[cfg(unix)]
    pub(super) fn is_public(&self) -> bool {
        let everybody = |stat: rustix::fs::Stat| Mode::from_raw_mode(stat.st_mode);
        rustix::fs::fstat(&self.held).map_or(true, |stat| everybody(stat).contains(Mode::WOTH))
    }

    /// Whether everybody may write in it.
    #[cfg(not(unix))]
    pub(super) fn is_public(&self) -> bool {
        false
    }
}

/// How folders are opened: to go on from them, which needs less than to list them where there is
/// `O_PATH`.
#[cfg(unix)]
fn flags_of_folders() -> OFlags {
    #[cfg(any(target_os = "linux", target_os = "android"))]
    let access = OFlags::PATH;
    #[cfg(not(any(target_os = "linux", target_os = "android")))]
    let access = OFlags::RDONLY;
    access | OFlags::DIRECTORY | OFlags::NOFOLLOW | OFlags::CLOEXEC
}
