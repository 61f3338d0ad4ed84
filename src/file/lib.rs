//! File input and output: reading a scene's text, and replacing files atomically. Independent of
//! what the bytes mean.

mod alike;
mod backup;
mod calls;
mod current;
mod digest;
#[cfg(any(test, feature = "faults"))]
pub mod faults;
mod lock;
mod owner;
mod replace;
pub mod state_folder;
mod stream;
mod target;
mod temporary;
mod version;

use std::fs::{File, FileType, OpenOptions};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use memory::{Need, OutOfMemory};
use text::{Position, Span};

pub use backup::{backups, interruption};
pub use current::{absolute, has_folder, regain_folder};
pub use digest::Digest;
pub use lock::{Lock, lock};
pub use replace::{Content, deliver, replace};
pub use target::{
    check_replaceable, check_target, directory_of, end_of_links, is_same_target, no_such_folder,
};
pub use version::{FileId, Version};

/// The largest readable file, in bytes: positions in a text are 32-bit.
pub const MAX_BYTES: u64 = u32::MAX as u64;

/// The largest text of a few settings, in bytes: a track, a configuration, a script of keys. People write
/// these, and what is built from one takes up to fifty times its length.
pub const MAX_SMALL_BYTES: u64 = 1 << 20;

/// The beginning of files longer than this is checked before the rest is read; in bytes. See
/// [`read_beginning`].
pub const LONG: u64 = 16 << 20;

/// The length of such a beginning in bytes, which parse within a few milliseconds.
pub const BEGINNING: usize = 1 << 20;

/// Files of this many bytes are read and checked in parallel. Smaller ones must not be: the configuration
/// is read before any threads are started.
const LARGE: usize = 16 * PART;

/// The length in bytes of the parts in which they are.
const PART: usize = 1 << 20;

/// How many bytes of a line are kept from its first invalid UTF-8 byte on.
const WRONG_LINE: usize = 1 << 10;

/// A file with more NUL bytes than this counts as binary.
const MAX_NULS: usize = 100;

/// Why a scene's text could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file does not exist.
    #[error("{path}: no such file", path = path.display())]
    NotFound {
        /// The path of the file.
        path: PathBuf,
    },
    /// The file does not exist, nor does its folder.
    #[error("{folder}: no such folder", folder = folder.display())]
    NoFolder {
        /// The path of the folder.
        folder: PathBuf,
    },
    /// The file system reported an error.
    #[error("{path}: {source}", path = path.display())]
    Io {
        /// The path of the file.
        path: PathBuf,
        /// The error it reported.
        source: io::Error,
    },
    /// Not a regular file but a folder, a pipe or a device.
    #[error("{path}: is {kind}, not a file", path = path.display())]
    NotRegular {
        /// The path of the file.
        path: PathBuf,
        /// Its type with an article, e.g. `a folder`.
        kind: &'static str,
    },
    /// Longer than allowed.
    #[error("{path}: is {}", too_long(*limit), path = path.display())]
    TooLong {
        /// The path of the file.
        path: PathBuf,
        /// The most bytes allowed, such as [`MAX_BYTES`].
        limit: u64,
    },
    /// Not enough memory for the file, or for what is built from it.
    #[error("{path}: {reason}", path = path.display())]
    NoMemory {
        /// The path of the file.
        path: PathBuf,
        /// The allocation that was refused.
        reason: OutOfMemory,
    },
    /// Contains more NUL bytes than text would.
    #[error("{path}: is a binary file, not text: NUL bytes from line {line} on", path = path.display())]
    Binary {
        /// The path of the file.
        path: PathBuf,
        /// The line of the first NUL byte, from 1.
        line: usize,
    },
    /// The content is not UTF-8.
    #[error(
        "{path}:{line}:{column}: the byte 0x{byte:02X} is not UTF-8 text; convert the file, for \
         example with: iconv -f {encoding} -t UTF-8",
        path = path.display(), line = position.line, column = position.column
    )]
    NotUtf8 {
        /// The path of the file.
        path: PathBuf,
        /// The position of the first invalid byte.
        position: Position,
        /// The text up to the end of that line, or a limited part of it, with invalid bytes
        /// replaced by U+FFFD.
        text: String,
        /// The first such replacement in `text`.
        span: Span,
        /// The first invalid byte.
        byte: u8,
        /// The most likely encoding, by its iconv name.
        encoding: &'static str,
    },
}

/// Reads a scene file: a regular UTF-8 file of at most [`MAX_BYTES`] bytes, with few NUL bytes.
pub fn read_text(path: &Path) -> Result<String, ReadError> {
    read_text_within(path, MAX_BYTES)
}

/// Reads a track, a configuration or a script of keys: as [`read_text`], but of at most
/// [`MAX_SMALL_BYTES`] bytes.
pub fn read_small_text(path: &Path) -> Result<String, ReadError> {
    read_text_within(path, MAX_SMALL_BYTES)
}

