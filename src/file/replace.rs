//! The one way in which files are written.

use std::fs::{self, File, Metadata, OpenOptions, Permissions};
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

/// Links followed before a chain of them counts as endless, as Linux does.
const MAX_LINKS: usize = 40;

/// Bytes handed to the system at once: pictures come in rows of a few hundred.
const CHUNK: usize = 1 << 18;

/// Replaces a file, or creates it, so that at every moment it holds either its old content or the
/// new one whole. Follows symbolic links; keeps mode, owner and extended attributes. A device or a
/// pipe, which has no content to keep, is written to.
///
/// A new file is written beside the old one, synced, and takes its name. Where that would break
/// a hard link or lose the owner, or where the directory can't be written to, the content is made
/// in memory and written over the old one, which is kept in a backup copy until the new one
/// is whole: only there can a sudden stop leave a half-written file, with the copy beside it or
/// in the directory for temporary files. A sudden stop may also leave a file
/// `.halflight-XXXXXX` behind.
pub fn replace(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    replace_if(path, write, || Ok(()))
}

/// As [`replace`], but asks `may` at the last moment, when the new content only has to take its
/// place: an error leaves the old file.
pub fn replace_if<E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    may: impl FnOnce() -> Result<(), E>,
) -> Result<(), E> {
    match Target::of(path)? {
        Target::New(path) => {
            let directory = directory_of(&path);
            write_and_rename(new_file(directory)?, &path, write, may)
        }
        Target::File(path, metadata) => match twin(&path, &metadata)? {
            Some(temporary) => write_and_rename(temporary, &path, write, may),
            None => overwrite(&path, write, may),
        },
        Target::Stream(path) => {
            may()?;
            let mut out = BufWriter::new(OpenOptions::new().write(true).open(path)?);
            write(&mut out)?;
            out.flush()?;
            Ok(())
        }
    }
}

/// Says why [`replace`] could not write to `path`, as far as that can be told without writing: to
/// be asked before long work whose outcome is to be written there.
pub fn check_target(path: &Path) -> io::Result<()> {
    match Target::of(path)? {
        Target::New(path) => {
            let directory = directory_of(&path);
            let found = fs::metadata(directory).map_err(|error| match error.kind() {
                io::ErrorKind::NotFound => io::Error::new(error.kind(), "no such folder"),
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
        Target::File(path, _) => OpenOptions::new().write(true).open(path).map(|_| ()),
        // Opening a pipe is noticed at its other end.
        Target::Stream(_) => Ok(()),
    }
}

/// What stands at the end of a path's links.
enum Target {
    New(PathBuf),
    File(PathBuf, Metadata),
    Stream(PathBuf),
}

impl Target {
    fn of(path: &Path) -> io::Result<Self> {
        match fs::metadata(path) {
            Ok(metadata) if metadata.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            Ok(metadata) if metadata.is_file() => Ok(Self::File(fs::canonicalize(path)?, metadata)),
            // By its own name: a pipe inherited as `/dev/stdout` has no other.
            Ok(_) => Ok(Self::Stream(path.to_owned())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                Ok(Self::New(end_of_links(path)?))
            }
            Err(error) => Err(error),
        }
    }
}

/// Where a chain of links that leads to no file ends.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
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

fn temporary(directory: &Path, permissions: Option<Permissions>) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".halflight-");
    if let Some(permissions) = permissions {
        builder.permissions(permissions);
    }
    builder.tempfile_in(directory).map_err(|error| {
        // The whole error names the temporary file, which nobody asked for.
        if is_refusal(&error) {
            error.kind().into()
        } else {
            error
        }
    })
}

/// An empty file with the mode that any new file gets.
fn new_file(directory: &Path) -> io::Result<NamedTempFile> {
    #[cfg(unix)]
    let permissions = {
        use std::os::unix::fs::PermissionsExt;
        // The kernel takes the process's mask off; asking for the mask would mean changing it.
        Some(Permissions::from_mode(0o666))
    };
    #[cfg(not(unix))]
    let permissions = None;
    temporary(directory, permissions)
}

/// An empty file beside `path` with its mode, owner and attributes, fit to take its name; `None`
/// if there can't be one.
fn twin(path: &Path, metadata: &Metadata) -> io::Result<Option<NamedTempFile>> {
    // A file that may not be written must not be replaced either, though its directory allows it.
    OpenOptions::new().write(true).open(path)?;
    if is_hard_linked(metadata) {
        return Ok(None);
    }
    match temporary(directory_of(path), None) {
        Ok(twin) => {
            let alike = take_after(path, metadata, twin.as_file()).is_ok();
            Ok(alike.then_some(twin))
        }
        Err(error) if is_refusal(&error) => Ok(None),
        Err(error) => Err(error),
    }
}

fn is_refusal(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem
    )
}

