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
//! last say what the picture is made from; a file is named after their digest. Files that have no
//! such name, or do not begin like this, are never replaced or removed.

use std::fs::File;
use std::io::{self, BufReader, ErrorKind, Read, Seek, Write};
use std::path::PathBuf;
use std::time::{Duration, Instant, SystemTime};

use crate::state_folder::{self, Folder, NEW, Part};
use file::{Digest, Digested};
use render::{Job, Kept, Provenance};

/// The first line, with the version of the format.
const MAGIC: &str = "halflight trace 2";

/// How the first line of every version begins.
const KIND: &str = "halflight trace ";

/// The end of the names of files, and the length of what is before it: hexadecimal digits.
const END: &str = ".trace";
const DIGITS: usize = 32;

/// Files that were to become traces are removed after this time, which none takes to write.
const LEFT_BEHIND: Duration = Duration::from_secs(3600);

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
    /// The state folder, which need not exist.
    state: PathBuf,
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
        Ok(Self {
            state: state_folder::path()?,
        })
    }

    /// Writes a trace, unless as many samples of it are kept already, and removes the oldest ones
    /// beyond [`MOST`] and [`MOST_BYTES`]. Stops at the deadline, which leaves what was there.
    pub(super) fn write(
        &self,
        picture: &Provenance,
        kept: &Kept,
        deadline: Instant,
    ) -> io::Result<()> {
        let folder = Folder::make(&self.state, Part::Traces)?;
        let (head, samples) = (head(picture), kept.samples());
        let name = name(&head);
        if let Some(file) = open(&folder, &name)?
            && samples_of(file, &head).is_ok_and(|there| samples <= there)
        {
            return Ok(());
        }
        let write = |out: &mut dyn Write| {
            let mut out = Digested::new(Timed { out, deadline });
            writeln!(out, "{head}samples {samples}")?;
            kept.write(&mut out)?;
            let (mut out, digest) = out.finish();
            out.write_all(&digest)?;
            out.flush()
        };
        folder.replace(&name, write)?;
        tidy(&folder, &name);
        Ok(())
    }

    /// Reads the trace that was kept of a picture and that the job can continue, if there is one.
    /// Removes a damaged one.
    pub(super) fn read(&self, picture: &Provenance, job: &Job) -> Result<Option<Kept>, Unreadable> {
        let Some(folder) = Folder::find(&self.state, Part::Traces)? else {
            return Ok(None);
        };
        let head = head(picture);
        let name = name(&head);
        let Some(file) = open(&folder, &name)? else {
            return Ok(None);
        };
        let read = || {
            let mut from = Digested::new(BufReader::with_capacity(CHUNK, file));
            check_head(&mut from, &head)?;
            samples_in(&mut from)?;
            let kept = Kept::read(&mut from, job)?;
            let (from, digest) = from.finish();
            let mut end = Vec::new();
            from.take(digest.len() as u64 + 1).read_to_end(&mut end)?;
            if end != digest {
                return Err(io::Error::from(ErrorKind::InvalidData));
            }
            Ok(kept)
        };
        read().map(Some).map_err(|error| match error.kind() {
            ErrorKind::InvalidData | ErrorKind::UnexpectedEof => {
                let _ = folder.remove(&name);
                Unreadable::Damaged
            }
            _ => error.into(),
        })
    }
}

/// The name of the file of a picture.
fn name(head: &str) -> String {
    let digest = Digest::of([head.as_bytes()]);
    format!("{}{END}", &digest[..DIGITS])
}

/// Whether a file may have this name.
fn is_name(name: &str) -> bool {
    let digits = name.strip_suffix(END);
    let is_digit = |byte: u8| matches!(byte, b'0'..=b'9' | b'a'..=b'f');
    digits.is_some_and(|digits| digits.len() == DIGITS && digits.bytes().all(is_digit))
}

/// Whether this is the name of a temporary file left by an unfinished write.
fn is_left_behind(name: &str, modified: SystemTime) -> bool {
    let name = name.strip_suffix(NEW);
    let meant = name.and_then(|name| name.rsplit_once('.'));
    let is_old = modified.elapsed().is_ok_and(|age| LEFT_BEHIND < age);
    is_old && meant.is_some_and(|(name, _)| is_name(name))
}

/// Opens a file, if it exists. Fails unless it begins like a trace.
fn open(folder: &Folder, name: &str) -> io::Result<Option<File>> {
    let Some(mut file) = folder.open(name)? else {
        return Ok(None);
    };
    let mut kind = [0; KIND.len()];
    if file.read_exact(&mut kind).is_err() || kind != KIND.as_bytes() {
        let place = folder.place(name);
        let place = place.display();
        let reason = format!("{place} is not a Halflight trace; move it elsewhere");
        return Err(io::Error::new(ErrorKind::InvalidInput, reason));
    }
    file.rewind()?;
    Ok(Some(file))
}

/// The number of samples that a file says it has. Fails if it is of another picture.
fn samples_of(file: File, head: &str) -> io::Result<u64> {
    let mut from = BufReader::new(file);
    check_head(&mut from, head)?;
    samples_in(&mut from)
}

/// Removes what was left behind, and the oldest traces but the newest, which was just written, if
/// there are too many.
fn tidy(folder: &Folder, newest: &str) {
    let dated = |name: String| {
        let found = open(folder, &name).ok()??.metadata().ok()?;
        let written = found.modified().unwrap_or(SystemTime::UNIX_EPOCH);
        Some((written, found.len(), name))
    };
    let names = folder.names().into_iter();
    let names = names.filter(|name| is_name(name) || name.ends_with(NEW));
    let (mut traces, mut others): (Vec<_>, Vec<_>) = names
        .filter_map(dated)
        .partition(|(.., name)| is_name(name));
    others.retain(|(written, _, name)| is_left_behind(name, *written));
    for (.., name) in others {
        let _ = folder.remove(&name);
    }
    let is_newest = |(.., name): &(SystemTime, u64, String)| name == newest;
    let newest = traces.extract_if(.., |trace| is_newest(trace));
    let mut bytes: u64 = newest.map(|(_, length, _)| length).sum();
    traces.sort_unstable();
    for (number, (_, length, name)) in traces.into_iter().rev().enumerate() {
        bytes = bytes.saturating_add(length);
        if MOST <= number + 1 || MOST_BYTES < bytes {
            let _ = folder.remove(&name);
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
    if found != head.as_bytes() {
        return Err(ErrorKind::InvalidData.into());
    }
    Ok(())
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
            let reason = "writing it takes too long";
            return Err(io::Error::new(ErrorKind::TimedOut, reason));
        }
        self.out.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
pub(super) mod tests;
