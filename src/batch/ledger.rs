//! Which frames of a sequence are finished.

use std::collections::HashSet;
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use super::Error;
use crate::file::{self, Digest, ReadError};

/// The first line of every list, with the version of the format.
const HEADER: &str = "halflight frames 1\n";

/// More bytes than any line has: two digests, and a name whose every byte is escaped.
const LONGEST: u64 = 8 << 10;

/// A list of finished frames beside their pictures: after [`HEADER`] a line `INPUTS PICTURE NAME` for
/// each, with the SHA-256 of what it was made of and of its file, whose name is escaped as in Rust.
/// Lines are only appended; what is no such line is skipped.
#[derive(Debug)]
pub(super) struct Ledger {
    path: PathBuf,
    /// The marks of the lines, of which there may be many millions.
    finished: HashSet<Mark>,
    /// What is to be written before the next line.
    lead: &'static str,
    file: Option<File>,
}

/// Half of the digest of a line.
type Mark = u128;

impl Ledger {
    /// Reads a list, which need not exist, to append to it; and what other lists name, as far as they
    /// are lists.
    pub(super) fn read(path: PathBuf, others: &[PathBuf]) -> Result<Self, Error> {
        let unusable = |source| Error::Create {
            path: path.clone(),
            source,
        };
        let mut finished = HashSet::new();
        let mut learn = |mark| {
            finished.insert(mark);
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
        for other in others {
            // What cannot be read is no list.
            let _ = learned(other, &mut learn);
        }
        Ok(Self {
            path,
            finished,
            lead,
            file: None,
        })
    }

    /// Whether a frame is made of these inputs, and its file is as it was written.
    pub(super) fn has(&self, inputs: &str, picture: &Path) -> bool {
        // Opening a pipe could wait for ever.
        if self.finished.is_empty() || !picture.is_file() {
            return false;
        }
        Digest::of_file(picture).is_ok_and(|found| {
            let line = format!("{inputs} {found} {}", name_of(picture));
            self.finished.contains(&mark(line.as_bytes()))
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

/// Reads a list, which need not exist, line by line, and calls `learn` with the mark of each line that
/// names a frame.
fn learned(path: &Path, mut learn: impl FnMut(Mark)) -> io::Result<Found> {
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
    let mut from = BufReader::new(file);
    let mut line = Vec::new();
    from.by_ref()
        .take(HEADER.len() as u64)
        .read_to_end(&mut line)?;
    if line != HEADER.as_bytes() {
        let is_part = HEADER.as_bytes().starts_with(&line);
        return Ok(if is_part {
            Found::Part(line.len())
        } else {
            Found::Other
        });
    }
    let mut is_cut = false;
    loop {
        line.clear();
        from.by_ref().take(LONGEST).read_until(b'\n', &mut line)?;
        if line.is_empty() {
            return Ok(Found::List { is_cut });
        }
        let is_begun = is_cut;
        is_cut = !line.ends_with(b"\n");
        let line = line.strip_suffix(b"\n").unwrap_or(&line);
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        // The pieces of a longer line name no frame.
        if !is_begun && (line.len() as u64) < LONGEST && names_a_frame(line) {
            learn(mark(line));
        }
    }
}

/// Whether a line begins with two digests.
fn names_a_frame(line: &[u8]) -> bool {
    let mut words = line.splitn(3, |&byte| byte == b' ');
    let mut is_digest = || {
        let word = words.next();
        word.is_some_and(|word| word.len() == 64 && word.iter().all(u8::is_ascii_hexdigit))
    };
    is_digest() && is_digest() && words.next().is_some()
}

fn mark(line: &[u8]) -> Mark {
    let mut digest = Digest::default();
    digest.add(line);
    digest.half()
}

/// The name of a file, on one line.
fn name_of(picture: &Path) -> String {
    let name = picture.file_name().unwrap_or_default();
    name.to_string_lossy().escape_debug().to_string()
}