#[cfg(unix)]
fn is_hard_linked(metadata: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    1 < metadata.nlink()
}

#[cfg(not(unix))]
fn is_hard_linked(_metadata: &Metadata) -> bool {
    false
}

/// Gives a twin the owner, the attributes and the mode of the file at `path`.
fn take_after(path: &Path, metadata: &Metadata, twin: &File) -> io::Result<()> {
    #[cfg(unix)]
    {
        use rustix::fs::{Gid, Uid, fchown};
        use std::os::unix::fs::MetadataExt;
        let own = twin.metadata()?;
        if (own.uid(), own.gid()) != (metadata.uid(), metadata.gid()) {
            let owner = Uid::from_raw(metadata.uid());
            let group = Gid::from_raw(metadata.gid());
            fchown(twin, Some(owner), Some(group))?;
        }
    }
    #[cfg(any(target_os = "linux", target_vendor = "apple"))]
    copy_attributes(path, twin)?;
    #[cfg(not(any(target_os = "linux", target_vendor = "apple")))]
    let _ = path;
    // After the owner: changing that one clears bits of the mode.
    twin.set_permissions(metadata.permissions())
}

/// Copies extended attributes, which hold access lists too.
#[cfg(any(target_os = "linux", target_vendor = "apple"))]
fn copy_attributes(path: &Path, twin: &File) -> io::Result<()> {
    use rustix::fs::{XattrFlags, fsetxattr, getxattr, getxattr_query, listxattr, listxattr_query};

    // A file system that can't tell has none.
    let mut names = vec![0; listxattr_query(path).unwrap_or(0)];
    if names.is_empty() {
        return Ok(());
    }
    let length = listxattr(path, &mut names[..])?;
    for name in names[..length].split(|&byte| byte == 0) {
        if !name.is_empty() {
            let mut value = vec![0; getxattr_query(path, name)?];
            let length = getxattr(path, name, &mut value[..])?;
            fsetxattr(twin, name, &value[..length], XattrFlags::empty())?;
        }
    }
    Ok(())
}

fn write_and_rename<E: From<io::Error>>(
    temporary: NamedTempFile,
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    may: impl FnOnce() -> Result<(), E>,
) -> Result<(), E> {
    let mut out = BufWriter::with_capacity(CHUNK, temporary.as_file());
    write(&mut out)?;
    out.flush()?;
    drop(out);
    temporary.as_file().sync_all()?;
    may()?;
    temporary.persist(path).map_err(|error| error.error)?;
    sync_directory(directory_of(path));
    Ok(())
}

/// Makes a rename last through a power cut. Some file systems can't; the file is whole either way.
fn sync_directory(directory: &Path) {
    #[cfg(unix)]
    if let Ok(directory) = File::open(directory) {
        let _ = directory.sync_all();
    }
    #[cfg(not(unix))]
    let _ = directory;
}

fn overwrite<E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    may: impl FnOnce() -> Result<(), E>,
) -> Result<(), E> {
    let mut content = Vec::new();
    write(&mut content)?;
    let mut file = OpenOptions::new().read(true).write(true).open(path)?;
    let mut backup =
        temporary(directory_of(path), None).or_else(|_| temporary(&std::env::temp_dir(), None))?;
    io::copy(&mut file, backup.as_file_mut())?;
    backup.as_file().sync_all()?;
    may()?;
    put(&mut file, &content).or_else(|error| restore(&mut file, backup, error))?;
    Ok(())
}

/// Puts the content of a backup copy back after `error`; where that fails too, keeps the copy and
/// says where it is.
fn restore(file: &mut File, mut backup: NamedTempFile, error: io::Error) -> io::Result<()> {
    let mut original = Vec::new();
    let restored = backup
        .rewind()
        .and_then(|()| backup.read_to_end(&mut original))
        .and_then(|_| put(file, &original));
    if restored.is_ok() {
        return Err(error);
    }
    let (_, kept) = backup.keep().map_err(|failed| failed.error)?;
    Err(io::Error::other(format!(
        "{error}; the file is damaged, its old content is in {}",
        kept.display()
    )))
}

/// Makes `content` the whole content of a file. Cuts only at the end, so that the blocks of the
/// old content stay its own and it can be put back even on a full disk.
fn put(file: &mut File, content: &[u8]) -> io::Result<()> {
    file.seek(SeekFrom::Start(0))?;
    file.write_all(content)?;
    file.set_len(content.len() as u64)?;
    file.sync_all()
}
