//! Writing files, atomically where possible: the only way in which the program writes them.

use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, BufWriter, Seek, Write};
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use super::alike::take_after;
use super::backup::Backup;
use super::calls::{CheckedWriter, call};
use super::lock::{Lock, lock};
use super::stream;
use super::target::{Target, directory_of, not_a_file, open};
use super::temporary::{Access, Temporary, is_refusal, sync_directory};
use super::version::{FileId, Version};

/// How long to wait for a file that another program has locked, and the interval between attempts.
const LOCK_PATIENCE: Duration = Duration::from_secs(1);
const LOCK_RETRY: Duration = Duration::from_millis(20);

/// The size of the write buffer in bytes: pictures arrive in rows of a few hundred.
const CHUNK: usize = 1 << 18;

/// Writes the content of a file. Taken as a trait object, so that replacing files is compiled only once.
pub type Content<'w> = dyn FnMut(&mut dyn Write) -> io::Result<()> + 'w;

/// Replaces or creates a file, so that at any moment it holds either the old or the complete new
/// content. Follows symbolic links; keeps mode, owner and extended attributes. Fails if the target
/// is not a file.
///
/// The content is written to a file without a name, or with a temporary one if the file system has
/// no unnamed files, and synced; then it takes the file's name. `confirm` is called just before:
/// an error leaves the old file. It is called again if another file took the name meanwhile. Until
/// the name is taken the old file is locked, so that of several writers of this kind each sees what
/// the one before has written; a lock of another program is waited for up to a second.
///
/// If that would break a hard link or lose the owner, or if the folder is not writable, the content
/// is built in memory and overwrites the old one, a copy of which is kept until the new one is
/// complete: only then can a crash leave a half-written file. [`backups`](super::backups) finds the
/// copy. If another program has locked the file, this waits for up to a second. The next write in a
/// folder removes temporary files that a crash left behind.
pub fn replace<E: From<io::Error>>(
    path: &Path,
    write: &mut Content<'_>,
    confirm: &dyn Fn() -> Result<(), E>,
) -> Result<(), E> {
    match Target::of(path)? {
        Target::Stream(_, kind) => Err(not_a_file(kind).into()),
        target => put(&target, write, confirm).map(drop),
    }
}

/// Like [`replace`], but also writes to pipes and devices, which have no content to keep. Fails for
/// a pipe without a reader. Returns the version of the written file, `None` for pipes and devices.
pub fn deliver<E: From<io::Error>>(
    path: &Path,
    write: &mut Content<'_>,
    confirm: &dyn Fn() -> Result<(), E>,
) -> Result<Option<Version>, E> {
    match Target::of(path)? {
        Target::Stream(path, _) => {
            confirm()?;
            let mut out = BufWriter::with_capacity(CHUNK, stream::open(&path)?);
            write(&mut out)?;
            out.flush()?;
            Ok(None)
        }
        target => put(&target, write, confirm),
    }
}

fn put<E: From<io::Error>>(
    target: &Target,
    write: &mut Content<'_>,
    confirm: &dyn Fn() -> Result<(), E>,
) -> Result<Option<Version>, E> {
    match target {
        Target::New(path) => {
            let new = Temporary::new(directory_of(path), Access::AsUsual)?;
            let mut new = filled(new, write)?;
            confirm()?;
            match new.take_new_name(path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                    confirm()?;
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
                return overwrite(path, write, confirm);
            };
            let mut twin = filled(twin, write)?;
            let turn = wait_for_turn(path);
            confirm()?;
            twin.take_name(path)?;
            drop(turn);
            let version = version_of(twin.file());
            sync_directory(directory_of(path));
            Ok(version)
        }
        Target::Stream(_, kind) => Err(not_a_file(kind).into()),
    }
}

/// The version of an open file; `None` if its metadata cannot be read.
fn version_of(file: &File) -> Option<Version> {
    let metadata = file.metadata().ok()?;
    Some(Version::of_metadata(&metadata))
}

/// Writes the content to a file and syncs it.
fn filled(file: Temporary, write: &mut Content<'_>) -> io::Result<Temporary> {
    let mut out = BufWriter::with_capacity(CHUNK, file.content());
    let written = write(&mut out).and_then(|()| out.flush());
    // After an error the rest of the buffer is not written.
    let _ = out.into_parts();
    written?;
    file.sync()?;
    Ok(file)
}

/// Creates an empty file in the folder of `path` that can replace it, with the same mode, owner and
/// attributes. Returns `None` if that is not possible.
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

fn is_hard_linked(metadata: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    1 < metadata.nlink()
}

fn overwrite<E: From<io::Error>>(
    path: &Path,
    write: &mut Content<'_>,
    confirm: &dyn Fn() -> Result<(), E>,
) -> Result<Option<Version>, E> {
    let mut content = Vec::new();
    write(&mut content)?;
    let file = open(OpenOptions::new().read(true).write(true), path)?;
    wait_for_others(&file)?;
    let backup = Backup::of(path, &file)?;
    if let Err(refused) = confirm() {
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

/// Locks a file that is to be replaced, so that no other writer replaces it between `confirm` and
/// the rename. Returns the lock. `None` if there are no locks, or after [`LOCK_PATIENCE`]: a lock of
/// another program may mean anything.
fn wait_for_turn(path: &Path) -> Option<File> {
    let give_up = Instant::now() + LOCK_PATIENCE;
    loop {
        let file = open(OpenOptions::new().read(true), path).ok()?;
        match lock(&file) {
            Lock::Unknown => return None,
            // The lock of a file that was replaced meanwhile keeps nobody out.
            Lock::Taken if FileId::of_file(&file) == FileId::of(path) => return Some(file),
            _ if give_up < Instant::now() => return None,
            Lock::Taken => {}
            Lock::Busy => thread::sleep(LOCK_RETRY),
        }
    }
}

/// Waits until no other program has the file locked, under any of its names. Fails after
/// [`LOCK_PATIENCE`].
fn wait_for_others(file: &File) -> io::Result<()> {
    let give_up = Instant::now() + LOCK_PATIENCE;
    // If files cannot be locked, no other writer is known.
    while lock(file) == Lock::Busy {
        if give_up < Instant::now() {
            return Err(io::Error::other("locked by another program"));
        }
        thread::sleep(LOCK_RETRY);
    }
    Ok(())
}

/// Restores the content of a backup after an error, which is returned. If that fails too, the copy
/// remains and the error also names it.
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
    let reason = format!("the file is damaged; its previous content is in {shown}: {error}");
    io::Error::new(error.kind(), reason)
}

/// Overwrites a file with `content`; sets `is_changed` as soon as the old content may be damaged.
/// Truncates last, so that the file keeps its blocks and can be restored even on a full disk.
fn put_in_place(mut file: &File, mut content: &[u8], is_changed: &mut bool) -> io::Result<()> {
    let length = content.len() as u64;
    call("seek", || file.rewind())?;
    while !content.is_empty() {
        match CheckedWriter(file).write(content)? {
            0 => return Err(io::ErrorKind::WriteZero.into()),
            written => content = &content[written..],
        }
        *is_changed = true;
    }
    call("ftruncate", || file.set_len(length))?;
    *is_changed = true;
    call("fsync", || file.sync_all())
}
