//! Backup copies of files that are overwritten in place, kept until the new content is complete. A
//! copy's name identifies its file, so that the copy is found again if the process is killed.

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

/// Marks backups; follows the prefix of all temporary files.
const MARK: &str = "backup-";

/// How many bytes of the file's name the copy's name contains; names have at most 255.
const NAME: usize = 180;

/// A copy of a file's previous content. It remains unless discarded.
#[derive(Debug)]
pub(super) struct Backup {
    path: PathBuf,
    copy: Temporary,
}

impl Backup {
    /// Copies a file's content into its folder, or failing that into the system's temporary folder.
    pub(super) fn of(path: &Path, file: &File) -> io::Result<Self> {
        let beside = Self::in_folder(directory_of(path), path, file);
        beside.or_else(|first| {
            let folder = std::env::temp_dir();
            Self::in_folder(&folder, path, file).map_err(|second| {
                // Overwriting in place may be necessary just because the folder is not writable.
                if is_refusal(&first) {
                    let shown = folder.display();
                    let reason = format!("cannot back it up in {shown}: {second}");
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
        // Only a complete copy gets the name of a backup.
        copy.take_new_name(&path)?;
        sync_directory(folder);
        Ok(Self { path, copy })
    }

    /// Reads the copied content.
    pub(super) fn content(&self) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let mut file = self.copy.file();
        call("seek", || file.rewind())?;
        call("read", || file.read_to_end(&mut bytes))?;
        Ok(bytes)
    }

    /// The path of the copy.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Removes the copy, or if that fails, empties it: empty copies are ignored.
    pub(super) fn discard(self) {
        let removed = call("unlink", || fs::remove_file(&self.path));
        if removed.is_err() {
            let _ = call("ftruncate", || self.copy.file().set_len(0));
        }
    }
}

/// The backup copies of a file that interrupted saves left behind.
pub fn backups(path: &Path) -> Vec<PathBuf> {
    let Ok(path) = fs::canonicalize(path) else {
        return Vec::new();
    };
    let beside = copies(directory_of(&path), &path);
    let elsewhere = copies(&std::env::temp_dir(), &path);
    let mut found: Vec<_> = beside.chain(elsewhere).collect();
    if found.is_empty() {
        // The usual case; the file may be large.
        return found;
    }
    let content = super::read_bytes(&path, super::MAX_BYTES).unwrap_or_default();
    found.retain(|copy| !is_needless(copy, &content));
    found.sort();
    found.dedup();
    found
}

/// The message about a backup copy that [`backups`] found.
pub fn interruption(name: impl Display, copy: &Path) -> String {
    let copy = copy.display();
    // The copy survives later, complete saves: whether it is still needed is not known here.
    format!(
        "a save of {name} was interrupted: the previous content is in {copy}; delete that file if \
         you do not need it"
    )
}

/// Removes backup copies that equal the file's content.
fn sweep(folder: &Path, path: &Path) {
    let Ok(content) = super::read_bytes(path, super::MAX_BYTES) else {
        return;
    };
    for copy in copies(folder, path).filter(|copy| is_needless(copy, &content)) {
        let _ = fs::remove_file(copy);
    }
}

/// This user's backup copies of a file in a folder, except those of saves in progress. In the
/// file's own folder, inode or name must match, for the file may have several names; elsewhere,
/// both. Inodes are reused after a file is deleted: the new file is then younger than the copy.
fn copies(folder: &Path, path: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let beside = folder == directory_of(path);
    let metadata = fs::metadata(path).ok();
    let own_inode = metadata.as_ref().map(inode);
    let born = metadata.and_then(|metadata| metadata.created().ok());
    let own_name = shown_name(path);
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .filter(move |entry| {
            let copy = entry.file_name();
            let copy = copy.to_string_lossy();
            parts(&copy).is_some_and(|(inode, name)| {
                let same_inode = own_inode == Some(inode) && !is_older(entry, born);
                let same_name = name == own_name;
                same_inode && same_name || beside && (same_inode || same_name)
            })
        })
        .map(|entry| entry.path())
        .filter(|copy| super::is_own(copy) && !is_in_use(copy))
}

/// Whether a copy was finished before a file was created. False if the times are not known.
fn is_older(copy: &DirEntry, born: Option<SystemTime>) -> bool {
    let finished = copy.metadata().and_then(|copy| copy.modified()).ok();
    finished
        .zip(born)
        .is_some_and(|(finished, born)| finished < born)
}

/// Whether a copy is empty or equals the file's content.
fn is_needless(copy: &Path, content: &[u8]) -> bool {
    super::read_bytes(copy, super::MAX_BYTES).is_ok_and(|held| held.is_empty() || held == content)
}

fn is_in_use(copy: &Path) -> bool {
    super::open(copy).is_ok_and(|file| lock(&file) == Lock::Busy)
}

fn name_of(path: &Path, inode: u64) -> String {
    let (random, name) = (random(), shown_name(path));
    format!("{PREFIX}{MARK}{inode:x}-{random:08x}-{name}")
}

/// Parses a copy's name into the inode and the name of its file.
fn parts(name: &str) -> Option<(u64, &str)> {
    let rest = name.strip_prefix(PREFIX)?.strip_prefix(MARK)?;
    let mut parts = rest.splitn(3, '-');
    let inode = u64::from_str_radix(parts.next()?, 16).ok()?;
    parts.next()?;
    Some((inode, parts.next()?))
}

/// A file's name, truncated to [`NAME`] bytes.
fn shown_name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let end = (0..=NAME.min(name.len())).rfind(|&at| name.is_char_boundary(at));
    name[..end.unwrap_or(0)].to_owned()
}

/// The inode, which is the same for all hard links.
fn inode(metadata: &Metadata) -> u64 {
    use std::os::unix::fs::MetadataExt;
    metadata.ino()
}
