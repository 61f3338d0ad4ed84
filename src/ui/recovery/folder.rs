//! The journal folder: `halflight/recovery` in `$XDG_STATE_HOME` or in `~/.local/state`.
//!
//! The folder is held open and all names are resolved relative to it, so that replacing it has no
//! effect. Neither it nor its parent may be a link or be writable by others: anyone who could write
//! there might plant links and edits. In the state folder itself others may write only as in
//! `/tmp`, where nobody can move files that belong to somebody else.

use std::env;
use std::ffi::OsString;
use std::fs::{DirBuilder, File, Metadata};
use std::io;
use std::path::{Path, PathBuf};

#[cfg(not(unix))]
use plain as system;
#[cfg(unix)]
use unix as system;

/// The folders below the state folder, outermost first.
const NAMES: [&str; 2] = ["halflight", "recovery"];

const NOT_REGULAR: &str = "is not a regular file";

/// The journal folder, held open.
#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    held: system::FolderHandle,
}

/// The path of the journal folder. Fails if no journals can be kept there.
pub(crate) fn place() -> io::Result<PathBuf> {
    let state = state()?;
    Folder::find(&state)?;
    Ok(path_in(&state))
}

fn path_in(state: &Path) -> PathBuf {
    NAMES
        .iter()
        .fold(state.to_owned(), |path, name| path.join(name))
}

/// The state folder that the environment defines.
pub(crate) fn state() -> io::Result<PathBuf> {
    state_by(|name| env::var_os(name))
}

fn state_by(set: impl Fn(&str) -> Option<OsString>) -> io::Result<PathBuf> {
    // A relative path would depend on the current folder; the specification says to ignore it.
    let set = |name| {
        set(name)
            .map(PathBuf::from)
            .filter(|path| path.is_absolute())
    };
    set("XDG_STATE_HOME")
        .or_else(|| Some(set("HOME")?.join(".local/state")))
        .ok_or_else(|| io::Error::other("neither HOME nor XDG_STATE_HOME names a folder"))
}

impl Folder {
    /// Opens the journal folder in a state folder, creating it if it is missing.
    pub(super) fn make(state: &Path) -> io::Result<Self> {
        let mut builder = DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder
            .recursive(true)
            .create(state)
            .map_err(|error| at(state, &error))?;
        Self::open_in(state, system::Missing::Made)
    }

