//! Detects changes of a file without reading it.

use std::fs::{self, File, Metadata};
use std::io;
use std::os::unix::fs::MetadataExt;
use std::path::Path;
use std::time::SystemTime;

/// The identity of a file or folder, independent of its names and content: its device and inode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileId((u64, u64));

impl FileId {
    /// The identity of what a path refers to, following links; `None` if it does not exist.
    pub fn of(path: &Path) -> Option<Self> {
        let metadata = fs::metadata(path).ok()?;
        Some(Self((metadata.dev(), metadata.ino())))
    }

    /// The identity of an open file.
    pub(super) fn of_file(file: &File) -> Option<Self> {
        let metadata = file.metadata().ok()?;
        Some(Self((metadata.dev(), metadata.ino())))
    }
}

/// The state of a file at one moment. Two versions are equal only if the file was neither replaced
/// nor written to in between, within the resolution of the file system's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Version {
    length: u64,
    /// When the content was last written; writers can set this back.
    modified: Option<SystemTime>,
    node: FileIdentity,
}

/// The attributes that only the file system sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct FileIdentity {
    device: u64,
    inode: u64,
    /// The time of the last change to content, name or owner, in seconds and nanoseconds.
    changed: (i64, i64),
}

impl Version {
    /// The version of the file that a path refers to, following links.
    pub fn of(path: &Path) -> io::Result<Self> {
        fs::metadata(path).map(|metadata| Self::of_metadata(&metadata))
    }

    pub(super) fn of_metadata(metadata: &Metadata) -> Self {
        Self {
            length: metadata.len(),
            modified: metadata.modified().ok(),
            node: FileIdentity {
                device: metadata.dev(),
                inode: metadata.ino(),
                changed: (metadata.ctime(), metadata.ctime_nsec()),
            },
        }
    }
}