fn read_text_within(path: &Path, limit: u64) -> Result<String, ReadError> {
    let file = open(path)?;
    if let Some(line) = binary_start(&file, limit) {
        return Err(ReadError::Binary {
            path: path.to_owned(),
            line,
        });
    }
    text(path, read_opened(&file, path, limit)?)
}

/// What a file longer than `limit` bytes is.
fn too_long(limit: u64) -> String {
    match limit {
        MAX_BYTES => "4 GiB or longer; scenes must be shorter".to_owned(),
        MAX_SMALL_BYTES => {
            "longer than 1 MiB, the limit for tracks, configurations and key scripts".to_owned()
        }
        _ => format!("longer than {limit} bytes"),
    }
}

/// Reads about the first megabyte of a scene file longer than [`LONG`] bytes, in whole characters.
/// Returns `None` for shorter files. Fails like [`read_text`].
pub fn read_beginning(path: &Path) -> Result<Option<String>, ReadError> {
    let file = open(path)?;
    let metadata = file.metadata().map_err(|source| ReadError::Io {
        path: path.to_owned(),
        source,
    })?;
    if metadata.len() <= LONG {
        return Ok(None);
    }
    if MAX_BYTES < metadata.len() {
        return Err(ReadError::TooLong {
            path: path.to_owned(),
            limit: MAX_BYTES,
        });
    }
    if let Some(line) = binary_start(&file, MAX_BYTES) {
        return Err(ReadError::Binary {
            path: path.to_owned(),
            line,
        });
    }
    let mut bytes = Vec::with_capacity(BEGINNING);
    let read = file.take(BEGINNING as u64).read_to_end(&mut bytes);
    read.map_err(|source| ReadError::Io {
        path: path.to_owned(),
        source,
    })?;
    if let Err(error) = std::str::from_utf8(&bytes)
        && error.error_len().is_none()
    {
        // The cut is inside a character.
        bytes.truncate(error.valid_up_to());
    }
    text(path, bytes).map(Some)
}

/// Converts bytes to text. Fails unless they are UTF-8 with few NUL bytes.
fn text(path: &Path, bytes: Vec<u8>) -> Result<String, ReadError> {
    let text = decode(path, bytes)?;
    match first_zero(text.as_bytes()) {
        None => Ok(text),
        Some(at) => Err(ReadError::Binary {
            path: path.to_owned(),
            line: line_of(&text.as_bytes()[..at]),
        }),
    }
}

/// Checks the first bytes of a file before all of it is read. Returns the line of the first NUL
/// byte if the file looks binary; `None` if it looks like UTF-16 or is too long anyway.
fn binary_start(file: &File, limit: u64) -> Option<usize> {
    if file.metadata().is_ok_and(|metadata| limit < metadata.len()) {
        return None;
    }
    let mut start = [0; 4096];
    let length = read_start(file, &mut start).unwrap_or(0);
    let start = &start[..length];
    if start.starts_with(&[0xFF, 0xFE]) || start.starts_with(&[0xFE, 0xFF]) {
        return None;
    }
    Some(line_of(&start[..first_zero(start)?]))
}

/// The offset of the first NUL byte of binary content; `None` if there are few enough for the
/// parser to report each.
fn first_zero(bytes: &[u8]) -> Option<usize> {
    // Texts usually have none, and checking that is faster than counting.
    let has_none = if bytes.len() < LARGE {
        !bytes.contains(&0)
    } else {
        bytes.par_chunks(PART).all(|part| !part.contains(&0))
    };
    if has_none {
        return None;
    }
    let zeros: usize = bytes.iter().map(|&byte| usize::from(byte == 0)).sum();
    if zeros <= MAX_NULS {
        return None;
    }
    bytes.iter().position(|&byte| byte == 0)
}

/// Reads from the beginning of a file; the file position does not advance.
fn read_start(file: &File, start: &mut [u8]) -> io::Result<usize> {
    std::os::unix::fs::FileExt::read_at(file, start, 0)
}

/// The number, from 1, of the line that contains the end of `before`.
fn line_of(before: &[u8]) -> usize {
    before.split(|&byte| byte == b'\n').count()
}

fn decode(path: &Path, bytes: Vec<u8>) -> Result<String, ReadError> {
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let mut bytes = error.into_bytes();
        let encoding = match bytes[..] {
            [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => "UTF-16",
            _ => "WINDOWS-1252",
        };
        let invalid = &bytes[valid..];
        let byte = invalid[0];
        let line = invalid
            .split(|&byte| byte == b'\n')
            .next()
            .unwrap_or(invalid);
        let line = &line[..line.len().min(WRONG_LINE)];
        let line = String::from_utf8_lossy(line).into_owned();
        // The text may be long: its valid part is not copied.
        bytes.truncate(valid);
        let mut text = String::from_utf8(bytes).unwrap_or_default();
        text.push_str(&line);
        ReadError::NotUtf8 {
            path: path.to_owned(),
            position: Position::of(&text, valid),
            text,
            span: Span::new(valid, valid + char::REPLACEMENT_CHARACTER.len_utf8()),
            byte,
            encoding,
        }
    })
}