    /// Opens the journal folder in a state folder; `None` if it is missing.
    pub(super) fn find(state: &Path) -> io::Result<Option<Self>> {
        match Self::open_in(state, system::Missing::Refused) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            opened => opened.map(Some),
        }
    }

    fn open_in(state: &Path, missing: system::Missing) -> io::Result<Self> {
        let held = system::FolderHandle::of(state, missing)?;
        let path = path_in(state);
        Ok(Self { path, held })
    }

    /// Whether the folder is still at its path and nobody else can write to it.
    pub(super) fn is_sound(&self) -> bool {
        self.held.is_sound(&self.path).unwrap_or(false)
    }

    /// Whether a name in the folder refers to this open file.
    pub(super) fn has(&self, name: &str, file: &File) -> io::Result<bool> {
        self.held.has(&self.path, name, file)
    }

    /// Creates a file for writing. Fails if the name exists, even as a link.
    pub(super) fn create(&self, name: &str) -> io::Result<File> {
        let made = self.held.create(&self.path, name);
        made.map_err(|error| at(&self.path, &error))
    }

    /// Opens a file for reading, if it exists. Fails unless it is a regular file of our own.
    pub(super) fn open(&self, name: &str) -> io::Result<Option<File>> {
        let place = self.place(name);
        let refused = |reason| {
            let reason = format!("{} {reason}", place.display());
            io::Error::new(io::ErrorKind::InvalidInput, reason)
        };
        let file = match self.held.open(&self.path, name) {
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
    pub(super) fn refusal(metadata: &Metadata) -> Option<&'static str> {
        let not_regular = Some(NOT_REGULAR).filter(|_| !metadata.is_file());
        not_regular.or_else(|| system::suspicion(metadata))
    }

    /// Whether a name in the folder is taken; `false` if that cannot be determined.
    pub(super) fn holds(&self, name: &str) -> bool {
        self.place(name).symlink_metadata().is_ok()
    }

    /// Renames a file, replacing any file of the new name.
    pub(super) fn rename(&self, from: &str, to: &str) -> io::Result<()> {
        self.held.rename(&self.path, from, to)
    }

    /// Removes a file, if it exists.
    pub(super) fn remove(&self, name: &str) -> io::Result<()> {
        match self.held.remove(&self.path, name) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    /// Makes names survive a system crash, where folders can be synchronized.
    pub(super) fn sync(&self) {
        self.held.sync();
    }

    /// The path of a file with this name.
    pub(super) fn place(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }
}

fn at(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}

#[cfg(unix)]
mod unix {
    use std::fs::{File, Metadata};
    use std::io;
    use std::os::fd::{AsFd, OwnedFd};
    use std::os::unix::fs::MetadataExt;
    use std::path::Path;

    use rustix::fs::{AtFlags, CWD, FileType, Mode, OFlags, RawMode, Stat};
    use rustix::fs::{fstat, fsync, mkdirat, openat, renameat, statat, unlinkat};
    use rustix::io::Errno;
    use rustix::process::geteuid;

    use super::{NAMES, at};

    /// What to do about a missing folder.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub(super) enum Missing {
        Made,
        Refused,
    }

    /// The write permissions of the group and of others.
    const WRITABLE: Mode = Mode::WGRP.union(Mode::WOTH);

    #[derive(Debug)]
    pub(super) struct FolderHandle(OwnedFd);

    impl FolderHandle {
        /// Opens the folder one component at a time, so that nothing can be slipped in meanwhile.
        pub(super) fn of(state: &Path, missing: Missing) -> io::Result<Self> {
            let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
            let opened = openat(CWD, state, flags, Mode::empty());
            let mut folder = opened.map_err(|error| at(state, &error.into()))?;
            check_around(&fstat(&folder)?, state)?;
            let mut path = state.to_owned();
            for name in NAMES {
                path.push(name);
                if missing == Missing::Made {
                    match mkdirat(&folder, name, Mode::RWXU) {
                        Ok(()) | Err(Errno::EXIST) => {}
                        Err(error) => return Err(at(&path, &error.into())),
                    }
                }
                let opened = openat(&folder, name, flags | OFlags::NOFOLLOW, Mode::empty());
                folder = opened.map_err(|error| obstacle(&folder, name, &path, error))?;
                check(&fstat(&folder)?, &path)?;
            }
            Ok(Self(folder))
        }

        pub(super) fn is_sound(&self, path: &Path) -> io::Result<bool> {
            let held = fstat(&self.0)?;
            let found = statat(CWD, path, AtFlags::SYMLINK_NOFOLLOW)?;
            Ok(is_same(&held, &found) && check(&held, path).is_ok())
        }

        pub(super) fn has(&self, _: &Path, name: &str, file: &File) -> io::Result<bool> {
            let found = statat(&self.0, name, AtFlags::SYMLINK_NOFOLLOW)?;
            Ok(is_same(&fstat(file)?, &found))
        }

        pub(super) fn create(&self, _: &Path, name: &str) -> io::Result<File> {
            let flags =
                OFlags::WRONLY | OFlags::CREATE | OFlags::EXCL | OFlags::NOFOLLOW | OFlags::CLOEXEC;
            Ok(openat(&self.0, name, flags, Mode::RUSR | Mode::WUSR)?.into())
        }

        pub(super) fn open(&self, _: &Path, name: &str) -> io::Result<File> {
            let flags = OFlags::RDONLY
                | OFlags::NOFOLLOW
                | OFlags::NONBLOCK
                | OFlags::NOCTTY
                | OFlags::CLOEXEC;
            Ok(openat(&self.0, name, flags, Mode::empty())?.into())
        }

        pub(super) fn rename(&self, _: &Path, from: &str, to: &str) -> io::Result<()> {
            Ok(renameat(&self.0, from, &self.0, to)?)
        }

        pub(super) fn remove(&self, _: &Path, name: &str) -> io::Result<()> {
            Ok(unlinkat(&self.0, name, AtFlags::empty())?)
        }

        pub(super) fn sync(&self) {
            // Not all file systems support this, and only a system crash would lose the names.
            let _ = fsync(&self.0);
        }
    }

    /// Why a file may have been written by somebody else, phrased to follow its name.
    pub(super) fn suspicion(metadata: &Metadata) -> Option<&'static str> {
        if metadata.uid() != geteuid().as_raw() {
            return Some("belongs to another user");
        }
        let mode = Mode::from_raw_mode(metadata.mode() as RawMode);
        mode.intersects(WRITABLE)
            .then_some("may be written by others")
    }

    fn is_same(one: &Stat, other: &Stat) -> bool {
        (one.st_dev, one.st_ino) == (other.st_dev, other.st_ino)
    }

    /// Fails unless a folder is ours and nobody else can write to it.
    fn check(stat: &Stat, path: &Path) -> io::Result<()> {
        let path = path.display();
        if stat.st_uid != geteuid().as_raw() {
            return Err(refusal(format!("{path} belongs to another user")));
        }
        if Mode::from_raw_mode(stat.st_mode).intersects(WRITABLE) {
            let reason = format!("{path} is writable by others: chmod go-w {path}");
            return Err(refusal(reason));
        }
        Ok(())
    }

    /// Fails if somebody else could replace our folder. Group write permission is accepted: on many
    /// systems each user has a group of their own.
    fn check_around(stat: &Stat, path: &Path) -> io::Result<()> {
        let path = path.display();
        let mode = Mode::from_raw_mode(stat.st_mode);
        if ![geteuid().as_raw(), 0].contains(&stat.st_uid) {
            return Err(refusal(format!("{path} belongs to another user")));
        }
        if mode.contains(Mode::WOTH) && !mode.contains(Mode::SVTX) {
            let reason = format!("{path} is writable by others: chmod o-w {path}");
            return Err(refusal(reason));
        }
        Ok(())
    }

    /// Explains why a name cannot be opened as a folder.
    fn obstacle(folder: impl AsFd, name: &str, path: &Path, error: Errno) -> io::Error {
        let found = statat(folder, name, AtFlags::SYMLINK_NOFOLLOW);
        let kind = found.map(|stat| FileType::from_raw_mode(stat.st_mode));
        let shown = path.display();
        match kind {
            Ok(FileType::Symlink) => refusal(format!(
                "{shown} is a symbolic link, which is not followed: put a folder in its place"
            )),
            Ok(kind) if kind != FileType::Directory => io::Error::new(
                io::ErrorKind::NotADirectory,
                format!("{shown} is not a folder: move it away"),
            ),
            _ => at(path, &error.into()),
        }
    }

    fn refusal(reason: String) -> io::Error {
        io::Error::new(io::ErrorKind::PermissionDenied, reason)
    }
}

/// Systems without the users and links that matter here.
#[cfg(not(unix))]
mod plain {
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
        pub(super) fn of(state: &Path, missing: Missing) -> io::Result<Self> {
            let path = super::path_in(state);
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
