//! The one way in which files are written.

use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, BufWriter, Seek, Write};
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use super::alike::take_after;
use super::backup::Backup;
use super::calls::{Content, call};
use super::lock::{Lock, lock};
use super::stream;
use super::target::{Target, directory_of, not_a_file, open};
use super::temporary::{Access, Temporary, is_refusal, sync_directory};
use super::version::Version;

/// How long a file that another program has locked is waited for, and how often it is looked at.
const LOCK_PATIENCE: Duration = Duration::from_secs(1);
const LOCK_RETRY: Duration = Duration::from_millis(20);

/// Bytes handed to the system at once: pictures come in rows of a few hundred.
const CHUNK: usize = 1 << 18;

/// Replaces a file, or creates it, so that at every moment it holds either its old content or the
/// new one whole. Follows symbolic links; keeps mode, owner and extended attributes. What is not a
/// file is refused. A program that has locked a file which is written over in place is waited for, for
/// a second at most.
///
/// The content is written to a file without a name, or with a temporary one where the file system
/// has no such files, and synced; then it takes the name. `may` is asked at that moment: an error
/// leaves the old file. It is asked again where another file got the name meanwhile.
///
/// Where that would break a hard link or lose the owner, or where the folder can't be written to, the
/// content is made in memory and written over the old one, of which a copy is kept until the new one
/// is whole: only there can a sudden stop leave a half-written file. [`backups`](super::backups)
/// finds the copy. Temporary files that a sudden stop leaves behind are removed by the next write in
/// their folder.
pub fn replace<E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    may: impl Fn() -> Result<(), E>,
) -> Result<(), E> {
    match Target::of(path)? {
        Target::Stream(_, kind) => Err(not_a_file(kind).into()),
        target => put(&target, write, may).map(drop),
    }
}

/// As [`replace`], but a pipe or a device, which has no content to keep, is written to. A pipe that
/// nobody reads is an error. Returns the version of the file that was written, if it is one.
pub fn deliver<E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    may: impl Fn() -> Result<(), E>,
) -> Result<Option<Version>, E> {
    match Target::of(path)? {
        Target::Stream(path, _) => {
            may()?;
            let mut out = BufWriter::with_capacity(CHUNK, stream::open(&path)?);
            write(&mut out)?;
            out.flush()?;
            Ok(None)
        }
        target => put(&target, write, may),
    }
}

fn put<E: From<io::Error>>(
    target: &Target,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    may: impl Fn() -> Result<(), E>,
) -> Result<Option<Version>, E> {
    match target {
        Target::New(path) => {
            let new = Temporary::new(directory_of(path), Access::AsUsual)?;
            let mut new = filled(new, write)?;
            may()?;
            match new.take_new_name(path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                    may()?;
                    new.take_name(path)?;
                }
                taken => taken?,
            }
            let version = version_of(new.file());
            sync_directory(directory_of(path));
            Ok(version)
        }
        Target::File(path, metadata) => {
            let Some(twin) = twin(path, metadata)? else {
                return overwrite(path, write, may);
            };
            let mut twin = filled(twin, write)?;
            may()?;
            twin.take_name(path)?;
            let version = version_of(twin.file());
            sync_directory(directory_of(path));
            Ok(version)
        }
        Target::Stream(_, kind) => Err(not_a_file(kind).into()),
    }
}

/// The version of a file that has its name; none where the system can't tell.
fn version_of(file: &File) -> Option<Version> {
    let metadata = file.metadata().ok()?;
    Some(Version::of_metadata(&metadata))
}

/// A file with all of its content, which a power cut does not take.
fn filled(
    file: Temporary,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<Temporary> {
    let mut out = BufWriter::with_capacity(CHUNK, file.content());
    let written = write(&mut out).and_then(|()| out.flush());
    // What is left after an error is not written.
    let _ = out.into_parts();
    written?;
    file.sync()?;
    Ok(file)
}

/// An empty file beside `path` with its mode, owner and attributes, fit to take its name; `None`
/// if there can't be one.
fn twin(path: &Path, metadata: &Metadata) -> io::Result<Option<Temporary>> {
    if is_hard_linked(metadata) {
        return Ok(None);
    }
    match Temporary::new(directory_of(path), Access::Private) {
        Ok(twin) => {
            let alike = take_after(path, metadata, twin.file()).is_ok();
            Ok(alike.then_some(twin))
        }
        Err(error) if is_refusal(&error) => Ok(None),
        Err(error) => Err(error),
    }
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

fn overwrite<E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    may: impl Fn() -> Result<(), E>,
) -> Result<Option<Version>, E> {
    let mut content = Vec::new();
    write(&mut content)?;
    let file = open(OpenOptions::new().read(true).write(true), path)?;
    wait_for_others(&file)?;
    let backup = Backup::of(path, &file)?;
    if let Err(refused) = may() {
        backup.discard();
        return Err(refused);
    }
    let mut is_changed = false;
    match put_in_place(&file, &content, &mut is_changed) {
        Ok(()) => {
            backup.discard();
            Ok(version_of(&file))
        }
        Err(error) if is_changed => Err(restore(&file, backup, path, error).into()),
        Err(error) => {
            backup.discard();
            Err(error.into())
        }
    }
}

/// Waits until nobody else writes over a file, under whatever name; an error if that takes long.
fn wait_for_others(file: &File) -> io::Result<()> {
    // Elsewhere a lock would keep this process, too, from reading the file by its name.
    if cfg!(unix) {
        let give_up = Instant::now() + LOCK_PATIENCE;
        // Where files can't be locked, nobody is known to write.
        while lock(file) == Lock::Busy {
            if give_up < Instant::now() {
                return Err(io::Error::other("another program has it locked"));
            }
            thread::sleep(LOCK_RETRY);
        }
    }
    Ok(())
}

/// Puts the content of a backup back after an error, which is returned; where that fails too, the
/// copy stays and the error says first where it is.
fn restore(file: &File, backup: Backup, path: &Path, error: io::Error) -> io::Error {
    let old = backup.content();
    let restored = old.and_then(|old| put_in_place(file, &old, &mut false));
    if restored.is_ok() {
        backup.discard();
        return error;
    }
    let copy = backup.path();
    let beside = (directory_of(copy) == directory_of(path)).then(|| copy.file_name());
    let shown = beside.flatten().map_or(copy, Path::new).display();
    let reason = format!("the file is damaged, its previous content is in {shown}: {error}");
    io::Error::new(error.kind(), reason)
}

/// Makes `content` the whole content of a file, and notes from when on the old one may be gone. Cuts
/// only at the end, so that the blocks of the old content stay its own and it can be put back even on
/// a full disk.
fn put_in_place(mut file: &File, mut content: &[u8], is_changed: &mut bool) -> io::Result<()> {
    let length = content.len() as u64;
    call("seek", || file.rewind())?;
    while !content.is_empty() {
        match Content(file).write(content)? {
            0 => return Err(io::ErrorKind::WriteZero.into()),
            written => content = &content[written..],
        }
        *is_changed = true;
    }
    call("ftruncate", || file.set_len(length))?;
    *is_changed = true;
    call("fsync", || file.sync_all())
}
