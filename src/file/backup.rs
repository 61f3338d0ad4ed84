//! What a file held before it was written over, kept beside it until the new content is whole. The
//! copy's name says which file it is of: where the process is killed meanwhile, the copy is found.

use std::fmt::Display;
use std::fs::{self, DirEntry, File, Metadata};
use std::io::{self, Read, Seek};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::calls::call;
use super::lock::{Lock, lock};
use super::owner::{PREFIX, random};
use super::target::directory_of;
use super::temporary::{Access, Temporary, copy_all, is_refusal, sync_directory};

/// What follows the common beginning of names of temporary files.
const MARK: &str = "backup-";

/// How much of a file's name is part of the copy's, in bytes: names have 255 at most.
const NAME: usize = 180;

/// A copy of what a file held. It stays unless it is discarded.
#[derive(Debug)]
pub(super) struct Backup {
    path: PathBuf,
    copy: Temporary,
}

impl Backup {
    /// Copies what a file holds: into its folder, or else into the one for temporary files.
    pub(super) fn of(path: &Path, file: &File) -> io::Result<Self> {
        let beside = Self::in_folder(directory_of(path), path, file);
        beside.or_else(|first| {
            let folder = std::env::temp_dir();
            Self::in_folder(&folder, path, file).map_err(|second| {
                // A folder that can't be written to is why there is a copy at all.
                if is_refusal(&first) {
                    let shown = folder.display();
                    let reason = format!("no copy of it can be kept in {shown}: {second}");
                    io::Error::new(second.kind(), reason)
                } else {
                    first
                }
            })
        })
    }

    fn in_folder(folder: &Path, path: &Path, file: &File) -> io::Result<Self> {
        sweep(folder, path);
        let name = name_of(path, inode(&file.metadata()?));
        let path = folder.join(name);
        let mut copy = Temporary::new(folder, Access::Private)?;
        copy_all(file, copy.file())?;
        copy.sync()?;
        // Only a whole copy has a backup's name.
        copy.take_new_name(&path)?;
        sync_directory(folder);
        Ok(Self { path, copy })
    }

    /// What the file held.
    pub(super) fn content(&self) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let mut file = self.copy.file();
        call("seek", || file.rewind())?;
        call("read", || file.read_to_end(&mut bytes))?;
        Ok(bytes)
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Removes it. Where that fails it is at least empty, which stands for nothing.
    pub(super) fn discard(self) {
        let removed = call("unlink", || fs::remove_file(&self.path));
        if removed.is_err() {
            let _ = call("ftruncate", || self.copy.file().set_len(0));
        }
    }
}

/// The copies of what a file held before saves of it that were cut off.
pub fn backups(path: &Path) -> Vec<PathBuf> {
    let Ok(path) = fs::canonicalize(path) else {
        return Vec::new();
    };
    let beside = copies(directory_of(&path), &path);
    let elsewhere = copies(&std::env::temp_dir(), &path);
    let mut found: Vec<_> = beside.chain(elsewhere).collect();
    if found.is_empty() {
        // There hardly ever are any, and the file may be large.
        return found;
    }
    let content = super::read_bytes(&path, super::MAX_BYTES).unwrap_or_default();
    found.retain(|copy| !is_needless(copy, &content));
    found.sort();
    found.dedup();
    found
}

/// What is said of a copy that [`backups`] found of a file.
pub fn interruption(name: impl Display, copy: &Path) -> String {
    let copy = copy.display();
    // The copy outlives saves that are not interrupted: whether it is needed is not known here.
    format!(
        "a save of {name} was interrupted: the content before it is in {copy}; delete that if you \
         do not need it"
    )
}

/// Removes copies of what a file holds anyway.
fn sweep(folder: &Path, path: &Path) {
    let Ok(content) = super::read_bytes(path, super::MAX_BYTES) else {
        return;
    };
    for copy in copies(folder, path).filter(|copy| is_needless(copy, &content)) {
        let _ = fs::remove_file(copy);
    }
}

/// This user's copies of a file in a folder, but for those of saves under way. Beside the file they
/// bear its number or its name, for it may be known by another of its names now; elsewhere both. A
/// number is used again once its file is gone: whoever got it is younger than the copy.
fn copies(folder: &Path, path: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let beside = folder == directory_of(path);
    let metadata = fs::metadata(path).ok();
    let number = metadata.as_ref().map(inode);
    let born = metadata.and_then(|metadata| metadata.created().ok());
    let named = shown_name(path);
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .filter(move |entry| {
            let copy = entry.file_name();
            let copy = copy.to_string_lossy();
            parts(&copy).is_some_and(|(inode, name)| {
                let is_number = number == Some(inode) && !is_older(entry, born);
                let is_name = name == named;
                is_number && is_name || beside && (is_number || is_name)
            })
        })
        .map(|entry| entry.path())
        .filter(|copy| is_own(copy) && !is_at_work(copy))
}

/// Whether a copy was finished before a file was made, as far as that can be told.
fn is_older(copy: &DirEntry, born: Option<SystemTime>) -> bool {
    let finished = copy.metadata().and_then(|copy| copy.modified()).ok();
    finished
        .zip(born)
        .is_some_and(|(finished, born)| finished < born)
}

/// Whether a copy holds nothing that is not in the file.
fn is_needless(copy: &Path, content: &[u8]) -> bool {
    super::read_bytes(copy, super::MAX_BYTES).is_ok_and(|held| held.is_empty() || held == content)
}

fn is_at_work(copy: &Path) -> bool {
    super::open(copy).is_ok_and(|file| lock(&file) == Lock::Busy)
}

/// Whether this user has made it.
fn is_own(copy: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let user = rustix::process::geteuid().as_raw();
        copy.symlink_metadata()
            .is_ok_and(|metadata| metadata.uid() == user)
    }
    #[cfg(not(unix))]
    {
        let _ = copy;
        true
    }
}

fn name_of(path: &Path, inode: u64) -> String {
    let (random, name) = (random(), shown_name(path));
    format!("{PREFIX}{MARK}{inode:x}-{random:08x}-{name}")
}

/// The inode and the name of the file that a copy of this name is of.
fn parts(name: &str) -> Option<(u64, &str)> {
    let rest = name.strip_prefix(PREFIX)?.strip_prefix(MARK)?;
    let mut parts = rest.splitn(3, '-');
    let inode = u64::from_str_radix(parts.next()?, 16).ok()?;
    parts.next()?;
    Some((inode, parts.next()?))
}

/// A file's name, as much of it as there is room for.
fn shown_name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let end = (0..=NAME.min(name.len())).rfind(|&at| name.is_char_boundary(at));
    name[..end.unwrap_or(0)].to_owned()
}

/// The file's number on its file system, the same for all its names.
fn inode(metadata: &Metadata) -> u64 {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        metadata.ino()
    }
    #[cfg(not(unix))]
    {
        let _ = metadata;
        0
    }
}
