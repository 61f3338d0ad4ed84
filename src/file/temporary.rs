//! Temporary files that hold new content until they take their final name.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use super::alike::take_after;
use super::calls::{CheckedWriter, call};
use super::lock::{Lock, lock};
use super::owner::{sweep, temporary_name};

/// The number of attempts to find an unused name.
const ATTEMPTS: usize = 16;

/// The permissions of a new file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Access {
    /// As the process's umask allows.
    AsUsual,
    /// Accessible only to its owner.
    Private,
}

/// A file that is deleted when dropped, unless it has taken a final name. Has no name at all if the
/// file system supports that: then not even a killed process leaves it behind.
#[derive(Debug)]
pub(super) struct Temporary {
    file: File,
    folder: PathBuf,
    /// Its temporary name, if it has one.
    name: Option<PathBuf>,
}

impl Temporary {
    /// Creates an empty file in a folder and removes the orphaned ones there.
    pub(super) fn new(folder: &Path, access: Access) -> io::Result<Self> {
        sweep(folder);
        match unnamed(folder, access) {
            Some(unnamed) => unnamed,
            None => Self::named(folder, access),
        }
    }

    fn named(folder: &Path, access: Access) -> io::Result<Self> {
        for _ in 0..ATTEMPTS {
            let name = folder.join(temporary_name());
            let made = call("create", || options(access).create_new(true).open(&name));
            let file = match made {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
                made => made?,
            };
            let named = Self {
                file,
                folder: folder.to_owned(),
                name: Some(name),
            };
            // Before it was locked, another writer may have taken it for an orphan.
            if lock(&named.file) != Lock::Busy && !is_gone(&named.file) {
                return Ok(named);
            }
        }
        Err(io::ErrorKind::AlreadyExists.into())
    }

    /// The open file.
    pub(super) fn file(&self) -> &File {
        &self.file
    }

    /// A writer to the file.
    pub(super) fn content(&self) -> CheckedWriter<&File> {
        CheckedWriter(&self.file)
    }

    /// Makes the content durable across a power cut.
    pub(super) fn sync(&self) -> io::Result<()> {
        call("fsync", || self.file.sync_all())
    }

    /// Takes an unused name. Fails with [`io::ErrorKind::AlreadyExists`] if it is in use.
    pub(super) fn take_new_name(&mut self, path: &Path) -> io::Result<()> {
        if self.name.is_none() {
            match self.link(path) {
                Err(error) if is_unlinkable(&error) => self.take_temporary_name()?,
                linked => return linked,
            }
        }
        if let Some(name) = &self.name {
            call("rename", || rename_to_new(name, path))?;
            self.name = None;
        }
        Ok(())
    }

    /// Takes a name and replaces the file that has it.
    pub(super) fn take_name(&mut self, path: &Path) -> io::Result<()> {
        if self.name.is_none() {
            self.take_temporary_name()?;
        }
        if let Some(name) = &self.name {
            call("rename", || fs::rename(name, path))?;
            self.name = None;
        }
        Ok(())
    }

    /// Gives an unnamed file a temporary name. If that is not possible, copies it to a named file.
    #[cfg(target_os = "linux")]
    fn take_temporary_name(&mut self) -> io::Result<()> {
        let name = self.folder.join(temporary_name());
        match self.link(&name) {
            Ok(()) => self.name = Some(name),
            Err(error) if is_unlinkable(&error) => {
                let copy = Self::named(&self.folder, Access::Private)?;
                copy_all(&self.file, &copy.file)?;
                take_after(&place_of(&self.file), &self.file.metadata()?, &copy.file)?;
                copy.sync()?;
                *self = copy;
            }
            Err(error) => return Err(error),
        }
        Ok(())
    }

    #[cfg(not(target_os = "linux"))]
    fn take_temporary_name(&mut self) -> io::Result<()> {
        Err(io::ErrorKind::Unsupported.into())
    }

    /// Gives an unnamed file an unused name.
    #[cfg(target_os = "linux")]
    fn link(&self, path: &Path) -> io::Result<()> {
        use rustix::fs::{AtFlags, CWD, linkat};
        let open = place_of(&self.file);
        call("link", || {
            Ok(linkat(CWD, &open, CWD, path, AtFlags::SYMLINK_FOLLOW)?)
        })
    }

