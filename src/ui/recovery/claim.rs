//! Journals that no other process uses: claimed by a lock that ends with the process at the latest.

use std::fs::File;
use std::io;
use std::sync::Arc;

use super::folder::Folder;
use super::identity::Identity;

/// A journal's file, locked.
#[derive(Debug)]
pub struct Claim {
    folder: Arc<Folder>,
    name: String,
    file: File,
}

impl Claim {
    /// Makes an empty file under the first name that is free.
    pub(super) fn new(folder: &Arc<Folder>, scene: &Identity) -> io::Result<Self> {
        for name in scene.names() {
            match folder.create(&name) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
                Ok(file) => {
                    // A process that looks for journals may have taken it for one left behind.
                    if lock(&file) && is_named(&file)? {
                        return Ok(Self {
                            folder: Arc::clone(folder),
                            name,
                            file,
                        });
                    }
                }
            }
        }
        Err(io::Error::other("too many journals of the scene"))
    }

    /// Claims a file that an earlier run left behind; `None` if there is none.
    pub(super) fn take(folder: &Arc<Folder>, name: String) -> Option<Self> {
        let file = folder.open(&name).ok()?;
        // Once it is locked, no process gives its name to another file. It may have lost it before.
        (lock(&file) && is_named(&file).ok()?).then(|| Self {
            folder: Arc::clone(folder),
            name,
            file,
        })
    }

    /// Its name.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The file.
    pub(super) fn file(&self) -> &File {
        &self.file
    }

    /// Whether the file can still be found by its name.
    pub(super) fn is_there(&self) -> bool {
        is_named(&self.file).unwrap_or(false)
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

    /// Removes the file.
    pub(super) fn remove(&self) -> io::Result<()> {
        if self.is_there() {
            self.folder.remove(&self.name)?;
        }
        Ok(())
    }

    /// Gives the file a name that it is not looked for under; where it is then.
    pub(super) fn set_aside(&self) -> io::Result<std::path::PathBuf> {
        let name = format!("{}.damaged", self.name);
        self.folder.rename(&self.name, &name)?;
        Ok(self.folder.place(&name))
    }
}

fn write(mut file: &File, content: &[u8]) -> io::Result<()> {
    io::Write::write_all(&mut file, content)?;
    file.sync_all()
}

/// Locks a file until it is closed; `false` if another run has the lock. Where files can't be locked,
/// no run is known to go on.
fn lock(file: &File) -> bool {
    #[cfg(unix)]
    {
        use rustix::fs::{FlockOperation, flock};
        use rustix::io::Errno;
        flock(file, FlockOperation::NonBlockingLockExclusive) != Err(Errno::WOULDBLOCK)
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        true
    }
}

/// Whether a file has a name.
fn is_named(file: &File) -> io::Result<bool> {
    #[cfg(unix)]
    {
        Ok(std::os::unix::fs::MetadataExt::nlink(&file.metadata()?) != 0)
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        Ok(true)
    }
}