/// The length of a scene file in bytes. Fails if [`read_text`] could not open it; reads nothing.
pub fn scene_length(path: &Path) -> Result<u64, ReadError> {
    let metadata = open(path)?.metadata().map_err(|source| ReadError::Io {
        path: path.to_owned(),
        source,
    })?;
    if MAX_BYTES < metadata.len() {
        return Err(ReadError::TooLong {
            path: path.to_owned(),
            limit: MAX_BYTES,
        });
    }
    Ok(metadata.len())
}

/// Reads a regular file of at most `limit` bytes.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    read_opened(&open(path)?, path, limit)
}

/// Reads an open regular file of at most `limit` bytes.
pub fn read_opened(file: &File, path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    let length = file.metadata().map_or(0, |metadata| metadata.len());
    memory::check(length.min(limit), || Need {
        what: "the file's contents".to_owned(),
        bytes: length,
    })
    .map_err(|reason| ReadError::NoMemory {
        path: path.to_owned(),
        reason,
    })?;
    read_open(file, limit).map_err(|source| match source.kind() {
        io::ErrorKind::FileTooLarge => ReadError::TooLong {
            path: path.to_owned(),
            limit,
        },
        _ => ReadError::Io {
            path: path.to_owned(),
            source,
        },
    })
}

/// Whether two paths name the same existing file, also through hard or symbolic links.
pub fn is_same(one: &Path, other: &Path) -> bool {
    FileId::of(one).is_some_and(|found| FileId::of(other) == Some(found))
}

/// Whether a path names something of the user's own, whether or not that can be read. `false` if
/// there is nothing, or nothing can be there.
pub fn is_own(path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let user = rustix::process::geteuid().as_raw();
    path.symlink_metadata()
        .is_ok_and(|found| found.uid() == user)
}

/// Opens a regular file for reading. Never blocks, as opening a pipe without a writer would.
pub fn open(path: &Path) -> Result<File, ReadError> {
    let describe = |source: io::Error| match source.kind() {
        io::ErrorKind::NotFound => ReadError::NotFound {
            path: path.to_owned(),
        },
        _ => ReadError::Io {
            path: path.to_owned(),
            source,
        },
    };
    let file = without_waiting(OpenOptions::new().read(true))
        .open(path)
        .map_err(describe)?;
    regular(file, path)
}

/// Returns the file if it is a regular one. Checks the open file, not the path, which may refer to
/// another file by now.
pub fn regular(file: File, path: &Path) -> Result<File, ReadError> {
    let describe = |source| ReadError::Io {
        path: path.to_owned(),
        source,
    };
    let file_type = file.metadata().map_err(describe)?.file_type();
    if file_type.is_file() {
        Ok(file)
    } else {
        Err(ReadError::NotRegular {
            path: path.to_owned(),
            kind: kind(file_type),
        })
    }
}

fn without_waiting(options: &mut OpenOptions) -> &mut OpenOptions {
    use rustix::fs::OFlags;
    use std::os::unix::fs::OpenOptionsExt;
    // Opening a terminal by its path must not make it the controlling terminal.
    let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
    options.custom_flags(flags.bits() as i32);
    options
}

fn kind(file_type: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    if file_type.is_dir() {
        return "a folder";
    }
    if file_type.is_fifo() {
        return "a pipe";
    }
    if file_type.is_socket() {
        return "a socket";
    }
    "a device"
}

fn read_open(file: &File, limit: u64) -> io::Result<Vec<u8>> {
    let length = file.metadata()?.len();
    if limit < length {
        return Err(io::ErrorKind::FileTooLarge.into());
    }
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(length as usize)?;
    read_by_parts(file, length as usize, &mut bytes)?;
    // The file may have grown meanwhile.
    let rest = limit + 1 - bytes.len() as u64;
    file.take(rest).read_to_end(&mut bytes)?;
    if limit < bytes.len() as u64 {
        return Err(io::ErrorKind::FileTooLarge.into());
    }
    Ok(bytes)
}

/// Reads the first `length` bytes of a large file in parallel: if they are cached, allocating
/// memory for them is most of the work. Reads nothing of small files and of files that shrink.
fn read_by_parts(mut file: &File, length: usize, bytes: &mut Vec<u8>) -> io::Result<()> {
    use std::io::{Seek, SeekFrom};
    use std::os::unix::fs::FileExt;
    if length < LARGE {
        return Ok(());
    }
    bytes.par_extend(rayon::iter::repeat_n(0, length));
    let parts = bytes.par_chunks_mut(PART).enumerate();
    let read = parts.map(|(number, part)| file.read_exact_at(part, (number * PART) as u64));
    if read.collect::<io::Result<()>>().is_ok() {
        file.seek(SeekFrom::Start(length as u64))?;
    } else {
        bytes.clear();
    }
    Ok(())
}

#[cfg(test)]
mod tests;
