//! Files whole or not at all: reading a scene's text, and replacing a file. Knows nothing of what
//! the bytes mean.

mod alike;
mod backup;
mod calls;
#[cfg(test)]
pub(crate) mod faults;
mod lock;
mod owner;
mod replace;
mod stream;
mod target;
mod temporary;
mod version;

use std::fs::{File, FileType, OpenOptions};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::memory::{self, Need, NoThreads, OutOfMemory};
use crate::text::{Position, Span};

pub use backup::{backups, interruption};
pub(crate) use lock::{Lock, lock};
pub use replace::{deliver, replace};
pub(crate) use target::end_of_links;
pub use target::{check_replaceable, check_target, directory_of, no_such_folder};
pub use version::{FileId, Version};

/// The longest file that is read, in bytes: positions in a text are 32-bit numbers.
pub const MAX_BYTES: u64 = u32::MAX as u64;

/// Of longer files the beginning is checked before the rest is read: see [`read_beginning`].
pub const LONG: u64 = 16 << 20;

/// The most bytes of a beginning. They are parsed within a few milliseconds.
const BEGINNING: usize = 1 << 20;

/// The most bytes that are kept of a line that is not UTF-8, from the first wrong one on.
const WRONG_LINE: usize = 1 << 10;

/// A text with more zeros than this is none.
const MOST_ZEROS: usize = 100;

/// Longer files may be worked on side by side.
const WITHOUT_THREADS: u64 = 1 << 14;

/// Why a scene's text could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// Nothing has that name.
    #[error("{path}: no such file", path = path.display())]
    NotFound {
        /// The file.
        path: PathBuf,
    },
    /// The file system said no.
    #[error("{path}: {source}", path = path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What it said.
        source: io::Error,
    },
    /// It is a folder, a pipe, a device: something that is not read as a scene.
    #[error("{path}: is {kind}, not a file", path = path.display())]
    NotRegular {
        /// The file.
        path: PathBuf,
        /// What it is, with its article: `a folder`.
        kind: &'static str,
    },
    /// It is longer than allowed, which is [`MAX_BYTES`] for scenes.
    #[error("{path}: is 4 GiB or longer; scenes are shorter", path = path.display())]
    TooLong {
        /// The file.
        path: PathBuf,
    },
    /// There is no memory for it, or for what is made of it.
    #[error("{path}: {reason}", path = path.display())]
    NoMemory {
        /// The file.
        path: PathBuf,
        /// What does not fit.
        reason: OutOfMemory,
    },
    /// It is too long to be read without threads.
    #[error(transparent)]
    NoThreads(#[from] NoThreads),
    /// It holds many bytes that no text has.
    #[error("{path}: is a binary file, not text: NUL bytes from line {line} on", path = path.display())]
    Binary {
        /// The file.
        path: PathBuf,
        /// The line of the first such byte, from 1.
        line: usize,
    },
    /// Its bytes are not UTF-8.
    #[error(
        "{path}:{line}:{column}: the byte 0x{byte:02X} is not UTF-8 text; convert the file, for \
         example with: iconv -f {encoding} -t UTF-8",
        path = path.display(), line = position.line, column = position.column
    )]
    NotUtf8 {
        /// The file.
        path: PathBuf,
        /// Where the first wrong byte stands.
        position: Position,
        /// The text to the end of its line or a good part of that, with U+FFFD for what can't be
        /// read.
        text: String,
        /// The place in `text` of what stands for the byte.
        span: Span,
        /// That byte.
        byte: u8,
        /// The encoding that it is most likely in, by iconv's name.
        encoding: &'static str,
    },
}

/// Reads a scene file: a regular file of at most [`MAX_BYTES`] bytes in UTF-8, with few zeros.
pub fn read_text(path: &Path) -> Result<String, ReadError> {
    let file = open(path)?;
    if let Some(line) = binary_start(&file) {
        return Err(ReadError::Binary {
            path: path.to_owned(),
            line,
        });
    }
    text(path, read_opened(&file, path, MAX_BYTES)?)
}

