//! Which frames of a sequence are finished.

use std::collections::HashSet;
use std::fs::{File, OpenOptions};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use crate::Error;
use file::{Digest, ReadError};

/// The first line of every list, with the version of the format.
const HEADER: &str = "halflight frames 1\n";

/// More bytes than any line has: two digests, and a name whose every byte is escaped.
const LONGEST: usize = 8 << 10;

/// Bytes of the digests that begin a line.
const DIGEST: usize = 64;

/// Bytes read at once.
const CHUNK: usize = 1 << 18;

/// A list of finished frames beside their pictures: after [`HEADER`] a line `INPUTS PICTURE NAME` for
/// each, with the SHA-256 of what it was made of and of its file, whose name is escaped as in Rust.
/// Lines are only appended; what is no such line is skipped.
#[derive(Debug)]
pub(super) struct Ledger {
    path: PathBuf,
    /// The hashes of the lines, of which there may be many millions.
    finished: HashSet<u64>,
    hasher: RandomState,
    /// What is to be written before the next line.
    lead: &'static str,
    file: Option<File>,
}

impl Ledger {
    /// Reads a list, which need not exist, to append to it; and what other lists name, as far as they
    /// are lists.
    pub(super) fn read(path: PathBuf, others: &[PathBuf]) -> Result<Self, Error> {
        let unusable = |source| Error::Create {
            path: path.clone(),
            source,
        };
        let hasher = RandomState::new();
        let mut finished = HashSet::new();
        let mut learn = |line: &[u8]| {
            finished.insert(hasher.hash_one(line));
        };
        let lead = match learned(&path, &mut learn).map_err(unusable)? {
            // There is none, or a process that was killed at once left a part of the first line.
            Found::Part(bytes) => &HEADER[bytes..],
            Found::Other => {
                return Err(unusable(io::Error::other(
                    "exists, but is not a list of finished frames; move it away, or name the \
                     pictures differently",
                )));
            }
            Found::List { is_cut: true } => "\n",
            Found::List { is_cut: false } => "",
        };
        for other in others.iter().filter(|other| **other != path) {
            // What cannot be read is no list.
            let _ = learned(other, &mut learn);
        }
        Ok(Self {
            path,
            finished,
            hasher,
            lead,
            file: None,
        })
    }

    /// The file that it is kept in.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether a frame is made of these inputs, and its file is as it was written.
    pub(super) fn has(&self, inputs: &str, picture: &Path) -> bool {
        // Opening a pipe could wait for ever.
        if self.finished.is_empty() || !picture.is_file() {
            return false;
        }
        Digest::of_file(picture).is_ok_and(|found| {
            let line = format!("{inputs} {found} {}", name_of(picture));
            self.finished
                .contains(&self.hasher.hash_one(line.as_bytes()))
        })
    }

    /// Notes that a frame is finished, and what its file holds.
    pub(super) fn add(&mut self, inputs: &str, picture: &Path, bytes: &[u8]) -> Result<(), Error> {
        let digest = Digest::of([bytes]);
        let line = format!("{}{inputs} {digest} {}\n", self.lead, name_of(picture));
        self.append(&line).map_err(|source| Error::Create {
            path: self.path.clone(),
            source,
        })?;
        self.lead = "";
        Ok(())
    }

    fn append(&mut self, line: &str) -> io::Result<()> {
        let file = if let Some(file) = &mut self.file {
            file
        } else {
            let mut options = OpenOptions::new();
            let opened = options.append(true).create(true).open(&self.path)?;
            self.file.insert(opened)
        };
        file.write_all(line.as_bytes())
    }
}

/// What stands where a list belongs.
enum Found {
    /// The first bytes of [`HEADER`], maybe none.
    Part(usize),
    /// A list, whose last line may be cut.
    List { is_cut: bool },
    /// Something else.
    Other,
}

/// Reads a list, which need not exist, chunk by chunk, and calls `learn` with each line that names a
/// frame.
fn learned(path: &Path, mut learn: impl FnMut(&[u8])) -> io::Result<Found> {
    let file = match file::open(path) {
        Ok(file) => file,
        Err(ReadError::NotFound { .. }) => return Ok(Found::Part(0)),
        Err(ReadError::Io { source, .. }) => return Err(source),
        Err(ReadError::NotRegular { kind, .. }) => {
            return Err(io::Error::other(format!(
                "is {kind}, where the list of finished frames belongs"
            )));
        }
        Err(error) => return Err(io::Error::other(error.to_string())),
    };
    let mut from = BufReader::with_capacity(CHUNK, file);
    let mut header = Vec::new();
    from.by_ref()
        .take(HEADER.len() as u64)
        .read_to_end(&mut header)?;
    if header != HEADER.as_bytes() {
        let is_part = HEADER.as_bytes().starts_with(&header);
        return Ok(if is_part {
            Found::Part(header.len())
        } else {
            Found::Other
        });
    }
    let mut learn = |line: &[u8]| {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        if names_a_frame(line) {
            learn(line);
        }
    };
    // What the previous chunk held of a line that it did not end.
    let mut begun = Vec::new();
    loop {
        let chunk = from.fill_buf()?;
        let length = chunk.len();
        if length == 0 {
            learn(&begun);
            let is_cut = !begun.is_empty();
            return Ok(Found::List { is_cut });
        }
        for piece in chunk.split_inclusive(|byte| *byte == b'\n') {
            let Some(line) = piece.strip_suffix(b"\n") else {
                extend(&mut begun, piece);
                continue;
            };
            if begun.is_empty() {
                learn(line);
            } else {
                extend(&mut begun, line);
                learn(&begun);
                begun.clear();
            }
        }
        from.consume(length);
    }
}

/// Extends a line, but no further than the length from which on it names no frame.
fn extend(line: &mut Vec<u8>, by: &[u8]) {
    let room = LONGEST.saturating_sub(line.len());
    line.extend_from_slice(&by[..by.len().min(room)]);
}

/// Whether a line is two digests and a name.
fn names_a_frame(line: &[u8]) -> bool {
    let is_digest = |word: &[u8]| word.iter().all(u8::is_ascii_hexdigit);
    let name = 2 * (DIGEST + 1);
    name < line.len()
        && line.len() < LONGEST
        && line[DIGEST] == b' '
        && line[name - 1] == b' '
        && is_digest(&line[..DIGEST])
        && is_digest(&line[DIGEST + 1..name - 1])
}

/// The name of a file, on one line.
fn name_of(picture: &Path) -> String {
    let name = picture.file_name().unwrap_or_default();
    name.to_string_lossy().escape_debug().to_string()
}
