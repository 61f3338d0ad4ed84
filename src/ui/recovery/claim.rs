//! Journals claimed for one process by a lock, which ends with the process at the latest.

use std::fs::File;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use super::identity::Identity;
use file::state_folder::Folder;
use file::{Lock, lock};

/// The maximum number of damaged journals with one name.
const MOST_DAMAGED: u32 = 1000;

/// A locked journal file.
#[derive(Debug)]
pub struct Claim {
    folder: Arc<Folder>,
    name: String,
    file: File,
    /// Whether it may hold more than can be read.
    is_damaged: bool,
}

impl Claim {
    /// Creates an empty file under the first free name.
    pub(super) fn new(folder: &Arc<Folder>, scene: &Identity) -> io::Result<Self> {
        for name in scene.names() {
            match folder.create(&name) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
                Ok(file) => {
                    let claim = Self {
                        folder: Arc::clone(folder),
                        name,
                        file,
                        is_damaged: false,
                    };
                    // Another process may have claimed it, taking it for one left behind.
                    if lock(&claim.file) != Lock::Busy && claim.is_there() {
                        return Ok(claim);
                    }
                }
            }
        }
        Err(io::Error::other("too many journals of the scene"))
    }

    /// Claims a file that an earlier run left behind; `None` if it is missing or in use. Fails
    /// unless it is a regular file of our own, and without file locks, as its run may go on.
    pub(super) fn take(folder: &Arc<Folder>, name: String) -> io::Result<Option<Self>> {
        let Some(file) = folder.open(&name)? else {
            return Ok(None);
        };
        let claim = Self {
            folder: Arc::clone(folder),
            name,
            file,
            is_damaged: false,
        };
        match lock(&claim.file) {
            // A locked file's name is not given to another file, but it may have lost it before.
            Lock::Taken => Ok(claim.is_there().then_some(claim)),
            Lock::Busy => Ok(None),
            Lock::Unknown => {
                let reason =
                    "may belong to a window that is still open: its file system has no locks";
                let reason = format!("{} {reason}", claim.place().display());
                Err(io::Error::new(io::ErrorKind::Unsupported, reason))
            }
        }
    }

    /// The name of the journal.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The open file.
    pub(super) fn file(&self) -> &File {
        &self.file
    }

    /// The path of the file.
    pub(super) fn place(&self) -> PathBuf {
        self.folder.place(&self.name)
    }

    /// Whether the file still has its name in the folder.
    pub(super) fn is_there(&self) -> bool {
        self.folder.has(&self.name, &self.file).unwrap_or(false)
    }

    /// Whether the file still has this length and belongs to nobody else.
    pub(super) fn is_as_left(&self, length: u64) -> bool {
        let found = self.file.metadata();
        found.is_ok_and(|found| found.len() == length && Folder::refusal(&found).is_none())
    }

    /// Marks it as holding more than can be read.
    pub(super) fn damaged(mut self) -> Self {
        self.is_damaged = true;
        self
    }

    /// Whether it may hold more than can be read.
    pub(super) fn is_damaged(&self) -> bool {
        self.is_damaged
    }

    /// Replaces the content atomically: at any time the old or the new content is there in full.
    pub(super) fn replace(&mut self, content: &[u8]) -> io::Result<()> {
        let name = format!("{}.new", self.name);
        // Left behind by an earlier run under the same name, which is ours now.
        self.folder.remove(&name)?;
        let file = self.folder.create(&name)?;
        let written = write(&file, content).and_then(|()| {
            lock(&file);
            self.folder.rename(&name, &self.name)
        });
        if let Err(error) = written {
            let _ = self.folder.remove(&name);
            return Err(error);
        }
        self.file = file;
        self.folder.sync();
        Ok(())
    }

    /// Fills the file, which is new and empty.
    pub(super) fn fill(&self, content: &[u8]) -> io::Result<()> {
        write(&self.file, content)?;
        self.folder.sync();
        Ok(())
    }

    /// Removes the file, or sets it aside if it is damaged.
    pub(super) fn remove(&self) -> io::Result<()> {
        if self.is_there() {
            if self.is_damaged {
                self.set_aside()?;
            } else {
                self.folder.remove(&self.name)?;
            }
        }
        Ok(())
    }

    /// Gives the file an unused name that is not searched, and returns its new path.
    pub(super) fn set_aside(&self) -> io::Result<PathBuf> {
        let name = |number: u32| match number {
            1 => format!("{}.damaged", self.name),
            _ => format!("{}.damaged-{number}", self.name),
        };
        // Only the holder of the claim assigns these names.
        let mut names = (1..MOST_DAMAGED).map(name);
        let free = names.find(|name| !self.folder.holds(name));
        let name = free.ok_or(io::ErrorKind::AlreadyExists)?;
        self.folder.rename(&self.name, &name)?;
        Ok(self.folder.place(&name))
    }
}

impl Drop for Claim {
    /// Closing the file does not end its lock while a child process has a copy of it, until it runs
    /// its program.
    fn drop(&mut self) {
        let _ = self.file.unlock();
    }
}

fn write(mut file: &File, content: &[u8]) -> io::Result<()> {
    io::Write::write_all(&mut file, content)?;
    file.sync_all()
}

#[cfg(test)]
mod tests {
    use super::*;
    use file::state_folder::Store;
    use language::Language;

    #[test]
    fn a_claim_ends_despite_copies_of_its_file() {
        let state = tempfile::tempdir().expect("a folder");
        let folder = Arc::new(Folder::make(state.path(), Store::Edits).expect("a folder"));
        let scene = Identity::of(None, Language::Ray);
        let claim = Claim::new(&folder, &scene).expect("the name is free");
        let name = claim.name().to_owned();
        let copy = claim.file().try_clone().expect("a copy");
        let other = Claim::take(&folder, name.clone());
        assert!(other.expect("readable").is_none(), "it is in use");
        drop(claim);
        let other = Claim::take(&folder, name);
        assert!(other.expect("readable").is_some());
        drop(copy);
    }
}