/// Reads the first characters, about a megabyte, of a scene file of more than [`LONG`] bytes; `None`
/// of a shorter one. The error is the one that [`read_text`] would give.
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
        });
    }
    if let Some(line) = binary_start(&file) {
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

/// The text that bytes are, if they are UTF-8 with few zeros.
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

/// The line of the first zero among a file's first bytes, which are looked at before long ones are
/// read. None where they begin as UTF-16 does, or the file is too long anyway.
fn binary_start(file: &File) -> Option<usize> {
    if file
        .metadata()
        .is_ok_and(|metadata| MAX_BYTES < metadata.len())
    {
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

/// The first zero of bytes that are not text; none where there are so few that each is worth a message.
fn first_zero(bytes: &[u8]) -> Option<usize> {
    // Texts have none, and that is told faster than a number.
    if !bytes.contains(&0) {
        return None;
    }
    let zeros: usize = bytes.iter().map(|&byte| usize::from(byte == 0)).sum();
    if zeros <= MOST_ZEROS {
        return None;
    }
    bytes.iter().position(|&byte| byte == 0)
}

/// Reads bytes from a file's beginning without moving on.
#[cfg(unix)]
fn read_start(file: &File, start: &mut [u8]) -> io::Result<usize> {
    std::os::unix::fs::FileExt::read_at(file, start, 0)
}

/// Reads bytes from a file's beginning without moving on.
#[cfg(not(unix))]
fn read_start(mut file: &File, start: &mut [u8]) -> io::Result<usize> {
    use std::io::Seek;
    let length = file.read(start)?;
    file.rewind()?;
    Ok(length)
}

/// The number of the line that begins before the end of some bytes, from 1.
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
        let wrong = &bytes[valid..];
        let byte = wrong[0];
        let line = wrong.split(|&byte| byte == b'\n').next().unwrap_or(wrong);
        let line = &line[..line.len().min(WRONG_LINE)];
        let line = String::from_utf8_lossy(line).into_owned();
        // The text may be long: what is valid of it is not copied.
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

/// The length of a scene file that [`read_text`] can open; the error is the one that it would give.
/// Reads nothing.
pub fn scene_length(path: &Path) -> Result<u64, ReadError> {
    let metadata = open(path)?.metadata().map_err(|source| ReadError::Io {
        path: path.to_owned(),
        source,
    })?;
    if MAX_BYTES < metadata.len() {
        return Err(ReadError::TooLong {
            path: path.to_owned(),
        });
    }
    Ok(metadata.len())
}

/// Reads a regular file of at most `limit` bytes.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    read_opened(&open(path)?, path, limit)
}

/// Reads a regular file that is open, of at most `limit` bytes.
pub(crate) fn read_opened(file: &File, path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    let length = file.metadata().map_or(0, |metadata| metadata.len());
    memory::check(length.min(limit), || Need {
        what: "the file's contents".to_owned(),
        bytes: length,
    })
    .map_err(|reason| ReadError::NoMemory {
        path: path.to_owned(),
        reason,
    })?;
    if WITHOUT_THREADS < length {
        memory::start_threads()?;
    }
    read_open(file, limit).map_err(|source| match source.kind() {
        io::ErrorKind::FileTooLarge => ReadError::TooLong {
            path: path.to_owned(),
        },
        _ => ReadError::Io {
            path: path.to_owned(),
            source,
        },
    })
}

/// Whether two names mean one file, through links of either kind. Names of nothing do not.
pub fn is_same(one: &Path, other: &Path) -> bool {
    FileId::of(one).is_some_and(|found| FileId::of(other) == Some(found))
}

/// Opens a regular file for reading. Never waits: opening a pipe would, until somebody writes.
pub(crate) fn open(path: &Path) -> Result<File, ReadError> {
    let told = |source: io::Error| match source.kind() {
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
        .map_err(told)?;
    regular(file, path)
}

/// The same file, if it is a regular one. Asked of the open file, not of the name, which may mean
/// another file by now.
pub(crate) fn regular(file: File, path: &Path) -> Result<File, ReadError> {
    let told = |source| ReadError::Io {
        path: path.to_owned(),
        source,
    };
    let file_type = file.metadata().map_err(told)?.file_type();
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
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        use std::os::unix::fs::OpenOptionsExt;
        // A terminal opened by its path must not become the one that controls the process.
        let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
        options.custom_flags(flags.bits() as i32);
    }
    options
}

fn kind(file_type: FileType) -> &'static str {
    if file_type.is_dir() {
        return "a folder";
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if file_type.is_fifo() {
            return "a pipe";
        }
        if file_type.is_socket() {
            return "a socket";
        }
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
    #[cfg(unix)]
    read_by_parts(file, length as usize, &mut bytes)?;
    // The file may grow while it is read.
    let rest = limit + 1 - bytes.len() as u64;
    file.take(rest).read_to_end(&mut bytes)?;
    if limit < bytes.len() as u64 {
        return Err(io::ErrorKind::FileTooLarge.into());
    }
    Ok(bytes)
}

/// Reads the first `length` bytes of a large file, side by side: where the system has them in memory,
/// taking new memory for them is most of the work. What has become shorter is left to be read.
#[cfg(unix)]
fn read_by_parts(mut file: &File, length: usize, bytes: &mut Vec<u8>) -> io::Result<()> {
    use rayon::prelude::*;
    use std::io::{Seek, SeekFrom};
    use std::os::unix::fs::FileExt;
    const PART: usize = 1 << 20;
    const LARGE: usize = 16 * PART;
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
