//! Examines the path that a write goes to.

use std::ffi::OsString;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use super::calls::call;
use super::version::FileId;
use super::{kind, without_waiting};

/// The number of symbolic links followed before a chain counts as endless, as on Linux.
const MAX_LINKS: usize = 40;

/// What a path refers to after following its symbolic links.
#[derive(Debug)]
pub(super) enum Target {
    /// Nothing yet, at this path.
    New(PathBuf),
    /// A writable file.
    File(PathBuf, Metadata),
    /// A pipe or a device, which holds no content, and its type with an article.
    Stream(PathBuf, &'static str),
}

impl Target {
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        match fs::metadata(path) {
            Ok(metadata) if metadata.is_dir() => Err(not_a_file("a folder")),
            Ok(metadata) if metadata.is_file() => {
                let path = fs::canonicalize(path)?;
                let mut options = OpenOptions::new();
                // A read-only file must not be replaced either, even if its folder allows that.
                let file = open(options.write(true), &path)?;
                Ok(Self::File(path, file.metadata()?))
            }
            // Not canonicalized: a pipe inherited as `/dev/stdout` has no other name.
            Ok(metadata) => Ok(Self::Stream(path.to_owned(), kind(metadata.file_type()))),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                Ok(Self::New(end_of_links(path)?))
            }
            Err(error) => Err(error),
        }
    }
}

/// Opens a regular file with `options`. Never blocks, even if a pipe has taken the file's place.
pub(super) fn open(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    let file = call("open", || without_waiting(options).open(path))?;
    let file_type = file.metadata()?.file_type();
    if file_type.is_file() {
        Ok(file)
    } else {
        Err(not_a_file(kind(file_type)))
    }
}

/// The error for a target that cannot hold content.
pub(super) fn not_a_file(kind: &str) -> io::Error {
    let reason = format!("is {kind}, not a file");
    io::Error::new(io::ErrorKind::InvalidInput, reason)
}

/// Fails if [`deliver`](super::deliver) could not write to `path`, as far as that can be determined
/// without writing. Meant to be called before long work whose result goes there.
pub fn check_target(path: &Path) -> io::Result<()> {
    use rustix::fs::{Access, access};
    match Target::of(path)? {
        Target::New(path) => {
            let directory = directory_of(&path);
            let found = fs::metadata(directory).map_err(|error| match error.kind() {
                io::ErrorKind::NotFound => no_such_folder(directory),
                _ => error,
            })?;
            if !found.is_dir() {
                return Err(io::ErrorKind::NotADirectory.into());
            }
            access(directory, Access::WRITE_OK | Access::EXEC_OK)?;
            Ok(())
        }
        // Not opened: a pipe's reader would notice.
        Target::File(..) | Target::Stream(..) => Ok(()),
    }
}

/// The error for a folder that does not exist; explains an unexpanded `~`.
pub fn no_such_folder(folder: &Path) -> io::Error {
    let is_home_meant = folder.as_os_str().as_encoded_bytes().starts_with(b"~");
    let reason = if is_home_meant {
        "no such folder; only shells expand ~"
    } else {
        "no such folder"
    };
    io::Error::new(io::ErrorKind::NotFound, reason)
}

/// Fails if [`replace`](super::replace()) could not write to `path`: if that is a folder, a pipe, a
/// device or a read-only file.
pub fn check_replaceable(path: &Path) -> io::Result<()> {
    match Target::of(path)? {
        Target::Stream(_, kind) => Err(not_a_file(kind)),
        Target::New(_) | Target::File(..) => Ok(()),
    }
}

/// The end of a chain of symbolic links that leads to no file.
pub fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    if path.file_name().is_none() {
        return Err(io::ErrorKind::NotFound.into());
    }
    let mut end = path.to_owned();
    for _ in 0..MAX_LINKS {
        match fs::read_link(&end) {
            Ok(next) => end = directory_of(&end).join(next),
            Err(_) => return Ok(end),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Whether writes to two paths go to the same file, also through hard or symbolic links, and also
/// where it does not exist yet.
pub fn is_same_target(one: &Path, other: &Path) -> bool {
    match [one, other].map(FileId::of) {
        [Some(one), Some(other)] => one == other,
        [None, None] => place(one).is_some_and(|found| place(other) == Some(found)),
        _ => false,
    }
}

/// The folder and the name of a file that does not exist yet.
fn place(path: &Path) -> Option<(FileId, OsString)> {
    let end = end_of_links(path).ok()?;
    let folder = FileId::of(directory_of(&end))?;
    Some((folder, end.file_name()?.to_owned()))
}

/// The parent directory of a path; `.` for a bare name.
pub fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}
