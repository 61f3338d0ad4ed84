//! Journals that no other process uses: claimed by a lock that ends with the process at the latest.

use std::fs::File;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use super::folder::Folder;
use super::identity::Identity;
use crate::file::{Lock, lock};

/// The most damaged journals of one name.
const MOST_DAMAGED: u32 = 1000;

/// A journal's file, locked.
#[derive(Debug)]
pub struct Claim {
    folder: Arc<Folder>,
    name: String,
    file: File,
    /// Whether it may hold more than what can be read of it.
    is_damaged: bool,
}

impl Claim {
    /// Makes an empty file under the first name that is free.
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
                    // A process that looks for journals may have taken it for one left behind.
                    if lock(&claim.file) != Lock::Busy && claim.is_there() {
                        return Ok(claim);
                    }
                }
            }
        }
        Err(io::Error::other("too many journals of the scene"))
    }

    /// Claims a file that an earlier run left behind; `None` if there is none. An error if there is
    /// something else, or its run may go on: where files can't be locked, it can't be told.
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
            // Once it is locked, nobody gives its name to another file. It may have lost it before.
            Lock::Taken => Ok(claim.is_there().then_some(claim)),
            Lock::Busy => Ok(None),
            Lock::Unknown => {
                let place = claim.place();
                let reason = format!(
                    "{} may belong to a window that is still open: its file system has no locks",
                    place.display()
                );
                Err(io::Error::new(io::ErrorKind::Unsupported, reason))
            }
        }
    }

    /// Its name.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The file.
    pub(super) fn file(&self) -> &File {
        &self.file
    }

    /// Where it is.
    pub(super) fn place(&self) -> PathBuf {
        self.folder.place(&self.name)
    }

    /// Whether the file still has its name in the folder.
    pub(super) fn is_there(&self) -> bool {
        self.folder.has(&self.name, &self.file).unwrap_or(false)
    }

    /// Whether the file is as long as it was left, and still nobody else's.
    pub(super) fn is_as_left(&self, length: u64) -> bool {
        let found = self.file.metadata();
        found.is_ok_and(|found| found.len() == length && Folder::refusal(&found).is_none())
    }

    /// The same, known to hold more than what can be read of it.
    pub(super) fn damaged(self) -> Self {
        Self {
            is_damaged: true,
            ..self
        }
    }

    /// Whether it may hold more than what can be read of it.
    pub(super) fn is_damaged(&self) -> bool {
        self.is_damaged
    }

    /// Puts another content in place of the file's: at every moment one of the two is there whole.
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

    /// Fills the file, which is empty and new.
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

    /// Gives the file a name that it is not looked for under, and nothing else has; where it is then.
    pub(super) fn set_aside(&self) -> io::Result<PathBuf> {
        let name = |number: u32| match number {
            1 => format!("{}.damaged", self.name),
            _ => format!("{}.damaged-{number}", self.name),
        };
        // Only who has the claim gives out these names.
        let free = (1..MOST_DAMAGED)
            .map(name)
            .find(|name| !self.folder.holds(name));
        let name = free.ok_or(io::ErrorKind::AlreadyExists)?;
        self.folder.rename(&self.name, &name)?;
        Ok(self.folder.place(&name))
    }
}

fn write(mut file: &File, content: &[u8]) -> io::Result<()> {
    io::Write::write_all(&mut file, content)?;
    file.sync_all()
}
