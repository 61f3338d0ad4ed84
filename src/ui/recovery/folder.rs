//! The folder of the journals, `halflight/recovery` in `$XDG_STATE_HOME` or in `~/.local/state`.
//!
//! It is held open and all names are looked up in it, so that another folder in its place changes
//! nothing. Neither it nor the one around it may be a link or be writable by others: whoever could
//! write there might plant links and edits. Others may write in the state folder only as they may
//! in `/tmp`, where nobody can move away what is not theirs.

use std::env;
use std::ffi::OsString;
use std::fs::{DirBuilder, File, Metadata};
use std::io;
use std::path::{Path, PathBuf};

#[cfg(not(unix))]
use plain as system;
#[cfg(unix)]
use unix as system;

/// The folders below the state folder, each in the one before.
const NAMES: [&str; 2] = ["halflight", "recovery"];

const NOT_REGULAR: &str = "is not a regular file";

/// The folder, held open.
#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    held: system::Held,
}

/// Where journals are kept; the error is why none can be.
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

/// Where programs keep their state, by the environment.
pub(super) fn state() -> io::Result<PathBuf> {
    state_by(|name| env::var_os(name))
}

fn state_by(set: impl Fn(&str) -> Option<OsString>) -> io::Result<PathBuf> {
    // What is not absolute would mean something else in every folder, and is to be ignored.
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
    /// Opens the folder in the state folder; makes it where it is missing.
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

    /// Opens the folder in the state folder, if it is there.
    pub(super) fn find(state: &Path) -> io::Result<Option<Self>> {
        match Self::open_in(state, system::Missing::Refused) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            opened => opened.map(Some),
        }
    }

    fn open_in(state: &Path, missing: system::Missing) -> io::Result<Self> {
        let held = system::Held::of(state, missing)?;
        let path = path_in(state);
        Ok(Self { path, held })
    }

    /// Whether it still is where it was, and nobody else can write in it.
    pub(super) fn is_sound(&self) -> bool {
        self.held.is_sound(&self.path).unwrap_or(false)
    }

    /// Whether a name in it is that of an open file.
    pub(super) fn has(&self, name: &str, file: &File) -> io::Result<bool> {
        self.held.has(&self.path, name, file)
    }

    /// Makes a file, to be written; there must be none of that name, nor a link.
    pub(super) fn create(&self, name: &str) -> io::Result<File> {
        let made = self.held.create(&self.path, name);
        made.map_err(|error| at(&self.path, &error))
    }

    /// Opens a file to read it, if there is one; an error if it is no regular one of our own.
    pub(super) fn open(&self, name: &str) -> io::Result<Option<File>> {
        let place = self.place(name);
        let refused = |reason| {
            let reason = format!("{} {reason}", place.display());
            io::Error::new(io::ErrorKind::InvalidInput, reason)
        };
        let file = match self.held.open(&self.path, name) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            // Such as a link, which is not followed.
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

    /// Why a file is not taken for one that we have written, in words that follow its name.
    pub(super) fn refusal(metadata: &Metadata) -> Option<&'static str> {
        let not_regular = Some(NOT_REGULAR).filter(|_| !metadata.is_file());
        not_regular.or_else(|| system::suspicion(metadata))
    }

    /// Whether a name in it is taken, as far as that can be told.
    pub(super) fn holds(&self, name: &str) -> bool {
        self.place(name).symlink_metadata().is_ok()
    }

    /// Gives a file the name of another one, which is replaced.
    pub(super) fn rename(&self, from: &str, to: &str) -> io::Result<()> {
        self.held.rename(&self.path, from, to)
    }

    /// Removes a file, if there is one.
    pub(super) fn remove(&self, name: &str) -> io::Result<()> {
        match self.held.remove(&self.path, name) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    /// Has the names outlive a crash of the system, where folders can be synchronized.
    pub(super) fn sync(&self) {
        self.held.sync();
    }

    /// Where a file of this name is.
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

    /// What becomes of a folder that is missing.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub(super) enum Missing {
        Made,
        Refused,
    }

    /// The permissions of a group and of others to write.
    const WRITABLE: Mode = Mode::WGRP.union(Mode::WOTH);

    #[derive(Debug)]
    pub(super) struct Held(OwnedFd);

    impl Held {
        /// Opens the folder name by name, so that nothing can be put in the way meanwhile.
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
            // Not all file systems can, and the names are there for all but a crash of the system.
            let _ = fsync(&self.0);
        }
    }

    /// Why a file may be written by somebody else, in words that follow its name.
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

    /// Whether a folder is ours, and nobody else can write in it.
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

    /// Whether nobody else can put another folder in the place of ours. A group may be allowed to
    /// write: on many systems each user has one of their own.
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

    /// Why a name can't be opened as a folder.
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

/// Systems without users and links that matter here.
#[cfg(not(unix))]
mod plain {
    use std::fs::{self, File, Metadata, OpenOptions};
    use std::io;
    use std::path::Path;

    /// What becomes of a folder that is missing.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub(super) enum Missing {
        Made,
        Refused,
    }

    #[derive(Debug)]
    pub(super) struct Held;

    impl Held {
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