    #[cfg(not(target_os = "linux"))]
    fn link(&self, _path: &Path) -> io::Result<()> {
        Err(io::ErrorKind::Unsupported.into())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(name) = &self.name {
            // If this fails, a later sweep removes it.
            let _ = call("unlink", || fs::remove_file(name));
        }
    }
}

/// Appends all of one file's content to another.
pub(super) fn copy_all(mut from: &File, to: &File) -> io::Result<()> {
    use std::io::{Read, Seek, Write};
    let mut bytes = Vec::new();
    call("seek", || from.rewind())?;
    call("read", || from.read_to_end(&mut bytes))?;
    CheckedWriter(to).write_all(&bytes)
}

/// Makes a new name durable. Some file systems cannot; the file is complete either way.
pub(super) fn sync_directory(directory: &Path) {
    if let Ok(directory) = File::open(directory) {
        let _ = call("fsync", || directory.sync_all());
    }
}

/// Whether an error means that a folder is not writable.
pub(super) fn is_refusal(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem
    )
}

fn options(access: Access) -> OpenOptions {
    let mut options = OpenOptions::new();
    options.read(true).write(true);
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, mode(access));
    options
}

/// The mode to request. The kernel applies the umask, which cannot be read without changing it.
fn mode(access: Access) -> u32 {
    match access {
        Access::AsUsual => 0o666,
        Access::Private => 0o600,
    }
}

/// Creates an unnamed file. Returns `None` if the system has none, or none that can be named later.
#[cfg(target_os = "linux")]
fn unnamed(folder: &Path, access: Access) -> Option<io::Result<Temporary>> {
    use rustix::fs::{CWD, Mode, OFlags, openat};
    use rustix::io::Errno;
    let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
    let mode = Mode::from_raw_mode(mode(access));
    let opened = call("create", || Ok(openat(CWD, folder, flags, mode)?));
    let file = match opened {
        Ok(opened) => File::from(opened),
        Err(error) => {
            let errno = Errno::from_io_error(&error);
            let is_unknown = matches!(
                errno,
                Some(Errno::OPNOTSUPP | Errno::ISDIR | Errno::INVAL | Errno::NOSYS)
            );
            return (!is_unknown).then_some(Err(error));
        }
    };
    // The lock marks the file as in use from the moment it gets a name.
    lock(&file);
    let temporary = Temporary {
        file,
        folder: folder.to_owned(),
        name: None,
    };
    place_of(&temporary.file).exists().then_some(Ok(temporary))
}

#[cfg(not(target_os = "linux"))]
fn unnamed(_folder: &Path, _access: Access) -> Option<io::Result<Temporary>> {
    None
}

/// The path under which the kernel exposes an open file.
#[cfg(target_os = "linux")]
fn place_of(file: &File) -> PathBuf {
    use std::os::fd::AsRawFd;
    PathBuf::from(format!("/proc/self/fd/{}", file.as_raw_fd()))
}

/// Whether an error means that this file system or process cannot name an unnamed file.
fn is_unlinkable(error: &io::Error) -> bool {
    use rustix::io::Errno;
    let errno = Errno::from_io_error(error);
    matches!(
        errno,
        Some(Errno::OPNOTSUPP | Errno::PERM | Errno::XDEV | Errno::NOSYS | Errno::MLINK)
    ) || error.kind() == io::ErrorKind::Unsupported
}

/// Renames a file unless the new name is in use; atomically if the file system supports that.
fn rename_to_new(from: &Path, to: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    use rustix::io::Errno;
    match renameat_with(CWD, from, CWD, to, RenameFlags::NOREPLACE) {
        Err(Errno::INVAL | Errno::NOSYS | Errno::OPNOTSUPP) => {}
        renamed => return Ok(renamed?),
    }
    if to.symlink_metadata().is_ok() {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    fs::rename(from, to)
}

fn is_gone(file: &File) -> bool {
    use std::os::unix::fs::MetadataExt;
    file.metadata().is_ok_and(|metadata| metadata.nlink() == 0)
}
