//! Whether a file is still the one that was seen before, without reading it.

use std::fs::{self, Metadata};
use std::io;
use std::path::Path;
use std::time::SystemTime;

/// Which file or folder it is, whatever its names and its content.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileId(
    /// The device and the inode.
    #[cfg(unix)]
    (u64, u64),
    #[cfg(not(unix))] std::path::PathBuf,
);

impl FileId {
    /// That of what is at the end of a path's links; `None` if that is nothing.
    pub fn of(path: &Path) -> Option<Self> {
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt;
            let metadata = fs::metadata(path).ok()?;
            Some(Self((metadata.dev(), metadata.ino())))
        }
        #[cfg(not(unix))]
        fs::canonicalize(path).ok().map(Self)
    }
}

/// A file at one moment. Two versions are equal only if no other file took its place and nobody
/// wrote to it in between, as far as the file system's clock tells moments apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Version {
    length: u64,
    /// When the content was last written; whoever writes may set this back.
    modified: Option<SystemTime>,
    #[cfg(unix)]
    node: Node,
}

/// What only the file system sets.
#[cfg(unix)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Node {
    device: u64,
    inode: u64,
    /// Seconds and nanoseconds of the last change to content, name or owner.
    changed: (i64, i64),
}

impl Version {
    /// The version of the file at the end of a path's links.
    pub fn of(path: &Path) -> io::Result<Self> {
        fs::metadata(path).map(|metadata| Self::of_metadata(&metadata))
    }

    pub(super) fn of_metadata(metadata: &Metadata) -> Self {
        #[cfg(unix)]
        use std::os::unix::fs::MetadataExt;
        Self {
            length: metadata.len(),
            modified: metadata.modified().ok(),
            #[cfg(unix)]
            node: Node {
                device: metadata.dev(),
                inode: metadata.ino(),
                changed: (metadata.ctime(), metadata.ctime_nsec()),
            },
        }
    }
}
