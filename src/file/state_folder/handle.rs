//! Folders opened one component at a time, and held.

use std::fs::{File, Metadata};
use std::io;
use std::os::fd::{AsFd, AsRawFd, OwnedFd};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

use rustix::fs::{
    AtFlags, CWD, FileType, Mode, OFlags, RawMode, Stat, fstat, fsync, mkdirat, openat, renameat,
    statat, unlinkat,
};
use rustix::io::Errno;
use rustix::process::geteuid;

use text::shell_path;

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
    pub(super) fn of(state: &Path, names: &[&str], missing: Missing) -> io::Result<Self> {
        let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
        let opened = openat(CWD, state, flags, Mode::empty());
        let mut folder = opened.map_err(|error| at(state, &error.into()))?;
        check_around(&fstat(&folder)?, state)?;
        let mut path = state.to_owned();
        for &name in names {
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

    /// The folder among the files that this process has open, as Linux names them.
    pub(super) fn number(&self) -> PathBuf {
        format!("/proc/self/fd/{}", self.0.as_raw_fd()).into()
    }

    pub(super) fn has(&self, name: &str, file: &File) -> io::Result<bool> {
        let found = statat(&self.0, name, AtFlags::SYMLINK_NOFOLLOW)?;
        Ok(is_same(&fstat(file)?, &found))
    }

    pub(super) fn create(&self, name: &str) -> io::Result<File> {
        let flags =
            OFlags::WRONLY | OFlags::CREATE | OFlags::EXCL | OFlags::NOFOLLOW | OFlags::CLOEXEC;
        Ok(openat(&self.0, name, flags, Mode::RUSR | Mode::WUSR)?.into())
    }

    pub(super) fn open(&self, name: &str) -> io::Result<File> {
        let flags =
            OFlags::RDONLY | OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
        Ok(openat(&self.0, name, flags, Mode::empty())?.into())
    }

    pub(super) fn rename(&self, from: &str, to: &str) -> io::Result<()> {
        Ok(renameat(&self.0, from, &self.0, to)?)
    }

    pub(super) fn remove(&self, name: &str) -> io::Result<()> {
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
    if stat.st_uid != geteuid().as_raw() {
        return Err(foreign(path));
    }
    if Mode::from_raw_mode(stat.st_mode).intersects(WRITABLE) {
        return Err(writable(path, "by its group or others", "go-w"));
    }
    Ok(())
}

fn foreign(path: &Path) -> io::Error {
    refusal(format!("{} belongs to another user", path.display()))
}

/// The refusal of a folder in which somebody else may write, and the command that ends that.
fn writable(path: &Path, by: &str, mode: &str) -> io::Error {
    let shown = path.display();
    let word = shell_path(&shown.to_string());
    refusal(format!("{shown} is writable {by}: chmod {mode} {word}"))
}

/// Fails if somebody else could replace our folder. Group write permission is accepted: on many
/// systems each user has a group of their own.
fn check_around(stat: &Stat, path: &Path) -> io::Result<()> {
    let mode = Mode::from_raw_mode(stat.st_mode);
    if ![geteuid().as_raw(), 0].contains(&stat.st_uid) {
        return Err(foreign(path));
    }
    if mode.contains(Mode::WOTH) && !mode.contains(Mode::SVTX) {
        return Err(writable(path, "by others", "o-w"));
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

/// Adds the path to an error.
pub(super) fn at(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}
