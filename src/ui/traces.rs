//! Full-size traces kept from one run to the next: `halflight/traces` in the state folder, readable
//! by their owner only.
//!
//! ```text
//! halflight trace 2
//! version 0.1.0
//! scene 9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0bd3ee0e1f5a3f0b6b9c1d
//! view own
//! layers none
//! size 800x600
//! …
//! samples 17760000
//! ```
//!
//! After these lines follow the bytes of [`Kept`], and the SHA-256 of all before. All lines but the
//! last say what the picture is made from; a file is named after their digest.

use std::fs::{self, DirBuilder};
use std::io::{self, BufReader, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Instant, SystemTime};

use super::recovery;
use crate::file::{self, Digest, Digested, ReadError};
use crate::render::{Job, Kept, Provenance};

/// The first line, with the version of the format.
const MAGIC: &str = "halflight trace 2";

/// The most files, and the most bytes of all of them; the newest alone may have more.
const MOST: usize = 4;
const MOST_BYTES: u64 = 2 << 30;

/// Bytes read at once.
const CHUNK: usize = 1 << 18;

/// More bytes than the line with the samples has.
const LONGEST: usize = 40;

/// The folder of kept traces.
#[derive(Clone, Debug)]
pub(super) struct Traces {
    folder: PathBuf,
}

/// Why a kept trace cannot be read.
#[derive(Debug, thiserror::Error)]
pub(super) enum Unreadable {
    /// Its bytes are not those that were written. It was removed.
    #[error("the full-size trace of an earlier run was damaged and has been removed")]
    Damaged,
    /// The file system reported an error, or memory is short.
    #[error("the full-size trace of an earlier run cannot be read: {0}")]
    Io(#[from] io::Error),
}

impl Traces {
    /// The folder in the user's state folder. Fails if the environment names none.
    pub(super) fn of_user() -> io::Result<Self> {
        Ok(Self::of(&recovery::state()?))
    }

    /// The folder in a state folder; neither needs to exist.
    fn of(state: &Path) -> Self {
        Self {
            folder: state.join("halflight").join("traces"),
        }
    }

    /// Writes a trace, unless as many samples of it are kept already, and removes the oldest ones
    /// beyond [`MOST`] and [`MOST_BYTES`]. Stops at the deadline, which leaves what was there.
    pub(super) fn write(
        &self,
        picture: &Provenance,
        kept: &Kept,
        deadline: Instant,
    ) -> io::Result<()> {
        let mut builder = DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.recursive(true).create(&self.folder)?;
        let (head, samples) = (head(picture), kept.samples());
        let path = self.place(&head);
        if self.samples(&head).is_some_and(|there| samples <= there) {
            return Ok(());
        }
        let write = |out: &mut dyn Write| {
            let mut out = Digested::new(Timed { out, deadline });
            writeln!(out, "{head}samples {samples}")?;
            kept.write(&mut out)?;
            let (mut out, digest) = out.finish();
            out.write_all(&digest)
        };
        let in_time = || match Instant::now() {
            now if now < deadline => Ok(()),
            _ => Err(too_late()),
        };
        file::replace(&path, write, in_time)?;
        self.tidy(&path);
        Ok(())
    }

    /// Reads the trace that was kept of a picture and that the job can continue, if there is one.
    /// Removes a damaged one.
    pub(super) fn read(&self, picture: &Provenance, job: &Job) -> Result<Option<Kept>, Unreadable> {
        let head = head(picture);
        let path = self.place(&head);
        let file = match file::open(&path) {
            Ok(file) => file,
            Err(ReadError::NotFound { .. }) => return Ok(None),
            Err(error) => return Err(io::Error::other(error).into()),
        };
        let read = || {
            let mut from = Digested::new(BufReader::with_capacity(CHUNK, file));
            check_head(&mut from, &head)?;
            samples_in(&mut from)?;
            let kept = Kept::read(&mut from, job)?;
            let (from, digest) = from.finish();
            let mut end = Vec::new();
            from.take(digest.len() as u64 + 1).read_to_end(&mut end)?;
            if end == digest {
                Ok(kept)
            } else {
                Err(io::Error::from(ErrorKind::InvalidData))
            }
        };
        match read() {
            Ok(kept) => Ok(Some(kept)),
            Err(error)
                if matches!(
                    error.kind(),
                    ErrorKind::InvalidData | ErrorKind::UnexpectedEof
                ) =>
            {
                let _ = fs::remove_file(path);
                Err(Unreadable::Damaged)
            }
            Err(error) => Err(error.into()),
        }
    }

    fn place(&self, head: &str) -> PathBuf {
        let digest = Digest::of([head.as_bytes()]);
        self.folder.join(format!("{}.trace", &digest[..32]))
    }

    /// The number of samples that a file says it has; `None` if there is none of this picture.
    fn samples(&self, head: &str) -> Option<u64> {
        let mut from = BufReader::new(file::open(&self.place(head)).ok()?);
        check_head(&mut from, head).ok()?;
        samples_in(&mut from).ok()
    }

    /// Removes the oldest files but the newest, which was just written, if there are too many.
    fn tidy(&self, newest: &Path) {
        let Ok(entries) = fs::read_dir(&self.folder) else {
            return;
        };
        let dated = entries.flatten().filter_map(|entry| {
            let path = entry.path();
            let is_trace = path.extension().is_some_and(|end| end == "trace");
            let found = entry
                .metadata()
                .ok()
                .filter(|_| is_trace && path != newest)?;
            let written = found.modified().unwrap_or(SystemTime::UNIX_EPOCH);
            Some((written, found.len(), path))
        });
        let mut others: Vec<_> = dated.collect();
        others.sort_unstable();
        let mut bytes = fs::metadata(newest).map_or(0, |found| found.len());
        for (number, (_, length, path)) in others.into_iter().rev().enumerate() {
            bytes = bytes.saturating_add(length);
            if MOST <= number + 1 || MOST_BYTES < bytes {
                let _ = fs::remove_file(path);
            }
        }
    }
}

/// All lines but the last.
fn head(picture: &Provenance) -> String {
    format!("{MAGIC}\n{}", picture.lines())
}

/// Reads these lines; fails if there are others.
fn check_head(from: &mut impl Read, head: &str) -> io::Result<()> {
    let mut found = vec![0; head.len()];
    from.read_exact(&mut found)?;
    if found == head.as_bytes() {
        Ok(())
    } else {
        Err(ErrorKind::InvalidData.into())
    }
}

/// Reads the last line.
fn samples_in(from: &mut impl Read) -> io::Result<u64> {
    let (mut line, mut byte) = (String::new(), [0]);
    while line.len() < LONGEST {
        from.read_exact(&mut byte)?;
        if byte == *b"\n" {
            let samples = line.strip_prefix("samples ");
            let samples = samples.and_then(|samples| samples.parse().ok());
            return samples.ok_or_else(|| ErrorKind::InvalidData.into());
        }
        line.push(char::from(byte[0]));
    }
    Err(ErrorKind::InvalidData.into())
}

/// A writer that fails from the deadline on.
struct Timed<W> {
    out: W,
    deadline: Instant,
}

impl<W: Write> Write for Timed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.deadline <= Instant::now() {
            return Err(too_late());
        }
        self.out.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

fn too_late() -> io::Error {
    io::Error::new(ErrorKind::TimedOut, "writing it takes too long")
}

#[cfg(test)]
pub(super) mod tests;
