//! The folder of the journals, `halflight/recovery` in `$XDG_STATE_HOME` or in `~/.local/state`.
//!
//! It is held open and all names are looked up in it, so that another folder in its place changes
//! nothing. It is used only where nobody else can write in it: whoever could might plant links and
//! edits there.

use std::env;
use std::ffi::OsString;
use std::fs::{DirBuilder, File};
use std::io;
use std::path::{Path, PathBuf};

#[cfg(not(unix))]
use plain as system;
#[cfg(unix)]
use unix as system;

/// The longest file that is read as a journal: a base, edits and what is not yet removed of them.
const LIMIT: u64 = 3 * crate::file::MAX_BYTES;

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
    Ok(path_in(&state.join("halflight")))
}

fn path_in(own: &Path) -> PathBuf {
    own.join("recovery")
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
        let own = state.join("halflight");
        let mut builder = DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder
            .recursive(true)
            .create(&own)
            .map_err(|error| at(&own, &error))?;
        Self::open_in(&own, system::Missing::Made)
    }

    /// Opens the folder in the state folder, if it is there.
    pub(super) fn find(state: &Path) -> io::Result<Option<Self>> {
        match Self::open_in(&state.join("halflight"), system::Missing::Refused) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            opened => opened.map(Some),
        }
    }

    fn open_in(own: &Path, missing: system::Missing) -> io::Result<Self> {
        let path = path_in(own);
        let held = system::Held::of(own, &path, missing)?;
        Ok(Self { path, held })
    }

    /// Whether it still is where it was, and nobody else can write in it.
    pub(super) fn check(&self) -> io::Result<()> {
        self.held.check(&self.path)
    }

    /// Makes a file, to be written; there must be none of that name, nor a link.
    pub(super) fn create(&self, name: &str) -> io::Result<File> {
        let made = self.held.create(&self.path, name);
        made.map_err(|error| at(&self.path, &error))
    }

    /// Opens a file to read it, if it is a plain one of our own.
    pub(super) fn open(&self, name: &str) -> io::Result<File> {
        let file = self.held.open(&self.path, name)?;
        let metadata = file.metadata()?;
        if !metadata.is_file() || LIMIT < metadata.len() || !system::is_own(&metadata) {
            return Err(io::ErrorKind::InvalidInput.into());
        }
        Ok(file)
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
    use std::os::fd::OwnedFd;
    use std::os::unix::fs::MetadataExt;
    use std::path::Path;

    use rustix::fs::{AtFlags, CWD, Mode, OFlags, RawMode, Stat};
    use rustix::fs::{fstat, fsync, mkdirat, openat, renameat, unlinkat};
    use rustix::io::Errno;
    use rustix::process::geteuid;

    use super::at;

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
        pub(super) fn of(own: &Path, path: &Path, missing: Missing) -> io::Result<Self> {
            let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
            let failed = |path| move |error: Errno| at(path, &error.into());
            let outer = openat(CWD, own, flags, Mode::empty()).map_err(failed(own))?;
            check(&fstat(&outer)?, own)?;
            if missing == Missing::Made {
                match mkdirat(&outer, "recovery", Mode::RWXU) {
                    Ok(()) | Err(Errno::EXIST) => {}
                    Err(error) => return Err(failed(path)(error)),
                }
            }
            let flags = flags | OFlags::NOFOLLOW;
            let held = openat(&outer, "recovery", flags, Mode::empty()).map_err(failed(path))?;
            let held = Self(held);
            held.check(path)?;
            Ok(held)
        }

        pub(super) fn check(&self, path: &Path) -> io::Result<()> {
            let stat = fstat(&self.0)?;
            if stat.st_nlink == 0 {
                return Err(io::ErrorKind::NotFound.into());
            }
            check(&stat, path)
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

    /// Whether a file is ours, and nobody else can have written it.
    pub(super) fn is_own(metadata: &Metadata) -> bool {
        metadata.uid() == geteuid().as_raw()
            && !Mode::from_raw_mode(metadata.mode() as RawMode).intersects(WRITABLE)
    }

    fn check(stat: &Stat, path: &Path) -> io::Result<()> {
        let path = path.display();
        let reason = if stat.st_uid != geteuid().as_raw() {
            format!("{path} belongs to another user")
        } else if Mode::from_raw_mode(stat.st_mode).intersects(WRITABLE) {
            format!("{path} can be written by others: chmod go-w {path}")
        } else {
            return Ok(());
        };
        Err(io::Error::new(io::ErrorKind::PermissionDenied, reason))
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
        pub(super) fn of(_: &Path, path: &Path, missing: Missing) -> io::Result<Self> {
            if missing == Missing::Made {
                fs::create_dir_all(path)?;
            }
            Self.check(path)?;
            Ok(Self)
        }

        pub(super) fn check(&self, path: &Path) -> io::Result<()> {
            fs::metadata(path).map(drop)
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

    pub(super) fn is_own(_: &Metadata) -> bool {
        true
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
