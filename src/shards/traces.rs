//! Full-size traces of the interface, kept for the next run and for renders: `halflight/traces` in the
//! state folder, readable by their owner only.
//!
//! A trace is a part file that is the whole picture, written at once. Its header says what the film is
//! made from that all pictures of it share; it is named after their digest. Files that have no such
//! name, or do not begin like a part, are never replaced or removed.

use std::fs::File;
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use super::contents::Contents;
use super::header::{Header, OldForm};
use super::reader::Unreadable;
use super::record::Goal;
use super::shard::Shard;
use super::writer::write_whole;
use file::Digest;
use file::state_folder::{self, Folder, NEW, Store};
use render::{Checkpoint, Provenance};

/// How the first line of every form of parts begins.
const KIND: &str = "halflight part ";

/// The end of the names of files, and the length of what is before it: hexadecimal digits.
const END: &str = ".part";
const DIGITS: usize = 32;

/// The end of the names of traces of earlier forms.
const OLD_END: &str = ".trace";

/// Unfinished files are removed after this time; writing one takes far less.
const LEFT_BEHIND: Duration = Duration::from_secs(3600);

/// The most files, and the most bytes of all of them; the newest alone may have more.
const MOST: usize = 4;
const MOST_BYTES: u64 = 2 << 30;

/// The folder of kept traces.
#[derive(Clone, Debug)]
pub struct Traces {
    /// The state folder, which need not exist.
    state: PathBuf,
}

/// Why a kept trace cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum NoTrace {
    /// Its bytes are not those that were written. It was removed.
    #[error("the full-size trace of an earlier run was damaged and has been removed")]
    Damaged,
    /// It has the form of an earlier version.
    #[error("the full-size trace {path} {form}", path = path.display())]
    Old {
        /// The file.
        path: PathBuf,
        /// Its form.
        form: OldForm,
    },
    /// The file system reported an error, or memory is short.
    #[error("the full-size trace of an earlier run cannot be read: {0}")]
    Io(#[from] io::Error),
}

impl Traces {
    /// The folder in the user's state folder. Fails if the environment names none.
    pub fn of_user() -> io::Result<Self> {
        Ok(Self::below(state_folder::path()?))
    }

    /// The folder in a state folder.
    pub fn below(state: PathBuf) -> Self {
        Self { state }
    }

    /// Writes a trace, unless as many samples of it are kept already, and removes the oldest ones
    /// beyond [`MOST`] and [`MOST_BYTES`]. Stops at the deadline, which leaves what was there.
    pub fn write(
        &self,
        picture: &Provenance,
        kept: &Checkpoint,
        deadline: Instant,
    ) -> io::Result<()> {
        let folder = Folder::make(&self.state, Store::Traces)?;
        let picture = picture.of_film();
        let name = name(&picture);
        if let Some(file) = open(&folder, &name)?
            && let Ok(there) = Contents::of(file)
            && is_whole(&there, &picture)
            && kept.samples() <= there.all_taken()
        {
            return Ok(());
        }
        let goal = Goal {
            spp: kept.goal(),
            time: kept.time(),
        };
        let write = |out: &mut dyn Write| {
            let mut out = Timed { out, deadline };
            write_whole(&picture, goal, kept.blocks(), &mut out)
        };
        folder.replace(&name, write)?;
        tidy(&folder, &name);
        Ok(())
    }

    /// The trace that was kept of the film of a picture, if there is one. Pictures of noise, cost and
    /// samples have none. Removes a damaged one.
    pub fn find(&self, picture: &Provenance) -> Result<Option<Contents>, NoTrace> {
        if !picture.is_of_film() {
            return Ok(None);
        }
        let Some(folder) = Folder::find(&self.state, Store::Traces)? else {
            return Ok(None);
        };
        let picture = picture.of_film();
        let name = name(&picture);
        let Some(file) = open(&folder, &name)? else {
            return find_old(&folder, &picture);
        };
        match Contents::of(file) {
            Ok(contents) if is_whole(&contents, &picture) => Ok(Some(contents)),
            Err(Unreadable::Io(error)) => Err(error.into()),
            Err(Unreadable::Old(form)) => Err(NoTrace::Old {
                path: folder.place(&name),
                form,
            }),
            Ok(_) | Err(Unreadable::NoPart) => {
                let _ = folder.remove(&name);
                Err(NoTrace::Damaged)
            }
        }
    }
}

/// The part at a path, if there is one of the film of a picture, and all of it.
pub fn find_part(path: &Path, picture: &Provenance) -> Option<Contents> {
    let contents = Contents::of(file::open(path).ok()?).ok()?;
    is_of(contents.header(), &picture.of_film()).then_some(contents)
}

/// Whether a trace is as it was written, of this film.
fn is_whole(contents: &Contents, picture: &Provenance) -> bool {
    contents.is_whole() && is_of(contents.header(), picture)
}

/// Whether a file is the only part of a picture that the film behind it shows.
fn is_of(header: &Header, film: &Provenance) -> bool {
    let is_seen = header.picture.is_of_film();
    is_seen && header.shard == Shard::WHOLE && header.picture.of_film().lines() == film.lines()
}

/// Fails if there is a trace of a film in an earlier form.
fn find_old(folder: &Folder, picture: &Provenance) -> Result<Option<Contents>, NoTrace> {
    for kind in OldForm::TRACES {
        let head = format!("{kind}\n{}", picture.lines());
        let name = format!("{}{OLD_END}", digits(&head));
        if let Some(file) = folder.open(&name)? {
            let mut beginning = String::new();
            let read = file.take(head.len() as u64).read_to_string(&mut beginning);
            if let Some(form) = read.ok().and_then(|_| OldForm::of(&beginning)) {
                let path = folder.place(&name);
                return Err(NoTrace::Old { path, form });
            }
        }
    }
    Ok(None)
}

/// The name of the file of a film.
fn name(picture: &Provenance) -> String {
    format!("{}{END}", digits(&picture.lines()))
}

fn digits(text: &str) -> String {
    let mut digest = Digest::of([text.as_bytes()]);
    digest.truncate(DIGITS);
    digest
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
mod tests;
