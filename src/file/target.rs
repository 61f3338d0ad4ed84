//! What stands where something is to be written.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use super::calls::call;
use super::{kind, without_waiting};

/// Links followed before a chain of them counts as endless, as Linux does.
const MAX_LINKS: usize = 40;

/// What stands at the end of a path's links.
#[derive(Debug)]
pub(super) enum Target {
    /// Nothing, in this place.
    New(PathBuf),
    /// A file that may be written.
    File(PathBuf, Metadata),
    /// What holds no content: a pipe or a device, and which of them.
    Stream(PathBuf, &'static str),
}

impl Target {
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        match fs::metadata(path) {
            Ok(metadata) if metadata.is_dir() => Err(not_a_file("a folder")),
            Ok(metadata) if metadata.is_file() => {
                let path = fs::canonicalize(path)?;
                let mut options = OpenOptions::new();
                // A file that may not be written must not be replaced either, though its folder
                // allows it.
                let file = open(options.write(true), &path)?;
                Ok(Self::File(path, file.metadata()?))
            }
            // By its own name: a pipe inherited as `/dev/stdout` has no other.
            Ok(metadata) => Ok(Self::Stream(path.to_owned(), kind(metadata.file_type()))),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                Ok(Self::New(end_of_links(path)?))
            }
            Err(error) => Err(error),
        }
    }
}

/// Opens a regular file as `options` say. Never waits: what takes the file's place meanwhile may be
/// a pipe.
pub(super) fn open(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    let file = call("open", || without_waiting(options).open(path))?;
    let file_type = file.metadata()?.file_type();
    if file_type.is_file() {
        Ok(file)
    } else {
        Err(not_a_file(kind(file_type)))
    }
}

/// That content which is to last can't be put there.
pub(super) fn not_a_file(kind: &str) -> io::Error {
    let reason = format!("is {kind}, not a file");
    io::Error::new(io::ErrorKind::InvalidInput, reason)
}

/// Says why [`deliver`](super::deliver) could not write to `path`, as far as that can be told
/// without writing: to be asked before long work whose outcome is to be written there.
pub fn check_target(path: &Path) -> io::Result<()> {
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
            #[cfg(unix)]
            {
                use rustix::fs::{Access, access};
                access(directory, Access::WRITE_OK | Access::EXEC_OK)?;
            }
            Ok(())
        }
        // Opening a pipe is noticed at its other end.
        Target::File(..) | Target::Stream(..) => Ok(()),
    }
}

/// That a folder in which something is to be written is not there.
pub fn no_such_folder(folder: &Path) -> io::Error {
    // Shells have taught that it is the home folder.
    let is_home_meant = folder.as_os_str().as_encoded_bytes().starts_with(b"~");
    let reason = if is_home_meant {
        "no such folder; only shells expand ~"
    } else {
        "no such folder"
    };
    io::Error::new(io::ErrorKind::NotFound, reason)
}

/// Says what stands at `path` if [`replace`](super::replace()) can't write there: a folder, a pipe, a
/// device, a file that may not be written.
pub fn check_replaceable(path: &Path) -> io::Result<()> {
    match Target::of(path)? {
        Target::Stream(_, kind) => Err(not_a_file(kind)),
        Target::New(_) | Target::File(..) => Ok(()),
    }
}

/// Where a chain of links that leads to no file ends.
pub(crate) fn end_of_links(path: &Path) -> io::Result<PathBuf> {
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

/// The directory that holds a path's last name.
pub fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}
